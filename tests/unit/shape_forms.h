/* What the tests of shape/ share: the canonical forms, one primitive on its own, random numbers. */
#ifndef MONGE_TESTS_SHAPE_FORMS_H
#define MONGE_TESTS_SHAPE_FORMS_H

#include "shape/shape.h"

/* clang-format off */
#define BOX(x0, y0, z0, x1, y1, z1) {{x0, y0, z0}, {x1, y1, z1}}
#define SLAB(z0, z1) BOX(-INFINITY, -INFINITY, z0, INFINITY, INFINITY, z1)

enum form {
    ELLIPSOID,
    CYLINDER,
    CONE,
    FRUSTUM,
    PARABOLOID,
    CUBE,
    TILTED,
    HYPERBOLOID,
    SHEETS,
    SADDLE,
    TUBE,
    OPEN_CONE,
    FORM_COUNT,
    CONVEX_FORMS = HYPERBOLOID /* those before it, and all closed */
};

static const char *const form_names[FORM_COUNT] = {"ellipsoid",  "cylinder", "cone",   "frustum",
                                                   "paraboloid", "box",      "tilted", "hyperboloid",
                                                   "two sheets", "saddle",   "tube",   "open cone"};

static const struct quadric_form forms[FORM_COUNT] = {
    [ELLIPSOID] =
        {.xx = 1, .yy = 1, .zz = 1, .constant = -1, .clip = BOX3_ALL, .extent = BOX(-1, -1, -1, 1, 1, 1)},
    [CYLINDER] =
        {.xx = 1, .yy = 1, .constant = -1, .clip = SLAB(-0.5, 0.5), .extent = BOX(-1, -1, -0.5, 1, 1, 0.5)},
    [CONE] = {.xx = 1, .yy = 1, .zz = -1, .clip = SLAB(-1, 0), .extent = BOX(-1, -1, -1, 1, 1, 0)},
    [FRUSTUM] = {.xx = 1, .yy = 1, .zz = -1, .clip = SLAB(-1, -0.25), .extent = BOX(-1, -1, -1, 1, 1, -0.25)},
    [PARABOLOID] = {.xx = 1, .yy = 1, .z = -1, .clip = SLAB(0, 1), .extent = BOX(-1, -1, 0, 1, 1, 1)},
    [CUBE] = {.constant = -1,
     .clip = BOX(-0.5, -0.5, -0.5, 0.5, 0.5, 0.5), .extent = BOX(-0.5, -0.5, -0.5, 0.5, 0.5, 0.5)},
    /* an ellipsoid with every term, cut by a box that leaves some of each */
    [TILTED] = {.xx = 2, .yy = 3, .zz = 1, .xy = 1, .yz = -0.5, .zx = 0.75, .x = -2, .y = 1, .z = -3,
     .constant = 1, .clip = BOX(-0.5, -1, 0.5, 1, 0.5, INFINITY), .extent = BOX(-0.5, -1, 0.5, 1, 0.5, 4)},
    [HYPERBOLOID] = {.xx = 1, .yy = 1, .zz = -1, .constant = -1,
     .clip = SLAB(-1, 1), .extent = BOX(-1.5, -1.5, -1, 1.5, 1.5, 1)},
    [SHEETS] = {.xx = 1, .yy = 1, .zz = -1, .constant = 0.25,
     .clip = SLAB(-1, 1), .extent = BOX(-1, -1, -1, 1, 1, 1)},
    [SADDLE] =
        {.xx = 1, .yy = -1, .z = -1, .clip = BOX(-1, -1, -1, 1, 1, 1), .extent = BOX(-1, -1, -1, 1, 1, 1)},
    [TUBE] = {.xx = 1, .yy = 1, .constant = -1,
     .clip = SLAB(-0.5, 0.5), .extent = BOX(-1, -1, -0.5, 1, 1, 0.5), .open = true},
    [OPEN_CONE] =
        {.xx = 1, .yy = 1, .zz = -1, .clip = SLAB(-1, 0), .extent = BOX(-1, -1, -1, 1, 1, 0), .open = true},
};
/* clang-format on */

/* One primitive on its own; p points into it, so it stays where it was made. */
struct alone {
    struct primitives p;
    primitive_ref ref;
    struct sphere sphere;
    struct flat flat;
    struct quadric quadric;
};

static inline void alone_sphere(struct alone *a, vec3 center, double radius) {
    *a = (struct alone){.sphere = {center, radius}, .ref = primitive_ref_make(PRIMITIVE_SPHERE, 0)};
    a->p.spheres = &a->sphere;
}

/* False where the map has no inverse. */
static inline bool alone_flat(struct alone *a, enum flat_outline outline, affine world_from_object) {
    *a = (struct alone){.flat = {.world_from_object = world_from_object, .outline = outline},
                        .ref = primitive_ref_make(PRIMITIVE_FLAT, 0)};
    a->p.flats = &a->flat;
    return affine_invert(world_from_object, &a->flat.object_from_world);
}

static inline bool alone_quadric(struct alone *a, const struct quadric_form *form, affine world_from_object) {
    *a = (struct alone){.quadric = {.world_from_object = world_from_object, .form = form},
                        .ref = primitive_ref_make(PRIMITIVE_QUADRIC, 0)};
    a->p.quadrics = &a->quadric;
    return affine_invert(world_from_object, &a->quadric.object_from_world);
}

#endif
