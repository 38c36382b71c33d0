#include "image/heat.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#include "image/png_file.h"
#include "image/seen.h"

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

struct heat {
    const struct comparison *comparison;
    bool all; /* FLIP's errors, of all pixels at once; else the largest differences of channels, of a row */
    float *errors; /* owned */
};

static void put_heat(struct png_file *file, const void *context) {
    const struct heat *heat = context;
    const struct monge_picture *a = heat->comparison->a;
    png_set_IHDR(file->png, file->info, a->width, a->height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_BASE, PNG_FILTER_TYPE_BASE);
    png_set_filter(file->png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
    png_set_compression_strategy(file->png, Z_RLE);
    png_set_sRGB(file->png, file->info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_write_info(file->png, file->info);
    for (uint32_t y = 0; y < a->height; y++) {
        float *errors = heat->errors + (heat->all ? (size_t)y * a->width : 0);
        if (!heat->all) compare_row(heat->comparison, y, errors);
        color_row(a, y, errors, file->row);
        png_write_row(file->png, file->row);
    }
    png_write_end(file->png, NULL);
}

/* False: no memory. */
static bool make_errors(struct heat *heat, const struct monge_compare *how) {
    const struct comparison *c = heat->comparison;
    double mean;
    heat->all = how->metrics >> MONGE_METRIC_FLIP & 1;
    heat->errors = calloc((size_t)c->a->width * (heat->all ? c->a->height : 1), sizeof *heat->errors);
    if (!heat->errors || !heat->all || c->pixels == 0) return heat->errors != NULL;
    return seen_flip(c, how->ppd > 0.0 ? how->ppd : MONGE_DEFAULT_PPD, heat->errors, &mean);
}

static bool write_file(struct heat *heat, const struct monge_compare *how, const char *path,
                       char reason[PICTURE_REASON_SIZE]) {
    struct png_file file = {.reason = ""};
    const size_t row_size = (size_t)heat->comparison->a->width * 3;
    const bool made = comparison_decode(heat->comparison) && make_errors(heat, how);
    const bool written = made && png_file_write(&file, path, row_size, put_heat, heat);
    if (!written) snprintf(reason, PICTURE_REASON_SIZE, "%s", made ? file.reason : strerror(ENOMEM));
    free(heat->errors);
    return written;
}

bool heat_map_write(struct monge_picture *a, struct monge_picture *b, const struct monge_compare *how,
                    const char *path, char reason[PICTURE_REASON_SIZE], const struct monge_picture **about) {
    struct comparison c;
    bool good = false;
    if (a->width != b->width || a->height != b->height) {
        *about = b;
        snprintf(reason, PICTURE_REASON_SIZE, "a heat map is of two pictures of the same size");
        return false;
    }
    if (comparison_begin(&c, a, b, how, reason, about)) {
        *about = NULL;
        struct heat heat = {.comparison = &c};
        good = write_file(&heat, how, path, reason);
    }
    comparison_end(&c);
    return good;
}
