/* What the tests of instances share: scenes made in code, at random too, once with instances and once with every
 * instance carried out. Random numbers from a printed seed; MONGE_SEED=n repeats a run. */
#ifndef MONGE_TESTS_INSTANCE_PAIR_H
#define MONGE_TESTS_INSTANCE_PAIR_H

#include "accel/accel.h"
#include "near.h"
#include "scene/scene.h"
#include "shape_forms.h"

enum { ROOM = 6000, GEOMETRIES = 40 };
enum { CLAY, GLASS, MIRROR, WATER, MATERIALS };

/* Slots of every geometry. */
#define FIRST  (MATERIAL_SLOT | 0)
#define SECOND (MATERIAL_SLOT | 1)
enum { SLOTS = 2 };

static const bool clear[MATERIALS] = {[GLASS] = true, [WATER] = true};

static struct material materials[MATERIALS] = {
    [CLAY] = {.ambient = {0.1, 0.1, 0.1},
              .diffuse = {0.7, 0.5, 0.3},
              .specular = {0.3, 0.3, 0.3},
              .shininess = 20,
              .index = 1},
    [GLASS] = {.reflection = {0.1, 0.1, 0.1},
               .refraction = {0.8, 0.85, 0.8},
               .specular = {0.5, 0.5, 0.5},
               .shininess = 90,
               .index = 1.5},
    [MIRROR] = {.diffuse = {0.1, 0.1, 0.2}, .reflection = {0.7, 0.7, 0.7}, .index = 1},
    [WATER] = {.diffuse = {0, 0, 0.1}, .refraction = {0.6, 0.7, 0.9}, .index = 1.33},
};

/* ---- Scenes, made in code ---- */

static inline void set_begin(struct arena *arena, struct primitives *p, uint32_t room) {
    *p = (struct primitives){0};
    p->info = arena_array(arena, room, sizeof *p->info);
    p->spheres = arena_array(arena, room, sizeof *p->spheres);
    p->flats = arena_array(arena, room, sizeof *p->flats);
    p->quadrics = arena_array(arena, room, sizeof *p->quadrics);
    p->instances = arena_array(arena, room, sizeof *p->instances);
    p->sphere_number = arena_array(arena, room, sizeof(uint32_t));
    p->flat_number = arena_array(arena, room, sizeof(uint32_t));
    p->quadric_number = arena_array(arena, room, sizeof(uint32_t));
    p->instance_number = arena_array(arena, room, sizeof(uint32_t));
}

static inline void add_info(struct primitives *p, enum primitive_kind kind, uint32_t index, uint32_t *numbers,
                            uint32_t material) {
    numbers[index] = p->count;
    p->info[p->count++] =
        (struct primitive_info){.ref = primitive_ref_make(kind, index), .material = material};
}

static inline void add_sphere(struct primitives *p, vec3 center, double radius, uint32_t material) {
    p->spheres[p->sphere_count] = (struct sphere){center, radius};
    add_info(p, PRIMITIVE_SPHERE, p->sphere_count++, p->sphere_number, material);
}

static inline void add_flat(struct primitives *p, enum flat_outline outline, affine map, uint32_t material) {
    struct flat flat = {.world_from_object = map, .outline = outline};
    assert_true(affine_invert(map, &flat.object_from_world));
    p->flats[p->flat_count] = flat;
    add_info(p, PRIMITIVE_FLAT, p->flat_count++, p->flat_number, material);
}

static inline void add_quadric(struct primitives *p, const struct quadric_form *form, affine map,
                               uint32_t material) {
    struct quadric quadric = {.world_from_object = map, .form = form};
    assert_true(affine_invert(map, &quadric.object_from_world));
    p->quadrics[p->quadric_count] = quadric;
    add_info(p, PRIMITIVE_QUADRIC, p->quadric_count++, p->quadric_number, material);
}

static inline const uint32_t *material_pair(uint32_t first, uint32_t second) {
    static uint32_t pairs[ROOM][SLOTS];
    static size_t next;
    uint32_t *pair = pairs[next++ % ROOM];
    pair[0] = first;
    pair[1] = second;
    return pair;
}

static inline void add_instance_of_two(struct primitives *p, uint32_t geometry, affine map, uint32_t first,
                                       uint32_t second) {
    struct instance instance = {
        .world_from_object = map, .geometry = geometry, .materials = material_pair(first, second)};
    assert_true(affine_invert(map, &instance.object_from_world));
    p->instances[p->instance_count] = instance;
    add_info(p, PRIMITIVE_INSTANCE, p->instance_count++, p->instance_number, 0);
}

static inline void add_instance(struct primitives *p, uint32_t geometry, affine map, uint32_t material) {
    add_instance_of_two(p, geometry, map, material, material);
}

/* A scene twice. */
struct pair {
    struct arena arena;
    struct scene instanced, flat;
    struct primitives geometries[GEOMETRIES];
    const struct accel *accel, *flat_accel;
    struct occurrence which[ROOM]; /* by number of a primitive of `flat` */
};

static inline void begin_scene(struct pair *s, struct scene *scene) {
    *scene = (struct scene){.settings = {.width = 80, .height = 60, .samples = 1, .bits = 8, .depth = 5},
                            .two_sided = true,
                            .background = {{0.2, 0.3, 0.4}, {0.6, 0.5, 0.4}},
                            .camera = {.up = {0, 1, 0}, .fov_deg = 40},
                            .default_lights = true,
                            .materials = materials,
                            .material_count = MATERIALS,
                            .geometries = s->geometries};
    set_begin(&s->arena, &scene->primitives, ROOM);
}

static inline struct pair *pair_begin(void) {
    struct pair *s = calloc(1, sizeof *s);
    begin_scene(s, &s->instanced);
    begin_scene(s, &s->flat);
    return s;
}

static inline void pair_end(struct pair *s) {
    arena_free(&s->arena);
    free(s);
}

static inline struct primitives *add_geometry(struct pair *s, uint32_t room) {
    struct primitives *p = &s->geometries[s->instanced.geometry_count++];
    set_begin(&s->arena, p, room);
    return p;
}

/* A sphere that a map leaves round stays a sphere. */
static inline void carry_out_shape(struct primitives *to, const struct primitives *from, primitive_ref ref,
                                   const affine *map, uint32_t material) {
    const uint32_t index = primitive_ref_index(ref);
    double factor;
    if (primitive_ref_kind(ref) == PRIMITIVE_SPHERE) {
        const struct sphere *sphere = &from->spheres[index];
        const affine place =
            affine_compose(affine_translate(sphere->center), affine_scale(vec3_all(sphere->radius)));
        if (affine_is_similarity(*map, &factor))
            add_sphere(to, affine_point(map, sphere->center), factor * sphere->radius, material);
        else
            add_quadric(to, &forms[ELLIPSOID], affine_compose(*map, place), material);
    } else if (primitive_ref_kind(ref) == PRIMITIVE_FLAT) {
        add_flat(to, from->flats[index].outline, affine_compose(*map, from->flats[index].world_from_object),
                 material);
    } else {
        add_quadric(to, from->quadrics[index].form,
                    affine_compose(*map, from->quadrics[index].world_from_object), material);
    }
}

/* Numbers rise as occurrences do. */
static inline void carry_out(struct pair *s, const struct primitives *from, affine map,
                             const uint32_t *around, struct occurrence which) {
    const struct instance outer = {.materials = around};
    for (uint32_t i = 0; i < from->count; i++) {
        const struct primitive_info *info = &from->info[i];
        which.number[which.depth] = i;
        if (primitive_ref_kind(info->ref) == PRIMITIVE_INSTANCE) {
            const struct instance *instance = &from->instances[primitive_ref_index(info->ref)];
            struct occurrence inner = which;
            const uint32_t within[SLOTS] = {material_around(&outer, instance->materials[0]),
                                            material_around(&outer, instance->materials[1])};
            inner.depth++;
            carry_out(s, &s->geometries[instance->geometry], affine_compose(map, instance->world_from_object),
                      within, inner);
        } else {
            assert_true(s->flat.primitives.count < ROOM);
            s->which[s->flat.primitives.count] = which;
            carry_out_shape(&s->flat.primitives, from, info->ref, &map,
                            material_around(&outer, info->material));
        }
    }
}

static inline void use_slots(struct primitives *p, const uint32_t *has, uint32_t count) {
    for (uint32_t i = 0; i < count; i++)
        if (has[i] & MATERIAL_SLOT && p->slots <= (has[i] & ~MATERIAL_SLOT))
            p->slots = (has[i] & ~MATERIAL_SLOT) + 1;
}

static inline void count_slots(struct pair *s) {
    for (uint32_t g = 0; g < s->instanced.geometry_count; g++) {
        struct primitives *p = &s->geometries[g];
        for (uint32_t i = 0; i < p->count; i++) {
            uint32_t count;
            const uint32_t *has = primitives_materials(p, s->geometries, i, &count);
            use_slots(p, has, count);
        }
    }
}

static inline void pair_build(struct pair *s) {
    const struct occurrence top = {0};
    count_slots(s);
    carry_out(s, &s->instanced.primitives, AFFINE_IDENTITY, NULL, top);
    s->accel =
        accel_build(&s->arena, &s->instanced.primitives, s->geometries, s->instanced.geometry_count, clear);
    s->flat_accel = accel_build(&s->arena, &s->flat.primitives, NULL, 0, clear);
}

/* ---- Random scenes ---- */

static inline affine random_map(struct random *r, double size) {
    const affine turn = affine_rotate(random_vec3(r, 0.1, 1), random_between(r, 0, 360));
    const vec3 by = random_vec3(r, 0.5, 1.2);
    affine map = affine_scale(random_below(r, 2) ? by : (vec3){by.x, -by.y, by.z});
    if (random_below(r, 3) == 0)
        map = affine_scale(vec3_all(random_between(r, 0.4, 1.1)));
    else if (random_below(r, 3) == 0)
        map.m[0][1] = random_between(r, -1, 1); /* sheared */
    return affine_compose(affine_translate(random_vec3(r, -size, size)), affine_compose(turn, map));
}

static inline uint32_t random_material(struct random *r, bool inherit) {
    return inherit && random_below(r, 2) ? MATERIAL_SLOT | random_below(r, SLOTS)
                                         : random_below(r, MATERIALS);
}

static inline void add_shapes(struct random *r, struct primitives *p, unsigned count, double size,
                              bool inherit) {
    for (unsigned i = 0; i < count; i++) {
        const uint32_t material = random_material(r, inherit);
        const affine map = random_map(r, size);
        switch (random_below(r, 6)) {
        case 0: add_flat(p, FLAT_SQUARE, map, material); break;
        case 1: add_flat(p, FLAT_DISC, map, material); break;
        case 2:
        case 3: add_quadric(p, &forms[random_below(r, FORM_COUNT)], map, material); break;
        default: add_sphere(p, affine_column(map, 3), random_between(r, 0.3, 1), material); break;
        }
    }
}

/* Three levels of instances, some of a geometry that is empty and some of one with a plane in it. */
static inline struct pair *random_pair(struct random *r, double size) {
    struct pair *s = pair_begin();
    add_shapes(r, add_geometry(s, 50), 4, 2, true);
    add_geometry(s, 1);
    struct primitives *middle = add_geometry(s, 50);
    for (int i = 0; i < 4; i++)
        add_instance_of_two(middle, random_below(r, 2), random_map(r, 4), random_material(r, true),
                            random_material(r, true));
    add_shapes(r, middle, 2, 4, true);
    struct primitives *outer = add_geometry(s, 50);
    for (int i = 0; i < 3; i++)
        add_instance_of_two(outer, 2 * random_below(r, 2), random_map(r, 8), random_material(r, true),
                            random_material(r, true));
    add_shapes(r, outer, 2, 8, true);
    struct primitives *plane = add_geometry(s, 50);
    add_flat(plane, FLAT_PLANE, random_map(r, 1), FIRST);
    add_shapes(r, plane, 2, 2, true);
    static const uint32_t placed[] = {0, 2, 3, 3, 0, 4};
    struct primitives *top = &s->instanced.primitives;
    for (uint32_t i = 0; i < COUNT(placed); i++)
        add_instance_of_two(top, placed[i],
                            affine_compose(affine_scale(vec3_all(size)), random_map(r, i < 5 ? 12 : 60)),
                            random_material(r, false), random_material(r, false));
    add_sphere(top, vec3_scale(random_vec3(r, -12, 12), size), 2 * size, CLAY);
    pair_build(s);
    return s;
}

/* Towards one of the primitives. */
static inline ray random_ray(struct random *r, const struct pair *s, double size) {
    const struct primitives *flat = &s->flat.primitives;
    const box3 box = shape_bounds(flat, flat->info[random_below(r, flat->count)].ref);
    const vec3 middle = box3_is_bounded(box) ? box3_center(box) : (vec3){0, 0, 0};
    const vec3 to = vec3_madd(middle, size, random_vec3(r, -0.7, 0.7)),
               from = vec3_scale(random_vec3(r, -40, 40), size);
    return (ray){from, vec3_scale(vec3_sub(to, from), random_between(r, 0.3, 2))};
}

#endif
