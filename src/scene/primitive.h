/* The flat arrays that a scene becomes: world-space primitives, grouped by kind.
 *
 *     number   0        1        2        3        4          in the order of the file: the lower
 *     ref    [sphere 0][flat 0][sphere 1][quadric 0][flat 1]  number wins where two hits tie
 *               |         \       |
 *     spheres  [0][1] flats [0][1]   quadrics [0]             tested by kind, several at once
 *
 * These are data only; shape/ knows how to hit them. */
#ifndef MONGE_SCENE_PRIMITIVE_H
#define MONGE_SCENE_PRIMITIVE_H

#include <stddef.h>
#include <stdint.h>

#include "base/affine.h"
#include "base/box3.h"

/* |p - center| = radius, world space. Any sphere whose transforms keep it round. */
struct sphere {
    vec3 center;
    double radius; /* > 0 */
};

enum flat_outline {
    FLAT_PLANE,  /* all of z = 0 */
    FLAT_SQUARE, /* |x| <= 1/2 and |y| <= 1/2 */
    FLAT_DISC,   /* x^2 + y^2 <= 1 */
};

/* A part of the plane z = 0 of object space. Its normal is +z. */
struct flat {
    affine object_from_world, world_from_object;
    enum flat_outline outline;
};

/* Q(p) = xx x^2 + yy y^2 + zz z^2 + xy x y + yz y z + zx z x + x x + y y + z z + constant,
 * cut to the box `clip` (whose sides may be infinite).
 *   solid: the points of the box with Q(p) <= 0; its surface is the quadric and the cut faces
 *   open:  the part of the surface Q(p) = 0 in the box, and nothing else
 * The gradient of Q points outwards: Q is negative inside. */
struct quadric_form {
    double xx, yy, zz, xy, yz, zx, x, y, z, constant;
    box3 clip;   /* object space */
    box3 extent; /* object space: holds all of the shape; infinite where the shape is */
    bool open;
};

struct quadric {
    affine object_from_world, world_from_object;
    const struct quadric_form *form; /* shared by primitives of the same form */
};

/* A geometry, placed: one of the scene's sets of primitives that stand in a space of their own. "World"
 * is here the space of the set that the instance is in: the scene's, or that of another geometry. */
struct instance {
    affine object_from_world, world_from_object; /* object space: that of the geometry */
    const uint32_t *materials;                   /* for each slot of the geometry; may be shared */
    uint32_t geometry;                           /* index into the scene's geometries */
};

/* Instances around a primitive, at most: whoever makes geometries flattens or refuses what is deeper. */
enum { INSTANCE_MAX_DEPTH = 32 };

enum primitive_kind { PRIMITIVE_SPHERE, PRIMITIVE_FLAT, PRIMITIVE_QUADRIC, PRIMITIVE_INSTANCE };

/* Names one primitive: its kind in the two high bits, its index in the array of that kind below. */
typedef uint32_t primitive_ref;
enum { PRIMITIVE_MAX = 1 << 30 }; /* of a kind */

static inline primitive_ref primitive_ref_make(enum primitive_kind kind, uint32_t index) {
    return (uint32_t)kind << 30 | index;
}
static inline enum primitive_kind primitive_ref_kind(primitive_ref ref) {
    return (enum primitive_kind)(ref >> 30);
}
static inline uint32_t primitive_ref_index(primitive_ref ref) { return ref & (PRIMITIVE_MAX - 1); }

/* What the renderer asks of a primitive besides its shape. */
struct primitive_info {
    primitive_ref ref;
    uint32_t
        material; /* index into the scene's materials, or a slot; of an instance not used: it has its own */
    uint32_t origin; /* index into the scene's origins: the object that it came from */
    uint32_t object; /* index into its objects: what it belongs to; or ORIGIN_NO_OBJECT */
};

/* A material is an index into those of the scene; or, within a geometry, MATERIAL_SLOT with the number of a slot,
 * for which each instance has a material of its own: so a geometry is one in whatever colours it stands.
 *
 *     scene       instance of 1 {red, gold}              instance of 1 {blue, gold}
 *     geometry 1  sphere: slot 0, sphere: slot 1, instance of 0 {slot 1}
 *     geometry 0  box: slot 0                            gold, in both
 */
#define MATERIAL_SLOT (1u << 31)
enum { MATERIAL_SLOTS = 64 }; /* of a geometry, at most */

/* `number` below is the index into `info`; sphere_number[i] is the number of spheres[i], and so on. */
struct primitives {
    struct primitive_info *info;
    uint32_t count;
    struct sphere *spheres;
    uint32_t *sphere_number, sphere_count;
    struct flat *flats;
    uint32_t *flat_number, flat_count;
    struct quadric *quadrics;
    uint32_t *quadric_number, quadric_count;
    struct instance *instances;
    uint32_t *instance_number, instance_count;
    uint32_t *uses, use_count; /* the templates that were used here, each time: indices into the scene's */
    uint32_t slots;            /* of a geometry: its primitives have each of them; of the scene's set 0 */
};

/* What a material within the instance's geometry is in the set that the instance is in. */
static inline uint32_t material_around(const struct instance *instance, uint32_t material) {
    return material & MATERIAL_SLOT ? instance->materials[material & ~MATERIAL_SLOT] : material;
}

/* The number of the primitive that `ref` names. */
static inline uint32_t primitives_number(const struct primitives *p, primitive_ref ref) {
    const uint32_t index = primitive_ref_index(ref);
    switch (primitive_ref_kind(ref)) {
    case PRIMITIVE_SPHERE: return p->sphere_number[index];
    case PRIMITIVE_FLAT: return p->flat_number[index];
    case PRIMITIVE_QUADRIC: return p->quadric_number[index];
    case PRIMITIVE_INSTANCE: break;
    }
    return p->instance_number[index];
}

/* The materials of one of the set's primitives, by its number: that of a shape, or those of an instance. */
static inline const uint32_t *primitives_materials(const struct primitives *p,
                                                   const struct primitives *geometries, uint32_t number,
                                                   uint32_t *count) {
    *count = 1;
    if (primitive_ref_kind(p->info[number].ref) != PRIMITIVE_INSTANCE) return &p->info[number].material;
    const struct instance *instance = &p->instances[primitive_ref_index(p->info[number].ref)];
    *count = geometries[instance->geometry].slots;
    return instance->materials;
}

#endif
