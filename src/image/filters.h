/* The filters of rows, which make them easier to compress: PNG specification, chapter 9. */
#ifndef MONGE_IMAGE_FILTERS_H
#define MONGE_IMAGE_FILTERS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { FILTERS_ROOM = 16 /* bytes that may be read beyond the last row */ };

/* A row is the number of its filter and then pixels of `step` bytes (1, 2, 3, 4, 6 or 8), `stride` bytes together. `rows` is
 * the first one's first pixel. */

/* Whether there are such filters. */
bool filters_are_known(const uint8_t *rows, size_t stride, uint32_t height);

/* Whether it takes the row above to undo the filter of this one. */
bool filters_look_up(const uint8_t *row);

/* Undoes the filters of rows in their place: of those for which `which` is 1, NULL being all. They are to be known filters. Of a
 * row that looks up and the one above it `which` has both or neither. False: no memory. */
bool filters_undo(uint8_t *rows, size_t stride, uint32_t height, size_t step, const uint8_t *which);

#endif
