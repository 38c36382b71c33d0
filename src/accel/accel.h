/* Finds what a ray hits among many primitives: bounding volume hierarchies behind the questions
 * nearest hit and any hit. A geometry has one hierarchy, however often it is placed: the instances
 * are leaves of the hierarchies above, and a ray that meets one goes on in the geometry's space. */
#ifndef MONGE_ACCEL_ACCEL_H
#define MONGE_ACCEL_ACCEL_H

#include <stdatomic.h>

#include "base/arena.h"
#include "shape/shape.h"

struct accel;

/* How often one question may go into an instance. Only where instances of instances lie at one place does a ray
 * meet so many: they double with each level. */
enum { ACCEL_MAX_ENTRIES = 1 << 20 };

/* Ends questions early, those of one thread. Starts with `cancel` alone. Once it has stopped, what the questions
 * that have it answer means nothing, and they answer at once. Where they may have none, NULL, a question that
 * needs more entries finds nothing further. */
struct accel_watch {
    const atomic_bool *cancel; /* stops them when it is set; NULL: nothing does */
    enum { ACCEL_GOES_ON, ACCEL_CANCELLED, ACCEL_TOO_MANY_ENTRIES } stop;
    uint32_t number; /* TOO_MANY_ENTRIES: of the instance in the scene's set */
};

/* Builds hierarchies over the primitives and the geometries that their instances place, all of which
 * must outlive them; they live in `arena`. The same trees for the same primitives, always.
 *   geometries  each holds instances of earlier ones alone, not more than INSTANCE_MAX_DEPTH within each
 *               other; may be NULL where there are no instances
 *   clear       tells of each material whether it lets light through, and is read here alone; NULL: none does */
struct accel *accel_build(struct arena *arena, const struct primitives *primitives,
                          const struct primitives *geometries, uint32_t geometry_count, const bool *clear);

/* One of the primitives that there are with all instances carried out: the numbers of the instances around it,
 * outermost first, each in the set of primitives that it is in, and then its own. */
struct occurrence {
    uint32_t depth;                          /* instances around */
    uint32_t number[INSTANCE_MAX_DEPTH + 1]; /* number[depth] is the primitive's; none beyond is set */
};

struct hit {
    struct crossing crossing;
    const struct primitives *set; /* that the primitive is in: the scene's or a geometry's */
    primitive_ref ref;            /* in `set` */
    uint32_t material;            /* of the scene's */
    struct occurrence which;
};

/* The hit with the smallest t in t_min < t <= t_max; of equal ones, that of the lowest number in the
 * outermost set where they differ. So the answer depends on the primitives alone, not on the tree.
 * False, leaving *hit alone, where there is none. Thread-safe, allocates nothing. */
bool accel_nearest(const struct accel *accel, struct accel_watch *watch, ray r, double t_min, double t_max,
                   struct hit *hit);

/* Whether anything that is not clear is hit in t_min < t < t_max: the end is left out, so that a ray
 * to a light stops before it. Thread-safe, allocates nothing. */
bool accel_any(const struct accel *accel, struct accel_watch *watch, ray r, double t_min, double t_max);

/* As accel_nearest, of the clear primitives alone. */
bool accel_nearest_clear(const struct accel *accel, struct accel_watch *watch, ray r, double t_min,
                         double t_max, struct hit *hit);

/* The surface, in world space, at a hit that this ray had. */
struct surface accel_surface(const struct accel *accel, ray r, const struct hit *hit);

/* Calls visit for every clear primitive whose bounds hold the origin of `r`, in an order that is always
 * the same: with its hit, of which the crossing is not set, and the ray in the space that its set is in,
 * with the same t. Thread-safe, allocates nothing. */
void accel_around(const struct accel *accel, struct accel_watch *watch, ray r,
                  void (*visit)(void *context, const struct hit *hit, ray in_set), void *context);

/* The same for what is not clear. */
void accel_around_opaque(const struct accel *accel, struct accel_watch *watch, ray r,
                         void (*visit)(void *context, const struct hit *hit, ray in_set), void *context);

/* A world-space box around all that one of the scene's instances places, by its index; infinite where that is. */
box3 accel_placed_bounds(const struct accel *accel, uint32_t index);

/* How far the bounded primitives reach along a world-space direction of any length: the largest dot
 * product with it. -INFINITY where there are none. Exact to rounding without instances, with them to 1e-6
 * of the scene's size; where too many reach about as far, not too small. */
double accel_support(const struct accel *accel, vec3 direction);

/* The box around all bounded primitives, as tight as accel_support; empty where there are none. World space. */
box3 accel_extent(const struct accel *accel);

/* A box that holds it, known at once: that of the boxes of what instances place. */
box3 accel_bounds(const struct accel *accel);

/* Whether two are the same. */
static inline bool occurrence_equal(const struct occurrence *a, const struct occurrence *b) {
    if (a->depth != b->depth) return false;
    for (uint32_t i = 0; i <= a->depth; i++)
        if (a->number[i] != b->number[i]) return false;
    return true;
}

#endif
