/* The metrics that look at each pixel by itself. All sums are of integers: exact, in whatever order. */
#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "base/elementary.h"
#include "base/parallel.h"
#include "base/wide.h"
#include "image/compare.h"

enum {
    BLOCK = 32,              /* pixels that are looked at together */
    PIECE = 16 * BLOCK,      /* pixels of a row that are read together */
    BLOCK_BYTES = BLOCK * 4, /* of 8 bits; at most */
    BAND = 16                /* rows that a thread takes at a time */
};

/* How both pictures are read: with as many channels and bits as the one that has more. Grey with alpha is read as colours
 * with alpha, so that means are the same however a picture is stored. */
struct layout {
    unsigned colors, channels; /* colors: 1 or 3; channels: with alpha */
    unsigned bits;
};

static struct layout common_layout(const struct monge_picture *a, const struct monge_picture *b) {
    const bool color = a->channels >= 3 || b->channels >= 3;
    const bool alpha = a->channels % 2 == 0 || b->channels % 2 == 0;
    const unsigned colors = color || alpha ? 3 : 1, bits = a->bits > b->bits ? a->bits : b->bits;
    return (struct layout){colors, colors + alpha, bits};
}

static unsigned max_code(const struct layout *layout) { return (1u << layout->bits) - 1; }

/* What a thread has found. */
struct tally {
    uint64_t different, beyond, sum, squares;
    unsigned max;
    uint32_t max_x, max_y, left, top, right, bottom; /* right and bottom within */
};

struct job {
    const struct comparison *comparison;
    struct layout layout;
    unsigned limit;             /* what differs by more is beyond */
    uint8_t first[BLOCK_BYTES]; /* of pixels of 8 bits: 1 for the byte with which one begins, and else 0 */
    atomic_uint next;
    struct tally tallies[PARALLEL_MAX_THREADS];
};

static bool is_before(uint32_t x, uint32_t y, uint32_t than_x, uint32_t than_y) {
    return y < than_y || (y == than_y && x < than_x);
}

/* Where a pixel is that differs. They come row by row, each from left to right. */
INLINE void place_pixel(struct tally *t, unsigned largest, uint32_t x, uint32_t y) {
    if (t->max == 0) t->left = t->right = x, t->top = y;
    t->left = x < t->left ? x : t->left;
    t->right = x > t->right ? x : t->right;
    t->bottom = y;
    if (largest > t->max) t->max = largest, t->max_x = x, t->max_y = y;
}

INLINE void count_pixel(struct tally *t, unsigned largest, unsigned limit, uint32_t x, uint32_t y) {
    place_pixel(t, largest, x, y);
    t->different++;
    t->beyond += largest > limit;
}

/* A pixel of both, as that many numbers. */
INLINE void count_numbers(const struct job *job, struct tally *t, uint32_t x, uint32_t y, const uint16_t *a,
                          const uint16_t *b, unsigned channels) {
    unsigned largest = 0;
    for (unsigned c = 0; c < channels; c++) {
        const unsigned difference = (unsigned)abs(a[c] - b[c]);
        t->sum += difference;
        t->squares += (uint64_t)difference * difference;
        largest = difference > largest ? difference : largest;
    }
    if (largest > 0) count_pixel(t, largest, job->limit, x, y);
}

/* ---- BLOCK pixels of 8 bits, byte by byte. The number of bytes is known to the compiler ---- */

/* Of the compilers: they do not see by themselves that a block is apart from the pictures. */
typedef uint8_t lanes __attribute__((vector_size(BLOCK)));

/* The largest difference of a pixel's channels is at the byte with which it begins; what is at the others is of no use. */
struct block {
    uint8_t difference[BLOCK_BYTES + 4]; /* and zeros */
    uint8_t largest[BLOCK_BYTES];
};

/* What is ignored has no differences. */
INLINE void subtract_block(struct block *block, const uint8_t *a, const uint8_t *b, const uint8_t *ignored,
                           size_t channels) {
    const size_t size = BLOCK * channels;
    memset(block->difference + size, 0, 4);
    for (size_t i = 0; i < size; i += sizeof(lanes)) {
        lanes of_a, of_b;
        memcpy(&of_a, a + i, sizeof of_a);
        memcpy(&of_b, b + i, sizeof of_b);
        const lanes more = (lanes)(of_a > of_b),
                    difference = ((of_a - of_b) & more) | ((of_b - of_a) & ~more);
        memcpy(block->difference + i, &difference, sizeof difference);
    }
    for (size_t x = 0; ignored && x < BLOCK; x++)
        if (ignored[x]) memset(block->difference + x * channels, 0, channels);
}

INLINE void find_largest(struct block *block, size_t channels) {
    const size_t size = BLOCK * channels;
    const uint8_t *d = block->difference;
    memcpy(block->largest, d, size);
    for (size_t c = 1; c < channels; c++)
        for (size_t i = 0; i < size; i++)
            block->largest[i] = d[i + c] > block->largest[i] ? d[i + c] : block->largest[i];
}

INLINE unsigned sum_bytes(const uint8_t *bytes, size_t size) {
    uint16_t sum = 0; /* BLOCK_BYTES * 255 fits */
    for (size_t i = 0; i < size; i++) sum = (uint16_t)(sum + bytes[i]);
    return sum;
}

INLINE unsigned sum_squares(const uint8_t *bytes, size_t size) {
    int sum = 0;
    for (size_t i = 0; i < size; i++) sum += (int16_t)bytes[i] * (int16_t)bytes[i];
    return (unsigned)sum;
}

INLINE unsigned max_byte(const uint8_t *bytes, size_t size) {
    uint8_t max = 0;
    for (size_t i = 0; i < size; i++) max = bytes[i] > max ? bytes[i] : max;
    return max;
}

/* How many pixels differ by more than `limit`. */
INLINE unsigned count_beyond(const struct block *block, const uint8_t *first, unsigned limit, size_t size) {
    const uint8_t most = (uint8_t)limit;
    uint8_t count = 0;
    for (size_t i = 0; i < size; i++) count = (uint8_t)(count + ((block->largest[i] > most) & first[i]));
    return count;
}

/* Where the differences are matters only where there are larger ones than before, or further to the left or right. */
static void place_block(const struct block *block, struct tally *t, uint32_t begin, uint32_t y,
                        size_t channels) {
    for (uint32_t x = 0; x < BLOCK; x++)
        if (block->largest[x * channels] > 0) place_pixel(t, block->largest[x * channels], begin + x, y);
}

/* Those from column `begin` on, of which some are not equal. */
INLINE void count_block(const struct job *job, struct tally *t, uint32_t begin, uint32_t y, const uint8_t *a,
                        const uint8_t *b, const uint8_t *ignored, size_t channels) {
    const size_t size = BLOCK * channels;
    struct block block;
    subtract_block(&block, a, b, ignored, channels);
    const unsigned max = max_byte(block.difference, size);
    if (max == 0) return;
    find_largest(&block, channels);
    if (max > t->max || begin < t->left || begin + BLOCK - 1 > t->right)
        place_block(&block, t, begin, y, channels);
    t->bottom = y;
    t->different += count_beyond(&block, job->first, 0, size);
    t->beyond += count_beyond(&block, job->first, job->limit, size);
    t->sum += sum_bytes(block.difference, size);
    t->squares += sum_squares(block.difference, size);
}

/* ---- Pixels of other kinds, as the layout has them ---- */

/* With `to` channels instead of `from`. */
INLINE void add_channels(const uint8_t *in, uint8_t *out, size_t count, size_t from, size_t to,
                         size_t bytes) {
    for (size_t i = 0; i < count; i++, in += from * bytes)
        for (size_t c = 0; c < to; c++, out += bytes) {
            const size_t channel = c == 3 ? from - 1 : from >= 3 ? c : 0;
            if (c == 3 && from % 2 == 1)
                memset(out, 255, bytes); /* opaque */
            else
                memcpy(out, in + channel * bytes, bytes);
        }
}

INLINE void add_channels_of(const uint8_t *in, uint8_t *out, size_t count, size_t from, size_t to,
                            size_t bytes) {
    if (from == 1 && to == 3)
        add_channels(in, out, count, 1, 3, bytes);
    else if (from == 1)
        add_channels(in, out, count, 1, 4, bytes);
    else if (from == 2)
        add_channels(in, out, count, 2, 4, bytes);
    else
        add_channels(in, out, count, 3, 4, bytes);
}

/* 8 bits become 16 by v * 257, which keeps 0 and 1: both bytes are v. */
INLINE void add_bits(const uint8_t *in, uint8_t *out, size_t count) {
    for (size_t i = 0; i < count; i++) out[2 * i] = out[2 * i + 1] = in[i];
}

/* Room for a piece of a row. */
struct piece {
    uint8_t channels[PIECE * 8], bits[PIECE * 8];
};

/* At most PIECE pixels: those of the picture, or others in `room`. */
INLINE const uint8_t *lay_out(const struct monge_picture *picture, const uint8_t *at, size_t count,
                              const struct layout *layout, struct piece *room) {
    if (picture->channels != layout->channels) {
        if (picture->bits == 8)
            add_channels_of(at, room->channels, count, picture->channels, layout->channels, 1);
        else
            add_channels_of(at, room->channels, count, picture->channels, layout->channels, 2);
        at = room->channels;
    }
    if (picture->bits == layout->bits) return at;
    add_bits(at, room->bits, count * layout->channels);
    return room->bits;
}

/* ---- Rows ---- */

/* Pixels from column `begin` on, of which most are equal, byte by byte. channels and bits are known to the compiler, for those
 * that are common. */
INLINE void count_pixels(const struct job *job, struct tally *t, uint32_t begin, uint32_t y, uint32_t count,
                         const uint8_t *a, const uint8_t *b, unsigned channels, unsigned bits) {
    const size_t bytes = bits / 8, size = channels * bytes;
    const uint8_t *ignored = comparison_ignored(job->comparison, y);
    for (uint32_t i = 0; i < count; i += BLOCK) {
        const uint32_t end = count - i < BLOCK ? count : i + BLOCK;
        if (memcmp(a + i * size, b + i * size, (end - i) * size) == 0) continue;
        if (bits == 8 && end - i == BLOCK) {
            count_block(job, t, begin + i, y, a + i * size, b + i * size,
                        ignored ? ignored + begin + i : NULL, channels);
            continue;
        }
        for (uint32_t x = i; x < end; x++) {
            const uint8_t *at_a = a + x * size, *at_b = b + x * size;
            uint16_t of_a[4], of_b[4];
            if (memcmp(at_a, at_b, size) == 0 || (ignored && ignored[begin + x])) continue;
            for (unsigned c = 0; c < channels; c++) {
                of_a[c] = (uint16_t)picture_number(at_a + c * bytes, bits);
                of_b[c] = (uint16_t)picture_number(at_b + c * bytes, bits);
            }
            count_numbers(job, t, begin + x, y, of_a, of_b, channels);
        }
    }
}

INLINE void count_piece(const struct job *job, struct tally *t, uint32_t begin, uint32_t y, uint32_t count,
                        const uint8_t *a, const uint8_t *b) {
    const unsigned channels = job->layout.channels, bits = job->layout.bits;
    if (bits == 8 && channels == 3)
        count_pixels(job, t, begin, y, count, a, b, 3, 8);
    else if (bits == 8 && channels == 4)
        count_pixels(job, t, begin, y, count, a, b, 4, 8);
    else if (bits == 16 && channels == 3)
        count_pixels(job, t, begin, y, count, a, b, 3, 16);
    else
        count_pixels(job, t, begin, y, count, a, b, channels, bits);
}

INLINE void count_row(const struct job *job, struct tally *t, uint32_t y) {
    const struct monge_picture *a = job->comparison->a, *b = job->comparison->b;
    const size_t size_a = picture_pixel_size(a), size_b = picture_pixel_size(b);
    struct piece room_a, room_b;
    for (uint32_t x = 0; x < a->width; x += PIECE) {
        const uint32_t count = a->width - x < PIECE ? a->width - x : PIECE;
        const uint8_t *at_a = picture_row(a, y) + x * size_a, *at_b = picture_row(b, y) + x * size_b;
        if (size_a == size_b && memcmp(at_a, at_b, count * size_a) == 0 && a->bits == b->bits) continue;
        count_piece(job, t, x, y, count, lay_out(a, at_a, count, &job->layout, &room_a),
                    lay_out(b, at_b, count, &job->layout, &room_b));
    }
}

INLINE void count_bands(void *context, unsigned thread) {
    struct job *job = context;
    struct tally t = {0};
    const uint32_t height = job->comparison->a->height;
    const uint8_t *equal = job->comparison->equal;
    for (uint64_t band; (band = (uint64_t)BAND * atomic_fetch_add(&job->next, 1)) < height;)
        for (uint32_t y = (uint32_t)band; y < height && y < band + BAND; y++)
            if (!equal || !equal[y]) count_row(job, &t, y);
    job->tallies[thread] = t;
}

static void count_bands_plain(void *context, unsigned thread) { count_bands(context, thread); }
WIDE static void count_bands_wide(void *context, unsigned thread) { count_bands(context, thread); }

static void merge(struct tally *into, const struct tally *t) {
    if (t->different == 0) return;
    const struct tally was = *into;
    *into = *t;
    if (was.different == 0) return;
    into->different += was.different;
    into->beyond += was.beyond;
    into->sum += was.sum;
    into->squares += was.squares;
    if (was.left < into->left) into->left = was.left;
    if (was.top < into->top) into->top = was.top;
    if (was.right > into->right) into->right = was.right;
    if (was.bottom > into->bottom) into->bottom = was.bottom;
    if (was.max > into->max || (was.max == into->max && is_before(was.max_x, was.max_y, t->max_x, t->max_y)))
        into->max = was.max, into->max_x = was.max_x, into->max_y = was.max_y;
}

/* The largest whole number of `max` that is no more than max_delta. Divided, as a number in a scene or on the
 * command line is: 51 / 255 is the same double as 0.2. */
static unsigned limit_of(double max_delta, unsigned max) {
    unsigned limit = max_delta > 0.0 ? (unsigned)(fmin(max_delta, 1.0) * max) : 0;
    while (limit < max && (limit + 1) / (double)max <= max_delta) limit++;
    while (limit > 0 && limit / (double)max > max_delta) limit--;
    return limit;
}

static void tell(const struct tally *t, uint64_t pixels, const struct layout *layout,
                 struct monge_difference *out) {
    const double max = max_code(layout);
    const double numbers = pixels > 0 ? (double)(pixels * layout->channels) : 1.0;
    out->pixels = pixels;
    out->different = t->different;
    out->beyond = t->beyond;
    out->max = t->max / max;
    out->max_x = t->max_x;
    out->max_y = t->max_y;
    out->mae = (double)t->sum / numbers / max;
    out->rmse = sqrt((double)t->squares / numbers) / max;
    out->psnr = t->squares > 0 ? 0.0 - 20.0 * elementary_log10(out->rmse) : INFINITY; /* 0, not -0 */
    if (t->different > 0)
        out->bounds = (struct monge_region){t->left, t->top, t->right - t->left + 1, t->bottom - t->top + 1};
}

void compare_pixels(const struct comparison *comparison, double max_delta, struct monge_difference *out) {
    struct job job = {.comparison = comparison, .layout = common_layout(comparison->a, comparison->b)};
    job.limit = limit_of(max_delta, max_code(&job.layout));
    for (size_t i = 0; i < sizeof job.first; i++) job.first[i] = i % job.layout.channels == 0;
    parallel_run(comparison->threads, has_wide() ? count_bands_wide : count_bands_plain, &job);
    for (unsigned i = 1; i < comparison->threads; i++) merge(&job.tallies[0], &job.tallies[i]);
    tell(&job.tallies[0], comparison->pixels, &job.layout, out);
}

void compare_row(const struct comparison *comparison, uint32_t y, float *largest) {
    const struct monge_picture *a = comparison->a, *b = comparison->b;
    const struct layout layout = common_layout(a, b);
    const uint8_t *ignored = comparison_ignored(comparison, y);
    const size_t bytes = layout.bits / 8;
    struct piece room_a, room_b;
    for (uint32_t x = 0; x < a->width; x++) {
        const uint8_t *at_a = picture_row(a, y) + x * picture_pixel_size(a),
                      *at_b = picture_row(b, y) + x * picture_pixel_size(b);
        int worst = 0;
        at_a = lay_out(a, at_a, 1, &layout, &room_a);
        at_b = lay_out(b, at_b, 1, &layout, &room_b);
        for (size_t c = 0; c < layout.channels; c++) {
            const int difference = abs((int)picture_number(at_a + c * bytes, layout.bits) -
                                       (int)picture_number(at_b + c * bytes, layout.bits));
            if (difference > worst) worst = difference;
        }
        largest[x] = ignored && ignored[x] ? 0.0f : (float)worst / (float)max_code(&layout);
    }
}
