#include "image/compare.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/parallel.h"
#include "image/filters.h"
#include "image/seen.h"

/* ---- What is ignored ---- */

static void ignore_region(uint8_t *ignored, uint32_t width, uint32_t height, const struct monge_region *r) {
    if (r->x >= width || r->y >= height) return;
    const uint32_t columns = r->width < width - r->x ? r->width : width - r->x;
    const uint32_t rows = r->height < height - r->y ? r->height : height - r->y;
    for (uint32_t y = r->y; y < r->y + rows; y++) memset(ignored + (size_t)y * width + r->x, 1, columns);
}

static bool is_zero(const uint8_t *bytes, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (bytes[i]) return false;
    return true;
}

static void ignore_mask(uint8_t *ignored, const struct monge_picture *mask) {
    const size_t bytes = mask->bits / 8, alpha = mask->channels % 2 == 0 ? bytes : 0;
    const size_t size = picture_pixel_size(mask), colors = size - alpha;
    for (uint32_t y = 0; y < mask->height; y++)
        for (uint32_t x = 0; x < mask->width; x++) {
            const uint8_t *at = picture_row(mask, y) + x * size;
            if (!is_zero(at, colors) && !(alpha && is_zero(at + colors, alpha)))
                ignored[(size_t)y * mask->width + x] = 1;
        }
}

static bool find_ignored(struct comparison *c, const struct monge_compare *how) {
    const uint32_t width = c->a->width, height = c->a->height;
    const size_t all = (size_t)width * height;
    c->pixels = all;
    if (how->ignore_count == 0 && !how->mask) return true;
    c->ignored = calloc(all, 1);
    if (!c->ignored) return false;
    for (size_t i = 0; i < how->ignore_count; i++) ignore_region(c->ignored, width, height, &how->ignore[i]);
    if (how->mask) ignore_mask(c->ignored, how->mask);
    for (size_t i = 0; i < all; i++) c->pixels -= c->ignored[i];
    return true;
}

/* ---- Decoding ---- */

struct decoding {
    struct monge_picture *picture[3]; /* a, b, mask; NULL: none */
    char reason[3][PICTURE_REASON_SIZE];
    bool good[3];
};

static void decode_one(void *context, unsigned thread) {
    struct decoding *d = context;
    bool (*decode)(struct monge_picture *, char *) = thread < 2 ? picture_inflate : picture_decode;
    d->good[thread] = !d->picture[thread] || decode(d->picture[thread], d->reason[thread]);
}

/* The mask is most often of a palette, and so the longest. */
static bool decode_all(struct decoding *d, char reason[PICTURE_REASON_SIZE],
                       const struct monge_picture **about) {
    parallel_run(d->picture[2] ? 3 : 2, decode_one, d);
    for (int i = 0; i < 3; i++) {
        if (d->good[i] || !d->picture[i]) continue;
        memcpy(reason, d->reason[i], PICTURE_REASON_SIZE);
        *about = d->picture[i];
        return false;
    }
    return true;
}

/* ---- Filters: those of rows that are the same in both pictures need not be undone ---- */

struct undoing {
    const struct comparison *comparison;
    uint8_t *needed; /* of which rows; NULL: of all that are left */
    bool good[2];
};

static bool is_filtered(const struct monge_picture *picture) {
    return picture->filtered && !memchr(picture->filtered, 0, picture->height);
}

/* Whether the rows of both can be compared as they are in the files. */
static bool are_alike(const struct monge_picture *a, const struct monge_picture *b) {
    return a != b && is_filtered(a) && is_filtered(b) && a->bits == b->bits && a->channels == b->channels;
}

static void match_rows(void *context, unsigned thread) {
    const struct comparison *c = context;
    const size_t stride = c->a->stride;
    for (uint64_t y = thread; y < c->a->height; y += c->threads)
        c->equal[y] = memcmp(c->a->rows + y * stride - 1, c->b->rows + y * stride - 1, stride) == 0;
}

/* Rows are equal which are so with their filters, and so are those above that they look at. */
static void find_equal(struct comparison *c) {
    parallel_run(c->threads, match_rows, c);
    for (uint32_t y = 1; y < c->a->height; y++)
        if (filters_look_up(picture_row(c->a, y))) c->equal[y] &= c->equal[y - 1];
}

/* Needed are those that are not equal, and what is above a row that is needed and looks at it. */
static void find_needed(const struct comparison *c, uint8_t *needed) {
    const uint32_t height = c->a->height;
    for (uint32_t y = height; y-- > 0;)
        needed[y] =
            !c->equal[y] ||
            (y + 1 < height && needed[y + 1] &&
             (filters_look_up(picture_row(c->a, y + 1)) || filters_look_up(picture_row(c->b, y + 1))));
}

static void undo_one(void *context, unsigned thread) {
    struct undoing *u = context;
    struct monge_picture *a = u->comparison->a, *b = u->comparison->b;
    u->good[thread] = (thread > 0 && a == b) || picture_undo(thread > 0 ? b : a, u->needed);
}

static bool undo_both(const struct comparison *c, uint8_t *needed) {
    struct undoing undoing = {.comparison = c, .needed = needed};
    parallel_run(2, undo_one, &undoing);
    return undoing.good[0] && undoing.good[1];
}

/* The filters of all rows, or where that is enough of those that are needed. */
static bool undo_filters(struct comparison *c, bool all) {
    if (all || !are_alike(c->a, c->b)) return undo_both(c, NULL);
    uint8_t *needed = malloc(c->a->height);
    c->equal = malloc(c->a->height);
    const bool room = needed && c->equal;
    if (room) find_equal(c);
    if (room) find_needed(c, needed);
    const bool good = room && undo_both(c, needed);
    free(needed);
    return good;
}

static bool no_memory(char reason[PICTURE_REASON_SIZE]) {
    snprintf(reason, PICTURE_REASON_SIZE, "%s", strerror(ENOMEM));
    return false;
}

static bool check_mask(const struct monge_picture *a, const struct monge_picture *mask,
                       char reason[PICTURE_REASON_SIZE], const struct monge_picture **about) {
    if (!mask || (mask->width == a->width && mask->height == a->height)) return true;
    *about = mask;
    snprintf(reason, PICTURE_REASON_SIZE, "it is %u x %u pixels, and what it should mask %u x %u",
             mask->width, mask->height, a->width, a->height);
    return false;
}

bool comparison_begin(struct comparison *c, struct monge_picture *a, struct monge_picture *b,
                      const struct monge_compare *how, char reason[PICTURE_REASON_SIZE],
                      const struct monge_picture **about) {
    *c = (struct comparison){.a = a, .b = b};
    c->threads = how->threads ? how->threads : parallel_processors();
    if (c->threads > PARALLEL_MAX_THREADS) c->threads = PARALLEL_MAX_THREADS;
    struct decoding decoding = {.picture = {a, b == a ? NULL : b, how->mask}};
    const bool masks_itself = how->mask == a || how->mask == b;
    if (masks_itself) decoding.picture[2] = NULL;
    *about = a;
    return check_mask(a, how->mask, reason, about) && decode_all(&decoding, reason, about) &&
           ((undo_filters(c, masks_itself) && find_ignored(c, how)) || no_memory(reason));
}

bool comparison_decode(const struct comparison *c) { return undo_both(c, NULL); }

void comparison_end(struct comparison *c) {
    free(c->ignored);
    free(c->equal);
}

/* ---- The whole ---- */

static bool same_space(const struct color_space *a, const struct color_space *b) {
    return a->kind == b->kind && (a->kind != COLOR_GAMMA || a->gamma == b->gamma) &&
           memcmp(a->primaries, b->primaries, sizeof a->primaries) == 0 &&
           a->profile_size == b->profile_size &&
           (a->profile_size == 0 || memcmp(a->profile, b->profile, a->profile_size) == 0);
}

enum monge_unlike compare_unlike(const struct monge_picture *a, const struct monge_picture *b) {
    if (a->width != b->width || a->height != b->height) return MONGE_UNLIKE_SIZE;
    if (!same_space(&a->space, &b->space)) return MONGE_UNLIKE_COLOR_SPACE;
    return a->bits != b->bits ? MONGE_UNLIKE_BITS : MONGE_UNLIKE_NOTHING;
}

static bool same_file(const struct monge_picture *a, const struct monge_picture *b) {
    return a->file_size == b->file_size && memcmp(a->file, b->file, a->file_size) == 0;
}

static void tell_same(const struct comparison *c, struct monge_difference *out) {
    out->same = true;
    out->pixels = c->pixels;
    out->max = out->mae = out->rmse = 0.0;
    out->psnr = INFINITY;
}

static bool compare_decoded(struct comparison *c, const struct monge_compare *how,
                            struct monge_difference *out) {
    const bool ssim = how->metrics >> MONGE_METRIC_SSIM & 1, flip = how->metrics >> MONGE_METRIC_FLIP & 1;
    compare_pixels(c, how->max_delta, out);
    out->same = out->unlike == MONGE_UNLIKE_NOTHING && out->different == 0;
    if (out->different == 0 || !(ssim || flip)) return true;
    const double ppd = how->ppd > 0.0 ? how->ppd : MONGE_DEFAULT_PPD;
    return comparison_decode(c) && (!ssim || seen_ssim(c, &out->ssim)) &&
           (!flip || seen_flip(c, ppd, NULL, &out->flip));
}

bool compare_pictures(struct monge_picture *a, struct monge_picture *b, const struct monge_compare *how,
                      struct monge_difference *out, char reason[PICTURE_REASON_SIZE],
                      const struct monge_picture **about) {
    *out = (struct monge_difference){.unlike = compare_unlike(a, b), .max = NAN, .mae = NAN, .rmse = NAN};
    out->psnr = out->ssim = out->flip = NAN;
    if (out->unlike == MONGE_UNLIKE_SIZE || out->unlike == MONGE_UNLIKE_COLOR_SPACE) return true;
    /* What is equal in every pixel needs no more than this. */
    if (how->metrics >> MONGE_METRIC_SSIM & 1) out->ssim = 1.0;
    if (how->metrics >> MONGE_METRIC_FLIP & 1) out->flip = 0.0;
    struct comparison c = {.a = a, .b = b, .pixels = (uint64_t)a->width * a->height};
    if (same_file(a, b) && !how->mask && how->ignore_count == 0) {
        tell_same(&c, out);
        return true;
    }
    const bool good = comparison_begin(&c, a, b, how, reason, about) &&
                      (compare_decoded(&c, how, out) || no_memory(reason));
    comparison_end(&c);
    return good;
}
