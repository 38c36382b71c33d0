/* The refracting bodies that a ray is inside of, outermost first: what the index of refraction is on
 * either side of a surface. A body that a ray has entered stays on the list until the ray leaves it. */
#ifndef MONGE_RENDER_MEDIA_H
#define MONGE_RENDER_MEDIA_H

#include "accel/accel.h"
#include "scene/scene.h"

enum { MEDIA_MAX = 16 }; /* a ray inside of more forgets the further ones */

struct media {
    int count;
    struct {
        const struct occurrence *which; /* of the body; kept by whoever entered it */
        double index;                   /* of refraction */
    } inside[MEDIA_MAX];
};

/* The media where a path begins, with the bodies: not to be copied or moved. */
struct media_origin {
    struct media media;
    struct occurrence occurrences[MEDIA_MAX];
};

/* The index of refraction around: that of the body entered last, 1 outside of all. */
double media_index(const struct media *media);

/* The media after a ray has passed the surface that it hit inwards or outwards. Only bodies that
 * divide space are kept: solids and planes. After media_enter, `hit` must outlive the media. */
struct media media_enter(const struct scene *scene, const struct media *media, const struct hit *hit);
struct media media_leave(const struct media *media, const struct hit *hit, bool *was_inside);

/* The media at the origin of a ray. Nested bodies are told apart by which the ray leaves last. */
void media_at(const struct scene *scene, const struct accel *accel, struct accel_watch *watch, ray r,
              struct media_origin *out);

#endif
