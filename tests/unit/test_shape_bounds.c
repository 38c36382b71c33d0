/* The boxes that hold shapes, and how far shapes reach. */
#include "near.h"
#include "shape_named.h"

static struct bounds_row {
    const char *name;
    int shape;
    box3 want;
} bounds_rows[] = {
    {"sphere", BALL_2, BOX(-1, 0, 1, 3, 4, 5)},
    {"square", SQUARE, BOX(-0.5, -0.5, 0, 0.5, 0.5, 0)},
    {"square, turned", SLANTED, BOX(-0.5, 0, -0.5, 0.5, 0, 0.5)},
    {"disc", DISC, BOX(-1, -1, 0, 1, 1, 0)},
    {"plane", PLANE, BOX(-INFINITY, -INFINITY, -INFINITY, INFINITY, INFINITY, INFINITY)},
    {"ellipsoid", STRETCHED, BOX(-1, -2, -3, 1, 2, 3)},
    {"cylinder", CYLINDER, BOX(-1, -1, -0.5, 1, 1, 0.5)},
    {"cone", CONE, BOX(-1, -1, -1, 1, 1, 0)},
    {"cone mirrored", MIRRORED, BOX(-1, -1, 0, 1, 1, 1)},
    {"paraboloid", PARABOLOID, BOX(-1, -1, 0, 1, 1, 1)},
    {"box", CUBE, BOX(-0.5, -0.5, -0.5, 0.5, 0.5, 0.5)},
    {"hyperboloid, tighter than its extent", HYPERBOLOID,
     BOX(-1.4142135623730951, -1.4142135623730951, -1, 1.4142135623730951, 1.4142135623730951, 1)},
    {"a term in x: its extent", LEANING, BOX(-3, -2, -1, 3, 2, 1)},
    {"a term in y", LEANING + 1, BOX(-2, -3, -1, 2, 3, 1)},
    {"a term in x y", LEANING + 2, BOX(-1.25, -1.25, -1, 1.25, 1.25, 1)},
    {"a term in y z", LEANING + 3, BOX(-1.25, -1.75, -1, 1.25, 1.75, 1)},
    {"a term in z x", LEANING + 4, BOX(-1.75, -1.25, -1, 1.75, 1.25, 1)},
    {"no end", SPACE, BOX(-INFINITY, -INFINITY, -INFINITY, INFINITY, INFINITY, INFINITY)},
};

static void check_bounds(void **state) {
    const struct bounds_row *row = *state;
    struct alone a;
    make(&a, row->shape);
    const box3 got = shape_bounds(&a.p, a.ref), want = row->want;
    if (!box3_is_bounded(want)) {
        assert_memory_equal(&got, &want, sizeof want);
        return;
    }
    assert_vec3_near(got.min, want.min, 1e-13, "min");
    assert_vec3_near(got.max, want.max, 1e-13, "max");
    assert_true(got.min.x <= want.min.x && got.min.y <= want.min.y && got.min.z <= want.min.z);
    assert_true(got.max.x >= want.max.x && got.max.y >= want.max.y && got.max.z >= want.max.z);
}

/* The two maps are each other's inverse only to rounding. Here they differ by more: what is hit, by
 * object_from_world, must be in the bounds all the same. */
static void check_bounds_of_hits(void **state) {
    (void)state;
    const vec3 gap = {1e-9, -1e-9, 1e-9};
    for (int i = 0; i < 18; i++) {
        const double side = i % 2 ? 1 : -1, size = i < 6 ? 1 : i < 12 ? 1e3 : 1e-3;
        const int axis = i / 2 % 3;
        const vec3 d = {axis == 0 ? side : 0, axis == 1 ? side : 0, axis == 2 ? side : 0};
        struct alone a;
        alone_quadric(&a, &forms[ELLIPSOID], affine_scale(vec3_all(size)));
        a.quadric.object_from_world =
            affine_compose(a.quadric.object_from_world, affine_translate(vec3_neg(gap)));
        const struct instance placed = {a.quadric.object_from_world, a.quadric.world_from_object, 0, 0};
        const vec3 hit = vec3_madd(gap, size, d);
        const box3 both[] = {shape_bounds(&a.p, a.ref),
                             shape_placed_bounds(&placed, (box3)BOX(-1, -1, -1, 1, 1, 1))};
        for (int k = 0; k < 2; k++) {
            const box3 got = both[k];
            assert_true(got.min.x <= hit.x && got.min.y <= hit.y && got.min.z <= hit.z);
            assert_true(got.max.x >= hit.x && got.max.y >= hit.y && got.max.z >= hit.z);
            assert_vec3_near(got.max, vec3_all(size), 4e-9, "max");
            assert_vec3_near(got.min, vec3_all(-size), 4e-9, "min");
        }
    }
}

/* The same where they differ in scale: by most far from the origin, on whichever side of it. */
static void check_bounds_of_scaled_hits(void **state) {
    (void)state;
    for (int i = 0; i < 4; i++) {
        const double scale = i & 1 ? 1 + 1e-9 : 1 - 1e-9;
        const vec3 center = vec3_scale((vec3){2, 3, 4}, i & 2 ? 1 : -1);
        struct alone a;
        alone_quadric(&a, &forms[CUBE], affine_translate(center));
        a.quadric.object_from_world =
            affine_compose(a.quadric.object_from_world, affine_scale(vec3_all(1 / scale)));
        const vec3 min = vec3_scale(vec3_sub(center, vec3_all(0.5)), scale),
                   max = vec3_scale(vec3_add(center, vec3_all(0.5)), scale);
        const box3 got = shape_bounds(&a.p, a.ref);
        assert_true(got.min.x <= min.x && got.min.y <= min.y && got.min.z <= min.z);
        assert_true(got.max.x >= max.x && got.max.y >= max.y && got.max.z >= max.z);
        assert_vec3_near(got.min, min, 2e-8, "min");
        assert_vec3_near(got.max, max, 2e-8, "max");
    }
}

/* What has no end reaches endlessly, along an axis too. */
static void check_endless_support(void **state) {
    (void)state;
    const int shapes[] = {SPACE, QUARTER, PLANE};
    for (size_t i = 0; i < COUNT(shapes); i++)
        for (int k = 1; k < 27; k++) {
            struct alone a;
            make(&a, shapes[i]);
            const vec3 d = {k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1};
            if (vec3_max_abs(d) > 0.0) assert_true(shape_support(&a.p, a.ref, d) == INFINITY);
        }
}

int main(void) {
    struct CMUnitTest tests[COUNT(bounds_rows) + 3];
    size_t n = 0;
    for (size_t i = 0; i < COUNT(bounds_rows); i++)
        tests[n++] = (struct CMUnitTest){bounds_rows[i].name, check_bounds, NULL, NULL, &bounds_rows[i]};
    tests[n++] =
        (struct CMUnitTest){"bounds follow object_from_world", check_bounds_of_hits, NULL, NULL, NULL};
    tests[n++] =
        (struct CMUnitTest){"bounds follow its scale", check_bounds_of_scaled_hits, NULL, NULL, NULL};
    tests[n++] = (struct CMUnitTest){"no end, along any direction", check_endless_support, NULL, NULL, NULL};
    return cmocka_run_group_tests_name("bounds", tests, NULL, NULL);
}
