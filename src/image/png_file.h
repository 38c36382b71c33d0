/* A PNG file on its way, by libpng. */
#ifndef MONGE_IMAGE_PNG_FILE_H
#define MONGE_IMAGE_PNG_FILE_H

#include <png.h>
#include <stdbool.h>
#include <stdint.h>

struct png_file {
    png_structp png;
    png_infop info;
    uint8_t *row; /* room for one */
    char reason[128];
};

/* Writes the file, complete or not at all, as png_write_film. `put` gives libpng everything, from the header to
 * png_write_end; file->row, of `row_size` bytes, is for it. libpng's errors leave it by longjmp: it must own nothing, and
 * what is needed later must be in *context. False: file->reason says why; the rest of *file is gone either way. */
bool png_file_write(struct png_file *file, const char *path, size_t row_size,
                    void (*put)(struct png_file *file, const void *context), const void *context);

#endif
