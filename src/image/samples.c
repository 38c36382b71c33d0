#include "image/samples.h"

#include <assert.h>
#include <stdio.h>
#include <string.h>

#include "image/png_file.h"

enum { SHORT_TEXT = 200 /* bytes; compressing fewer gains nothing */ };

void samples_add_text(struct samples *samples, const char *key, const char *text) {
    if (!text) return;
    assert(samples->text_count < SAMPLES_TEXTS);
    samples->texts[samples->text_count++] = (struct samples_text){key, text};
}

static void set_texts(struct png_file *file, const struct samples *samples) {
    for (unsigned i = 0; i < samples->text_count; i++) {
        const struct samples_text *from = &samples->texts[i];
        const bool is_short = strlen(from->text) < SHORT_TEXT;
        const png_text text = {.compression =
                                   is_short ? PNG_ITXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_zTXt,
                               .key = (char *)from->key, /* libpng does not write there */
                               .text = (char *)from->text};
        png_set_text(file->png, file->info, &text, 1);
    }
}

static void put_samples(struct png_file *file, const void *context) {
    const struct samples *samples = context;
    png_set_filter(file->png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
    png_set_compression_level(file->png, 3);
    png_set_IHDR(file->png, file->info, samples->width, samples->height, 16,
                 samples->channels == 1 ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_BASE, PNG_FILTER_TYPE_BASE);
    set_texts(file, samples);
    png_write_info(file->png, file->info);
    const size_t count = (size_t)samples->width * samples->channels;
    for (uint32_t y = 0; y < samples->height; y++) {
        const uint16_t *values = samples->values + y * count;
        for (size_t i = 0; i < count; i++) {
            file->row[2 * i] = (uint8_t)(values[i] >> 8);
            file->row[2 * i + 1] = (uint8_t)values[i];
        }
        png_write_row(file->png, file->row);
    }
    png_write_end(file->png, NULL);
}

bool samples_write(const char *path, const struct samples *samples, char *message, size_t size) {
    struct png_file file;
    if (png_file_write(&file, path, (size_t)samples->width * samples->channels * 2, put_samples, samples))
        return true;
    snprintf(message, size, "cannot write %s: %s", path, file.reason);
    return false;
}
