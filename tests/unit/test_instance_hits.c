/* What rays hit of instances: the same as by brute force to the bit, and the same, with the same surfaces and shadows,
 * as of the scene with every instance carried out. */
#include "instance_pair.h"

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

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_same_as_brute_force), cmocka_unit_test(ties),
        cmocka_unit_test(the_same_as_flattened),   cmocka_unit_test(support_is_tight),
        cmocka_unit_test(ten_million_balls),       cmocka_unit_test(the_deepest_nesting),
    };
    return cmocka_run_group_tests_name("hits of instances", tests, NULL, NULL);
}
