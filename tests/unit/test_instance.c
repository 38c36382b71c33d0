/* Instances against the same scenes with every instance carried out: the same hits, surfaces, shadows and
 * pictures. Random numbers from a printed seed; MONGE_SEED=n repeats a run. */
#include <string.h>

#include "accel/bvh.h"
#include "loading.h"
#include "near.h"
#include "render/media.h"
#include "render/render.h"
#include "scene/builder.h"
#include "shape_forms.h"

/* ---- Scenes, made in code ---- */

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

static void set_begin(struct arena *arena, struct primitives *p, uint32_t room) {
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

static void add_info(struct primitives *p, enum primitive_kind kind, uint32_t index, uint32_t *numbers,
                     uint32_t material) {
    numbers[index] = p->count;
    p->info[p->count++] =
        (struct primitive_info){.ref = primitive_ref_make(kind, index), .material = material};
}

static void add_sphere(struct primitives *p, vec3 center, double radius, uint32_t material) {
    p->spheres[p->sphere_count] = (struct sphere){center, radius};
    add_info(p, PRIMITIVE_SPHERE, p->sphere_count++, p->sphere_number, material);
}

static void add_flat(struct primitives *p, enum flat_outline outline, affine map, uint32_t material) {
    struct flat flat = {.world_from_object = map, .outline = outline};
    assert_true(affine_invert(map, &flat.object_from_world));
    p->flats[p->flat_count] = flat;
    add_info(p, PRIMITIVE_FLAT, p->flat_count++, p->flat_number, material);
}

static void add_quadric(struct primitives *p, const struct quadric_form *form, affine map,
                        uint32_t material) {
    struct quadric quadric = {.world_from_object = map, .form = form};
    assert_true(affine_invert(map, &quadric.object_from_world));
    p->quadrics[p->quadric_count] = quadric;
    add_info(p, PRIMITIVE_QUADRIC, p->quadric_count++, p->quadric_number, material);
}

static const uint32_t *material_pair(uint32_t first, uint32_t second) {
    static uint32_t pairs[ROOM][SLOTS];
    static size_t next;
    uint32_t *pair = pairs[next++ % ROOM];
    pair[0] = first;
    pair[1] = second;
    return pair;
}

static void add_instance_of_two(struct primitives *p, uint32_t geometry, affine map, uint32_t first,
                                uint32_t second) {
    struct instance instance = {
        .world_from_object = map, .geometry = geometry, .materials = material_pair(first, second)};
    assert_true(affine_invert(map, &instance.object_from_world));
    p->instances[p->instance_count] = instance;
    add_info(p, PRIMITIVE_INSTANCE, p->instance_count++, p->instance_number, 0);
}

static void add_instance(struct primitives *p, uint32_t geometry, affine map, uint32_t material) {
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

static void begin_scene(struct pair *s, struct scene *scene) {
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

static struct pair *pair_begin(void) {
    struct pair *s = calloc(1, sizeof *s);
    begin_scene(s, &s->instanced);
    begin_scene(s, &s->flat);
    return s;
}

static void pair_end(struct pair *s) {
    arena_free(&s->arena);
    free(s);
}

static struct primitives *add_geometry(struct pair *s, uint32_t room) {
    struct primitives *p = &s->geometries[s->instanced.geometry_count++];
    set_begin(&s->arena, p, room);
    return p;
}

/* A sphere that a map leaves round stays a sphere. */
static void carry_out_shape(struct primitives *to, const struct primitives *from, primitive_ref ref,
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
static void carry_out(struct pair *s, const struct primitives *from, affine map, const uint32_t *around,
                      struct occurrence which) {
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

static void use_slots(struct primitives *p, const uint32_t *has, uint32_t count) {
    for (uint32_t i = 0; i < count; i++)
        if (has[i] & MATERIAL_SLOT && p->slots <= (has[i] & ~MATERIAL_SLOT))
            p->slots = (has[i] & ~MATERIAL_SLOT) + 1;
}

static void count_slots(struct pair *s) {
    for (uint32_t g = 0; g < s->instanced.geometry_count; g++) {
        struct primitives *p = &s->geometries[g];
        for (uint32_t i = 0; i < p->count; i++) {
            uint32_t count;
            const uint32_t *has = primitives_materials(p, s->geometries, i, &count);
            use_slots(p, has, count);
        }
    }
}

static void pair_build(struct pair *s) {
    const struct occurrence top = {0};
    count_slots(s);
    carry_out(s, &s->instanced.primitives, AFFINE_IDENTITY, NULL, top);
    s->accel =
        accel_build(&s->arena, &s->instanced.primitives, s->geometries, s->instanced.geometry_count, clear);
    s->flat_accel = accel_build(&s->arena, &s->flat.primitives, NULL, 0, clear);
}

/* ---- Random scenes ---- */

static affine random_map(struct random *r, double size) {
    const affine turn = affine_rotate(random_vec3(r, 0.1, 1), random_between(r, 0, 360));
    const vec3 by = random_vec3(r, 0.5, 1.2);
    affine map = affine_scale(random_below(r, 2) ? by : (vec3){by.x, -by.y, by.z});
    if (random_below(r, 3) == 0)
        map = affine_scale(vec3_all(random_between(r, 0.4, 1.1)));
    else if (random_below(r, 3) == 0)
        map.m[0][1] = random_between(r, -1, 1); /* sheared */
    return affine_compose(affine_translate(random_vec3(r, -size, size)), affine_compose(turn, map));
}

static uint32_t random_material(struct random *r, bool inherit) {
    return inherit && random_below(r, 2) ? MATERIAL_SLOT | random_below(r, SLOTS)
                                         : random_below(r, MATERIALS);
}

static void add_shapes(struct random *r, struct primitives *p, unsigned count, double size, bool inherit) {
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
static struct pair *random_pair(struct random *r, double size) {
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
static ray random_ray(struct random *r, const struct pair *s, double size) {
    const struct primitives *flat = &s->flat.primitives;
    const box3 box = shape_bounds(flat, flat->info[random_below(r, flat->count)].ref);
    const vec3 middle = box3_is_bounded(box) ? box3_center(box) : (vec3){0, 0, 0};
    const vec3 to = vec3_madd(middle, size, random_vec3(r, -0.7, 0.7)),
               from = vec3_scale(random_vec3(r, -40, 40), size);
    return (ray){from, vec3_scale(vec3_sub(to, from), random_between(r, 0.3, 2))};
}

/* ---- Against brute force, bit for bit ---- */

struct oracle {
    const struct pair *s;
    bool found;
    double t;
    struct occurrence which;
};

static void oracle_search(struct oracle *o, const struct primitives *p, ray r, double t_min,
                          struct occurrence which) {
    for (uint32_t i = 0; i < p->count; i++) {
        const primitive_ref ref = p->info[i].ref;
        struct crossing c;
        which.number[which.depth] = i;
        if (primitive_ref_kind(ref) == PRIMITIVE_INSTANCE) {
            const struct instance *instance = &p->instances[primitive_ref_index(ref)];
            struct occurrence inner = which;
            inner.depth++;
            oracle_search(o, &o->s->geometries[instance->geometry],
                          affine_ray(&instance->object_from_world, r), t_min, inner);
        } else if (shape_first_crossing(p, ref, r, t_min, INFINITY, &c) && (!o->found || c.t < o->t)) {
            o->found = true;
            o->t = c.t;
            o->which = which; /* the walk is in order: the first of equal ones stays */
        }
    }
}

static bool check_oracle(const struct pair *s, ray r, double t_min, struct hit *hit) {
    struct oracle o = {.s = s};
    const struct occurrence top = {0};
    oracle_search(&o, &s->instanced.primitives, r, t_min, top);
    const bool found = accel_nearest(s->accel, NULL, r, t_min, INFINITY, hit);
    assert_int_equal(found, o.found);
    if (!found) return false;
    if (hit->crossing.t != o.t || !occurrence_equal(&hit->which, &o.which))
        fail_msg("ray %a %a %a, %a %a %a: found at %a, not at %a", r.org.x, r.org.y, r.org.z, r.dir.x,
                 r.dir.y, r.dir.z, hit->crossing.t, o.t);
    return true;
}

static void the_same_as_brute_force(void **state) {
    (void)state;
    struct random r = random_begin();
    int hits = 0;
    for (int round = 0; round < 20; round++) {
        static const double sizes[] = {1, 1e-4, 1e6};
        const double size = sizes[round % 3];
        struct pair *s = random_pair(&r, size);
        for (int i = 0; i < 400; i++) {
            const ray one = random_ray(&r, s, size);
            struct hit hit;
            double t_min = 0;
            for (int k = 0; k < 5 && check_oracle(s, one, t_min, &hit); k++, hits++) t_min = hit.crossing.t;
        }
        pair_end(s);
    }
    assert_true(hits > 8000);
}

/* Every geometry placed many times at the same spot, within one that is, too: the first of all is seen,
 * in whatever order the tree has them, and of clear and opaque ones, too. */
static void ties(void **state) {
    (void)state;
    struct random r = random_begin();
    struct pair *s = pair_begin();
    struct primitives *one = add_geometry(s, 9), *two = add_geometry(s, 20), *top = &s->instanced.primitives;
    const affine map = random_map(&r, 1);
    add_shapes(&r, one, 3, 1, true);
    for (int i = 0; i < 11; i++) add_instance(two, 0, map, i == 0 ? GLASS : FIRST);
    add_sphere(two, random_vec3(&r, -1, 1), 0.2, GLASS);
    for (int i = 0; i < 11; i++) add_instance(top, 1, AFFINE_IDENTITY, i == 0 ? WATER : CLAY);
    pair_build(s);
    int hits = 0;
    for (int i = 0; i < 2000; i++) {
        struct hit hit;
        hits += check_oracle(s, random_ray(&r, s, 1.0), 0.0, &hit);
    }
    assert_true(hits > 100);
    pair_end(s);
}

/* ---- Against the same scene with all instances carried out ---- */

static void assert_same_surface(const struct surface *got, const struct surface *want, double size) {
    assert_vec3_near(got->normal, want->normal, 1e-7, "normal");
    const double far = size + vec3_max_abs(want->point);
    assert_vec3_near(got->point, want->point, 1e-9 * far, "point");
    if (!(got->error > 0.1 * want->error && got->error < 1000 * want->error + 1e-14 * far))
        fail_msg("error %g, as one primitive %g", got->error, want->error);
}

static void check_hit(const struct pair *s, ray r, const struct hit *hit, const struct hit *want,
                      double size) {
    assert_true(occurrence_equal(&hit->which, &s->which[want->which.number[0]]));
    assert_int_equal(hit->material, want->material);
    assert_int_equal(hit->crossing.part, want->crossing.part);
    assert_near(hit->crossing.t, want->crossing.t, 1e-9 * (100 + want->crossing.t), "t");
    const struct surface surface = accel_surface(s->accel, r, hit),
                         flat = accel_surface(s->flat_accel, r, want);
    assert_same_surface(&surface, &flat, 100 * size);
}

static void the_same_as_flattened(void **state) {
    (void)state;
    struct random r = random_begin();
    int hits = 0, clears = 0, blocked = 0;
    for (int round = 0; round < 20; round++) {
        const double size = round % 2 ? 1.0 : 1e-3;
        struct pair *s = random_pair(&r, size);
        for (int i = 0; i < 500; i++) {
            const ray one = random_ray(&r, s, size);
            struct hit hit, want;
            double t_min = 0.0;
            while (accel_nearest(s->flat_accel, NULL, one, t_min, INFINITY, &want)) {
                assert_true(accel_nearest(s->accel, NULL, one, t_min, INFINITY, &hit));
                check_hit(s, one, &hit, &want, size);
                t_min = want.crossing.t + 1e-9 * (100 + want.crossing.t);
                hits++;
            }
            t_min = 0.0;
            while (accel_nearest_clear(s->flat_accel, NULL, one, t_min, 1.0, &want)) {
                assert_true(accel_nearest_clear(s->accel, NULL, one, t_min, 1.0, &hit));
                check_hit(s, one, &hit, &want, size);
                assert_true(clear[hit.material]);
                t_min = want.crossing.t + 1e-9 * (100 + want.crossing.t);
                clears++;
            }
            const bool any = accel_any(s->flat_accel, NULL, one, 0.0, 1.0);
            assert_int_equal(accel_any(s->accel, NULL, one, 0.0, 1.0), any);
            blocked += any;
        }
        pair_end(s);
    }
    assert_true(hits > 6000 && clears > 600 && blocked > 600);
}

/* A ray that leaves a flat or convex body from beyond the error does not find it again. */
static void errors_hold(void **state) {
    (void)state;
    struct random r = random_begin();
    int tried = 0;
    for (int round = 0; round < 30; round++) {
        struct pair *s = pair_begin();
        const double far[] = {1, 1e3, 1e6};
        struct primitives *leaf = add_geometry(s, 9);
        add_sphere(leaf, random_vec3(&r, -far[round % 3], far[round % 3]), 1, CLAY);
        add_quadric(leaf, &forms[CYLINDER], random_map(&r, 5), CLAY);
        add_quadric(leaf, &forms[CUBE], random_map(&r, 5), CLAY);
        add_flat(leaf, FLAT_SQUARE, random_map(&r, 5), CLAY);
        const double size = far[random_below(&r, 3)];
        add_instance(add_geometry(s, 9), 0, random_map(&r, far[random_below(&r, 3)]), CLAY);
        add_instance(&s->instanced.primitives, 1,
                     affine_compose(affine_scale(vec3_all(size)), random_map(&r, far[random_below(&r, 3)])),
                     CLAY);
        pair_build(s);
        for (int i = 0; i < 2000; i++) {
            const struct primitives *flat = &s->flat.primitives;
            const primitive_ref ref = flat->info[random_below(&r, flat->count)].ref;
            const box3 box = shape_bounds(flat, ref);
            const vec3 from = vec3_madd(box3_center(box), size, random_vec3(&r, -20, 20));
            const ray one = {from,
                             vec3_sub(vec3_madd(box3_center(box), size, random_vec3(&r, -0.3, 0.3)), from)};
            struct hit hit, again;
            if (!accel_nearest(s->accel, NULL, one, 0.0, INFINITY, &hit)) continue;
            const struct surface surface = accel_surface(s->accel, one, &hit);
            vec3 out = surface.normal;
            if (vec3_dot(one.dir, out) > 0.0) {
                if (shape_is_solid(hit.set, hit.ref)) continue; /* it began inside */
                out = vec3_neg(out);
            }
            vec3 dir = random_vec3(&r, -1, 1);
            const double up = vec3_dot(dir, out);
            dir = vec3_madd(dir, -up + (i % 2 ? fabs(up) : 1e-14), out); /* half of them along the surface */
            if (!(vec3_dot(dir, out) > 0.0)) continue;
            const ray leaving = {vec3_madd(surface.point, surface.error, out), dir};
            tried++;
            if (accel_nearest(s->accel, NULL, leaving, 0.0, INFINITY, &again) &&
                occurrence_equal(&again.which, &hit.which))
                fail_msg("round %d: a ray at %g off the surface hits it again after %g", round, surface.error,
                         again.crossing.t);
        }
        pair_end(s);
    }
    assert_true(tried > 10000);
}

/* The same, by half of the error, on what is far larger than its distance to the origin: along the surface the ray runs
 * to where its own rounding is of that size. */
static void errors_hold_on_what_is_large(void **state) {
    (void)state;
    struct random r = random_begin();
    int tried = 0, bad = 0;
    for (int round = 0; round < 300; round++) {
        struct pair *s = pair_begin();
        struct primitives *leaf = add_geometry(s, 1), *around = add_geometry(s, 1);
        const double size = round % 3 ? 1e5 : 1e3;
        const affine large = affine_scale(vec3_all(size)); /* its own map rounds nothing */
        if (round % 2)
            add_flat(leaf, FLAT_SQUARE, large, CLAY);
        else
            add_quadric(leaf, &forms[CUBE], affine_compose(large, affine_translate((vec3){0, 0, -0.5})),
                        CLAY);
        add_instance(around, 0, random_map(&r, 1), CLAY);
        add_instance(&s->instanced.primitives, 1, random_map(&r, 1), CLAY);
        pair_build(s);
        const affine top = affine_compose(s->instanced.primitives.instances[0].world_from_object,
                                          affine_compose(around->instances[0].world_from_object, large));
        const vec3 up = affine_direction(&top, (vec3){0, 0, 1 / size});
        for (int i = 0; i < 40; i++) {
            const vec3 target = affine_point(&top, vec3_scale(random_vec3(&r, -1, 1), 1 / size));
            const ray one = {vec3_madd(target, 20, up), vec3_neg(up)};
            struct hit hit, again;
            if (!accel_nearest(s->accel, NULL, one, 0.0, INFINITY, &hit)) continue;
            const struct surface surface = accel_surface(s->accel, one, &hit);
            const double side = vec3_dot(surface.normal, up) > 0.0 ? 1.0 : -1.0;
            const vec3 out = vec3_scale(surface.normal, side), any = random_vec3(&r, -1, 1);
            const vec3 along = vec3_madd(any, -vec3_dot(any, out), out);
            const vec3 dir = vec3_madd(along, pow(10, random_between(&r, -18, -10)), out);
            if (!(vec3_dot(dir, out) > 0.0)) continue;
            const ray leaving = {vec3_madd(surface.point, 0.5 * surface.error, out), dir};
            bad += accel_nearest(s->accel, NULL, leaving, 0.0, INFINITY, &again);
            tried++;
        }
        pair_end(s);
    }
    if (bad) fail_msg("%d of %d rays find again what they left", bad, tried);
    assert_true(tried > 5000);
}

static void support_is_tight(void **state) {
    (void)state;
    struct random r = random_begin();
    for (int round = 0; round < 20; round++) {
        struct pair *s = random_pair(&r, 1.0);
        const box3 box = accel_bounds(s->accel), flat = accel_bounds(s->flat_accel);
        for (int i = 0; i < 50; i++) {
            const vec3 to = random_vec3(&r, -1, 1);
            const double want = accel_support(s->flat_accel, to), got = accel_support(s->accel, to);
            assert_near(got, want, 3e-4, "support"); /* 1e-6 of up to 200 */
        }
        const vec3 below = vec3_sub(flat.min, box.min), above = vec3_sub(box.max, flat.max);
        assert_true(below.x > -1e-9 && below.y > -1e-9 && below.z > -1e-9 && above.x > -1e-9 &&
                    above.y > -1e-9 && above.z > -1e-9);
        pair_end(s);
    }
}

/* ---- Pictures ---- */

static struct monge_film *render(const struct scene *scene, const struct accel *accel, unsigned threads) {
    const struct monge_job job = {.threads = threads};
    struct monge_stats stats;
    struct monge_film *film = film_new(
        &scene->settings, (struct monge_region){0, 0, scene->settings.width, scene->settings.height});
    assert_non_null(film);
    assert_true(render_film(scene, accel, &job, film, &stats, NULL));
    return film;
}

/* All settings of the two but the primitives are the same. Returns how often the colour changes in a row. */
static size_t assert_same_picture(struct pair *s, size_t allowed) {
    const struct monge_settings settings = s->instanced.settings;
    struct primitives own = s->flat.primitives;
    s->flat = s->instanced;
    s->flat.primitives = own;
    struct monge_film *one = render(&s->instanced, s->accel, 2), *two = render(&s->flat, s->flat_accel, 2);
    size_t different = 0, colors = 0;
    for (size_t i = 0; i < (size_t)settings.width * settings.height; i++) {
        bool same = true;
        for (size_t c = 0; c < 3; c++)
            same &= fabs((double)one->rgb[3 * i + c] - (double)two->rgb[3 * i + c]) < 1e-4;
        different += !same;
        colors += i > 0 && memcmp(&one->rgb[3 * i], &one->rgb[3 * i - 3], 3 * sizeof(float)) != 0;
    }
    monge_film_free(one);
    monge_film_free(two);
    if (different > allowed) fail_msg("%zu pixels differ", different);
    return colors;
}

static void the_same_pictures(void **state) {
    (void)state;
    struct random r = random_begin();
    size_t colors = 0;
    for (int round = 0; round < 6; round++) {
        struct pair *s = random_pair(&r, round == 5 ? 1e-5 : 1.0);
        if (round % 2) s->instanced.camera.projection = CAMERA_ORTHOGRAPHIC;
        colors += assert_same_picture(s, 6);
        pair_end(s);
    }
    assert_true(colors > 5000);
}

/* Balls of glass and water that overlap, in each other, and the camera in both; by instances of one ball. */
static struct pair *glass_pair(bool orthographic) {
    struct pair *s = pair_begin();
    add_sphere(add_geometry(s, 9), (vec3){0, 0, 0}, 1, FIRST);
    struct primitives *two = add_geometry(s, 9), *top = &s->instanced.primitives;
    add_instance(two, 0, affine_scale(vec3_all(3)), WATER);
    add_instance(
        two, 0, affine_compose(affine_translate((vec3){0.3, 0, 0}), affine_scale((vec3){1, 1.4, -1})), FIRST);
    add_instance(two, 0,
                 affine_compose(affine_translate((vec3){0.9, 0.2, -0.4}), affine_scale((vec3){1, 0.6, 1})),
                 WATER);
    add_instance(top, 1, AFFINE_IDENTITY, GLASS);
    add_instance(top, 1,
                 affine_compose(affine_translate((vec3){-4, 0, -5}), affine_rotate((vec3){0, 1, 0}, 40)),
                 GLASS);
    add_instance(top, 0, affine_translate((vec3){4, 0, -7}), CLAY);
    add_instance(top, 0, affine_translate((vec3){2, 3, -9}), MIRROR);
    add_flat(top, FLAT_PLANE,
             affine_compose(affine_translate((vec3){0, -3.5, 0}), affine_rotate((vec3){1, 0, 0}, -90)), CLAY);
    s->instanced.camera =
        (struct camera){.projection = orthographic ? CAMERA_ORTHOGRAPHIC : CAMERA_PERSPECTIVE,
                        .has_eye = true,
                        .has_direction = true,
                        .has_height = orthographic,
                        .height = 5,
                        .eye = {0.4, 0.1, 0.2},
                        .direction = {-0.1, 0, -1},
                        .up = {0, 1, 0},
                        .fov_deg = 60};
    pair_build(s);
    return s;
}

static void a_camera_in_glass(void **state) {
    (void)state;
    for (int orthographic = 0; orthographic < 2; orthographic++) {
        struct pair *s = glass_pair(orthographic);
        struct media_origin in, flat_in;
        const ray r = {s->instanced.camera.eye, s->instanced.camera.direction};
        media_at(&s->instanced, s->accel, NULL, r, &in);
        media_at(&s->flat, s->flat_accel, NULL, r, &flat_in);
        assert_int_equal(in.media.count, 3); /* the large ball, of water, and both small ones */
        assert_int_equal(flat_in.media.count, 3);
        for (int i = 0; i < in.media.count; i++) {
            assert_true(occurrence_equal(in.media.inside[i].which,
                                         &s->which[flat_in.media.inside[i].which->number[0]]));
            assert_true(in.media.inside[i].index == flat_in.media.inside[i].index);
        }
        assert_true(assert_same_picture(s, 6) > 3000);
        pair_end(s);
    }
}

/* More bodies around the eye than are kept: those that end first stay, in whatever order they are found. */
static void too_many_media(void **state) {
    (void)state;
    struct pair *s = pair_begin();
    add_sphere(add_geometry(s, 9), (vec3){0, 0, 0}, 1, FIRST);
    for (int i = 0; i < 40; i++)
        add_instance(&s->instanced.primitives, 0, affine_scale(vec3_all(1 + (i * 7) % 40)), GLASS);
    pair_build(s);
    struct media_origin in;
    media_at(&s->instanced, s->accel, NULL, (ray){{0, 0, 0.5}, {0, 1, 1}}, &in);
    assert_int_equal(in.media.count, MEDIA_MAX);
    for (uint32_t i = 0; i < MEDIA_MAX; i++) {
        assert_int_equal(in.media.inside[i].which->depth, 1);
        assert_int_equal(in.media.inside[i].which->number[0] * 7 % 40, MEDIA_MAX - 1 - i);
    }
    pair_end(s);
}

/* Balls at one place, some within instances at one place within such: the first as they are written is the outermost, in
 * whatever order the trees have them. */
static void media_that_end_together(void **state) {
    (void)state;
    struct pair *s = pair_begin();
    struct primitives *one = add_geometry(s, 9), *two = add_geometry(s, 9), *top = &s->instanced.primitives;
    add_quadric(one, &forms[ELLIPSOID], AFFINE_IDENTITY, FIRST);
    add_sphere(one, (vec3){0, 0, 0}, 1, FIRST);
    add_quadric(two, &forms[ELLIPSOID], AFFINE_IDENTITY, FIRST);
    add_instance(two, 0, AFFINE_IDENTITY, FIRST);
    add_sphere(two, (vec3){0, 0, 0}, 1, FIRST);
    add_instance(two, 0, AFFINE_IDENTITY, FIRST);
    add_instance(top, 1, AFFINE_IDENTITY, GLASS);
    add_quadric(top, &forms[ELLIPSOID], AFFINE_IDENTITY, GLASS);
    add_instance(top, 1, AFFINE_IDENTITY, GLASS);
    add_sphere(top, (vec3){0, 0, 0}, 1, GLASS);
    pair_build(s);
    struct media_origin in;
    media_at(&s->instanced, s->accel, NULL, (ray){{0, 0, 0.5}, {0, 0, 2}}, &in);
    assert_int_equal(s->flat.primitives.count, 14);
    assert_int_equal(in.media.count, 14);
    for (int i = 0; i < 14; i++) assert_true(occurrence_equal(in.media.inside[i].which, &s->which[i]));
    pair_end(s);
}

static void threads_change_nothing(void **state) {
    (void)state;
    struct random r = random_begin();
    struct pair *s = random_pair(&r, 1.0);
    const unsigned counts[] = {2, 3, 64};
    struct monge_film *one = render(&s->instanced, s->accel, 1);
    for (size_t i = 0; i < COUNT(counts); i++) {
        struct monge_film *many = render(&s->instanced, s->accel, counts[i]);
        assert_memory_equal(one->rgb, many->rgb, 80 * 60 * 3 * sizeof(float));
        monge_film_free(many);
    }
    monge_film_free(one);
    pair_end(s);
}

/* ---- Many ---- */

/* A ball at every integer 0 .. 9999999 of the x axis: the digits are the numbers of the instances. */
static void ten_million_balls(void **state) {
    (void)state;
    struct random r = random_begin();
    struct pair *s = pair_begin();
    struct arena arena = {0};
    add_sphere(add_geometry(s, 1), (vec3){0, 0, 0}, 0.4, FIRST);
    double apart = 1.0;
    for (uint32_t level = 0; level < 7; level++, apart *= 10.0) {
        struct primitives *p = level < 6 ? add_geometry(s, 10) : &s->instanced.primitives;
        for (int i = 0; i < 10; i++)
            add_instance(p, level, affine_translate((vec3){i * apart, 0, 0}), level < 6 ? FIRST : GLASS);
    }
    count_slots(s);
    s->accel =
        accel_build(&arena, &s->instanced.primitives, s->geometries, s->instanced.geometry_count, clear);
    printf("# %zu bytes\n", arena.total);
    assert_true(arena.total < 300 * 1000);
    for (int i = 0; i < 1000; i++) {
        const uint32_t n = random_below(&r, 10000000);
        const double dx = random_below(&r, 200) * 0x1p-10, dz = random_below(&r, 200) * 0x1p-10;
        struct hit hit;
        assert_true(accel_nearest(s->accel, NULL, (ray){{n + dx, 5, dz}, {0, -2, 0}}, 0.0, INFINITY, &hit));
        assert_near(hit.crossing.t, 0.5 * (5.0 - sqrt(0.16 - dx * dx - dz * dz)), 1e-12, "t");
        assert_int_equal(hit.which.depth, 7);
        assert_int_equal(hit.material, GLASS);
        uint32_t digits = 0;
        for (int k = 0; k < 7; k++) digits = 10 * digits + hit.which.number[k];
        assert_int_equal(digits, n);
        assert_int_equal(hit.which.number[7], 0);
        assert_false(accel_any(s->accel, NULL, (ray){{n + dx, 5, dz}, {0, -2, 0}}, 0.0, INFINITY));
        assert_false(accel_nearest(s->accel, NULL, (ray){{n + 0.5, 5, dz}, {0, -2, 0}}, 0.0, INFINITY, &hit));
    }
    assert_near(accel_support(s->accel, (vec3){1, 0, 0}), 9999999.4, 20, "to the end");
    assert_near(accel_support(s->accel, (vec3){-1, 0, 0}), 0.4, 20, "to the begin");
    assert_near(accel_support(s->accel, (vec3){0, 1, 0}), 0.4, 1e-6, "up, where all are equal");
    const double slanted = accel_support(s->accel, (vec3){0, 1, 1}); /* their boxes reach further than they */
    assert_true(slanted >= 0.4 * sqrt(2.0) - 1e-9 && slanted <= 0.8 + 1e-12);
    arena_free(&arena);
    pair_end(s);
}

/* As many instances around a primitive as there may be. */
static void the_deepest_nesting(void **state) {
    (void)state;
    struct pair *s = pair_begin();
    add_sphere(add_geometry(s, 1), (vec3){0, 0, 0}, 1, FIRST);
    for (uint32_t level = 1; level < INSTANCE_MAX_DEPTH; level++)
        add_instance(add_geometry(s, 1), level - 1, affine_translate((vec3){1, 0, 0}),
                     level == 5 ? GLASS : FIRST);
    add_instance(&s->instanced.primitives, INSTANCE_MAX_DEPTH - 1, affine_scale(vec3_all(2)), CLAY);
    pair_build(s);
    struct hit hit;
    assert_true(accel_nearest(s->accel, NULL, (ray){{62, 9, 0}, {0, -1, 0}}, 0.0, INFINITY, &hit));
    assert_near(hit.crossing.t, 7, 1e-12, "t");
    assert_int_equal(hit.which.depth, INSTANCE_MAX_DEPTH);
    assert_int_equal(hit.material, GLASS);
    assert_vec3_near(accel_surface(s->accel, (ray){{62, 9, 0}, {0, -1, 0}}, &hit).point, (vec3){62, 2, 0},
                     1e-12, "point");
    pair_end(s);
}

/* ---- What the scene makes of them ---- */

static struct hash hash_of(const struct scene *scene) {
    struct hash hash;
    hash_begin(&hash);
    scene_hash(scene, &hash);
    return hash;
}

static void fingerprints(void **state) {
    (void)state;
    struct random r = random_begin();
    struct pair *s = random_pair(&r, 1.0);
    for (int i = 0; i < 3; i++) s->geometries[i].slots = SLOTS; /* even where chance has used none */
    const struct hash before = hash_of(&s->instanced);
    struct instance *placed = s->instanced.primitives.instances, *inner = s->geometries[2].instances;
    const struct instance keep = *placed, keep_inner = *inner;
    placed->world_from_object.m[1][3] += 1e-9;
    assert_memory_not_equal(&before, &(struct hash[]){hash_of(&s->instanced)}, sizeof before);
    *placed = keep;
    placed->materials = material_pair((keep.materials[0] + 1) % MATERIALS, keep.materials[1]);
    assert_memory_not_equal(&before, &(struct hash[]){hash_of(&s->instanced)}, sizeof before);
    *placed = keep;
    placed->materials = material_pair(keep.materials[0], (keep.materials[1] + 1) % MATERIALS);
    assert_memory_not_equal(&before, &(struct hash[]){hash_of(&s->instanced)}, sizeof before);
    *placed = keep;
    placed->geometry = 3;
    assert_memory_not_equal(&before, &(struct hash[]){hash_of(&s->instanced)}, sizeof before);
    *placed = keep;
    inner->materials =
        material_pair(keep_inner.materials[0] == FIRST ? SECOND : FIRST, keep_inner.materials[1]);
    assert_memory_not_equal(&before, &(struct hash[]){hash_of(&s->instanced)}, sizeof before);
    *inner = keep_inner;
    s->instanced.primitives.info[0].material = MIRROR; /* of an instance: not used */
    assert_memory_equal(&before, &(struct hash[]){hash_of(&s->instanced)}, sizeof before);
    s->geometries[0].info[0].material = s->geometries[0].info[0].material == CLAY ? MIRROR : CLAY;
    assert_memory_not_equal(&before, &(struct hash[]){hash_of(&s->instanced)}, sizeof before);
    pair_end(s);
}

/* Under a white point light: whether what instances place is lit depends on the material that it gets. */
static void dark_scenes(void **state) {
    (void)state;
    static struct material two[] = {{.index = 1}, {.diffuse = {1, 1, 1}, .index = 1}};
    enum { BLACK, WHITE };
    static const struct {
        uint32_t own, inner, outer;
        unsigned warnings;
    } rows[] = {
        {FIRST, FIRST, BLACK, 1}, {FIRST, FIRST, WHITE, 0}, {FIRST, BLACK, WHITE, 1},
        {FIRST, WHITE, BLACK, 0}, {BLACK, WHITE, WHITE, 1}, {WHITE, BLACK, BLACK, 0},
    };
    for (size_t i = 0; i < COUNT(rows); i++) {
        struct loaded l;
        load_good(&l, "lights: [{point: {at: [0, 5, 0]}}]\nscene: [{sphere: {}}]\n");
        struct pair *s = pair_begin();
        add_sphere(add_geometry(s, 1), (vec3){0, 0, 0}, 1, rows[i].own);
        add_instance(add_geometry(s, 1), 0, AFFINE_IDENTITY, rows[i].inner);
        add_instance(&s->instanced.primitives, 1, AFFINE_IDENTITY, rows[i].outer);
        s->instanced.materials = two;
        s->instanced.material_count = COUNT(two);
        s->instanced.default_lights = false;
        s->instanced.lights = l.scene.lights;
        s->instanced.light_count = l.scene.light_count;
        count_slots(s);
        struct builder b = {.arena = &s->arena, .diag = &l.diag, .scene = &s->instanced};
        lights_check(&b, l.result.file);
        if (l.diag.warnings != rows[i].warnings) fail_msg("row %zu: %u warnings", i, l.diag.warnings);
        pair_end(s);
        unload(&l);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_same_as_brute_force),
        cmocka_unit_test(ties),
        cmocka_unit_test(the_same_as_flattened),
        cmocka_unit_test(errors_hold),
        cmocka_unit_test(errors_hold_on_what_is_large),
        cmocka_unit_test(support_is_tight),
        cmocka_unit_test(the_same_pictures),
        cmocka_unit_test(a_camera_in_glass),
        cmocka_unit_test(too_many_media),
        cmocka_unit_test(media_that_end_together),
        cmocka_unit_test(threads_change_nothing),
        cmocka_unit_test(ten_million_balls),
        cmocka_unit_test(the_deepest_nesting),
        cmocka_unit_test(fingerprints),
        cmocka_unit_test(dark_scenes),
    };
    return cmocka_run_group_tests_name("instance", tests, NULL, NULL);
}
