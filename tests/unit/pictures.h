/* PNG files made by libpng, for the tests of what reads them. */
#ifndef MONGE_TESTS_PICTURES_H
#define MONGE_TESTS_PICTURES_H

#include <limits.h>
#include <png.h>
#include <string.h>
#include <unistd.h>

#include "folder.h"
#include "monge.h"
#include "near.h"

/* A file to be written. Zeroed fields are the usual. */
struct sample {
    uint32_t width, height;
    int type, bits;         /* PNG_COLOR_TYPE_RGB, 8 */
    bool interlaced, keyed; /* keyed: with a tRNS chunk */
    int filters;            /* PNG_ALL_FILTERS */
    int pieces;             /* bytes of an IDAT chunk */
    int gamma;              /* times 100000 */
    bool srgb;
    const char *before, *behind;                   /* texts */
    uint8_t (*byte)(size_t x, size_t y, size_t i); /* byte i of pixel x of row y */
};

#define SAMPLE(width_, height_, ...) (&(struct sample){.width = (width_), .height = (height_), __VA_ARGS__})

/* Noise on a slope, so that every filter is of use somewhere. */
static inline uint8_t sample_byte(size_t x, size_t y, size_t i) {
    uint64_t z = (x * 7919 + y) * 31 + i;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    return (uint8_t)(x * 3 + y * 5 + i * 11 + (z >> 60));
}

static inline void sample_chunks(const struct sample *s, png_structp png, png_infop info, bool behind) {
    png_color palette[256];
    png_byte alpha[256];
    png_color_16 key = {.gray = 1, .red = 10, .green = 20, .blue = 30};
    png_text texts[2] = {{.compression = PNG_TEXT_COMPRESSION_zTXt, .key = (char *)"Comment"},
                         {.compression = PNG_ITXT_COMPRESSION_NONE, .key = (char *)"monge:scene"}};
    texts[0].text = texts[1].text = (char *)(behind ? s->behind : s->before);
    if (texts[0].text) png_set_text(png, info, texts, 2);
    if (behind) return;
    for (int i = 0; i < 256; i++) {
        palette[i] = (png_color){(png_byte)(i * 5), (png_byte)(255 - i), (png_byte)(i ^ 85)};
        alpha[i] = (png_byte)(i * 3);
    }
    if (s->type == PNG_COLOR_TYPE_PALETTE) png_set_PLTE(png, info, palette, 1 << s->bits);
    if (s->keyed)
        png_set_tRNS(png, info, alpha, s->type == PNG_COLOR_TYPE_PALETTE ? (1 << s->bits) - 1 : 0, &key);
    if (s->gamma) png_set_gAMA_fixed(png, info, s->gamma);
    if (s->srgb) png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
}

static inline void write_sample(const char *path, const struct sample *given) {
    struct sample s = *given;
    if (!s.bits) s.bits = 8, s.type = s.type ? s.type : PNG_COLOR_TYPE_RGB;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png), end = png_create_info_struct(png);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    png_init_io(png, file);
    png_set_IHDR(png, info, s.width, s.height, s.bits, s.type,
                 s.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_set_filter(png, 0, s.filters ? s.filters : PNG_ALL_FILTERS);
    if (s.pieces) png_set_compression_buffer_size(png, (size_t)s.pieces);
    sample_chunks(&s, png, info, false);
    png_write_info(png, info);
    const size_t size = png_get_rowbytes(png, info), pixel = size / s.width ? size / s.width : 1;
    uint8_t *row = malloc(size);
    const int passes = png_set_interlace_handling(png);
    for (int pass = 0; pass < passes; pass++)
        for (uint32_t y = 0; y < s.height; y++) {
            for (size_t i = 0; i < size; i++)
                row[i] = (s.byte ? s.byte : sample_byte)(i / pixel, y, i % pixel);
            png_write_row(png, row);
        }
    sample_chunks(&s, png, end, true);
    png_write_end(png, end);
    png_destroy_info_struct(png, &end);
    png_destroy_write_struct(&png, &info);
    fclose(file);
    free(row);
}

/* A picture that can be read. */
static inline struct monge_picture *read_good(const char *path) {
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_picture *picture = monge_picture_read(path, diag);
    if (!picture) monge_diagnostics_print(diag, stdout);
    assert_non_null(picture);
    monge_diagnostics_free(diag);
    return picture;
}

#endif
