/* From linear colour to the numbers of a file. */
#ifndef MONGE_IMAGE_ENCODE_H
#define MONGE_IMAGE_ENCODE_H

#include <stddef.h>
#include <stdint.h>

#include "monge.h"

/* Clamps a linear value to 0..1 (NaN to 0), encodes it and rounds to the nearest of 0 .. 2^bits - 1.
 * bits is 8 or 16. sRGB as IEC 61966-2-1 has it. This is the definition; a power a call makes it slow. */
uint16_t encode_channel(float linear, enum monge_encoding encoding, unsigned bits);

enum { ENCODER_KNOTS = 9 * 512 + 1 };

/* encode_channel for a whole picture: the same numbers, most of them without a power. */
struct encoder {
    enum monge_encoding encoding;
    unsigned bits;
    double max;                 /* 2^bits - 1 */
    double knot[ENCODER_KNOTS]; /* the sRGB curve at 512 even steps an octave, from 2^-9 to 1 */
};

void encoder_init(struct encoder *encoder, enum monge_encoding encoding, unsigned bits);

/* encode_channel of each of `count` values, in one byte each for 8 bits, in two for 16, the high one first. */
void encoder_bytes(const struct encoder *encoder, const float *linear, size_t count, uint8_t *bytes);

#endif
