#include "image/pixels.h"

#include <stdlib.h>

#include "image/encode.h"

void pixels_hash_begin(struct hash *hash, uint32_t width, uint32_t height, unsigned bits,
                       enum monge_encoding encoding) {
    const uint64_t numbers[] = {width, height, bits, encoding};
    hash_begin(hash);
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) hash_integer(hash, numbers[i]);
}

bool pixels_hash_film(const struct monge_film *film, struct hash *hash) {
    const struct monge_settings *settings = &film->settings;
    const struct monge_region *region = &film->region;
    const size_t channels = 3 * (size_t)region->width, size = channels * (settings->bits / 8);
    struct encoder encoder;
    uint8_t *row = malloc(size);
    if (!row) return false;
    encoder_init(&encoder, settings->encoding, settings->bits);
    pixels_hash_begin(hash, region->width, region->height, settings->bits, settings->encoding);
    for (uint32_t y = 0; y < region->height; y++) {
        encoder_bytes(&encoder, film_pixel(film, 0, y), channels, row);
        hash_bulk(hash, row, size);
    }
    free(row);
    return true;
}
