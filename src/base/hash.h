/* FNV-1a with 128 bits (Fowler, Noll, Vo): tells pictures and scenes apart, against accidents, not
 * against an adversary. Numbers go in as their IEEE bits, least byte first, on every machine. */
#ifndef MONGE_BASE_HASH_H
#define MONGE_BASE_HASH_H

#include <stddef.h>
#include <stdint.h>

#include "base/vec3.h"

struct hash {
    uint64_t high, low;
};

enum { HASH_TEXT_SIZE = 33 }; /* 32 hexadecimal digits and the final zero */

void hash_begin(struct hash *hash);
void hash_bytes(struct hash *hash, const void *bytes, size_t size);

/* Many bytes at once, 8 as one: for texts and pixels. Not what hash_bytes would give. */
void hash_bulk(struct hash *hash, const void *bytes, size_t size);
void hash_integer(struct hash *hash, uint64_t value);
void hash_double(struct hash *hash, double value); /* -0 counts as 0 */
void hash_vec3(struct hash *hash, vec3 value);
void hash_text(const struct hash *hash, char text[HASH_TEXT_SIZE]);

#endif
