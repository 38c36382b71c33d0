/* The fast way to the pixels of most pictures. */
#include <libdeflate.h>
#include <stdlib.h>
#include <string.h>

#include "base/pages.h"
#include "base/wide.h"
#include "image/filters.h"
#include "image/picture.h"

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
    uint8_t *rows = pages_alloc(size + FILTERS_ROOM);
    if (rows && inflate_rows(picture, rows, size) && filters_undo(rows + 1, stride, picture->height, step))
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
    uint8_t *memory = numbers ? pages_alloc(stride * picture->height + sizeof *picture->palette) : NULL;
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
