/* PNG files, by libpng: the only place that includes png.h. */
#ifndef MONGE_IMAGE_PNG_H
#define MONGE_IMAGE_PNG_H

#include "render/film.h"

/* Writes the film to `path` ("-": standard output), encoded as its settings say: 8 or 16 bits a
 * channel, with an sRGB chunk, or linear with gAMA 1. Text chunks: Software (program and version),
 * monge:scene (hash of the evaluated scene and settings), monge:region where it is not the whole.
 * A regular file is written under a temporary name in the same folder, synced and renamed: complete
 * or absent, also when the process is killed in between. Anything else (a pipe, a device) is written
 * as it is. False on failure, with a message of at most `size` bytes in `message`, nothing left behind. */
bool png_write_film(const struct monge_film *film, const char *path, char *message, size_t size);

#endif
