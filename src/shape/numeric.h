/* What the shapes share of numbers. Private to shape/. */
#ifndef MONGE_SHAPE_NUMERIC_H
#define MONGE_SHAPE_NUMERIC_H

#include "base/affine.h"

/* 16 units in the last place of 1: what a chain of some ten roundings, done twice (where a point was
 * found, and where the next ray starts), comes to at worst, and half as much again. */
#define ROUNDING (16 * 0x1p-52)

static inline double vec3_component(vec3 v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

/* The size of the box around the image of a box of this size; of the half size, the half. */
static inline vec3 map_size(const affine *map, vec3 size) {
    const double(*m)[4] = map->m;
    return (vec3){fabs(m[0][0]) * size.x + fabs(m[0][1]) * size.y + fabs(m[0][2]) * size.z,
                  fabs(m[1][0]) * size.x + fabs(m[1][1]) * size.y + fabs(m[1][2]) * size.z,
                  fabs(m[2][0]) * size.x + fabs(m[2][1]) * size.y + fabs(m[2][2]) * size.z};
}

#endif
