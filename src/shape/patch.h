/* A patch is one smooth part of a surface: where a function of object space is zero, positive
 * outside. It is all that is needed to move a hit onto the surface, and for its normal and its
 * error. Private to shape/. */
#ifndef MONGE_SHAPE_PATCH_H
#define MONGE_SHAPE_PATCH_H

#include "shape/shape.h"

struct patch {
    const struct quadric_form *form; /* Q(p); NULL: the plane sign * (p[axis] - at) */
    int axis;                        /* 0, 1, 2 */
    double at, sign;                 /* sign is 1 or -1 */
};

/* Q at a point of object space. */
static inline double form_value(const struct quadric_form *f, vec3 p) {
    return p.x * (f->xx * p.x + f->xy * p.y + f->zx * p.z + f->x) + p.y * (f->yy * p.y + f->yz * p.z + f->y) +
           p.z * (f->zz * p.z + f->z) + f->constant;
}

/* The surface where the ray crosses the patch, at t or near it.
 *   reach  world units along each axis, >= 0: how far a ray that leaves from here, almost along the
 *          surface, can run by the same primitive; 0 where that has no end */
struct surface patch_surface(const struct patch *patch, const affine *object_from_world, vec3 reach, ray r,
                             double t);

#endif
