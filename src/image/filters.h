/* The filters of rows, which make them easier to compress: PNG specification, chapter 9. */
#ifndef MONGE_IMAGE_FILTERS_H
#define MONGE_IMAGE_FILTERS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { FILTERS_ROOM = 16 /* bytes that may be read beyond the last row */ };

/* Undoes the filters of all rows in their place. A row is the number of its filter and then pixels of `step` bytes (1, 2, 3, 4,
 * 6 or 8), `stride` bytes together; `rows` is the first one's first pixel. False: there is no such filter, or no memory. */
bool filters_undo(uint8_t *rows, size_t stride, uint32_t height, size_t step);

#endif
