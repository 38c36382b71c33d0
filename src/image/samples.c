#include "image/samples.h"

#include <errno.h>
#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/replace.h"

enum { SHORT_TEXT = 200 /* bytes; compressing fewer gains nothing */ };

/* One file on its way. Everything that libpng's longjmp must not lose lives here. */
struct writer {
    png_structp png;
    png_infop info;
    uint8_t *row;
    char reason[128];
};

static void on_error(png_structp png, png_const_charp text) {
    struct writer *w = png_get_error_ptr(png);
    snprintf(w->reason, sizeof w->reason, "%s", text);
    png_longjmp(png, 1);
}

static void on_warning(png_structp png, png_const_charp text) { (void)png, (void)text; }

static void on_write(png_structp png, png_bytep bytes, size_t size) {
    if (fwrite(bytes, 1, size, png_get_io_ptr(png)) != size) png_error(png, strerror(errno));
}

static void on_flush(png_structp png) { (void)png; }

static void set_texts(struct writer *w, const struct samples *samples) {
    for (unsigned i = 0; i < samples->text_count; i++) {
        const struct samples_text *from = &samples->texts[i];
        const bool is_short = strlen(from->text) < SHORT_TEXT;
        const png_text text = {.compression =
                                   is_short ? PNG_ITXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_zTXt,
                               .key = from->key,
                               .text = from->text};
        png_set_text(w->png, w->info, &text, 1);
    }
}

static bool write_stream(struct writer *w, const struct samples *samples) {
    if (setjmp(png_jmpbuf(w->png))) return false;
    png_set_filter(w->png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
    png_set_compression_level(w->png, 3);
    png_set_IHDR(w->png, w->info, samples->width, samples->height, 16,
                 samples->channels == 1 ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_BASE, PNG_FILTER_TYPE_BASE);
    set_texts(w, samples);
    png_write_info(w->png, w->info);
    const size_t count = (size_t)samples->width * samples->channels;
    for (uint32_t y = 0; y < samples->height; y++) {
        const uint16_t *values = samples->values + y * count;
        for (size_t i = 0; i < count; i++) {
            w->row[2 * i] = (uint8_t)(values[i] >> 8);
            w->row[2 * i + 1] = (uint8_t)values[i];
        }
        png_write_row(w->png, w->row);
    }
    png_write_end(w->png, NULL);
    return true;
}

static bool write_samples(struct writer *w, const struct samples *samples, FILE *stream) {
    bool written = false;
    snprintf(w->reason, sizeof w->reason, "%s", strerror(ENOMEM));
    w->row = malloc((size_t)samples->width * samples->channels * 2);
    w->png = png_create_write_struct(PNG_LIBPNG_VER_STRING, w, on_error, on_warning);
    if (w->png) w->info = png_create_info_struct(w->png);
    if (w->row && w->info) {
        png_set_write_fn(w->png, stream, on_write, on_flush);
        written = write_stream(w, samples);
    }
    png_destroy_write_struct(&w->png, &w->info);
    free(w->row);
    return written;
}

static bool write_file(struct writer *w, const char *path, const struct samples *samples) {
    struct replacement file;
    if (replace_begin(&file, path)) {
        if (!write_samples(w, samples, file.stream)) {
            replace_abandon(&file);
            return false;
        }
        if (replace_commit(&file)) return true;
    }
    snprintf(w->reason, sizeof w->reason, "%s", strerror(errno));
    return false;
}

bool samples_write(const char *path, const struct samples *samples, char *message, size_t size) {
    struct writer w = {.png = NULL};
    if (write_file(&w, path, samples)) return true;
    snprintf(message, size, "cannot write %s: %s", path, w.reason);
    return false;
}
