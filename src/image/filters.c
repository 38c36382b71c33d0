#include "image/filters.h"

#include <stdlib.h>
#include <string.h>

#include "base/wide.h"

enum { FILTER_NONE, FILTER_SUB, FILTER_UP, FILTER_AVERAGE, FILTER_PAETH };

/* Vectors of the compilers, which all machines have: a pixel is at most 8 bytes, and its bytes are added at once. What
 * is in them beyond the pixel is of no use and does no harm. */
typedef uint8_t bytes __attribute__((vector_size(8)));
typedef int16_t words __attribute__((vector_size(16)));
typedef uint8_t run __attribute__((vector_size(16))); /* of pixels */
typedef uint64_t halves __attribute__((vector_size(16)));

INLINE bytes load(const uint8_t *at) {
    bytes pixel;
    memcpy(&pixel, at, sizeof pixel);
    return pixel;
}

/* The first `step` of them, a number that is known to the compiler. By way of a number, not of the stack. */
INLINE void store(uint8_t *at, bytes pixel, size_t step) {
    const uint64_t all = (uint64_t)pixel;
    const size_t odd = step % 4 == 3 ? 2 : step == 6 ? 4 : step; /* 3 is 2 and 1, 6 is 4 and 2 */
    memcpy(at, &all, odd);
    const uint64_t rest = all >> (8 * odd % 64);
    if (step > odd) memcpy(at + odd, &rest, step - odd);
}

INLINE run load_run(const uint8_t *at) {
    run pixels;
    memcpy(&pixels, at, sizeof pixels);
    return pixels;
}

/* The first `size` bytes, 12 or 16. */
INLINE void store_run(uint8_t *at, run pixels, size_t size) {
    const halves both = (halves)pixels;
    const uint64_t low = both[0], high = both[1];
    memcpy(at, &low, 8);
    memcpy(at + 8, &high, size - 8);
}

static void add_above(uint8_t *row, const uint8_t *above, size_t size) {
    size_t i = 0;
    for (; i + 16 <= size; i += 16) store_run(row + i, load_run(row + i) + load_run(above + i), 16);
    for (; i < size; i++) row[i] = (uint8_t)(row[i] + above[i]);
}

INLINE void add_left_from(uint8_t *row, size_t begin, size_t size, size_t step) {
    bytes left = {0};
    if (begin > 0) left = load(row + begin - step);
    for (size_t i = begin; i < size; i += step) {
        left += load(row + i);
        store(row + i, left, step);
    }
}

/* Those of a run, each with all raw ones before it that are no more than a run away. */
INLINE run sum_run(const uint8_t *at, size_t length, size_t step) {
    run sum = load_run(at);
    for (size_t back = step; back < length; back += step) sum += load_run(at - back);
    return sum;
}

/* A pixel is the sum of the raw ones up to it: of those of a run's length, and of what the one before them has become. So
 * the pixels of a run do not wait for each other. The next are summed before theirs is written over what they need. */
INLINE void add_left(uint8_t *row, size_t size, size_t step) {
    const size_t length = step % 3 == 0 ? 12 : 16;
    size_t i = 0;
    if (size >= length) {
        run next = sum_run(row + length, length, step);
        add_left_from(row, 0, length, step);
        run left = load_run(row);
        for (i = length; i + length <= size; i += length) {
            left += next;
            next = sum_run(row + i + length, length, step);
            store_run(row + i, left, length);
        }
    }
    add_left_from(row, i, size, step);
}

INLINE words load_words(const uint8_t *at) { return __builtin_convertvector(load(at), words); }

INLINE void store_words(uint8_t *at, words pixel, size_t step) {
    store(at, __builtin_convertvector(pixel, bytes), step);
}

INLINE void add_average(uint8_t *row, const uint8_t *above, size_t size, size_t step) {
    words left = {0};
    for (size_t i = 0; i < size; i += step) {
        left = (load_words(row + i) + ((left + load_words(above + i)) >> 1)) & 255;
        store_words(row + i, left, step);
    }
}

/* Pixels, from what is in their rows and from those to the left, above and between. The nearest of these three to
 * left + up - corner is the larger one of left and up where far = 3 corner - left - up is above neither of them, the smaller
 * one where it is below neither, and else the corner. left is known last: `far > left` is rest > twice, and so on. */
INLINE words paeth(words raw, words left, words up, words corner) {
    const words rest = 3 * corner - up, rest_of_up = rest - up, twice = left + left;
    const words above_one = (rest > twice) | (rest_of_up > left);
    const words below_one = (twice > rest) | (left > rest_of_up);
    const words exchange = (left ^ up) & (left > up), larger = up ^ exchange, smaller = left ^ exchange;
    const words other = (smaller & ~below_one) | (corner & below_one);
    const words nearest = (larger & ~above_one) | (other & above_one);
    return (words)((run)raw + (run)nearest); /* byte by byte: every second is 0 */
}

/* Of the pixels from byte `begin` on. */
INLINE void add_paeth(uint8_t *row, const uint8_t *above, size_t begin, size_t end, size_t step) {
    words left = {0}, corner = {0};
    if (begin > 0) left = load_words(row + begin - step), corner = load_words(above + begin - step);
    for (size_t i = begin; i < end; i += step) {
        const words up = load_words(above + i);
        left = paeth(load_words(row + i), left, up, corner);
        store_words(row + i, left, step);
        corner = up;
    }
}

/* ---- Rows of that filter, two or four at once: each pixel waits for the one to its left, and they wait together ---- */

/* Two vectors make a wave, and each is of two rows, or of one where a pixel has more than four bytes. */
INLINE size_t rows_of_wave(size_t step) { return step <= 4 ? 4 : 2; }

INLINE words load_rows(const uint8_t *upper, const uint8_t *lower, size_t step) {
    uint32_t of_upper, of_lower;
    if (rows_of_wave(step) == 2) return load_words(upper);
    memcpy(&of_upper, upper, sizeof of_upper);
    memcpy(&of_lower, lower, sizeof of_lower);
    return __builtin_convertvector((bytes)((uint64_t)of_lower << 32 | of_upper), words);
}

INLINE void store_rows(uint8_t *upper, uint8_t *lower, words pixels, size_t step) {
    const bytes both = __builtin_convertvector(pixels, bytes);
    store(upper, both, step);
    if (rows_of_wave(step) == 4) store(lower, (bytes)((uint64_t)both >> 32), step);
}

/* Of the rows that are one above those of `pixels`; `before` has the rows before these. */
INLINE words move_up(words before, words pixels, size_t step) {
    return rows_of_wave(step) == 2 ? before : (words)(halves){((halves)before)[1], ((halves)pixels)[0]};
}

/* Each row is a pixel behind the one above it: what is above a pixel is what was made last in that row. */
INLINE void add_paeth_wave(uint8_t *row, const uint8_t *above, size_t stride, size_t size, size_t step) {
    const size_t rows = rows_of_wave(step), last = rows - 1, half = rows / 2;
    uint8_t *at[4], lefts[4][8] = {{0}}, corners[4][8] = {{0}};
    for (size_t k = 0; k < rows; k++) {
        const uint8_t *over = k > 0 ? row + (k - 1) * stride : above;
        const size_t done = (last - k) * step;
        at[k] = row + k * stride;
        add_paeth(at[k], over, 0, done, step);
        if (done > 0) memcpy(lefts[k], at[k] + done - step, step);
        if (done > 0) memcpy(corners[k], over + done - step, step);
        at[k] -= k * step;
    }
    words left[] = {load_rows(lefts[0], lefts[half - 1], step), load_rows(lefts[half], lefts[last], step)};
    words corner[] = {load_rows(corners[0], corners[half - 1], step),
                      load_rows(corners[half], corners[last], step)};
    for (size_t i = last * step; i < size; i += step) {
        const words top = load_rows(above + i, above + i, step);
        const words up[] = {move_up(top, left[0], step), move_up(left[0], left[1], step)};
        left[0] = paeth(load_rows(at[0] + i, at[half - 1] + i, step), left[0], up[0], corner[0]);
        left[1] = paeth(load_rows(at[half] + i, at[last] + i, step), left[1], up[1], corner[1]);
        store_rows(at[0] + i, at[half - 1] + i, left[0], step);
        store_rows(at[half] + i, at[last] + i, left[1], step);
        corner[0] = up[0];
        corner[1] = up[1];
    }
    for (size_t k = 1; k < rows; k++)
        add_paeth(row + k * stride, row + (k - 1) * stride, size - k * step, size, step);
}

INLINE void undo_filter(uint8_t *row, const uint8_t *above, size_t size, size_t step) {
    switch (row[-1]) {
    case FILTER_SUB: add_left(row, size, step); break;
    case FILTER_UP: add_above(row, above, size); break;
    case FILTER_AVERAGE: add_average(row, above, size, step); break;
    case FILTER_PAETH: add_paeth(row, above, 0, size, step); break;
    }
}

/* ---- All rows ---- */

struct filtered {
    uint8_t *rows;
    const uint8_t *zero;  /* a row of zeros, what is above the first */
    const uint8_t *which; /* NULL: all */
    size_t stride;
    uint32_t height;
};

/* How many rows from y on can be undone together: those of a wave, or one. */
INLINE uint32_t count_together(const struct filtered *f, uint32_t y, size_t step) {
    const uint32_t rows = (uint32_t)rows_of_wave(step);
    if (f->height - y < rows || f->stride - 1 < rows * step) return 1;
    for (uint32_t i = y; i < y + rows; i++)
        if ((f->rows - 1)[i * f->stride] != FILTER_PAETH) return 1;
    return rows;
}

INLINE void undo_all(const struct filtered *f, size_t step) {
    for (uint32_t y = 0, count = 1; y < f->height; y += count, count = 1) {
        uint8_t *row = f->rows + y * f->stride;
        const uint8_t *above = y > 0 ? row - f->stride : f->zero;
        if (f->which && !f->which[y]) continue;
        count = count_together(f, y, step);
        if (count > 1)
            add_paeth_wave(row, above, f->stride, f->stride - 1, step);
        else
            undo_filter(row, above, f->stride - 1, step);
    }
}

INLINE void undo_by_step(const struct filtered *f, size_t step) {
    switch (step) {
    case 1: undo_all(f, 1); break;
    case 2: undo_all(f, 2); break;
    case 3: undo_all(f, 3); break;
    case 4: undo_all(f, 4); break;
    case 6: undo_all(f, 6); break;
    case 8: undo_all(f, 8); break;
    }
}

static void undo_plain(const struct filtered *f, size_t step) { undo_by_step(f, step); }
WIDE static void undo_wide(const struct filtered *f, size_t step) { undo_by_step(f, step); }

bool filters_are_known(const uint8_t *rows, size_t stride, uint32_t height) {
    for (uint32_t y = 0; y < height; y++)
        if ((rows - 1)[y * stride] > FILTER_PAETH) return false;
    return true;
}

bool filters_look_up(const uint8_t *row) { return row[-1] >= FILTER_UP; }

bool filters_undo(uint8_t *rows, size_t stride, uint32_t height, size_t step, const uint8_t *which) {
    uint8_t *zero = calloc(1, stride + FILTERS_ROOM);
    const struct filtered filtered = {rows, zero, which, stride, height};
    if (zero) (has_wide() ? undo_wide : undo_plain)(&filtered, step);
    free(zero);
    return zero;
}
