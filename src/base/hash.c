#include "base/hash.h"

#include <string.h>

#define FNV_PRIME ((unsigned __int128)1 << 88 | 0x13b)

/* The offset basis of the 128-bit FNV-1a. */
void hash_begin(struct hash *hash) { *hash = (struct hash){0x6c62272e07bb0142u, 0x62b821756295c58du}; }

void hash_bytes(struct hash *hash, const void *bytes, size_t size) {
    const unsigned char *byte = bytes;
    unsigned __int128 sum = (unsigned __int128)hash->high << 64 | hash->low;
    for (size_t i = 0; i < size; i++) sum = (sum ^ byte[i]) * FNV_PRIME;
    *hash = (struct hash){(uint64_t)(sum >> 64), (uint64_t)sum};
}

void hash_bulk(struct hash *hash, const void *bytes, size_t size) {
    const unsigned char *byte = bytes;
    unsigned __int128 sum = (unsigned __int128)hash->high << 64 | hash->low;
    for (size_t i = 0; i + 8 <= size; i += 8) {
        uint64_t word = 0;
        for (int k = 7; k >= 0; k--) word = word << 8 | byte[i + (size_t)k];
        sum = (sum ^ word) * FNV_PRIME;
    }
    *hash = (struct hash){(uint64_t)(sum >> 64), (uint64_t)sum};
    hash_bytes(hash, byte + size / 8 * 8, size % 8);
    hash_integer(hash, size);
}

void hash_integer(struct hash *hash, uint64_t value) {
    unsigned char bytes[8];
    for (int i = 0; i < 8; i++) bytes[i] = (unsigned char)(value >> (8 * i));
    hash_bytes(hash, bytes, sizeof bytes);
}

void hash_double(struct hash *hash, double value) {
    uint64_t bits;
    const double plain = value == 0.0 ? 0.0 : value;
    memcpy(&bits, &plain, sizeof bits);
    hash_integer(hash, bits);
}

void hash_vec3(struct hash *hash, vec3 value) {
    hash_double(hash, value.x);
    hash_double(hash, value.y);
    hash_double(hash, value.z);
}

void hash_text(const struct hash *hash, char text[HASH_TEXT_SIZE]) {
    for (int i = 0; i < 16; i++) {
        const uint64_t half = i < 8 ? hash->high : hash->low;
        const unsigned byte = (unsigned)(half >> (56 - 8 * (i & 7))) & 0xff;
        text[2 * i] = "0123456789abcdef"[byte >> 4];
        text[2 * i + 1] = "0123456789abcdef"[byte & 15];
    }
    text[HASH_TEXT_SIZE - 1] = '\0';
}
