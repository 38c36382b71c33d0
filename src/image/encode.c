#include "image/encode.h"

#include <math.h>
#include <string.h>

#include "base/elementary.h"

#define SRGB_KNEE 0.0031308 /* where the curve of IEC 61966-2-1 goes from a line to a power */

/* Between two knots the curve rises above its chord by at most (h/x)^2/8 * 1.055 * 1/2.4 * (1 - 1/2.4)
 * = 1.23e-7, where h/x = 1/512. */
#define CHORD_ERROR 1.5e-7

enum { FIRST_KNOT_BITS = 0x3b000000 /* of the float 2^-9 */, KNOT_SHIFT = 14 /* 2^23 / 512 = 2^14 */ };

static double srgb_line(double linear) { return 12.92 * linear; }
static double srgb_power(double linear) { return 1.055 * elementary_pow(linear, 1.0 / 2.4) - 0.055; }

static uint16_t nearest_code(double encoded, double max) { return (uint16_t)(encoded * max + 0.5); }

uint16_t encode_channel(float linear, enum monge_encoding encoding, unsigned bits) {
    const double max = (double)((1u << bits) - 1);
    const double value = (double)linear;
    if (!(value > 0.0)) return 0; /* negated, so NaN is 0 */
    if (value >= 1.0) return (uint16_t)max;
    if (encoding == MONGE_ENCODING_LINEAR) return nearest_code(value, max);
    return nearest_code(value <= SRGB_KNEE ? srgb_line(value) : srgb_power(value), max);
}

static float float_from_bits(uint32_t bits) {
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static uint32_t bits_from_float(float value) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

void encoder_init(struct encoder *encoder, enum monge_encoding encoding, unsigned bits) {
    encoder->encoding = encoding;
    encoder->bits = bits;
    encoder->max = (double)((1u << bits) - 1);
    if (encoding == MONGE_ENCODING_LINEAR) return;
    for (uint32_t i = 0; i < ENCODER_KNOTS; i++)
        encoder->knot[i] = srgb_power((double)float_from_bits(FIRST_KNOT_BITS + (i << KNOT_SHIFT)));
}

/* encode_channel of a value between the knee and 1. The chord between two knots decides, unless the
 * true curve could lie on the other side of a rounding step. */
static inline uint16_t power_code(const struct encoder *encoder, float linear) {
    const uint32_t offset = bits_from_float(linear) - FIRST_KNOT_BITS;
    const double *knot = encoder->knot + (offset >> KNOT_SHIFT);
    const double part = (double)(int32_t)(offset & ((1u << KNOT_SHIFT) - 1)) * (1.0 / (1u << KNOT_SHIFT));
    const double scaled = (knot[0] + part * (knot[1] - knot[0])) * encoder->max + 0.5;
    const int32_t code = (int32_t)scaled;
    const double margin = CHORD_ERROR * encoder->max;
    if (fabs(scaled - code - 0.5) < 0.5 - margin) return (uint16_t)code;
    return encode_channel(linear, encoder->encoding, encoder->bits);
}

static inline uint16_t encoder_code(const struct encoder *encoder, float linear) {
    if (encoder->encoding == MONGE_ENCODING_SRGB && (double)linear > SRGB_KNEE && linear < 1.0f)
        return power_code(encoder, linear);
    return encode_channel(linear, encoder->encoding, encoder->bits);
}

void encoder_bytes(const struct encoder *encoder, const float *linear, size_t count, uint8_t *bytes) {
    if (encoder->bits == 8) {
        for (size_t i = 0; i < count; i++) bytes[i] = (uint8_t)encoder_code(encoder, linear[i]);
        return;
    }
    for (size_t i = 0; i < count; i++) {
        const uint16_t code = encoder_code(encoder, linear[i]);
        bytes[2 * i] = (uint8_t)(code >> 8);
        bytes[2 * i + 1] = (uint8_t)code;
    }
}
