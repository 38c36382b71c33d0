/* Portable float maps of one channel: "Pf", the size, -1.0 for numbers with their least byte first, and the rows
 * from the bottom up (Debevec). Nothing else is in such a file. */
#ifndef MONGE_IMAGE_PFM_H
#define MONGE_IMAGE_PFM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Writes width * height values, row by row from the top left, complete or not at all, as png_write_film. False: the
 * reason is in `message`. */
bool pfm_write(const char *path, uint32_t width, uint32_t height, const float *values, char *message,
               size_t size);

/* Reads a file of at most `most` values, whatever the order of its bytes. *values is to be freed. False: the reason
 * is in `message`. */
bool pfm_read(const char *path, size_t most, uint32_t *width, uint32_t *height, float **values, char *message,
              size_t size);

#endif
