/* What a ray meets: crossings, surfaces, normals and bounds of the primitives. Pure functions; no
 * state, no allocation. Rays are in world space, and t is in multiples of the ray's direction, which
 * need not be unit, but long and short enough (1e-100 .. 1e100) for its square to be a number.
 * An instance is not a shape: it is never crossed, not solid, and its bounds are infinite. What it places
 * is asked for in the space of the geometry and brought to the world by the two functions at the end. */
#ifndef MONGE_SHAPE_SHAPE_H
#define MONGE_SHAPE_SHAPE_H

#include "base/ray.h"
#include "scene/primitive.h"

/* Which part of a surface was crossed. */
enum shape_part {
    SHAPE_SIDE, /* the sphere, the flat, the quadric itself */
    SHAPE_CUT_MIN_X,
    SHAPE_CUT_MAX_X, /* the faces of a quadric's clip box */
    SHAPE_CUT_MIN_Y,
    SHAPE_CUT_MAX_Y,
    SHAPE_CUT_MIN_Z,
    SHAPE_CUT_MAX_Z,
};

struct crossing {
    double t; /* finite, may be negative */
    enum shape_part part;
};

enum { SHAPE_MAX_CROSSINGS = 4 };

/* All crossings of the line with the primitive, in order of t; the count, 0 .. SHAPE_MAX_CROSSINGS.
 * Of a solid (sphere, closed quadric) they come in pairs, in and out, unless one end is at infinity.
 * A graze (a double root) is a miss; so is anything that is not a number. */
int shape_crossings(const struct primitives *p, primitive_ref ref, ray r,
                    struct crossing out[SHAPE_MAX_CROSSINGS]);

/* The first crossing with t_min < t <= t_max. False, leaving *out alone, where there is none. */
bool shape_first_crossing(const struct primitives *p, primitive_ref ref, ray r, double t_min, double t_max,
                          struct crossing *out);

/* A point of a surface. */
struct surface {
    vec3 point;   /* world space, moved onto the surface as exactly as doubles allow */
    vec3 normal;  /* world space, unit, outwards (of a flat: its +z) */
    double error; /* >= 0, world units: the true surface is within this of `point`, and a ray that starts
                     further than this from it, measured along the normal, finds itself on the right side */
};

/* The surface at a crossing that shape_crossings gave for the same ray. */
struct surface shape_surface(const struct primitives *p, primitive_ref ref, ray r, struct crossing crossing);

/* Whether the primitive has an inside: spheres and closed quadrics; not flats and open quadrics. */
bool shape_is_solid(const struct primitives *p, primitive_ref ref);

/* Whether a world-space point is inside a solid; its surface is not. False for what is not solid. */
bool shape_contains(const struct primitives *p, primitive_ref ref, vec3 point);

/* The largest dot product of a point of the primitive with `direction` (world space, any length):
 * how far it reaches that way, to rounding. Infinite where the primitive is, or may be. */
double shape_support(const struct primitives *p, primitive_ref ref, vec3 direction);

/* A world-space box that holds the primitive, rounded outwards; infinite where the primitive is. */
box3 shape_bounds(const struct primitives *p, primitive_ref ref);

/* A surface of the instance's geometry, in world space. `extent`: bounds of the geometry, in its space, or
 * empty; the error holds for rays in the world that run so far. */
struct surface shape_placed_surface(const struct instance *instance, const struct surface *surface,
                                    box3 extent);

/* A world-space box that holds what the instance places of a bounded or empty box of its geometry,
 * rounded outwards. */
box3 shape_placed_bounds(const struct instance *instance, box3 box);

#endif
