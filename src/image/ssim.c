#include "image/ssim.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>

#include "base/elementary.h"
#include "base/parallel.h"

enum { RADIUS = 5, WINDOW = 2 * RADIUS + 1, BAND = 32 /* rows that a thread takes at a time */ };

static const double deviation = 1.5, c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;

/* What is averaged over the window: both lumas, their squares and their product. */
enum { OF_A, OF_B, A_A, B_B, A_B, MEANS };

struct ssim {
    const struct comparison *comparison;
    double weight[WINDOW];
    uint32_t margin_x, margin_y; /* pixels at the edges that have no windows of their own */
    double *sums;                /* of each row */
    uint64_t *counts;
    atomic_uint next;
    atomic_bool no_memory;
};

static double number_at(const uint8_t *at, unsigned bits) {
    return picture_number(at, bits) / (bits == 16 ? 65535.0 : 255.0);
}

static double luma_at(const struct monge_picture *picture, uint32_t x, uint32_t y) {
    const uint8_t *at = picture_row(picture, y) + x * picture_pixel_size(picture);
    const unsigned bits = picture->bits, bytes = bits / 8;
    if (picture->channels < 3) return number_at(at, bits);
    return 0.299 * number_at(at, bits) + 0.587 * number_at(at + bytes, bits) +
           0.114 * number_at(at + 2 * bytes, bits);
}

static uint32_t clamp(int64_t value, uint32_t size) {
    return (uint32_t)(value < 0 ? 0 : value >= size ? size - 1 : value);
}

/* The averages along x of row y, as one row of each. luma is room for both, with margins. */
static void average_row(const struct ssim *s, int64_t y, double *luma, double *out) {
    const struct comparison *c = s->comparison;
    const uint32_t width = c->a->width, row = clamp(y, c->a->height);
    const uint8_t *ignored = comparison_ignored(c, row);
    double *of_a = luma, *of_b = luma + width + 2 * RADIUS;
    for (uint32_t i = 0; i < width + 2 * RADIUS; i++) {
        const uint32_t x = clamp((int64_t)i - RADIUS, width);
        of_a[i] = luma_at(c->a, x, row);
        of_b[i] = ignored && ignored[x] ? of_a[i] : luma_at(c->b, x, row);
    }
    for (uint32_t x = 0; x < width; x++) {
        double sum[MEANS] = {0};
        for (int k = 0; k < WINDOW; k++) {
            const double a = of_a[x + (uint32_t)k], b = of_b[x + (uint32_t)k], weight = s->weight[k];
            sum[OF_A] += weight * a;
            sum[OF_B] += weight * b;
            sum[A_A] += weight * (a * a);
            sum[B_B] += weight * (b * b);
            sum[A_B] += weight * (a * b);
        }
        for (int m = 0; m < MEANS; m++) out[(size_t)m * width + x] = sum[m];
    }
}

static double similarity(const double mean[MEANS]) {
    const double a = mean[OF_A], b = mean[OF_B];
    const double covariance = mean[A_B] - a * b;
    const double variances = mean[A_A] - a * a + mean[B_B] - b * b;
    return (2.0 * a * b + c1) * (2.0 * covariance + c2) / ((a * a + b * b + c1) * (variances + c2));
}

/* Row y from the averages along x of the rows around it; row i is in rows[i % WINDOW]. */
static void finish_row(const struct ssim *s, uint32_t y, double *const rows[WINDOW]) {
    const uint32_t width = s->comparison->a->width;
    const uint8_t *ignored = comparison_ignored(s->comparison, y);
    for (uint32_t x = s->margin_x; x < width - s->margin_x; x++) {
        double mean[MEANS] = {0};
        if (ignored && ignored[x]) continue;
        for (uint32_t k = 0; k < WINDOW; k++)
            for (int m = 0; m < MEANS; m++)
                mean[m] += s->weight[k] * rows[(y + k) % WINDOW][(size_t)m * width + x];
        s->sums[y] += similarity(mean);
        s->counts[y]++;
    }
}

static void do_band(const struct ssim *s, uint32_t band, double *luma, double *const rows[WINDOW]) {
    const uint32_t height = s->comparison->a->height - s->margin_y;
    const uint32_t top = s->margin_y + band, bottom = top + BAND < height ? top + BAND : height;
    for (uint32_t i = top; i < top + WINDOW - 1; i++)
        average_row(s, (int64_t)i - RADIUS, luma, rows[i % WINDOW]);
    for (uint32_t y = top; y < bottom; y++) {
        const uint32_t last = y + WINDOW - 1;
        average_row(s, (int64_t)last - RADIUS, luma, rows[last % WINDOW]);
        finish_row(s, y, rows);
    }
}

static void do_bands(void *context, unsigned thread) {
    (void)thread;
    struct ssim *s = context;
    const size_t width = s->comparison->a->width;
    const uint32_t height = s->comparison->a->height - 2 * s->margin_y;
    double *room = malloc((WINDOW * MEANS * width + 2 * (width + 2 * RADIUS)) * sizeof *room), *rows[WINDOW];
    if (!room) atomic_store(&s->no_memory, true);
    for (size_t i = 0; room && i < WINDOW; i++) rows[i] = room + i * MEANS * width;
    for (uint64_t band; room && (band = (uint64_t)BAND * atomic_fetch_add(&s->next, 1)) < height;)
        do_band(s, (uint32_t)band, room + WINDOW * MEANS * width, rows);
    free(room);
}

static void make_weights(double weight[WINDOW]) {
    double sum = 0.0;
    for (int k = 0; k < WINDOW; k++) {
        const double x = (k - RADIUS) / deviation;
        sum += weight[k] = elementary_exp(-0.5 * x * x);
    }
    for (int k = 0; k < WINDOW; k++) weight[k] /= sum;
}

/* Where pixels are ignored there may be none but those at the edges: so these have windows of their own then. */
static uint32_t margin(const struct comparison *comparison, uint32_t size) {
    return size >= WINDOW && !comparison->ignored ? RADIUS : 0;
}

bool ssim_mean(const struct comparison *comparison, double *mean) {
    const uint32_t width = comparison->a->width, height = comparison->a->height;
    struct ssim s = {.comparison = comparison,
                     .margin_x = margin(comparison, width),
                     .margin_y = margin(comparison, height),
                     .sums = calloc(height, sizeof *s.sums),
                     .counts = calloc(height, sizeof *s.counts)};
    bool good = s.sums && s.counts;
    double sum = 0.0;
    uint64_t count = 0;
    make_weights(s.weight);
    if (good) parallel_run(comparison->threads, do_bands, &s);
    good = good && !atomic_load(&s.no_memory);
    for (uint32_t y = 0; good && y < height; y++) {
        sum += s.sums[y];
        count += s.counts[y];
    }
    if (good) *mean = count > 0 ? sum / (double)count : 1.0;
    free(s.sums);
    free(s.counts);
    return good;
}
