/* A half-line from `org` along `dir`: the points org + t dir, t > 0. */
#ifndef MONGE_BASE_RAY_H
#define MONGE_BASE_RAY_H

#include "base/vec3.h"

typedef struct {
    vec3 org; /* a point */
    vec3 dir; /* any length but zero: t counts in multiples of it */
} ray;

static inline vec3 ray_at(ray r, double t) { return vec3_madd(r.org, t, r.dir); }

#endif
