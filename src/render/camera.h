/* The camera, with all that the scene leaves open decided. */
#ifndef MONGE_RENDER_CAMERA_H
#define MONGE_RENDER_CAMERA_H

#include "accel/accel.h"
#include "scene/scene.h"

/* World space. `right` and `up` reach from the middle of the picture to its right and upper edge, at
 * the distance of `forward` (perspective) or as they are (orthographic). */
struct view {
    bool orthographic;
    vec3 eye, forward, right, up;
    double distance; /* from the eye to what is looked at; for placing default lights */
};

/* For a picture of this size. */
struct view camera_view(const struct scene *scene, const struct accel *accel, uint32_t width,
                        uint32_t height);

/* The ray through the point (x, y) of the picture, in 0..1 from its top left corner. Its direction
 * is not unit. */
static inline ray camera_ray(const struct view *view, double x, double y) {
    const vec3 across = vec3_madd(vec3_scale(view->right, 2.0 * x - 1.0), 1.0 - 2.0 * y, view->up);
    if (view->orthographic) return (ray){vec3_add(view->eye, across), view->forward};
    return (ray){view->eye, vec3_add(view->forward, across)};
}

#endif
