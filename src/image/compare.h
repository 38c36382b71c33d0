/* How two pictures differ. */
#ifndef MONGE_IMAGE_COMPARE_H
#define MONGE_IMAGE_COMPARE_H

#include "image/picture.h"

/* Two pictures of the same size and colour space, decoded as far as it takes to see where they differ. */
struct comparison {
    struct monge_picture *a, *b;
    unsigned threads;
    uint8_t *
        equal; /* height, 1 where rows are known to be equal: what is in them may be filtered; NULL: none; owned */
    uint8_t *ignored; /* width * height, 1 where a pixel is ignored; NULL: none is; owned */
    uint64_t pixels;  /* that are not ignored */
};

/* Decodes the pictures, but for rows that are equal, and the mask, each on a thread of its own. False, with the reason and
 * the picture that it is about. Either way to be ended. */
bool comparison_begin(struct comparison *comparison, struct monge_picture *a, struct monge_picture *b,
                      const struct monge_compare *how, char reason[PICTURE_REASON_SIZE],
                      const struct monge_picture **about);
void comparison_end(struct comparison *comparison);

/* Decodes the rows that are equal, too: before anything looks at a pixel by itself. False: no memory. */
bool comparison_decode(const struct comparison *comparison);

/* Whether row y of ignored pixels, and the pixel x in it, counts as equal. */
static inline const uint8_t *comparison_ignored(const struct comparison *comparison, uint32_t y) {
    return comparison->ignored ? comparison->ignored + (size_t)y * comparison->a->width : NULL;
}

/* The first of these that is not the same, whatever the pixels are. */
enum monge_unlike compare_unlike(const struct monge_picture *a, const struct monge_picture *b);

/* The whole of monge_compare. */
bool compare_pictures(struct monge_picture *a, struct monge_picture *b, const struct monge_compare *how,
                      struct monge_difference *out, char reason[PICTURE_REASON_SIZE],
                      const struct monge_picture **about);

/* Counts what is different, pixel by pixel, into all fields of *out but `same`, `unlike`, `ssim` and `flip`. */
void compare_pixels(const struct comparison *comparison, double max_delta, struct monge_difference *out);

/* The largest difference of a channel of each pixel of a row, 0 .. 1. */
void compare_row(const struct comparison *comparison, uint32_t y, float *largest);

#endif
