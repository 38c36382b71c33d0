/* The hierarchy against brute force over all primitives: it may never change an answer. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "accel/bvh.h"
#include "shape_forms.h"

/* ---- Random numbers, from a printed seed ---- */

static uint64_t random_state;

static void random_begin(uint64_t seed) {
    printf("# seed %llu\n", (unsigned long long)seed);
    random_state = seed * 0x9e3779b97f4a7c15u + 1;
}

static uint64_t random_bits(void) { /* xorshift64* of Vigna */
    random_state ^= random_state >> 12;
    random_state ^= random_state << 25;
    random_state ^= random_state >> 27;
    return random_state * 0x2545f4914f6cdd1du;
}

static double random_in(double low, double high) {
    return low + (high - low) * (double)(random_bits() >> 11) * 0x1p-53;
}
static uint32_t random_below(uint32_t count) { return (uint32_t)((random_bits() >> 32) * count >> 32); }

/* On a grid of halves where `grid`, so that faces, edges and rays coincide. */
static double random_coordinate(double size, bool grid) {
    const double x = random_in(-size, size);
    return grid ? floor(2.0 * x / size * 4.0) * size / 8.0 : x;
}

static vec3 random_vec3(double size, bool grid) {
    return (vec3){random_coordinate(size, grid), random_coordinate(size, grid),
                  random_coordinate(size, grid)};
}

/* ---- Scenes ---- */

struct scene {
    struct arena arena;
    struct primitives p;
    struct accel *accel;
    const bool *clear; /* by material; NULL: none */
};

static void scene_begin(struct scene *s, uint32_t room) {
    *s = (struct scene){0};
    struct primitives *p = &s->p;
    p->info = arena_array(&s->arena, room, sizeof *p->info);
    p->spheres = arena_array(&s->arena, room, sizeof *p->spheres);
    p->flats = arena_array(&s->arena, room, sizeof *p->flats);
    p->quadrics = arena_array(&s->arena, room, sizeof *p->quadrics);
    p->sphere_number = arena_array(&s->arena, room, sizeof *p->sphere_number);
    p->flat_number = arena_array(&s->arena, room, sizeof *p->flat_number);
    p->quadric_number = arena_array(&s->arena, room, sizeof *p->quadric_number);
}

static void set_number(struct primitives *p, primitive_ref ref, uint32_t number) {
    uint32_t *const numbers[] = {p->sphere_number, p->flat_number, p->quadric_number};
    numbers[primitive_ref_kind(ref)][primitive_ref_index(ref)] = number;
    p->info[number].ref = ref;
}

static void add(struct primitives *p, enum primitive_kind kind, uint32_t index) {
    set_number(p, primitive_ref_make(kind, index), p->count++);
}

static void add_sphere(struct primitives *p, vec3 center, double radius) {
    p->spheres[p->sphere_count] = (struct sphere){center, radius};
    add(p, PRIMITIVE_SPHERE, p->sphere_count++);
}

static void add_flat(struct primitives *p, enum flat_outline outline, affine world_from_object) {
    struct flat flat = {.world_from_object = world_from_object, .outline = outline};
    if (!affine_invert(world_from_object, &flat.object_from_world)) return;
    p->flats[p->flat_count] = flat;
    add(p, PRIMITIVE_FLAT, p->flat_count++);
}

static void add_quadric(struct primitives *p, const struct quadric_form *form, affine world_from_object) {
    struct quadric quadric = {.world_from_object = world_from_object, .form = form};
    if (!affine_invert(world_from_object, &quadric.object_from_world)) return;
    p->quadrics[p->quadric_count] = quadric;
    add(p, PRIMITIVE_QUADRIC, p->quadric_count++);
}

/* Numbers no longer follow the order in the arrays. */
static void shuffle(struct primitives *p) {
    for (uint32_t i = p->count; i > 1; i--) {
        const uint32_t j = random_below(i);
        const primitive_ref a = p->info[i - 1].ref, b = p->info[j].ref;
        set_number(p, a, j);
        set_number(p, b, i - 1);
    }
}

static affine random_map(double size, bool grid) {
    const affine place = affine_translate(random_vec3(size, grid));
    if (grid) return affine_compose(place, affine_scale(vec3_all(size / 4.0)));
    const affine turn = affine_rotate((vec3){random_in(-1, 1), random_in(-1, 1), 1.5}, random_in(0, 360));
    const vec3 scale = {size * random_in(0.02, 0.3), size * random_in(0.02, 0.3),
                        size * random_in(-0.3, -0.02)};
    return affine_compose(place, affine_compose(turn, affine_scale(scale)));
}

static void add_random(struct primitives *p, double size, bool grid) {
    static const struct quadric_form endless = {
        .xx = 1, .yy = 1, .constant = -1, .clip = BOX3_ALL, .extent = BOX3_ALL};
    switch (random_below(12)) {
    case 0: add_flat(p, FLAT_SQUARE, random_map(size, grid)); break;
    case 1: add_flat(p, FLAT_DISC, random_map(size, grid)); break;
    case 2:
        if (random_below(8) == 0) add_flat(p, FLAT_PLANE, random_map(size, grid));
        break;
    case 3:
        if (random_below(8) == 0) add_quadric(p, &endless, random_map(0.1 * size, grid));
        break;
    case 4:
    case 5:
    case 6:
    case 7: add_quadric(p, &forms[random_below(FORM_COUNT)], random_map(size, grid)); break;
    default: add_sphere(p, random_vec3(size, grid), grid ? size / 4.0 : size * random_in(0.01, 0.2)); break;
    }
}

static ray random_ray(double size, bool grid) {
    static const double far_away[] = {1.0, 1.0, 1.0, 3.0, 1e4};
    const double away = far_away[random_below(5)];
    ray r = {random_vec3(size * away, grid), random_vec3(1.0, grid)};
    if (away > 1.0) r.dir = vec3_sub(random_vec3(size, grid), r.org);
    if (random_below(4) == 0) { /* along an axis, with zeros of either sign */
        r.dir = (vec3){copysign(0.0, random_in(-1, 1)), copysign(0.0, random_in(-1, 1)),
                       copysign(0.0, random_in(-1, 1))};
        double *const axes[] = {&r.dir.x, &r.dir.y, &r.dir.z};
        double *const places[] = {&r.org.x, &r.org.y, &r.org.z};
        const uint32_t along = random_below(3);
        *axes[along] = (random_below(2) ? 1 : -1) * (random_below(2) ? 2.0 : random_in(1, 7));
        if (random_below(3) == 0) *places[along] = -*axes[along] * size * exp2(random_in(30, 50));
    }
    return vec3_max_abs(r.dir) > 0.0 ? r : (ray){r.org, {0, 0, 1}};
}

/* ---- The oracle ---- */

enum among { ALL, OPAQUE, CLEAR };

static bool is_among(const struct scene *s, uint32_t number, enum among among) {
    const bool clear = s->clear && s->clear[s->p.info[number].material];
    return among == ALL || clear == (among == CLEAR);
}

static struct hit hit_of(uint32_t number, struct crossing crossing) {
    return (struct hit){.crossing = crossing, .which = {.number = {number}}};
}

static bool oracle_nearest(const struct scene *s, enum among among, ray r, double t_min, double t_max,
                           struct hit *hit) {
    const struct primitives *p = &s->p;
    bool found = false;
    for (uint32_t i = 0; i < p->count; i++) {
        struct crossing c;
        if (!is_among(s, i, among)) continue;
        if (!shape_first_crossing(p, p->info[i].ref, r, t_min, t_max, &c)) continue;
        if (found && !(c.t < hit->crossing.t)) continue; /* numbers rise: an equal one loses */
        *hit = hit_of(i, c);
        found = true;
    }
    return found;
}

static bool oracle_any(const struct scene *s, ray r, double t_min, double t_max) {
    struct hit hit;
    return oracle_nearest(s, OPAQUE, r, t_min, t_max, &hit) && hit.crossing.t < t_max;
}

/* Asks for the nearest among all or the clear ones; returns whether the ray hit. */
static bool check_nearest(const struct scene *s, enum among among, ray r, double t_min, double t_max) {
    const struct hit untouched = hit_of(77, (struct crossing){-5.0, SHAPE_CUT_MAX_Z});
    struct hit want = untouched, found = untouched;
    const bool hit = oracle_nearest(s, among, r, t_min, t_max, &want);
    const bool answer = among == CLEAR ? accel_nearest_clear(s->accel, NULL, r, t_min, t_max, &found)
                                       : accel_nearest(s->accel, NULL, r, t_min, t_max, &found);
    if (answer != hit || found.which.number[0] != want.which.number[0] ||
        found.crossing.t != want.crossing.t || found.crossing.part != want.crossing.part)
        fail_msg("ray %a %a %a, %a %a %a in %a .. %a: found %u at %a, not %u at %a", r.org.x, r.org.y,
                 r.org.z, r.dir.x, r.dir.y, r.dir.z, t_min, t_max, found.which.number[0], found.crossing.t,
                 want.which.number[0], want.crossing.t);
    return hit;
}

/* All questions of one ray; returns whether it hit. */
static bool check_ray(const struct scene *s, ray r, double t_min, double t_max) {
    const bool hit = check_nearest(s, ALL, r, t_min, t_max);
    if (s->clear) check_nearest(s, CLEAR, r, t_min, t_max);
    if (accel_any(s->accel, NULL, r, t_min, t_max) != oracle_any(s, r, t_min, t_max))
        fail_msg("any hit: ray %a %a %a, %a %a %a in %a .. %a", r.org.x, r.org.y, r.org.z, r.dir.x, r.dir.y,
                 r.dir.z, t_min, t_max);
    return hit;
}

static void check_random_rays(const struct scene *s, double size, bool grid, int rays, int least_hits) {
    int hits = 0;
    for (int i = 0; i < rays; i++) {
        const ray r = random_ray(size, grid);
        hits += check_ray(s, r, 0.0, INFINITY);
        struct hit hit;
        if (!accel_nearest(s->accel, NULL, r, -1.0, INFINITY, &hit)) continue;
        const double t = hit.crossing.t;
        check_ray(s, r, t, INFINITY);
        check_ray(s, r, -INFINITY, t);
        check_ray(s, r, -1.0, nextafter(t, -INFINITY));
        check_ray(s, r, t, t);
        check_ray(s, r, -1.0, nextafter(t, INFINITY));
    }
    assert_true(hits >= least_hits);
}

/* ---- The tree itself ---- */

struct tree_check {
    const struct primitives *primitives;
    const struct bvh *bvh;
    unsigned depth;
    uint32_t nodes, refs;
    unsigned char *seen[3]; /* by kind and index */
};

static bool holds(const struct bvh_node *outer, const double min[3], const double max[3]) {
    for (int k = 0; k < 3; k++)
        if (!((double)outer->bounds[k] <= min[k] && max[k] <= (double)outer->bounds[3 + k])) return false;
    return true;
}

static void check_leaf(struct tree_check *check, const struct bvh_node *node) {
    assert_true(node->count <= ACCEL_LEAF_SIZE);
    for (uint32_t i = node->first; i < node->first + node->count; i++) {
        const primitive_ref ref = check->bvh->refs[i];
        const box3 box = shape_bounds(check->primitives, ref);
        unsigned char *seen = &check->seen[primitive_ref_kind(ref)][primitive_ref_index(ref)];
        const double room = 0x1p-23 * fmax(vec3_max_abs(box.min), vec3_max_abs(box.max));
        assert_true(holds(node, (double[3]){box.min.x - room, box.min.y - room, box.min.z - room},
                          (double[3]){box.max.x + room, box.max.y + room, box.max.z + room}));
        assert_true(i == node->first || check->bvh->refs[i - 1] < ref);
        assert_false(*seen);
        *seen = 1;
        check->refs++;
    }
}

static void check_node(struct tree_check *check, uint32_t index, unsigned depth) {
    const struct bvh_node *node = &check->bvh->nodes[index];
    check->nodes++;
    check->depth = depth > check->depth ? depth : check->depth;
    assert_true(index < check->bvh->node_count);
    if (node->count) {
        check_leaf(check, node);
        return;
    }
    for (uint32_t child = node->first; child < node->first + 2; child++) {
        const float *b = check->bvh->nodes[child].bounds;
        assert_true(holds(node, (double[3]){b[0], b[1], b[2]}, (double[3]){b[3], b[4], b[5]}));
        check_node(check, child, depth + 1);
    }
}

/* Every bounded primitive in one leaf, every box around its content; returns the depth. */
static unsigned check_tree(const struct scene *s, uint32_t bounded) {
    const struct bvh *bvh = s->accel->opaque;
    struct tree_check check = {.primitives = &s->p, .bvh = bvh};
    for (int k = 0; k < 3; k++) check.seen[k] = calloc(s->p.count + 1, 1);
    if (bvh->node_count) check_node(&check, 0, 0);
    for (int k = 0; k < 3; k++) free(check.seen[k]);
    assert_int_equal(check.refs, bounded);
    assert_int_equal(bvh->node_count, check.nodes ? check.nodes + 1 : 0);
    assert_true(check.depth <= ACCEL_MAX_DEPTH);
    return check.depth;
}

static void scene_end(struct scene *s) { arena_free(&s->arena); }

static void scene_build(struct scene *s) { s->accel = accel_build(&s->arena, &s->p, NULL, 0, s->clear); }

/* ---- Tests ---- */

struct mix {
    const char *name;
    int primitives;
    double size;
    bool grid;
};

static void mixed_scenes(void **state) {
    const struct mix *mix = *state;
    for (uint64_t seed = 1; seed <= 12; seed++) {
        struct scene s;
        random_begin(seed);
        scene_begin(&s, 1000);
        for (int i = 0; i < mix->primitives; i++) add_random(&s.p, mix->size, mix->grid);
        shuffle(&s.p);
        scene_build(&s);
        check_tree(&s, s.p.count - s.accel->opaque->unbounded_count);
        check_random_rays(&s, mix->size, mix->grid, 400, mix->primitives > 30 ? 100 : 0);
        scene_end(&s);
    }
}

/* Some of every kind let light through: they are hit, but do not stop it. */
static void clear_and_opaque(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= 12; seed++) {
        struct scene s;
        random_begin(seed);
        scene_begin(&s, 1000);
        for (int i = 0; i < 200; i++) add_random(&s.p, 4.0, seed % 2);
        shuffle(&s.p);
        static const bool clear[] = {false, true, false};
        for (uint32_t i = 0; i < s.p.count; i++) s.p.info[i].material = random_below(3);
        s.clear = clear;
        scene_build(&s);
        check_random_rays(&s, 4.0, seed % 2, 300, 60);
        scene_end(&s);
    }
}

static void ten_thousand_spheres(void **state) {
    (void)state;
    struct scene s;
    random_begin(5);
    scene_begin(&s, 10000);
    for (int i = 0; i < 10000; i++) add_sphere(&s.p, random_vec3(10.0, false), random_in(0.01, 0.3));
    shuffle(&s.p);
    scene_build(&s);
    check_tree(&s, 10000);
    check_random_rays(&s, 10.0, false, 100, 40);
    scene_end(&s);
}

static void nothing(void **state) {
    (void)state;
    struct scene s;
    scene_begin(&s, 1);
    scene_build(&s);
    check_ray(&s, (ray){{0, 0, -3}, {0, 0, 1}}, -INFINITY, INFINITY);
    assert_true(box3_is_empty(accel_bounds(s.accel)));
    assert_int_equal(check_tree(&s, 0), 0);
    scene_end(&s);
}

static void one_sphere(void **state) {
    (void)state;
    struct scene s;
    scene_begin(&s, 1);
    add_sphere(&s.p, (vec3){0, 0, 5}, 1.0);
    scene_build(&s);
    struct hit hit;
    assert_true(accel_nearest(s.accel, NULL, (ray){{0, 0, 0}, {0, 0, 2}}, 0.0, INFINITY, &hit));
    assert_int_equal(hit.which.number[0], 0);
    assert_true(fabs(hit.crossing.t - 2.0) < 1e-15);
    const box3 bounds = accel_bounds(s.accel), want = shape_bounds(&s.p, s.p.info[0].ref);
    assert_memory_equal(&bounds, &want, sizeof want);
    scene_end(&s);
}

static void planes_alone(void **state) {
    (void)state;
    struct scene s;
    scene_begin(&s, 2);
    add_flat(&s.p, FLAT_PLANE, affine_translate((vec3){0, 0, 2}));
    add_flat(&s.p, FLAT_PLANE, affine_translate((vec3){0, 0, 1}));
    scene_build(&s);
    check_tree(&s, 0);
    assert_int_equal(s.accel->opaque->unbounded_count, 2);
    assert_true(check_ray(&s, (ray){{0, 0, 0}, {0, 0, 1}}, 0.0, INFINITY));
    assert_false(check_ray(&s, (ray){{0, 0, 0}, {0, 0, -1}}, 0.0, INFINITY));
    assert_true(box3_is_empty(accel_bounds(s.accel)));
    scene_end(&s);
}

/* t of the crossings of a sphere of radius 1 at z = 0 from z = -3: 2 and 4. */
static struct limit_row {
    const char *name;
    double t_min, t_max;
    bool nearest, any;
} limit_rows[] = {
    {"limits: all", 0.0, 10.0, true, true},
    {"limits: t_min is left out", 2.0, 3.0, false, false},
    {"limits: the far side", 2.0, 5.0, true, true},
    {"limits: t_max is in for the nearest hit, out for any hit", 0.0, 2.0, true, false},
    {"limits: the same for the far side", 2.0, 4.0, true, false},
    {"limits: before", 0.0, 1.999, false, false},
    {"limits: beyond", 4.0, INFINITY, false, false},
    {"limits: an empty range", 3.0, 1.0, false, false},
    {"limits: not a number", NAN, NAN, false, false},
};

static void limits(void **state) {
    const struct limit_row *row = *state;
    struct scene s;
    scene_begin(&s, 1);
    add_sphere(&s.p, (vec3){0, 0, 0}, 1.0);
    scene_build(&s);
    const ray r = {{0, 0, -3}, {0, 0, 1}};
    struct hit hit;
    assert_int_equal(accel_nearest(s.accel, NULL, r, row->t_min, row->t_max, &hit), row->nearest);
    assert_int_equal(accel_any(s.accel, NULL, r, row->t_min, row->t_max), row->any);
    scene_end(&s);
}

/* 61 copies of one primitive: the lowest number of those hit is the answer, wherever it is stored. */
static void ties(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= 20; seed++) {
        struct scene s;
        random_begin(seed);
        scene_begin(&s, 200);
        const affine map = random_map(1.0, seed % 2);
        for (int i = 0; i < 61; i++) {
            add_sphere(&s.p, (vec3){3, 0, 0}, 1.0);
            add_quadric(&s.p, &forms[CYLINDER], map);
            add_flat(&s.p, seed % 3 ? FLAT_SQUARE : FLAT_PLANE,
                     affine_compose(affine_translate((vec3){0, 3, 0}), map));
        }
        shuffle(&s.p);
        scene_build(&s);
        check_tree(&s, s.p.count - s.accel->opaque->unbounded_count);
        check_random_rays(&s, 3.0, false, 50, 0);
        const vec3 targets[] = {{3, 0, 0}, affine_column(map, 3)};
        for (int k = 0; k < 2; k++) {
            const vec3 org = {0.1, -5, 7};
            assert_true(check_ray(&s, (ray){org, vec3_sub(targets[k], org)}, 0.0, INFINITY));
        }
        scene_end(&s);
    }
}

/* Squares edge to edge and one upon the other, hit from afar along the axes and at their edges. */
static void touching_squares(void **state) {
    (void)state;
    struct scene s;
    random_begin(3);
    scene_begin(&s, 200);
    for (int layer = 0; layer < 2; layer++)
        for (int i = 0; i < 100; i++)
            add_flat(&s.p, FLAT_SQUARE, affine_translate((vec3){i % 10, i / 10, 0.1 * layer}));
    shuffle(&s.p);
    scene_build(&s);
    int hits = 0;
    for (int y = 0; y <= 40; y++) {
        for (int x = 0; x <= 40; x++) {
            const vec3 target = {-0.5 + x / 4.0, -0.5 + y / 4.0, 0.0};
            hits += check_ray(&s, (ray){{target.x, target.y, 7}, {0, -0.0, -1}}, 0.0, INFINITY);
            hits += check_ray(&s, (ray){{target.x, target.y, 0}, {0, 1, 0}}, 0.0, INFINITY);
            hits +=
                check_ray(&s, (ray){{1e5, 3e4, 1e5}, vec3_sub(target, (vec3){1e5, 3e4, 1e5})}, 0.0, INFINITY);
        }
    }
    assert_true(hits > 1000);
    scene_end(&s);
}

static void coincident(void **state) {
    (void)state;
    struct scene s;
    random_begin(9);
    scene_begin(&s, 5000);
    for (int i = 0; i < 5000; i++) add_sphere(&s.p, (vec3){1, 2, 3}, 1.0 + (i % 7) / 7.0);
    shuffle(&s.p);
    scene_build(&s);
    assert_true(check_tree(&s, 5000) <= 24);
    check_random_rays(&s, 3.0, false, 50, 5);
    scene_end(&s);
}

/* Sizes and places that shrink toward one point: each split by cost cuts off a few primitives only. */
static void depth_is_bounded(void **state) {
    (void)state;
    struct scene s;
    random_begin(4);
    scene_begin(&s, 100000);
    for (int i = 0; i < 100000; i++) {
        const double x = exp2(125.0 - 250.0 * i / 100000.0);
        add_sphere(&s.p, (vec3){x, i % 2 ? x : -x, 0}, 1e-4 * x);
    }
    scene_build(&s);
    const unsigned depth = check_tree(&s, 100000);
    printf("# depth %u\n", depth);
    assert_true(depth > 40); /* else this does not test the bound */
    check_random_rays(&s, 1.0, false, 5, 0);
    scene_end(&s);
}

/* Numbers near the ends of what float and double hold; the answer stays that of brute force. */
static void huge_and_tiny(void **state) {
    (void)state;
    static const double sizes[] = {1e-300, 1e-150, 1e-44, 1e-38, 1e-4, 1e6, 1e30, 2e38, 1e39, 1e150, 1e300};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        struct scene s;
        random_begin(i);
        scene_begin(&s, 200);
        for (int k = 0; k < 200; k++)
            add_sphere(&s.p, random_vec3(sizes[i], false), sizes[i] * random_in(0.01, 0.2));
        scene_build(&s);
        check_tree(&s, 200 - s.accel->opaque->unbounded_count);
        check_random_rays(&s, sizes[i], false, 100, sizes[i] < 1e-100 || sizes[i] > 1e100 ? 0 : 20);
        scene_end(&s);
    }
}

static void same_tree_again(void **state) {
    (void)state;
    struct scene s;
    random_begin(8);
    scene_begin(&s, 1000);
    for (int i = 0; i < 1000; i++) add_random(&s.p, 4.0, i % 2);
    scene_build(&s);
    const struct bvh *first = s.accel->opaque;
    scene_build(&s);
    const struct bvh *second = s.accel->opaque;
    assert_int_equal(first->node_count, second->node_count);
    assert_memory_equal(first->nodes, second->nodes, first->node_count * sizeof *first->nodes);
    assert_memory_equal(first->refs, second->refs,
                        (s.p.count - first->unbounded_count) * sizeof *first->refs);
    scene_end(&s);
}

/* Memory that runs out leaves by the arena's own way, and nothing of the build stays behind. */
static void arena_that_is_full(void **state) {
    (void)state;
    struct scene s;
    random_begin(2);
    scene_begin(&s, 1000);
    for (int i = 0; i < 1000; i++) add_sphere(&s.p, random_vec3(1.0, false), 0.01);
    jmp_buf full;
    struct arena small = {.limit = 5000, .on_full = &full};
    volatile bool came_back = false;
    if (setjmp(full) == 0)
        accel_build(&small, &s.p, NULL, 0, NULL);
    else
        came_back = true;
    assert_true(came_back);
    assert_ptr_equal(small.on_full, &full);
    arena_free(&small);
    scene_end(&s);
}

int main(void) {
    static struct mix mixes[] = {
        {"few", 7, 2.0, false},           {"many", 400, 5.0, false},
        {"few on a grid", 9, 2.0, true},  {"many on a grid", 300, 4.0, true},
        {"many, tiny", 200, 1e-4, false}, {"many, huge", 200, 1e6, false},
    };
    struct CMUnitTest tests[64] = {
        cmocka_unit_test(nothing),
        cmocka_unit_test(one_sphere),
        cmocka_unit_test(planes_alone),
        cmocka_unit_test(clear_and_opaque),
        cmocka_unit_test(ten_thousand_spheres),
        cmocka_unit_test(ties),
        cmocka_unit_test(touching_squares),
        cmocka_unit_test(coincident),
        cmocka_unit_test(depth_is_bounded),
        cmocka_unit_test(huge_and_tiny),
        cmocka_unit_test(same_tree_again),
        cmocka_unit_test(arena_that_is_full),
    };
    size_t count = 12;
    for (size_t i = 0; i < sizeof mixes / sizeof *mixes; i++)
        tests[count++] = (struct CMUnitTest){mixes[i].name, mixed_scenes, NULL, NULL, &mixes[i]};
    for (size_t i = 0; i < sizeof limit_rows / sizeof *limit_rows; i++)
        tests[count++] = (struct CMUnitTest){limit_rows[i].name, limits, NULL, NULL, &limit_rows[i]};
    return _cmocka_run_group_tests("accel", tests, count, NULL, NULL);
}
