/* Affine maps of space, named target from source: world_from_object takes object space to world space.
 *
 *     | m[0][0] m[0][1] m[0][2] | m[0][3] |     column vectors: p' = M p + t
 *     | m[1][0] m[1][1] m[1][2] | m[1][3] |     t is the last column
 *     | m[2][0] m[2][1] m[2][2] | m[2][3] |     the row 0 0 0 1 is not stored
 */
#ifndef MONGE_BASE_AFFINE_H
#define MONGE_BASE_AFFINE_H

#include "base/ray.h"

typedef struct {
    double m[3][4];
} affine;

extern const affine AFFINE_IDENTITY;

affine affine_translate(vec3 by);
affine affine_scale(vec3 by);
affine affine_rotate(
    vec3 axis,
    double angle_deg); /* counter-clockwise seen against `axis`, which need not be unit but not null */
affine affine_columns(vec3 x, vec3 y, vec3 z, vec3 origin); /* takes the axes to x, y, z and 0 to origin */

/* The map that applies `first`, then `then`: then * first. */
affine affine_compose(affine then, affine first);

/* The inverse. False, leaving *inverse alone, where there is none: a determinant that vanishes beside
 * the lengths of the columns (relative 1e-12), or numbers out of the range that can be inverted. */
bool affine_invert(affine map, affine *inverse);

bool affine_is_finite(affine map);

/* If the linear part is a uniform scale times an orthogonal matrix (mirrored or not), to rounding:
 * true, and the factor > 0. False leaves *factor alone. */
bool affine_is_similarity(affine map, double *factor);

static inline vec3 affine_column(affine a, int column) {
    return (vec3){a.m[0][column], a.m[1][column], a.m[2][column]};
}

static inline vec3 affine_direction(const affine *a, vec3 d) {
    return (vec3){a->m[0][0] * d.x + a->m[0][1] * d.y + a->m[0][2] * d.z,
                  a->m[1][0] * d.x + a->m[1][1] * d.y + a->m[1][2] * d.z,
                  a->m[2][0] * d.x + a->m[2][1] * d.y + a->m[2][2] * d.z};
}

static inline vec3 affine_point(const affine *a, vec3 p) {
    return (vec3){a->m[0][0] * p.x + a->m[0][1] * p.y + a->m[0][2] * p.z + a->m[0][3],
                  a->m[1][0] * p.x + a->m[1][1] * p.y + a->m[1][2] * p.z + a->m[1][3],
                  a->m[2][0] * p.x + a->m[2][1] * p.y + a->m[2][2] * p.z + a->m[2][3]};
}

/* The normal `n` of source space, in target space: by the inverse transpose. Takes the *inverse*
 * map (object_from_world brings an object's normal to the world). Not normalized. A gradient keeps
 * its side, so a mirrored transform does not turn an outward normal inwards. */
static inline vec3 affine_normal(const affine *inverse, vec3 n) {
    return (vec3){inverse->m[0][0] * n.x + inverse->m[1][0] * n.y + inverse->m[2][0] * n.z,
                  inverse->m[0][1] * n.x + inverse->m[1][1] * n.y + inverse->m[2][1] * n.z,
                  inverse->m[0][2] * n.x + inverse->m[1][2] * n.y + inverse->m[2][2] * n.z};
}

/* The same line in the other space, with the same t: the direction is not normalized. */
static inline ray affine_ray(const affine *a, ray r) {
    return (ray){affine_point(a, r.org), affine_direction(a, r.dir)};
}

/* A bound of the rounding of affine_point, before the unit roundoff: |M| |p| + |t|. */
static inline vec3 affine_magnitude(const affine *a, vec3 p) {
    const vec3 q = vec3_abs(p);
    return (vec3){fabs(a->m[0][0]) * q.x + fabs(a->m[0][1]) * q.y + fabs(a->m[0][2]) * q.z + fabs(a->m[0][3]),
                  fabs(a->m[1][0]) * q.x + fabs(a->m[1][1]) * q.y + fabs(a->m[1][2]) * q.z + fabs(a->m[1][3]),
                  fabs(a->m[2][0]) * q.x + fabs(a->m[2][1]) * q.y + fabs(a->m[2][2]) * q.z +
                      fabs(a->m[2][3])};
}

#endif
