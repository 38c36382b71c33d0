/* What stays of a scene from one frame of its animation to the next. */
#include <string.h>

#include "scene/builder.h"

bool scene_view(struct arena *arena, struct diagnostics *diag, const struct object_value *file,
                struct scene *scene) {
    struct scene next = *scene;
    struct builder b = {.arena = arena, .diag = diag, .scene = &next};
    const unsigned errors = diag->errors;
    settings_build(&b, file);
    camera_build(&b, file);
    lights_build(&b, file);
    if (diag->errors != errors || file->failed) return false;
    if (next.primitives.count > 0) lights_check(&b, file);
    *scene = next;
    return true;
}

/* ---- Equal to the bit ----
 * Structs that may have bytes between their members are compared by these. */

static bool same_bits(const void *a, const void *b, size_t size) {
    return size == 0 || memcmp(a, b, size) == 0;
}

static bool same_affine(const affine *a, const affine *b) { return same_bits(a->m, b->m, sizeof a->m); }

static bool same_flats(const struct flat *a, const struct flat *b, uint32_t count) {
    for (uint32_t i = 0; i < count; i++)
        if (a[i].outline != b[i].outline || !same_affine(&a[i].world_from_object, &b[i].world_from_object))
            return false;
    return true;
}

static bool same_form(const struct quadric_form *a, const struct quadric_form *b) {
    const double p[] = {a->xx, a->yy, a->zz, a->xy, a->yz, a->zx, a->x, a->y, a->z, a->constant};
    const double q[] = {b->xx, b->yy, b->zz, b->xy, b->yz, b->zx, b->x, b->y, b->z, b->constant};
    return same_bits(p, q, sizeof p) && same_bits(&a->clip, &b->clip, sizeof a->clip) &&
           same_bits(&a->extent, &b->extent, sizeof a->extent) && a->open == b->open;
}

static bool same_quadrics(const struct quadric *a, const struct quadric *b, uint32_t count) {
    for (uint32_t i = 0; i < count; i++)
        if (!same_affine(&a[i].world_from_object, &b[i].world_from_object) ||
            !same_form(a[i].form, b[i].form))
            return false;
    return true;
}

static bool same_instances(const struct instance *a, const struct instance *b, uint32_t count,
                           const struct primitives *geometries) {
    for (uint32_t i = 0; i < count; i++)
        if (a[i].geometry != b[i].geometry ||
            !same_affine(&a[i].world_from_object, &b[i].world_from_object) ||
            !same_bits(a[i].materials, b[i].materials,
                       geometries[a[i].geometry].slots * sizeof *a[i].materials))
            return false;
    return true;
}

/* The geometries that both place are the same. */
static bool same_primitives(const struct primitives *a, const struct primitives *b,
                            const struct primitives *geometries) {
    return a->count == b->count && a->sphere_count == b->sphere_count && a->flat_count == b->flat_count &&
           a->quadric_count == b->quadric_count && a->instance_count == b->instance_count &&
           a->use_count == b->use_count && a->slots == b->slots &&
           same_bits(a->info, b->info, a->count * sizeof *a->info) &&
           same_bits(a->uses, b->uses, a->use_count * sizeof *a->uses) &&
           same_bits(a->spheres, b->spheres, a->sphere_count * sizeof *a->spheres) &&
           same_flats(a->flats, b->flats, a->flat_count) &&
           same_quadrics(a->quadrics, b->quadrics, a->quadric_count) &&
           same_instances(a->instances, b->instances, a->instance_count, geometries);
}

static bool is_clear(const struct material *m) { return vec3_max_abs(m->refraction) > 0.0; }

static bool same_clear(const struct scene *a, const struct scene *b) {
    if (a->material_count != b->material_count) return false;
    for (uint32_t i = 0; i < a->material_count; i++)
        if (is_clear(&a->materials[i]) != is_clear(&b->materials[i])) return false;
    return true;
}

bool scene_same_shapes(const struct scene *a, const struct scene *b) {
    if (a->geometry_count != b->geometry_count || !same_clear(a, b)) return false;
    for (uint32_t i = 0; i < a->geometry_count; i++)
        if (!same_primitives(&a->geometries[i], &b->geometries[i], a->geometries)) return false;
    return same_primitives(&a->primitives, &b->primitives, a->geometries);
}
