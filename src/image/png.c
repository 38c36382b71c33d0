#include "image/png.h"

#include <stdio.h>
#include <string.h>
#include <zlib.h>

#include "base/program.h"
#include "image/encode.h"
#include "image/pixels.h"
#include "image/png_file.h"

/* As it is where it is ASCII; else in the kind of chunk that is UTF-8. libpng copies both texts. */
static void set_text(struct png_file *file, char *key, char *value) {
    bool ascii = true;
    for (const char *c = value; *c; c++) ascii &= (unsigned char)*c < 0x80;
    const png_text text = {.compression = ascii ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE,
                           .key = key,
                           .text = value};
    png_set_text(file->png, file->info, &text, 1);
}

static void set_hash(struct png_file *file, char *key, const struct hash *hash) {
    char text[HASH_TEXT_SIZE];
    hash_text(hash, text);
    set_text(file, key, text);
}

static void set_texts(struct png_file *file, const struct monge_film *film) {
    const struct monge_settings *settings = &film->settings;
    const struct monge_region r = film->region;
    char software[] = "Monge " MONGE_VERSION, region[80];
    set_text(file, "Software", software);
    set_text(file, "monge:program", (char *)program_hash);
    set_hash(file, "monge:scene", &film->scene);
    set_hash(file, "monge:text", &film->texts);
    if (film->files && *film->files) set_text(file, "monge:files", film->files);
    if (film->options && *film->options) set_text(file, "monge:options", film->options);
    if (film->passes && *film->passes) set_text(file, "monge:passes", film->passes);
    if (r.width == settings->width && r.height == settings->height) return;
    snprintf(region, sizeof region, "%u,%u,%u,%u of %ux%u", r.x, r.y, r.width, r.height, settings->width,
             settings->height);
    set_text(file, "monge:region", region);
}

/* Differences from the left neighbour. At 8 bits Z_RLE takes 10 to 35 ms for 1024x1024; zlib's level 4
 * makes clean pictures a sixth smaller and grainy ones larger, in up to twice the time. At 16 bits level
 * 1 takes 30 to 60 ms, as does Z_RLE, for a third less (grainy: 190 ms, and Z_RLE would take 65). */
static void set_compression(struct png_file *file, unsigned bits) {
    png_set_filter(file->png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
    if (bits == 8)
        png_set_compression_strategy(file->png, Z_RLE);
    else
        png_set_compression_level(file->png, 1);
    png_set_compression_buffer_size(file->png, 1 << 16);
}

static void write_header(struct png_file *file, const struct monge_film *film) {
    const struct monge_region region = film->region;
    const struct monge_settings *settings = &film->settings;
    set_compression(file, settings->bits);
    png_set_IHDR(file->png, file->info, region.width, region.height, (int)settings->bits, PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_BASE, PNG_FILTER_TYPE_BASE);
    if (settings->encoding == MONGE_ENCODING_SRGB)
        png_set_sRGB(file->png, file->info, PNG_sRGB_INTENT_PERCEPTUAL);
    else
        png_set_gAMA_fixed(file->png, file->info, PNG_FP_1);
    set_texts(file, film);
    png_write_info(file->png, file->info);
}

static void put_film(struct png_file *file, const void *context) {
    const struct monge_film *film = context;
    const struct monge_region region = film->region;
    const struct monge_settings *settings = &film->settings;
    const size_t channels = 3 * (size_t)region.width;
    struct encoder encoder;
    struct hash pixels;
    write_header(file, film);
    encoder_init(&encoder, settings->encoding, settings->bits);
    pixels_hash_begin(&pixels, region.width, region.height, settings->bits, settings->encoding);
    for (uint32_t y = 0; y < region.height; y++) {
        encoder_bytes(&encoder, film_pixel(film, 0, y), channels, file->row);
        hash_bulk(&pixels, file->row, channels * (settings->bits / 8));
        png_write_row(file->png, file->row);
    }
    set_hash(file, "monge:pixels", &pixels); /* behind the pixels: by now they are known */
    png_write_end(file->png, file->info);
}

bool png_write_film(const struct monge_film *film, const char *path, char *message, size_t size) {
    struct png_file file;
    const size_t row_size = (size_t)film->region.width * 3 * (film->settings.bits / 8);
    if (png_file_write(&file, path, row_size, put_film, film)) return true;
    const char *name = strcmp(path, "-") == 0 ? "standard output" : path;
    snprintf(message, size, "cannot write %s: %s", name, file.reason);
    return false;
}
