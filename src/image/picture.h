/* PNG files in memory: their chunks, and their pixels once they are wanted. */
#ifndef MONGE_IMAGE_PICTURE_H
#define MONGE_IMAGE_PICTURE_H

#include "monge.h"

/* What the numbers in a file mean. */
struct color_space {
    enum { COLOR_SRGB, COLOR_GAMMA, COLOR_PROFILE } kind;
    int32_t gamma;        /* of COLOR_GAMMA: light = number ^ (100000 / gamma) */
    int32_t primaries[8]; /* of COLOR_GAMMA: x, y of white, red, green, blue times 100000; all 0: not said */
    uint8_t *profile;     /* of COLOR_PROFILE; owned */
    size_t profile_size;
    char name[96];
};

struct picture_text {
    char *key, *text; /* one piece of memory, of key */
};

/* Where the compressed pixels are in `file`. The chunks that have them are joined there to one, the first, which has no
 * check sum; behind it, up to `last`, is what was left over. */
struct picture_data {
    size_t first, last; /* of the IDAT chunks: where the first begins and where the last ended */
    size_t end;         /* where IEND begins */
    size_t bytes;       /* of all of them together: from first + 8 on */
};

struct monge_picture {
    char *name;    /* of the file, for messages */
    uint8_t *file; /* but for `data` as it was read */
    size_t file_size;
    struct picture_data data;
    uint32_t width, height;
    unsigned bits, channels; /* as decoded: 8 or 16, 1 to 4 */
    /* In the file, but for compression and filters: */
    unsigned number_bits;    /* 1, 2, 4, 8 or 16 */
    bool interlaced;         /* in seven passes */
    bool indexed;            /* a pixel is one number, of an entry in: */
    uint8_t palette[256][4]; /* as it is decoded: red, green, blue, alpha; grey, alpha */
    bool keyed;              /* a pixel of these bytes is transparent, of others opaque: */
    uint8_t key[6];
    struct color_space space;
    struct picture_text *texts;
    size_t text_count;
    uint8_t *memory;   /* NULL: not decoded */
    uint8_t *rows;     /* in `memory` */
    size_t stride;     /* bytes from one row to the next */
    uint8_t *filtered; /* 1 for each row of which the filter is not undone yet; NULL: none; owned */
};

enum { PICTURE_REASON_SIZE = 200 };

/* No stream of DEFLATE becomes more than this many times as long: 258 bytes take two bits. */
#define DEFLATE_MAX_RATIO 1032

/* Reads the file and checks its chunks. *picture is zeroed. False, with the reason: no PNG, or damaged; or, where
 * *system becomes true, the file cannot be read. Either way to be freed. */
bool picture_open(struct monge_picture *picture, const char *path, char reason[PICTURE_REASON_SIZE],
                  bool *system);
void picture_close(struct monge_picture *picture);

/* Decodes the pixels where that has not been done. False, with the reason, when they are damaged, or there is no
 * memory for them. */
bool picture_decode(struct monge_picture *picture, char reason[PICTURE_REASON_SIZE]);

/* The same, but for the filters of rows: those are left to be undone that picture->filtered tells. */
bool picture_inflate(struct monge_picture *picture, char reason[PICTURE_REASON_SIZE]);

/* The same by libdeflate: several times as fast as libpng's way, and giving up
 * wherever something is out of the ordinary. picture->memory stays NULL when it fails. */
void picture_inflate_plain(struct monge_picture *picture);

/* Undoes the filters that are left, or where none has been undone those of rows for which `which` is 1: as filters_undo. */
bool picture_undo(struct monge_picture *picture, const uint8_t *which);

static inline const uint8_t *picture_row(const struct monge_picture *picture, uint32_t y) {
    return picture->rows + y * picture->stride;
}

/* One number of a pixel, of 8 or 16 bits. */
static inline unsigned picture_number(const uint8_t *at, unsigned bits) {
    return bits == 16 ? (unsigned)at[0] << 8 | at[1] : at[0];
}

/* Bytes of a pixel. */
static inline size_t picture_pixel_size(const struct monge_picture *picture) {
    return picture->channels * (picture->bits / 8);
}

#endif
