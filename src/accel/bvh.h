/* The bounding volume hierarchy: what accel_build makes and the traversal reads.
 *
 *     nodes  [root][ -- ][ a ][ b ][a.0][a.1][b.0][b.1] ...    siblings adjacent, in one cache line
 *                                |          \
 *     refs   [ s3 s9 q0 ][ s1 s2 f4 ][ ... ]     a leaf is a run of refs, sorted by kind
 *
 * A box holds the boxes of its children, and a leaf's box all its primitives with room for the
 * rounding of their hits; so culling by boxes never changes an answer. */
#ifndef MONGE_ACCEL_BVH_H
#define MONGE_ACCEL_BVH_H

#include "accel/accel.h"

#ifdef MONGE_HOSTILE
enum { ACCEL_LEAF_SIZE = 1 };
#else
enum { ACCEL_LEAF_SIZE = 4 }; /* primitives of a leaf, at most */
#endif

/* No node is deeper below the root, whatever the scene, so a traversal needs a stack of this. */
enum { ACCEL_MAX_DEPTH = 64 };

enum { LEAF_OF_SHAPES, LEAF_WITH_INSTANCES };

struct bvh_node {
    float bounds[6]; /* min x y z, max x y z; in the space of the primitives */
    uint32_t first;  /* of a leaf: into refs; else the first child, and the second comes after it */
    uint16_t count;  /* of a leaf: its primitives; else 0 */
    uint16_t axis; /* along which the first child comes before the second; of a leaf: LEAF_OF_SHAPES or not */
};

struct bvh {
    const struct bvh_node *nodes; /* nodes[0] is the root, nodes[1] is not used */
    uint32_t node_count;          /* 0: nothing is bounded */
    const primitive_ref *refs;
    const primitive_ref *unbounded; /* tested for every ray */
    uint32_t unbounded_count;
    box3 bounds;
};

/* Of one set of primitives. Every shape is in one of the two trees, an instance in each that the hierarchy
 * of its geometry has something in. Whether a slot is clear depends on the instances around: a geometry has
 * one of these for each choice of clear slots that it is placed with, so that a search never has to sort
 * out what it finds. */
struct accel {
    const struct primitives *primitives;
    const struct accel **placed; /* by index of instance: the hierarchy of its geometry */
    const struct bvh *opaque, *clear;
};

/* What a question has left of its entries. */
struct budget {
    uint32_t entries;
    const atomic_bool *cancel;
    struct accel_watch *watch; /* may be NULL */
};

/* False: the question is not to be asked. */
static inline bool budget_begin(struct budget *b, struct accel_watch *watch) {
    static const atomic_bool never;
    *b = (struct budget){ACCEL_MAX_ENTRIES, watch && watch->cancel ? watch->cancel : &never, watch};
    if (watch && !watch->stop && atomic_load_explicit(b->cancel, memory_order_relaxed))
        watch->stop = ACCEL_CANCELLED;
    return !watch || !watch->stop;
}

/* One more entry, within the scene's instance of this number. False: the question ends. */
static inline bool budget_take(struct budget *b, uint32_t number) {
    const bool cancelled = atomic_load_explicit(b->cancel, memory_order_relaxed);
    if (b->entries && !cancelled) return b->entries--, true;
    if (b->watch) {
        b->watch->stop = cancelled ? ACCEL_CANCELLED : ACCEL_TOO_MANY_ENTRIES;
        b->watch->number = number;
    }
    return false;
}

/* The material in the scene of a primitive within the instances of `chain`, outermost first. */
static inline uint32_t material_in_scene(const struct instance *const *chain, uint32_t depth,
                                         uint32_t material) {
    while (material & MATERIAL_SLOT) material = material_around(chain[--depth], material);
    return material;
}

static inline bool bvh_is_empty(const struct bvh *bvh) { return !bvh->node_count && !bvh->unbounded_count; }

static inline const struct bvh *accel_tree(const struct accel *accel, bool clear) {
    return clear ? accel->clear : accel->opaque;
}

#endif
