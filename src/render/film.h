/* The film: linear colour of a region of the picture, filled tile by tile. */
#ifndef MONGE_RENDER_FILM_H
#define MONGE_RENDER_FILM_H

#include "base/hash.h"
#include "monge.h"

struct monge_film {
    struct monge_settings settings; /* of the render that filled it */
    struct monge_region region;     /* pixels of the whole picture */
    struct hash scene;              /* of the evaluated scene and the settings that change a pixel */
    struct hash texts;              /* of the files that the scene was read from */
    char *files, *options, *passes; /* owned: for the text chunks of its picture; NULL: none */
    float *rgb;                     /* region.width * region.height * 3, row by row from the top left */
};

/* A black film; NULL when there is no memory for it. Freed by monge_film_free. */
struct monge_film *film_new(const struct monge_settings *settings, struct monge_region region);

static inline float *film_pixel(const struct monge_film *film, uint32_t x, uint32_t y) {
    return film->rgb + 3 * ((size_t)y * film->region.width + x); /* x, y within the region */
}

#endif
