/* The fast way to the pixels of most pictures. */
#include <libdeflate.h>
#include <stdlib.h>
#include <string.h>

#include "base/pages.h"
#include "image/picture.h"

enum { FILTER_NONE, FILTER_SUB, FILTER_UP, FILTER_AVERAGE, FILTER_PAETH };

/* ---- Filters of rows: PNG specification, chapter 9 ---- */

/* Vectors of the compilers, which all machines have: a pixel is at most 8 bytes, and its bytes are added at once. What
 * is in them beyond the pixel is of no use and does no harm. */
typedef uint8_t bytes __attribute__((vector_size(8)));
typedef int16_t words __attribute__((vector_size(16)));
enum { ROOM = 8 /* bytes that may be read beyond the last pixel */ };

#define INLINE static inline __attribute__((always_inline))

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

static void add_above(uint8_t *row, const uint8_t *above, size_t size) {
    size_t i = 0;
    for (; i + 8 <= size; i += 8) store(row + i, load(row + i) + load(above + i), 8);
    for (; i < size; i++) row[i] = (uint8_t)(row[i] + above[i]);
}

INLINE void add_left(uint8_t *row, size_t size, size_t step) {
    bytes left = {0};
    for (size_t i = 0; i < size; i += step) {
        left += load(row + i);
        store(row + i, left, step);
    }
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

INLINE words absolute(words v) {
    const words sign = v >> 15;
    return (v ^ sign) - sign;
}

/* The pixel, from what is in the row and from those to the left, above and between. */
INLINE words paeth(words raw, words left, words up, words corner) {
    const words rise = up - corner, to_left = absolute(rise);
    const words run = left - corner, to_up = absolute(run), to_corner = absolute(run + rise);
    const words is_left = (to_left <= to_up) & (to_left <= to_corner), is_up = to_up <= to_corner;
    const words other = (up & is_up) | (corner & ~is_up);
    return (raw + ((left & is_left) | (other & ~is_left))) & 255;
}

INLINE void add_paeth(uint8_t *row, const uint8_t *above, size_t size, size_t step) {
    words left = {0}, corner = {0};
    for (size_t i = 0; i < size; i += step) {
        const words up = load_words(above + i);
        left = paeth(load_words(row + i), left, up, corner);
        store_words(row + i, left, step);
        corner = up;
    }
}

/* Of a row and the next, which follows a pixel behind: each pixel waits for the one to its left, and two rows wait
 * together. */
INLINE void add_paeth_twice(uint8_t *row, const uint8_t *above, uint8_t *next, size_t size, size_t step) {
    words up = load_words(above), left = paeth(load_words(row), (words){0}, up, (words){0});
    words corner = up, next_left = {0}, next_corner = {0};
    store_words(row, left, step);
    for (size_t i = step; i < size; i += step) {
        const words before = left;
        up = load_words(above + i);
        left = paeth(load_words(row + i), left, up, corner);
        next_left = paeth(load_words(next + i - step), next_left, before, next_corner);
        store_words(row + i, left, step);
        store_words(next + i - step, next_left, step);
        corner = up;
        next_corner = before;
    }
    store_words(next + size - step, paeth(load_words(next + size - step), next_left, left, next_corner),
                step);
}

INLINE bool undo_filter(uint8_t *row, const uint8_t *above, size_t size, size_t step) {
    switch (row[-1]) {
    case FILTER_NONE: return true;
    case FILTER_SUB: add_left(row, size, step); return true;
    case FILTER_UP: add_above(row, above, size); return true;
    case FILTER_AVERAGE: add_average(row, above, size, step); return true;
    case FILTER_PAETH: add_paeth(row, above, size, step); return true;
    }
    return false;
}

/* Of all rows in their place. `above` is a row of zeros, what is above the first. */
INLINE bool undo_all(uint8_t *rows, const uint8_t *above, size_t stride, uint32_t height, size_t step) {
    for (uint32_t y = 0; y < height; y++) {
        uint8_t *row = rows + y * stride;
        const bool twice = row[-1] == FILTER_PAETH && y + 1 < height && row[stride - 1] == FILTER_PAETH;
        if (twice)
            add_paeth_twice(row, above, row + stride, stride - 1, step);
        else if (!undo_filter(row, above, stride - 1, step))
            return false;
        above = twice ? row + stride : row;
        y += twice;
    }
    return true;
}

INLINE bool undo_by_step(uint8_t *rows, const uint8_t *above, size_t stride, uint32_t height, size_t step) {
    switch (step) {
    case 1: return undo_all(rows, above, stride, height, 1);
    case 2: return undo_all(rows, above, stride, height, 2);
    case 3: return undo_all(rows, above, stride, height, 3);
    case 4: return undo_all(rows, above, stride, height, 4);
    case 6: return undo_all(rows, above, stride, height, 6);
    case 8: return undo_all(rows, above, stride, height, 8);
    }
    return false;
}

static bool undo_plain(uint8_t *rows, const uint8_t *above, size_t stride, uint32_t height, size_t step) {
    return undo_by_step(rows, above, stride, height, step);
}

/* The same once more for machines with more instructions: half as long. */
#if defined __x86_64__
__attribute__((target("avx2"))) static bool undo_avx2(uint8_t *rows, const uint8_t *above, size_t stride,
                                                      uint32_t height, size_t step) {
    return undo_by_step(rows, above, stride, height, step);
}
#endif

static bool undo_filters(uint8_t *rows, size_t stride, uint32_t height, size_t step) {
    bool (*undo)(uint8_t *, const uint8_t *, size_t, uint32_t, size_t) = undo_plain;
    uint8_t *zero = calloc(1, stride + ROOM);
#if defined __x86_64__
    if (__builtin_cpu_supports("avx2")) undo = undo_avx2;
#endif
    const bool good = zero && undo(rows, zero, stride, height, step);
    free(zero);
    return good;
}

/* ---- The compressed data ---- */

static bool inflate_rows(const struct monge_picture *picture, uint8_t *out, size_t size) {
    size_t made = 0;
    const uint8_t *data = picture->file + picture->data.first + 8;
    struct libdeflate_decompressor *inflater = libdeflate_alloc_decompressor();
    const bool good = inflater && libdeflate_zlib_decompress(inflater, data, picture->data.bytes, out, size,
                                                             &made) == LIBDEFLATE_SUCCESS;
    libdeflate_free_decompressor(inflater);
    return good && made == size;
}

/* Rows of pixels of `step` bytes, each with the number of its filter before it. NULL: it did not work out. */
static uint8_t *decode_rows(const struct monge_picture *picture, size_t step) {
    const size_t stride = 1 + picture->width * step, size = stride * picture->height;
    if (size / DEFLATE_MAX_RATIO > picture->data.bytes) return NULL;
    uint8_t *rows = pages_alloc(size + ROOM);
    if (rows && inflate_rows(picture, rows, size) && undo_filters(rows + 1, stride, picture->height, step))
        return rows;
    free(rows);
    return NULL;
}

/* ---- Colors by number ---- */

INLINE void look_up(const struct monge_picture *picture, const uint8_t *numbers, uint8_t *out, size_t step) {
    for (uint32_t x = 0; x < picture->width; x++)
        memcpy(out + x * step, picture->palette[numbers[x]], 4); /* what is too much is written over */
}

static void decode_indexed(struct monge_picture *picture) {
    const size_t width = picture->width, stride = width * picture->channels;
    uint8_t *numbers = decode_rows(picture, 1);
    uint8_t *memory = numbers ? pages_alloc(stride * picture->height + ROOM) : NULL;
    for (uint32_t y = 0; memory && y < picture->height; y++) {
        const uint8_t *row = numbers + y * (width + 1) + 1;
        if (picture->channels == 3)
            look_up(picture, row, memory + y * stride, 3);
        else
            look_up(picture, row, memory + y * stride, 4);
    }
    free(numbers);
    picture->memory = picture->rows = memory;
    picture->stride = stride;
}

static void decode_plain(struct monge_picture *picture) {
    const size_t step = picture_pixel_size(picture);
    picture->memory = decode_rows(picture, step);
    picture->rows = picture->memory ? picture->memory + 1 : NULL;
    picture->stride = 1 + picture->width * step;
}

void picture_decode_plain(struct monge_picture *picture) {
    if (picture->plain) decode_plain(picture);
    if (picture->indexed) decode_indexed(picture);
}
