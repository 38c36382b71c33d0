/* Films as PNG files. */
#ifndef MONGE_IMAGE_PNG_H
#define MONGE_IMAGE_PNG_H

#include "render/film.h"

/* Writes the film to `path` ("-": standard output), encoded as its settings say: 8 or 16 bits a
 * channel, with an sRGB chunk, or linear with gAMA 1. Text chunks, the hashes of 32 hexadecimal digits:
 *   Software       "Monge 1.2.3"
 *   monge:program  hash of the program's sources
 *   monge:scene    hash of the evaluated scene and settings
 *   monge:text     hash of the files that the scene was read from
 *   monge:files    those that it includes, relative to its folder, one a line; absent where there are none
 *   monge:options  what the caller of monge_render says it changed; absent where nothing
 *   monge:passes   what monge_film_note_passes was told; absent where nothing
 *   monge:region   where it is not the whole: "0,0,16,16 of 320x240"
 *   monge:pixels   hash of the pixels, see image/pixels.h; behind them
 * A regular file is written under a temporary name in the same folder, synced and renamed: complete
 * or absent, also when the process is killed in between. Anything else (a pipe, a device) is written
 * as it is. False on failure, with a message of at most `size` bytes in `message`, nothing left behind. */
bool png_write_film(const struct monge_film *film, const char *path, char *message, size_t size);

#endif
