/* The refracting bodies that a ray is inside of, outermost first: what the index of refraction is on
 * either side of a surface. A body that a ray has entered stays on the list until the ray leaves it. */
#ifndef MONGE_RENDER_MEDIA_H
#define MONGE_RENDER_MEDIA_H

#include "scene/scene.h"

enum { MEDIA_MAX = 16 }; /* a ray inside of more forgets the further ones */

struct media {
    int count;
    struct {
        uint32_t number; /* of the primitive */
        double index;    /* of refraction */
    } inside[MEDIA_MAX];
};

/* The index of refraction around: that of the body entered last, 1 outside of all. */
double media_index(const struct media *media);

/* The media after a ray has passed the surface of primitive `number` inwards or outwards. Only
 * bodies that divide space are kept: solids and planes. */
struct media media_enter(const struct scene *scene, const struct media *media, uint32_t number);
struct media media_leave(const struct media *media, uint32_t number, bool *was_inside);

/* The refracting bodies of the scene that could hold a camera: numbers, in an array of `arena`. */
uint32_t *media_candidates(struct arena *arena, const struct scene *scene, uint32_t *count);

/* The media at the origin of a ray. Nested bodies are told apart by which the ray leaves last. */
struct media media_at(const struct scene *scene, const uint32_t *candidates, uint32_t count, ray r);

#endif
