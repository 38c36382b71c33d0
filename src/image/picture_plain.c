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

/* Whether the data can be of so many bytes: before memory is taken for them. */
static bool has_data(const struct monge_picture *picture, size_t size) {
    return size / DEFLATE_MAX_RATIO <= picture->data.bytes;
}

static uint8_t *inflate_straight(const struct monge_picture *picture, size_t stride) {
    const size_t size = stride * picture->height;
    uint8_t *rows = has_data(picture, size) ? pages_alloc(size + FILTERS_ROOM) : NULL;
    if (rows && inflate_rows(picture, rows, size) && filters_are_known(rows + 1, stride, picture->height))
        return rows;
    free(rows);
    return NULL;
}

/* ---- Interlaced pictures: PNG specification, chapter 8 ---- */

/* Of every `down` rows from y on the pixels from x on, every `across`. */
static const struct pass {
    uint32_t x, y, across, down;
} passes[] = {{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4},
              {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}};
enum { PASSES = sizeof passes / sizeof *passes };

static uint32_t count_from(uint32_t first, uint32_t size, uint32_t every) {
    return first < size ? (size - first - 1) / every + 1 : 0;
}

/* A row of a pass with the number of its filter; one without pixels has not even that. */
static size_t pass_stride(const struct pass *pass, const struct monge_picture *picture, size_t step) {
    const size_t width = count_from(pass->x, picture->width, pass->across);
    return width > 0 ? 1 + width * step : 0;
}

static uint32_t pass_height(const struct pass *pass, const struct monge_picture *picture) {
    return count_from(pass->y, picture->height, pass->down);
}

INLINE void spread_row(uint8_t *out, const uint8_t *row, size_t size, size_t every, size_t step) {
    for (size_t i = 0; i < size; i += step, out += every) memcpy(out, row + i, step);
}

static void place_row(uint8_t *out, const uint8_t *row, size_t size, size_t every, size_t step) {
    switch (step) {
    case 1: spread_row(out, row, size, every, 1); break;
    case 2: spread_row(out, row, size, every, 2); break;
    case 3: spread_row(out, row, size, every, 3); break;
    case 4: spread_row(out, row, size, every, 4); break;
    case 6: spread_row(out, row, size, every, 6); break;
    case 8: spread_row(out, row, size, every, 8); break;
    }
}

/* Undoes the filters of the pass, and puts its pixels to `rows` of the picture. */
static bool place_pass(const struct pass *pass, const struct monge_picture *picture, uint8_t *packed,
                       uint8_t *rows, size_t step) {
    const size_t stride = pass_stride(pass, picture, step), all = 1 + picture->width * step;
    const uint32_t height = pass_height(pass, picture);
    if (stride == 0 || height == 0) return true;
    if (!filters_are_known(packed + 1, stride, height) ||
        !filters_undo(packed + 1, stride, height, step, NULL))
        return false;
    for (uint32_t i = 0; i < height; i++)
        place_row(rows + (pass->y + (size_t)i * pass->down) * all + 1 + pass->x * step,
                  packed + i * stride + 1, stride - 1, pass->across * step, step);
    return true;
}

static uint8_t *decode_passes(const struct monge_picture *picture, size_t step) {
    size_t begin[PASSES + 1] = {0};
    for (int i = 0; i < PASSES; i++)
        begin[i + 1] = begin[i] + pass_stride(&passes[i], picture, step) * pass_height(&passes[i], picture);
    const size_t size = begin[PASSES];
    if (!has_data(picture, size)) return NULL;
    uint8_t *packed = pages_alloc(size + FILTERS_ROOM);
    uint8_t *rows = pages_alloc((1 + picture->width * step) * picture->height);
    bool good = packed && rows && inflate_rows(picture, packed, size);
    for (int i = 0; good && i < PASSES; i++)
        good = place_pass(&passes[i], picture, packed + begin[i], rows, step);
    free(packed);
    if (good) return rows;
    free(rows);
    return NULL;
}

/* ---- Pixels that are not as they are decoded ---- */

INLINE void unpack(const uint8_t *row, uint8_t *numbers, uint32_t width, unsigned bits) {
    for (uint32_t x = 0; x < width; x++)
        numbers[x] = (uint8_t)((unsigned)row[x * bits / 8] >> (8 - bits - x * bits % 8) & ((1u << bits) - 1));
}

static void unpack_row(const uint8_t *row, uint8_t *numbers, uint32_t width, unsigned bits) {
    switch (bits) {
    case 1: unpack(row, numbers, width, 1); break;
    case 2: unpack(row, numbers, width, 2); break;
    case 4: unpack(row, numbers, width, 4); break;
    }
}

INLINE void look_up(const struct monge_picture *picture, const uint8_t *numbers, uint8_t *out, size_t step) {
    for (uint32_t x = 0; x < picture->width; x++)
        memcpy(out + x * step, picture->palette[numbers[x]], 4); /* what is too much is written over */
}

static void look_up_row(const struct monge_picture *picture, const uint8_t *numbers, uint8_t *out) {
    switch (picture->channels) {
    case 1: look_up(picture, numbers, out, 1); break;
    case 2: look_up(picture, numbers, out, 2); break;
    case 3: look_up(picture, numbers, out, 3); break;
    case 4: look_up(picture, numbers, out, 4); break;
    }
}

INLINE void add_alpha(const struct monge_picture *picture, const uint8_t *row, uint8_t *out, size_t step,
                      size_t bytes) {
    for (uint32_t x = 0; x < picture->width; x++, row += step, out += step + bytes) {
        memcpy(out, row, step);
        memset(out + step, memcmp(row, picture->key, step) == 0 ? 0 : 255, bytes);
    }
}

static void add_alpha_row(const struct monge_picture *picture, const uint8_t *row, uint8_t *out) {
    if (picture->bits == 8)
        add_alpha(picture, row, out, 3, 1);
    else if (picture->channels == 2)
        add_alpha(picture, row, out, 2, 2);
    else
        add_alpha(picture, row, out, 6, 2);
}

static void expand_row(const struct monge_picture *picture, const uint8_t *row, uint8_t *numbers,
                       uint8_t *out) {
    if (picture->number_bits < 8) {
        unpack_row(row, numbers, picture->width, picture->number_bits);
        row = numbers;
    }
    if (picture->indexed)
        look_up_row(picture, row, out);
    else
        add_alpha_row(picture, row, out);
}

static void expand(struct monge_picture *picture) {
    const size_t stride = picture->width * picture_pixel_size(picture);
    uint8_t *numbers = malloc(picture->width), *memory = NULL;
    if (numbers) memory = pages_alloc(stride * picture->height + sizeof *picture->palette);
    for (uint32_t y = 0; memory && y < picture->height; y++)
        expand_row(picture, picture_row(picture, y), numbers, memory + y * stride);
    free(numbers);
    free(picture->memory);
    picture->memory = picture->rows = memory;
    picture->stride = stride;
}

/* ---- All of it ---- */

/* Of a pixel in the file. */
static size_t bits_of_pixel(const struct monge_picture *picture) {
    return picture->number_bits * (picture->indexed ? 1 : picture->channels - picture->keyed);
}

/* Has all filters as not undone. False: no memory. */
static bool mark_filtered(struct monge_picture *picture) {
    picture->filtered = malloc(picture->height);
    if (picture->filtered) memset(picture->filtered, 1, picture->height);
    return picture->filtered;
}

static void forget(struct monge_picture *picture) {
    free(picture->memory);
    free(picture->filtered);
    picture->memory = picture->filtered = NULL;
}

void picture_inflate_plain(struct monge_picture *picture) {
    const size_t bits = bits_of_pixel(picture);
    if (picture->interlaced && bits < 8) return;
    picture->stride = 1 + (picture->width * bits + 7) / 8;
    picture->memory = picture->interlaced ? decode_passes(picture, (bits + 7) / 8)
                                          : inflate_straight(picture, picture->stride);
    if (!picture->memory) return;
    picture->rows = picture->memory + 1;
    const bool other = picture->indexed || picture->keyed;
    if ((!picture->interlaced && !mark_filtered(picture)) || (other && !picture_undo(picture, NULL)))
        forget(picture);
    else if (other)
        expand(picture);
}

bool picture_undo(struct monge_picture *picture, const uint8_t *which) {
    const size_t step = (bits_of_pixel(picture) + 7) / 8;
    if (!picture->filtered) return true;
    if (!filters_undo(picture->rows, picture->stride, picture->height, step,
                      which ? which : picture->filtered))
        return false;
    for (uint32_t y = 0; which && y < picture->height; y++) picture->filtered[y] = !which[y];
    if (which) return true;
    free(picture->filtered);
    picture->filtered = NULL;
    return true;
}
