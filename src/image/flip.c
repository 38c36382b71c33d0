#include "image/flip.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "base/elementary.h"
#include "base/parallel.h"
#include "base/wide.h"
#include "image/flip_filter.h"

/* Vectors of the compilers: the same operations on each number, whatever the machine has for them. They are passed
 * between functions that are inlined alone, so that there is no calling convention to warn of. */
#pragma GCC diagnostic ignored "-Wpsabi"
enum { LANES = 8 };
typedef float vector __attribute__((vector_size(4 * LANES), aligned(4), may_alias));
typedef int32_t mask __attribute__((vector_size(4 * LANES), aligned(4), may_alias));

/* ---- Colour ---- */

/* Light of linear RGB as X, Y, Z (IEC 61966-2-1, as fractions of whole numbers), each over that of white. */
static const double xyz_of_rgb[3][3] = {
    {10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0},
    {2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0},
    {1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0},
};

/* CIE L*a*b*: above the knee a cube root, below it a line. */
#define LAB_KNEE   (216.0 / 24389.0)
#define LAB_SLOPE  (841.0 / 108.0)
#define LAB_OFFSET (4.0 / 29.0)

struct matrix {
    float m[3][3];
};

struct flip {
    const struct comparison *comparison;
    struct flip_filters filters;
    struct matrix white_from_rgb; /* to X / Xn, Y / Yn, Z / Zn */
    struct matrix rgb_from_white;
    float *light[2]; /* of each number in the files of a and b, linear; owned */
    float farthest;  /* the largest difference of colours */
    float *map;      /* NULL, or for each pixel */
    double *sums;    /* of the errors of each tile */
    uint32_t columns, tiles;
    atomic_uint next;
    atomic_bool no_memory;
};

static void invert(const double m[3][3], struct matrix *out) {
    double det = 0.0, cofactor[3][3];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, k1 = (k + 1) % 3, k2 = (k + 2) % 3;
            cofactor[i][k] = m[i1][k1] * m[i2][k2] - m[i1][k2] * m[i2][k1];
        }
    for (int k = 0; k < 3; k++) det += m[0][k] * cofactor[0][k];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) out->m[i][k] = (float)(cofactor[k][i] / det);
}

static double lab_curve(double t) {
    return t > LAB_KNEE ? elementary_pow(t, 1.0 / 3.0) : LAB_SLOPE * t + LAB_OFFSET;
}

/* L*, and a* and b* with the Hunt effect: colours fade in the dark. */
static void lab_of_white(const double white[3], double lab[3]) {
    const double x = lab_curve(white[0]), y = lab_curve(white[1]), z = lab_curve(white[2]);
    lab[0] = 116.0 * y - 16.0;
    lab[1] = 0.01 * lab[0] * 500.0 * (x - y);
    lab[2] = 0.01 * lab[0] * 200.0 * (y - z);
}

/* The paper's exponent of colour differences, and where it bends their curve: from 0.4 of the largest to 0.95. */
#define COLOR_EXPONENT 0.7
#define COLOR_BEND     0.4
#define COLOR_BENT     0.95

/* Green and blue are farthest apart. */
static double farthest_colors(const double white_from_rgb[3][3]) {
    double lab[3][3];
    for (int c = 1; c < 3; c++) {
        const double white[3] = {white_from_rgb[0][c], white_from_rgb[1][c], white_from_rgb[2][c]};
        lab_of_white(white, lab[c]);
    }
    const double a = lab[1][1] - lab[2][1], b = lab[1][2] - lab[2][2];
    return elementary_pow(fabs(lab[1][0] - lab[2][0]) + sqrt(a * a + b * b), COLOR_EXPONENT);
}

static double light_of(const struct color_space *space, double number) {
    if (space->kind == COLOR_GAMMA) return number > 0.0 ? elementary_pow(number, 1e5 / space->gamma) : 0.0;
    return number <= 0.04045 ? number / 12.92 : elementary_pow((number + 0.055) / 1.055, 2.4);
}

static float *make_light(const struct monge_picture *picture) {
    const unsigned count = 1u << picture->bits;
    float *light = malloc(count * sizeof *light);
    for (unsigned i = 0; light && i < count; i++)
        light[i] = (float)light_of(&picture->space, i / (double)(count - 1));
    return light;
}

static void set_colors(struct flip *f) {
    double m[3][3];
    for (int i = 0; i < 3; i++) {
        const double white = xyz_of_rgb[i][0] + xyz_of_rgb[i][1] + xyz_of_rgb[i][2];
        for (int k = 0; k < 3; k++) {
            m[i][k] = xyz_of_rgb[i][k] / white;
            f->white_from_rgb.m[i][k] = (float)m[i][k];
        }
    }
    invert(m, &f->rgb_from_white);
    f->farthest = (float)farthest_colors(m);
}

/* ---- Tiles ----
 *
 * A thread goes down a tile row by row. Of both pictures it keeps the last rows filtered along x, as many as the
 * filters reach over, in rings; with a new one at the bottom it can filter the row in the middle along y.
 *
 *     row, with a margin   ->   7 planes along x   ->   rings of rows   ->   8 planes along y   ->   the error
 */

enum { TILE_WIDTH = 256, TILE_HEIGHT = 256 };

/* Linear in light, so that filters may act: luminance over that of white, and two opponent colours. */
enum { LUMA, RED_GREEN, BLUE_YELLOW, COLORS };

/* Filtered along x. */
enum { X_LUMA, X_RED_GREEN, X_BLUE_YELLOW_1, X_BLUE_YELLOW_2, X_BLUR, X_EDGE, X_POINT, X_PLANES };

/* Filtered along y as well. The features are derivatives along x or y, blurred along the other. */
enum { LUMINANCE, CHROMA_1, CHROMA_2, CHROMA_3, EDGE_X, POINT_X, EDGE_Y, POINT_Y, PLANES };

struct tile {
    float row[COLORS][TILE_WIDTH + 2 * FLIP_MAX_RADIUS + LANES];
    float plane[2][PLANES][TILE_WIDTH];
    float error[TILE_WIDTH], exponent[TILE_WIDTH];
    const float *ring[2 * FLIP_MAX_RADIUS + 1]; /* of a plane, from the top row to the bottom */
    float rows[];                               /* [2][X_PLANES][2 * radius + 1][TILE_WIDTH] */
};

static float *tile_row(struct tile *tile, int radius, int picture, int plane, int slot) {
    return tile->rows + (size_t)((picture * X_PLANES + plane) * (2 * radius + 1) + slot) * TILE_WIDTH;
}

/* The colours of `count` pixels of a row from column `left` on; beyond the edges, those of the edge. */
INLINE void load_row(const struct flip *f, int which, uint32_t y, int64_t left, int count, struct tile *tile,
                     unsigned bits) {
    const struct comparison *c = f->comparison;
    const uint8_t *ignored = which == 1 ? comparison_ignored(c, y) : NULL;
    const struct monge_picture *picture = which == 1 ? c->b : c->a;
    const int64_t last = (int64_t)picture->width - 1;
    const float(*m)[3] = f->white_from_rgb.m;
    for (int i = 0; i < count; i++) {
        const int64_t x = left + i < 0 ? 0 : left + i > last ? last : left + i;
        const bool other = ignored && ignored[x];
        const struct monge_picture *p = other ? c->a : picture;
        const unsigned depth = other ? p->bits : bits, bytes = depth / 8;
        const float *light = f->light[other ? 0 : which];
        const uint8_t *at = picture_row(p, y) + (size_t)x * p->channels * bytes;
        const size_t step = p->channels >= 3 ? bytes : 0;
        const float red = light[picture_number(at, depth)], green = light[picture_number(at + step, depth)],
                    blue = light[picture_number(at + 2 * step, depth)];
        const float luma = m[1][0] * red + m[1][1] * green + m[1][2] * blue;
        tile->row[LUMA][i] = luma;
        tile->row[RED_GREEN][i] = m[0][0] * red + m[0][1] * green + m[0][2] * blue - luma;
        tile->row[BLUE_YELLOW][i] = luma - (m[2][0] * red + m[2][1] * green + m[2][2] * blue);
    }
}

#define AT(p)  (*(const vector *)(p))
#define SET(p) (*(vector *)(p))

/* Filters go over blocks of columns, so that a weight is fetched once for several vectors. */
enum { BLOCK = 4 * LANES };
#define EACH(v) for (int v = 0; v < BLOCK; v += LANES)

/* What a filter that is even adds up, and what one that is odd does, of two rows that are as far from the middle. */
INLINE void add_pair(vector sum[4], float weight, const float *a, const float *b) {
    EACH(v) sum[v / LANES] += weight * (AT(a + v) + AT(b + v));
}

INLINE void store_sum(float *out, const vector sum[4]) { EACH(v) SET(out + v) = sum[v / LANES]; }

INLINE void even_along_x(const struct flip_filter *filter, const float *row, float *out) {
    for (int x = 0; x < TILE_WIDTH; x += BLOCK) {
        vector sum[4];
        EACH(v) sum[v / LANES] = filter->weight[0] * AT(row + x + v);
        for (int k = 1; k <= filter->radius; k++) add_pair(sum, filter->weight[k], row + x - k, row + x + k);
        store_sum(out + x, sum);
    }
}

INLINE void even_along_y(const struct flip_filter *filter, const float *const *middle, float *out) {
    for (int x = 0; x < TILE_WIDTH; x += BLOCK) {
        vector sum[4];
        EACH(v) sum[v / LANES] = filter->weight[0] * AT(middle[0] + x + v);
        for (int k = 1; k <= filter->radius; k++)
            add_pair(sum, filter->weight[k], middle[-k] + x, middle[k] + x);
        store_sum(out + x, sum);
    }
}

/* The derivatives of the Gaussian share what they read, and along x so does the Gaussian. */
INLINE void features_along_x(const struct flip_filters *f, const float *row, float *blurred, float *edge,
                             float *point) {
    for (int x = 0; x < TILE_WIDTH; x += LANES) {
        const vector middle = AT(row + x);
        vector blurs = f->blur.weight[0] * middle, points = f->point.weight[0] * middle, edges = {0};
        for (int k = 1; k <= f->blur.radius; k++) {
            const vector before = AT(row + x - k), behind = AT(row + x + k), both = before + behind;
            blurs += f->blur.weight[k] * both;
            points += f->point.weight[k] * both;
            edges += f->edge.weight[k] * (behind - before);
        }
        SET(blurred + x) = blurs;
        SET(point + x) = points;
        SET(edge + x) = edges;
    }
}

INLINE void features_along_y(const struct flip_filters *f, const float *const *middle, float *edge,
                             float *point) {
    for (int x = 0; x < TILE_WIDTH; x += LANES) {
        vector points = f->point.weight[0] * AT(middle[0] + x), edges = {0};
        for (int k = 1; k <= f->blur.radius; k++) {
            const vector before = AT(middle[-k] + x), behind = AT(middle[k] + x);
            points += f->point.weight[k] * (before + behind);
            edges += f->edge.weight[k] * (behind - before);
        }
        SET(point + x) = points;
        SET(edge + x) = edges;
    }
}

/* Takes row y, or the picture's first or last, into the rings, in the place of the oldest. */
INLINE void enter_row(const struct flip *f, struct tile *tile, uint32_t left, int64_t y) {
    const struct flip_filters *filters = &f->filters;
    const int radius = filters->radius, slot = (int)((y + radius) % (2 * radius + 1));
    const int64_t last = (int64_t)f->comparison->a->height - 1;
    const uint32_t from = (uint32_t)(y < 0 ? 0 : y > last ? last : y);
    for (int which = 0; which < 2; which++) {
        const unsigned bits = which == 1 ? f->comparison->b->bits : f->comparison->a->bits;
        const int64_t begin = (int64_t)left - radius;
        const int count = TILE_WIDTH + 2 * radius;
        if (bits == 8)
            load_row(f, which, from, begin, count, tile, 8);
        else
            load_row(f, which, from, begin, count, tile, 16);
        float *out[X_PLANES];
        for (int p = 0; p < X_PLANES; p++) out[p] = tile_row(tile, radius, which, p, slot);
        even_along_x(&filters->luma, tile->row[LUMA] + radius, out[X_LUMA]);
        even_along_x(&filters->red_green, tile->row[RED_GREEN] + radius, out[X_RED_GREEN]);
        even_along_x(&filters->blue_yellow[0], tile->row[BLUE_YELLOW] + radius, out[X_BLUE_YELLOW_1]);
        even_along_x(&filters->blue_yellow[1], tile->row[BLUE_YELLOW] + radius, out[X_BLUE_YELLOW_2]);
        features_along_x(filters, tile->row[LUMA] + radius, out[X_BLUR], out[X_EDGE], out[X_POINT]);
    }
}

/* The rows of a plane around row y, from which on they may be counted up and down. */
INLINE const float *const *find_ring(const struct flip *f, struct tile *tile, int which, int plane,
                                     int64_t y) {
    const int radius = f->filters.radius, size = 2 * radius + 1;
    for (int i = 0; i < size; i++)
        tile->ring[i] = tile_row(tile, radius, which, plane, (int)((y + i) % size));
    return tile->ring + radius;
}

INLINE void filter_along_y(const struct flip *f, struct tile *tile, int64_t y) {
    const struct flip_filters *filters = &f->filters;
    for (int which = 0; which < 2; which++) {
        float(*out)[TILE_WIDTH] = tile->plane[which];
        even_along_y(&filters->luma, find_ring(f, tile, which, X_LUMA, y), out[LUMINANCE]);
        even_along_y(&filters->red_green, find_ring(f, tile, which, X_RED_GREEN, y), out[CHROMA_1]);
        even_along_y(&filters->blue_yellow[0], find_ring(f, tile, which, X_BLUE_YELLOW_1, y), out[CHROMA_2]);
        even_along_y(&filters->blue_yellow[1], find_ring(f, tile, which, X_BLUE_YELLOW_2, y), out[CHROMA_3]);
        even_along_y(&filters->blur, find_ring(f, tile, which, X_EDGE, y), out[EDGE_X]);
        even_along_y(&filters->blur, find_ring(f, tile, which, X_POINT, y), out[POINT_X]);
        features_along_y(filters, find_ring(f, tile, which, X_BLUR, y), out[EDGE_Y], out[POINT_Y]);
    }
}

/* ---- The error of a row ---- */

INLINE vector choose(mask which, vector yes, vector no) {
    return (vector)(((mask)yes & which) | ((mask)no & ~which));
}

INLINE vector absolute(vector v) { return (vector)((mask)v & 0x7fffffff); }

INLINE vector limit_01(vector v) {
    const vector zero = {0}, one = zero + 1.0f;
    const vector positive = choose(v > zero, v, zero);
    return choose(positive < one, positive, one);
}

INLINE vector root(vector v) {
    for (int i = 0; i < LANES; i++) v[i] = sqrtf(v[i]);
    return v;
}

/* Of 0.008 to 1.1: a third of the bits is a root to 6 %, and each of Halley's steps triples the digits. */
INLINE vector cube_root(vector v) {
    const vector bits = __builtin_convertvector((mask)v, vector);
    vector y = (vector)(__builtin_convertvector(bits * (1.0f / 3.0f), mask) + 709921077);
    for (int i = 0; i < 2; i++) {
        const vector cube = y * y * y;
        y = y * ((cube + 2.0f * v) / (2.0f * cube + v));
    }
    return y;
}

INLINE vector lab_curve_of(vector t) {
    const vector line = (float)LAB_SLOPE * t + (float)LAB_OFFSET;
    const mask above = t > (float)LAB_KNEE;
    return choose(above, cube_root(choose(above, t, (vector){0} + 1.0f)), line);
}

struct lab {
    vector l, a, b;
};

/* From what the filters leave, clamped to what a screen can show, to lab_of_white. */
INLINE struct lab find_lab(const struct flip *f, float (*plane)[TILE_WIDTH], int at) {
    const float(*in)[3] = f->rgb_from_white.m, (*out)[3] = f->white_from_rgb.m;
    vector white[3], rgb[3];
    white[1] = AT(plane[LUMINANCE] + at);
    white[0] = white[1] + AT(plane[CHROMA_1] + at);
    white[2] = white[1] - (AT(plane[CHROMA_2] + at) + AT(plane[CHROMA_3] + at));
    for (int i = 0; i < 3; i++)
        rgb[i] = limit_01(in[i][0] * white[0] + in[i][1] * white[1] + in[i][2] * white[2]);
    for (int i = 0; i < 3; i++)
        white[i] = lab_curve_of(out[i][0] * rgb[0] + out[i][1] * rgb[1] + out[i][2] * rgb[2]);
    const vector l = 116.0f * white[1] - 16.0f;
    return (struct lab){l, 0.01f * l * (500.0f * (white[0] - white[1])),
                        0.01f * l * (200.0f * (white[1] - white[2]))};
}

/* How long the vector of a feature along x and along y is. */
INLINE vector length_of(const float *x, const float *y) { return root(AT(x) * AT(x) + AT(y) * AT(y)); }

/* The differences of colour, before they are raised to a power, and of features. */
INLINE void find_differences(const struct flip *f, struct tile *tile) {
    float(*pa)[TILE_WIDTH] = tile->plane[0], (*pb)[TILE_WIDTH] = tile->plane[1];
    for (int x = 0; x < TILE_WIDTH; x += LANES) {
        const struct lab a = find_lab(f, pa, x), b = find_lab(f, pb, x);
        const vector da = a.a - b.a, db = a.b - b.b;
        SET(tile->error + x) = absolute(a.l - b.l) + root(da * da + db * db);
        const vector edge =
            absolute(length_of(pa[EDGE_X] + x, pa[EDGE_Y] + x) - length_of(pb[EDGE_X] + x, pb[EDGE_Y] + x));
        const vector point = absolute(length_of(pa[POINT_X] + x, pa[POINT_Y] + x) -
                                      length_of(pb[POINT_X] + x, pb[POINT_Y] + x));
        SET(tile->exponent + x) = 1.0f - root(choose(edge > point, edge, point) * 0.70710678f);
    }
}

/* Of powers of the difference of colours: the large ones are drawn together. */
INLINE void bend_differences(const struct flip *f, struct tile *tile) {
    const float bend = (float)COLOR_BEND * f->farthest, bent = (float)COLOR_BENT;
    for (int x = 0; x < TILE_WIDTH; x += LANES) {
        const vector v = AT(tile->error + x);
        const vector high = bent + (v - bend) / (f->farthest - bend) * (1.0f - bent);
        SET(tile->error + x) = choose(v < bend, v * (bent / bend), high);
    }
}

static void raise_differences(struct tile *tile) {
    float power[TILE_WIDTH];
    for (int x = 0; x < TILE_WIDTH; x++) power[x] = (float)COLOR_EXPONENT;
    elementary_powf(TILE_WIDTH, tile->error, power, tile->error);
}

/* Adds up the errors of a row of the tile. */
static double take_row(const struct flip *f, const struct tile *tile, uint32_t left, uint32_t y) {
    const uint32_t width = f->comparison->a->width;
    const uint32_t count = width - left < TILE_WIDTH ? width - left : TILE_WIDTH;
    const uint8_t *ignored = comparison_ignored(f->comparison, y);
    double sum = 0.0;
    for (uint32_t x = 0; x < count; x++) {
        const float error = ignored && ignored[left + x] ? 0.0f : tile->error[x];
        if (f->map) f->map[(size_t)y * width + left + x] = error;
        sum += (double)error;
    }
    return sum;
}

INLINE void do_tile(const struct flip *f, struct tile *tile, uint32_t number) {
    const uint32_t left = number % f->columns * TILE_WIDTH, top = number / f->columns * TILE_HEIGHT;
    const uint32_t height = f->comparison->a->height;
    const int64_t radius = f->filters.radius,
                  bottom = top + TILE_HEIGHT < height ? top + TILE_HEIGHT : height;
    double sum = 0.0;
    for (int64_t y = top - radius; y < top + radius; y++) enter_row(f, tile, left, y);
    for (int64_t y = top; y < bottom; y++) {
        enter_row(f, tile, left, y + radius);
        filter_along_y(f, tile, y);
        find_differences(f, tile);
        raise_differences(tile);
        bend_differences(f, tile);
        elementary_powf(TILE_WIDTH, tile->error, tile->exponent, tile->error);
        sum += take_row(f, tile, left, (uint32_t)y);
    }
    f->sums[number] = sum;
}

static void do_tile_plain(const struct flip *f, struct tile *tile, uint32_t number) {
    do_tile(f, tile, number);
}

WIDE static void do_tile_wide(const struct flip *f, struct tile *tile, uint32_t number) {
    do_tile(f, tile, number);
}

static void do_tiles(void *context, unsigned thread) {
    (void)thread;
    struct flip *f = context;
    void (*work)(const struct flip *, struct tile *, uint32_t) = has_wide() ? do_tile_wide : do_tile_plain;
    const size_t rows = (size_t)2 * X_PLANES * (size_t)(2 * f->filters.radius + 1);
    struct tile *tile = calloc(1, sizeof *tile + rows * TILE_WIDTH * sizeof(float));
    if (!tile) atomic_store(&f->no_memory, true);
    for (uint32_t number; tile && (number = atomic_fetch_add(&f->next, 1)) < f->tiles;) work(f, tile, number);
    free(tile);
}

static bool flip_begin(struct flip *f, double ppd) {
    const struct comparison *c = f->comparison;
    const uint32_t rows = (c->a->height + TILE_HEIGHT - 1) / TILE_HEIGHT;
    f->columns = (c->a->width + TILE_WIDTH - 1) / TILE_WIDTH;
    f->tiles = f->columns * rows;
    f->sums = calloc(f->tiles, sizeof *f->sums);
    f->light[0] = make_light(c->a);
    f->light[1] = make_light(c->b);
    set_colors(f);
    flip_filters_make(&f->filters, ppd);
    return f->sums && f->light[0] && f->light[1];
}

bool flip_mean(const struct comparison *comparison, double ppd, float *map, double *mean) {
    struct flip f = {.comparison = comparison, .map = map};
    bool good = flip_begin(&f, ppd);
    double sum = 0.0;
    if (good) parallel_run(comparison->threads, do_tiles, &f);
    good = good && !atomic_load(&f.no_memory);
    for (uint32_t i = 0; good && i < f.tiles; i++) sum += f.sums[i];
    if (good) *mean = sum / (double)comparison->pixels;
    free(f.sums);
    free(f.light[0]);
    free(f.light[1]);
    return good;
}
