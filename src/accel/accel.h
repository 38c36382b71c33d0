/* Finds what a ray hits among many primitives: bounding volume hierarchies behind the questions
 * nearest hit and any hit. */
#ifndef MONGE_ACCEL_ACCEL_H
#define MONGE_ACCEL_ACCEL_H

#include "base/arena.h"
#include "shape/shape.h"

struct accel;

/* Builds hierarchies over the primitives, which must outlive them; they live in `arena`. The same
 * trees for the same primitives, always. `clear` tells of each number whether the primitive lets light
 * through, and is read here alone; NULL: none does. */
struct accel *accel_build(struct arena *arena, const struct primitives *primitives, const bool *clear);

struct hit {
    uint32_t number; /* of the primitive */
    struct crossing crossing;
};

/* The hit with the smallest t in t_min < t <= t_max; of equal ones, that of the lowest primitive
 * number. So the answer depends on the primitives alone, not on the tree. False, leaving *hit alone,
 * where there is none. Thread-safe, allocates nothing. */
bool accel_nearest(const struct accel *accel, ray r, double t_min, double t_max, struct hit *hit);

/* Whether anything that is not clear is hit in t_min < t < t_max: the end is left out, so that a ray
 * to a light stops before it. Thread-safe, allocates nothing. */
bool accel_any(const struct accel *accel, ray r, double t_min, double t_max);

/* As accel_nearest, of the clear primitives alone. */
bool accel_nearest_clear(const struct accel *accel, ray r, double t_min, double t_max, struct hit *hit);

/* The box around all bounded primitives; empty where there are none. World space. */
box3 accel_bounds(const struct accel *accel);

#endif
