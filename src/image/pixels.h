/* A hash of a picture's pixels as its file has them: of every file with the same pixels, however it is compressed. */
#ifndef MONGE_IMAGE_PIXELS_H
#define MONGE_IMAGE_PIXELS_H

#include "render/film.h"

/* Begins the hash of a picture; each row follows by hash_bulk: red, green, blue of `bits` each, the high byte first. */
void pixels_hash_begin(struct hash *hash, uint32_t width, uint32_t height, unsigned bits,
                       enum monge_encoding encoding);

/* That of the file that png_write_film would write. False: no memory. */
bool pixels_hash_film(const struct monge_film *film, struct hash *hash);

#endif
