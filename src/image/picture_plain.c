/* The fast way to the pixels of most pictures. */
#include <libdeflate.h>
#include <stdlib.h>
#include <string.h>

#include "image/picture.h"

enum { FILTER_NONE, FILTER_SUB, FILTER_UP, FILTER_AVERAGE, FILTER_PAETH };

/* ---- Filters of rows: PNG specification, chapter 9 ---- */

static void add_up(uint8_t *row, const uint8_t *above, size_t size) {
    for (size_t i = 0; i < size; i++) row[i] = (uint8_t)(row[i] + above[i]);
}

/* What the functions below have of the pixel before, by channel bytes: at most 8 of them. */
struct pixel {
    uint8_t byte[8];
};

static inline __attribute__((always_inline)) void add_left(uint8_t *row, size_t size, size_t step) {
    struct pixel left = {{0}};
    for (size_t i = 0; i < size; i += step)
        for (size_t k = 0; k < step; k++)
            row[i + k] = left.byte[k] = (uint8_t)(left.byte[k] + row[i + k]);
}

static inline __attribute__((always_inline)) void add_average(uint8_t *row, const uint8_t *above, size_t size,
                                                              size_t step) {
    struct pixel left = {{0}};
    for (size_t i = 0; i < size; i += step)
        for (size_t k = 0; k < step; k++)
            row[i + k] = left.byte[k] = (uint8_t)(row[i + k] + (left.byte[k] + above[i + k]) / 2);
}

static inline int paeth(int left, int above, int corner) {
    const int to_left = abs(above - corner), to_above = abs(left - corner);
    const int to_corner = abs(left + above - 2 * corner);
    const int upper = to_above <= to_corner ? above : corner;
    return to_left <= to_above && to_left <= to_corner ? left : upper;
}

static inline __attribute__((always_inline)) void add_paeth(uint8_t *row, const uint8_t *above, size_t size,
                                                            size_t step) {
    struct pixel left = {{0}}, corner = {{0}};
    for (size_t i = 0; i < size; i += step)
        for (size_t k = 0; k < step; k++) {
            const int guess = paeth(left.byte[k], above[i + k], corner.byte[k]);
            row[i + k] = left.byte[k] = (uint8_t)(row[i + k] + guess);
            corner.byte[k] = above[i + k];
        }
}

static inline __attribute__((always_inline)) bool undo_filter(uint8_t *row, const uint8_t *above, size_t size,
                                                              size_t step) {
    switch (row[-1]) {
    case FILTER_NONE: return true;
    case FILTER_SUB: add_left(row, size, step); return true;
    case FILTER_UP: add_up(row, above, size); return true;
    case FILTER_AVERAGE: add_average(row, above, size, step); return true;
    case FILTER_PAETH: add_paeth(row, above, size, step); return true;
    }
    return false;
}

/* The number of bytes of a pixel being known to the compiler, it keeps them in registers. */
static bool undo_filter_of(uint8_t *row, const uint8_t *above, size_t size, size_t step) {
    switch (step) {
    case 1: return undo_filter(row, above, size, 1);
    case 2: return undo_filter(row, above, size, 2);
    case 3: return undo_filter(row, above, size, 3);
    case 4: return undo_filter(row, above, size, 4);
    case 6: return undo_filter(row, above, size, 6);
    case 8: return undo_filter(row, above, size, 8);
    }
    return false;
}

/* Of all rows in their place. Above the first row is zero. */
static bool undo_filters(uint8_t *rows, size_t stride, uint32_t height, size_t step) {
    uint8_t *zero = calloc(1, stride);
    bool good = zero != NULL;
    const uint8_t *above = zero;
    for (uint32_t y = 0; good && y < height; y++) {
        uint8_t *row = rows + y * stride;
        good = undo_filter_of(row, above, stride - 1, step);
        above = row;
    }
    free(zero);
    return good;
}

/* ---- The compressed data ---- */

static uint32_t read_big(const uint8_t *at) {
    return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
}

/* What the IDAT chunks have, in one piece; *owned is to be freed. NULL: no memory. */
static const uint8_t *join_data(const struct monge_picture *picture, uint8_t **owned) {
    const uint8_t *chunk = picture->file + picture->data.first;
    *owned = NULL;
    if (read_big(chunk) == picture->data.bytes) return chunk + 8; /* the rest of them is empty */
    uint8_t *to = *owned = malloc(picture->data.bytes);
    while (to && chunk < picture->file + picture->data.last) {
        const size_t size = read_big(chunk);
        memcpy(to, chunk + 8, size);
        to += size;
        chunk += size + 12;
    }
    return *owned;
}

static bool inflate_rows(const struct monge_picture *picture, uint8_t *out, size_t size) {
    uint8_t *owned;
    size_t made = 0;
    const uint8_t *data = join_data(picture, &owned);
    struct libdeflate_decompressor *inflater = data ? libdeflate_alloc_decompressor() : NULL;
    const bool good = inflater && libdeflate_zlib_decompress(inflater, data, picture->data.bytes, out, size,
                                                             &made) == LIBDEFLATE_SUCCESS;
    libdeflate_free_decompressor(inflater);
    free(owned);
    return good && made == size;
}

void picture_decode_plain(struct monge_picture *picture) {
    const size_t step = picture_pixel_size(picture);
    const size_t stride = 1 + picture->width * step; /* a row has the number of its filter before it */
    const size_t size = stride * picture->height;
    if (!picture->plain || size / DEFLATE_MAX_RATIO > picture->data.bytes) return;
    uint8_t *memory = malloc(size);
    if (memory && inflate_rows(picture, memory, size) &&
        undo_filters(memory + 1, stride, picture->height, step)) {
        picture->memory = memory;
        picture->rows = memory + 1;
        picture->stride = stride;
    } else {
        free(memory);
    }
}
