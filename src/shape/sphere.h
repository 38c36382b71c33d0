/* Spheres, in world space. Private to shape/; for the arguments see shape.h. */
#ifndef MONGE_SHAPE_SPHERE_H
#define MONGE_SHAPE_SPHERE_H

#include "shape/shape.h"

/* The stretch of the line inside the sphere, *enter < *leave, in multiples of r.dir. False, leaving
 * both alone, on a miss, a graze or a NaN. */
static inline bool sphere_chord(const struct sphere *s, ray r, double *enter, double *leave) {
    const vec3 org = vec3_sub(r.org, s->center);
    const double len2 = vec3_dot(r.dir, r.dir);
    const double mid = -vec3_dot(org, r.dir) / len2;
    const vec3 closest = vec3_madd(org, mid, r.dir);
    const double depth2 = s->radius * s->radius - vec3_dot(closest, closest); /* b*b-4ac cancels when far */
    if (!(depth2 > 0.0)) return false;                                        /* negated, so NaN is a miss */
    const double half = sqrt(depth2 / len2);
    *enter = mid - half;
    *leave = mid + half;
    return true;
}

static inline bool sphere_first_crossing(const struct sphere *s, ray r, double t_min, double t_max,
                                         struct crossing *out) {
    double enter, leave;
    if (!sphere_chord(s, r, &enter, &leave)) return false;
    const double t = enter > t_min ? enter : leave;
    if (!(t > t_min && t <= t_max)) return false;
    *out = (struct crossing){t, SHAPE_SIDE};
    return true;
}

int sphere_crossings(const struct sphere *s, ray r, struct crossing out[SHAPE_MAX_CROSSINGS]);
struct surface sphere_surface(const struct sphere *s, ray r, double t);
bool sphere_contains(const struct sphere *s, vec3 point);

#endif
