#include "image/png.h"

#include <errno.h>
#include <png.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#include "base/program.h"
#include "image/encode.h"
#include "image/pixels.h"
#include "image/replace.h"

/* One picture on its way to a stream. Everything that libpng's longjmp must not lose lives here. */
struct writer {
    const struct monge_film *film;
    png_structp png;
    png_infop info;
    uint8_t *row; /* encoded bytes of one row */
    char reason[128];
    struct encoder encoder;
    struct hash pixels; /* of the rows so far */
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

/* As it is where it is ASCII; else in the kind of chunk that is UTF-8. libpng copies both texts. */
static void set_text(struct writer *w, char *key, char *value) {
    bool ascii = true;
    for (const char *c = value; *c; c++) ascii &= (unsigned char)*c < 0x80;
    const png_text text = {.compression = ascii ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE,
                           .key = key,
                           .text = value};
    png_set_text(w->png, w->info, &text, 1);
}

static void set_hash(struct writer *w, char *key, const struct hash *hash) {
    char text[HASH_TEXT_SIZE];
    hash_text(hash, text);
    set_text(w, key, text);
}

static void set_texts(struct writer *w) {
    const struct monge_film *film = w->film;
    const struct monge_settings *settings = &film->settings;
    const struct monge_region r = film->region;
    char software[] = "Monge " MONGE_VERSION, region[80];
    set_text(w, "Software", software);
    set_text(w, "monge:program", (char *)program_hash);
    set_hash(w, "monge:scene", &film->scene);
    set_hash(w, "monge:text", &film->texts);
    if (film->files && *film->files) set_text(w, "monge:files", film->files);
    if (film->options && *film->options) set_text(w, "monge:options", film->options);
    if (film->passes && *film->passes) set_text(w, "monge:passes", film->passes);
    if (r.width == settings->width && r.height == settings->height) return;
    snprintf(region, sizeof region, "%u,%u,%u,%u of %ux%u", r.x, r.y, r.width, r.height, settings->width,
             settings->height);
    set_text(w, "monge:region", region);
}

/* Differences from the left neighbour. At 8 bits Z_RLE takes 10 to 35 ms for 1024x1024; zlib's level 4
 * makes clean pictures a sixth smaller and grainy ones larger, in up to twice the time. At 16 bits level
 * 1 takes 30 to 60 ms, as does Z_RLE, for a third less (grainy: 190 ms, and Z_RLE would take 65). */
static void set_compression(struct writer *w) {
    png_set_filter(w->png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
    if (w->film->settings.bits == 8)
        png_set_compression_strategy(w->png, Z_RLE);
    else
        png_set_compression_level(w->png, 1);
    png_set_compression_buffer_size(w->png, 1 << 16);
}

static void write_header(struct writer *w) {
    const struct monge_region region = w->film->region;
    const struct monge_settings *settings = &w->film->settings;
    set_compression(w);
    png_set_IHDR(w->png, w->info, region.width, region.height, (int)settings->bits, PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_BASE, PNG_FILTER_TYPE_BASE);
    if (settings->encoding == MONGE_ENCODING_SRGB)
        png_set_sRGB(w->png, w->info, PNG_sRGB_INTENT_PERCEPTUAL);
    else
        png_set_gAMA_fixed(w->png, w->info, PNG_FP_1);
    set_texts(w);
    png_write_info(w->png, w->info);
}

/* libpng's errors come back here by longjmp. */
static bool write_stream(struct writer *w) {
    if (setjmp(png_jmpbuf(w->png))) return false;
    write_header(w);
    const struct monge_region region = w->film->region;
    const struct monge_settings *settings = &w->film->settings;
    const size_t channels = 3 * (size_t)region.width;
    pixels_hash_begin(&w->pixels, region.width, region.height, settings->bits, settings->encoding);
    for (uint32_t y = 0; y < region.height; y++) {
        encoder_bytes(&w->encoder, film_pixel(w->film, 0, y), channels, w->row);
        hash_bulk(&w->pixels, w->row, channels * (settings->bits / 8));
        png_write_row(w->png, w->row);
    }
    set_hash(w, "monge:pixels", &w->pixels); /* behind the pixels: by now they are known */
    png_write_end(w->png, w->info);
    return true;
}

static bool write_picture(struct writer *w, FILE *stream) {
    const struct monge_settings *settings = &w->film->settings;
    bool written = false;
    w->row = malloc((size_t)w->film->region.width * 3 * (settings->bits / 8));
    w->png = png_create_write_struct(PNG_LIBPNG_VER_STRING, w, on_error, on_warning);
    if (w->png) w->info = png_create_info_struct(w->png);
    if (w->row && w->info) {
        png_set_write_fn(w->png, stream, on_write, on_flush);
        encoder_init(&w->encoder, settings->encoding, settings->bits);
        written = write_stream(w);
    } else {
        snprintf(w->reason, sizeof w->reason, "%s", strerror(ENOMEM));
    }
    png_destroy_write_struct(&w->png, &w->info);
    free(w->row);
    return written;
}

static bool write_file(struct writer *w, const char *path) {
    struct replacement file;
    if (replace_begin(&file, path)) {
        if (!write_picture(w, file.stream)) {
            replace_abandon(&file);
            return false;
        }
        if (replace_commit(&file)) return true;
    }
    snprintf(w->reason, sizeof w->reason, "%s", strerror(errno));
    return false;
}

bool png_write_film(const struct monge_film *film, const char *path, char *message, size_t size) {
    struct writer w = {.film = film};
    if (write_file(&w, path)) return true;
    const char *name = strcmp(path, "-") == 0 ? "standard output" : path;
    snprintf(message, size, "cannot write %s: %s", name, w.reason);
    return false;
}
