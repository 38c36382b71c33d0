/* PNG files of numbers that are no colours: 16 bits a channel, with texts beside them. */
#ifndef MONGE_IMAGE_SAMPLES_H
#define MONGE_IMAGE_SAMPLES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { SAMPLES_TEXTS = 8 };

struct samples {
    uint32_t width, height;
    unsigned channels; /* 1 or 3 */
    uint16_t *values;  /* row by row from the top left */
    struct samples_text {
        const char *key, *text; /* a keyword of PNG, and UTF-8; long ones are compressed */
    } texts[SAMPLES_TEXTS];
    unsigned text_count;
};

/* One more text, which stays the caller's; NULL is none. */
void samples_add_text(struct samples *samples, const char *key, const char *text);

/* Writes the file, complete or not at all, as png_write_film. False: the reason is in `message`. */
bool samples_write(const char *path, const struct samples *samples, char *message, size_t size);

#endif
