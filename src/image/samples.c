#include "image/samples.h"

#include <errno.h>
#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/replace.h"

enum {
    SHORT_TEXT = 200,    /* bytes; compressing fewer gains nothing */
    MOST_TEXT = 1 << 28, /* bytes of a text that is read */
};

/* One file on its way. Everything that libpng's longjmp must not lose lives here. */
struct transfer {
    png_structp png;
    png_infop info;
    uint8_t *row;
    char reason[128];
};

static void on_error(png_structp png, png_const_charp text) {
    struct transfer *t = png_get_error_ptr(png);
    snprintf(t->reason, sizeof t->reason, "%s", text);
    png_longjmp(png, 1);
}

static void on_warning(png_structp png, png_const_charp text) { (void)png, (void)text; }

static void on_write(png_structp png, png_bytep bytes, size_t size) {
    if (fwrite(bytes, 1, size, png_get_io_ptr(png)) != size) png_error(png, strerror(errno));
}

static void on_flush(png_structp png) { (void)png; }

static void on_read(png_structp png, png_bytep bytes, size_t size) {
    if (fread(bytes, 1, size, png_get_io_ptr(png)) != size) png_error(png, "it ends too early");
}

/* ---- Writing ---- */

static void set_texts(struct transfer *t, const struct samples *samples) {
    for (unsigned i = 0; i < samples->text_count; i++) {
        const struct samples_text *from = &samples->texts[i];
        const bool is_short = strlen(from->text) < SHORT_TEXT;
        const png_text text = {.compression = is_short ? PNG_ITXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_zTXt,
                               .key = from->key,
                               .text = from->text};
        png_set_text(t->png, t->info, &text, 1);
    }
}

static bool write_stream(struct transfer *t, const struct samples *samples) {
    if (setjmp(png_jmpbuf(t->png))) return false;
    png_set_filter(t->png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
    png_set_compression_level(t->png, 3);
    png_set_IHDR(t->png, t->info, samples->width, samples->height, 16,
                 samples->channels == 1 ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_BASE, PNG_FILTER_TYPE_BASE);
    set_texts(t, samples);
    png_write_info(t->png, t->info);
    const size_t count = (size_t)samples->width * samples->channels;
    for (uint32_t y = 0; y < samples->height; y++) {
        const uint16_t *values = samples->values + y * count;
        for (size_t i = 0; i < count; i++) {
            t->row[2 * i] = (uint8_t)(values[i] >> 8);
            t->row[2 * i + 1] = (uint8_t)values[i];
        }
        png_write_row(t->png, t->row);
    }
    png_write_end(t->png, NULL);
    return true;
}

static bool write_samples(struct transfer *t, const struct samples *samples, FILE *stream) {
    bool written = false;
    snprintf(t->reason, sizeof t->reason, "%s", strerror(ENOMEM));
    t->row = malloc((size_t)samples->width * samples->channels * 2);
    t->png = png_create_write_struct(PNG_LIBPNG_VER_STRING, t, on_error, on_warning);
    if (t->png) t->info = png_create_info_struct(t->png);
    if (t->row && t->info) {
        png_set_write_fn(t->png, stream, on_write, on_flush);
        written = write_stream(t, samples);
    }
    png_destroy_write_struct(&t->png, &t->info);
    free(t->row);
    return written;
}

static bool write_file(struct transfer *t, const char *path, const struct samples *samples) {
    struct replacement file;
    if (replace_begin(&file, path)) {
        if (!write_samples(t, samples, file.stream)) {
            replace_abandon(&file);
            return false;
        }
        if (replace_commit(&file)) return true;
    }
    snprintf(t->reason, sizeof t->reason, "%s", strerror(errno));
    return false;
}

bool samples_write(const char *path, const struct samples *samples, char *message, size_t size) {
    struct transfer t = {.png = NULL};
    if (write_file(&t, path, samples)) return true;
    snprintf(message, size, "cannot write %s: %s", path, t.reason);
    return false;
}

/* ---- Reading ---- */

static void get_texts(struct transfer *t, struct samples *samples) {
    png_textp texts = NULL;
    const int count = png_get_text(t->png, t->info, &texts, NULL);
    for (int i = 0; i < count; i++)
        for (unsigned k = 0; k < samples->text_count; k++)
            if (strcmp(samples->texts[k].key, texts[i].key) == 0 && !samples->texts[k].text)
                samples->texts[k].text = strdup(texts[i].text);
}

static void read_header(struct transfer *t, uint64_t most, struct samples *samples) {
    png_set_chunk_malloc_max(t->png, MOST_TEXT);
    png_read_info(t->png, t->info);
    const int color = png_get_color_type(t->png, t->info);
    samples->width = png_get_image_width(t->png, t->info);
    samples->height = png_get_image_height(t->png, t->info);
    samples->channels = color == PNG_COLOR_TYPE_GRAY ? 1 : 3;
    if (png_get_bit_depth(t->png, t->info) != 16 || png_get_interlace_type(t->png, t->info) ||
        (color != PNG_COLOR_TYPE_GRAY && color != PNG_COLOR_TYPE_RGB))
        png_error(t->png, "it is no layer: those have 16 bits, grey or RGB");
    if ((uint64_t)samples->width * samples->height > most) png_error(t->png, "it has too many pixels");
    t->row = malloc((size_t)samples->width * samples->channels * 2);
    samples->values =
        malloc((size_t)samples->width * samples->height * samples->channels * sizeof *samples->values);
    if (!t->row || !samples->values) png_error(t->png, strerror(ENOMEM));
}

static bool read_stream(struct transfer *t, uint64_t most, struct samples *samples) {
    if (setjmp(png_jmpbuf(t->png))) return false;
    read_header(t, most, samples);
    const size_t count = (size_t)samples->width * samples->channels;
    for (uint32_t y = 0; y < samples->height; y++) {
        uint16_t *values = samples->values + y * count;
        png_read_row(t->png, t->row, NULL);
        for (size_t i = 0; i < count; i++)
            values[i] = (uint16_t)(t->row[2 * i] << 8 | t->row[2 * i + 1]);
    }
    png_read_end(t->png, t->info);
    get_texts(t, samples);
    return true;
}

static bool read_samples(struct transfer *t, FILE *stream, uint64_t most, struct samples *samples) {
    bool good = false;
    snprintf(t->reason, sizeof t->reason, "%s", strerror(ENOMEM));
    t->png = png_create_read_struct(PNG_LIBPNG_VER_STRING, t, on_error, on_warning);
    if (t->png) t->info = png_create_info_struct(t->png);
    if (t->info) {
        png_set_read_fn(t->png, stream, on_read);
        good = read_stream(t, most, samples);
    }
    png_destroy_read_struct(&t->png, &t->info, NULL);
    free(t->row);
    return good;
}

bool samples_read(const char *path, uint64_t most, struct samples *samples, char *message, size_t size) {
    struct transfer t = {.png = NULL};
    FILE *stream = fopen(path, "rb");
    snprintf(t.reason, sizeof t.reason, "%s", strerror(errno));
    const bool good = stream && read_samples(&t, stream, most, samples);
    if (stream) fclose(stream);
    if (!good) snprintf(message, size, "cannot read %s: %s", path, t.reason);
    return good;
}

void samples_free(struct samples *samples) {
    free(samples->values);
    for (unsigned i = 0; i < samples->text_count; i++) free(samples->texts[i].text);
}
