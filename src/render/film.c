#include "render/film.h"

#include <stdlib.h>

struct monge_film *film_new(const struct monge_settings *settings, struct monge_region region) {
    struct monge_film *film = malloc(sizeof *film);
    if (!film) return NULL;
    *film = (struct monge_film){.settings = *settings, .region = region};
    film->rgb = calloc((size_t)region.width * region.height, 3 * sizeof *film->rgb);
    if (film->rgb) return film;
    free(film);
    return NULL;
}

void monge_film_free(struct monge_film *film) {
    if (!film) return;
    free(film->rgb);
    free(film->files);
    free(film->options);
    free(film->passes);
    free(film);
}

struct monge_region monge_film_region(const struct monge_film *film) {
    return film->region;
}

const float *monge_film_pixels(const struct monge_film *film) { return film->rgb; }
