#include "image/seen.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "image/flip.h"
#include "image/ssim.h"

enum ground { BLACK, WHITE, GROUNDS };

/* ---- Over a ground ---- */

static bool has_alpha(const struct monge_picture *picture) { return picture->channels % 2 == 0; }

static bool is_plain(const struct comparison *c) { return !has_alpha(c->a) && !has_alpha(c->b); }

static void mix_row(const struct monge_picture *picture, enum ground ground, uint32_t y, uint8_t *out) {
    const size_t bytes = picture->bits / 8, colors = picture->channels - 1;
    const uint32_t most = (1u << picture->bits) - 1, under = ground == WHITE ? most : 0;
    const uint8_t *at = picture_row(picture, y);
    for (uint32_t x = 0; x < picture->width; x++, at += bytes) {
        const uint32_t alpha = picture_number(at + colors * bytes, picture->bits);
        for (size_t c = 0; c < colors; c++, at += bytes) {
            const uint32_t sum =
                picture_number(at, picture->bits) * alpha + under * (most - alpha); /* most^2 fits */
            const uint32_t mixed = (sum + most / 2) / most;
            if (bytes == 2) *out++ = (uint8_t)(mixed >> 8);
            *out++ = (uint8_t)mixed;
        }
    }
}

/* Makes *out the picture as it is over the ground, without alpha: of its own are its rows alone, in out->memory. False: no
 * memory. */
static bool lay(const struct monge_picture *picture, enum ground ground, struct monge_picture *out) {
    *out = *picture;
    out->memory = NULL;
    if (!has_alpha(picture)) return true;
    out->channels--;
    out->stride = out->width * picture_pixel_size(out);
    out->rows = out->memory = malloc(out->stride * out->height);
    for (uint32_t y = 0; out->memory && y < out->height; y++)
        mix_row(picture, ground, y, out->memory + y * out->stride);
    return out->memory;
}

/* Both pictures of a comparison over a ground. */
struct laid {
    struct monge_picture a, b;
    struct comparison comparison;
    bool same; /* but for what is ignored */
};

/* False: no memory. Either way to be ended. */
static bool laid_begin(struct laid *laid, const struct comparison *c, enum ground ground) {
    struct monge_difference d;
    laid->b.memory = NULL;
    if (!lay(c->a, ground, &laid->a) || !lay(c->b, ground, &laid->b)) return false;
    laid->comparison = *c;
    laid->comparison.a = &laid->a;
    laid->comparison.b = &laid->b;
    compare_pixels(&laid->comparison, 0.0, &d);
    laid->same = d.different == 0;
    return true;
}

static void laid_end(struct laid *laid) {
    free(laid->a.memory);
    free(laid->b.memory);
}

/* ---- The metrics ---- */

/* Raises the errors of the pixels to those over the ground. */
static bool raise_errors(const struct comparison *c, double ppd, enum ground ground, float *errors,
                         float *room) {
    struct laid laid;
    double mean;
    const size_t count = (size_t)c->a->width * c->a->height;
    bool good = laid_begin(&laid, c, ground);
    if (good && !laid.same) {
        good = flip_mean(&laid.comparison, ppd, room, &mean);
        for (size_t i = 0; good && i < count; i++) errors[i] = fmaxf(errors[i], room[i]);
    }
    laid_end(&laid);
    return good;
}

bool seen_flip(const struct comparison *comparison, double ppd, float *map, double *mean) {
    if (is_plain(comparison)) return flip_mean(comparison, ppd, map, mean);
    const size_t count = (size_t)comparison->a->width * comparison->a->height;
    float *errors = calloc(count, sizeof *errors), *room = malloc(count * sizeof *room);
    bool good = errors && room;
    double sum = 0.0;
    for (enum ground g = BLACK; good && g < GROUNDS; g++)
        good = raise_errors(comparison, ppd, g, errors, room);
    for (size_t i = 0; good && i < count; i++) sum += (double)errors[i];
    if (good) *mean = sum / (double)comparison->pixels;
    if (good && map) memcpy(map, errors, count * sizeof *map);
    free(errors);
    free(room);
    return good;
}

bool seen_ssim(const struct comparison *comparison, double *mean) {
    if (is_plain(comparison)) return ssim_mean(comparison, mean);
    bool good = true;
    *mean = 1.0;
    for (enum ground g = BLACK; good && g < GROUNDS; g++) {
        struct laid laid;
        double value = 1.0;
        good = laid_begin(&laid, comparison, g) && (laid.same || ssim_mean(&laid.comparison, &value));
        *mean = fmin(*mean, value);
        laid_end(&laid);
    }
    return good;
}
