#include "image/heat.h"

#include <errno.h>
#include <math.h>
#include <png.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#include "image/flip.h"
#include "image/replace.h"

/* ---- Colours ---- */

/* From the least difference to the largest. Not from black: what differs is to be seen. */
static const double colors[][3] = {
    {92, 20, 128}, {160, 44, 120}, {222, 73, 84}, {250, 134, 64}, {254, 200, 96}, {252, 250, 196},
};

static void color_of(double error, uint8_t rgb[3]) {
    const double place = fmin(sqrt(error), 1.0) * (sizeof colors / sizeof *colors - 1); /* small ones apart */
    const size_t i = (size_t)fmin(place, sizeof colors / sizeof *colors - 2);
    for (int c = 0; c < 3; c++)
        rgb[c] = (uint8_t)(colors[i][c] + (place - (double)i) * (colors[i + 1][c] - colors[i][c]) + 0.5);
}

/* Dim grey of a pixel. */
static uint8_t grey_of(const struct monge_picture *picture, const uint8_t *at) {
    const size_t step = picture->channels >= 3 ? picture->bits / 8 : 0; /* high bytes alone */
    return (uint8_t)((299 * at[0] + 587 * at[step] + 114 * at[2 * step]) / 4000);
}

static void color_row(const struct monge_picture *a, uint32_t y, const float *errors, uint8_t *rgb) {
    const uint8_t *at = picture_row(a, y);
    for (uint32_t x = 0; x < a->width; x++, at += picture_pixel_size(a), rgb += 3) {
        if (errors[x] > 0.0f)
            color_of((double)errors[x], rgb);
        else
            memset(rgb, grey_of(a, at), 3);
    }
}

/* ---- The file ---- */

/* Everything that libpng's longjmp must not lose lives here. */
struct writer {
    const struct comparison *comparison;
    const float *map; /* FLIP's; NULL: the largest differences of channels */
    png_structp png;
    png_infop info;
    float *errors; /* of a row */
    uint8_t *row;
    char *reason;
};

static void on_error(png_structp png, png_const_charp text) {
    struct writer *w = png_get_error_ptr(png);
    snprintf(w->reason, PICTURE_REASON_SIZE, "%s", text);
    png_longjmp(png, 1);
}

static void on_warning(png_structp png, png_const_charp text) { (void)png, (void)text; }

static void on_write(png_structp png, png_bytep bytes, size_t size) {
    if (fwrite(bytes, 1, size, png_get_io_ptr(png)) != size) png_error(png, strerror(errno));
}

static void on_flush(png_structp png) { (void)png; }

static bool write_rows(struct writer *w) {
    if (setjmp(png_jmpbuf(w->png))) return false;
    const struct monge_picture *a = w->comparison->a;
    png_set_IHDR(w->png, w->info, a->width, a->height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_BASE, PNG_FILTER_TYPE_BASE);
    png_set_filter(w->png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
    png_set_compression_strategy(w->png, Z_RLE);
    png_set_sRGB(w->png, w->info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_write_info(w->png, w->info);
    for (uint32_t y = 0; y < a->height; y++) {
        if (!w->map) compare_row(w->comparison, y, w->errors);
        color_row(a, y, w->map ? w->map + (size_t)y * a->width : w->errors, w->row);
        png_write_row(w->png, w->row);
    }
    png_write_end(w->png, NULL);
    return true;
}

static bool write_picture(struct writer *w, FILE *stream) {
    bool written = false;
    w->errors = malloc(w->comparison->a->width * sizeof *w->errors);
    w->row = malloc((size_t)w->comparison->a->width * 3);
    w->png = png_create_write_struct(PNG_LIBPNG_VER_STRING, w, on_error, on_warning);
    if (w->png) w->info = png_create_info_struct(w->png);
    snprintf(w->reason, PICTURE_REASON_SIZE, "%s", strerror(ENOMEM));
    if (w->errors && w->row && w->info) {
        png_set_write_fn(w->png, stream, on_write, on_flush);
        written = write_rows(w);
    }
    png_destroy_write_struct(&w->png, &w->info);
    free(w->errors);
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
    snprintf(w->reason, PICTURE_REASON_SIZE, "%s", strerror(errno));
    return false;
}

/* FLIP's error of each pixel, in *map where it is asked for. */
static bool make_map(const struct comparison *c, const struct monge_compare *how, float **map) {
    double mean;
    if (!(how->metrics >> MONGE_METRIC_FLIP & 1)) return true;
    *map = calloc((size_t)c->a->width * c->a->height, sizeof **map);
    return *map &&
           (c->pixels == 0 || flip_mean(c, how->ppd > 0.0 ? how->ppd : MONGE_DEFAULT_PPD, *map, &mean));
}

bool heat_map_write(struct monge_picture *a, struct monge_picture *b, const struct monge_compare *how,
                    const char *path, char reason[PICTURE_REASON_SIZE], const struct monge_picture **about) {
    struct comparison c;
    float *map = NULL;
    bool good = false;
    if (a->width != b->width || a->height != b->height) {
        *about = b;
        snprintf(reason, PICTURE_REASON_SIZE, "a heat map is of two pictures of the same size");
        return false;
    }
    if (comparison_begin(&c, a, b, how, reason, about)) {
        *about = NULL;
        struct writer w = {.comparison = &c, .reason = reason};
        if (make_map(&c, how, &map)) {
            w.map = map;
            good = write_file(&w, path);
        } else {
            snprintf(reason, PICTURE_REASON_SIZE, "%s", strerror(ENOMEM));
        }
    }
    comparison_end(&c);
    free(map);
    return good;
}
