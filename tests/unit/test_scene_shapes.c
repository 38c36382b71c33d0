/* Shapes by their parameters: where they stand, which form they have and how far it reaches. */
#include "loading.h"

/* ---- from and to in any direction ---- */

static struct revolution {
    const char *name;
    double z_from, z_to;
} revolutions[] = {{"cylinder", -0.5, 0.5}, {"cone", -1, 0}, {"paraboloid", 0, 1}, {"hyperboloid", -1, 1}};

/* The heights of the canonical form come to from and to, and its circles stay circles of the radius across. */
static void check_revolution(void **state) {
    const struct revolution *row = *state;
    struct random r = random_begin();
    for (int i = 0; i < 300; i++) {
        const vec3 from = random_vec3(&r, -5, 5),
                   to = i % 10 ? random_vec3(&r, -5, 5) : (vec3){from.x, from.y, from.z + (i % 20 ? 1 : -2)};
        const double radius = random_between(&r, 0.1, 3);
        char text[400];
        snprintf(text, sizeof text,
                 "scene: [{%s: {from: [%.17g, %.17g, %.17g], to: [%.17g, %.17g, %.17g], radius: %.17g}}]",
                 row->name, from.x, from.y, from.z, to.x, to.y, to.z, radius);
        struct loaded l;
        load_good(&l, text);
        const affine map = l.scene.primitives.quadrics[0].world_from_object;
        assert_vec3_near(affine_point(&map, (vec3){0, 0, row->z_from}), from, 1e-13, "from");
        assert_vec3_near(affine_point(&map, (vec3){0, 0, row->z_to}), to, 1e-13, "to");
        const vec3 x = affine_column(map, 0), y = affine_column(map, 1),
                   axis = vec3_normalize(vec3_sub(to, from));
        assert_near(vec3_length(x), radius, 1e-14 * radius, "radius along x");
        assert_near(vec3_length(y), radius, 1e-14 * radius, "radius along y");
        assert_near(vec3_dot(x, y), 0, 1e-14, "x across y");
        assert_near(vec3_dot(x, axis), 0, 1e-14, "x across the axis");
        assert_near(vec3_dot(y, axis), 0, 1e-14, "y across the axis");
        assert_true(vec3_dot(vec3_cross(x, y), axis) > 0);
        unload(&l);
    }
}

static void planes_and_discs_face_along_their_normal(void **state) {
    (void)state;
    const char *const forms[] = {"plane: {point: [1, 2, 3], normal: [%.17g, %.17g, %.17g]}",
                                 "disc: {center: [1, 2, 3], radius: 2, normal: [%.17g, %.17g, %.17g]}"};
    struct random r = random_begin();
    for (int i = 0; i < 400; i++) {
        const vec3 n = i == 0   ? (vec3){0, 0, -1}
                       : i == 2 ? (vec3){0, 1e-200, 0}
                                : vec3_scale(random_vec3(&r, -1, 1), 5);
        char shape[200], text[300];
        snprintf(shape, sizeof shape, forms[i % 2], n.x, n.y, n.z);
        snprintf(text, sizeof text, "scene: [{%s}]", shape);
        struct loaded l;
        load_good(&l, text);
        const struct flat *flat = &l.scene.primitives.flats[0];
        assert_vec3_near(vec3_normalize(affine_normal(&flat->object_from_world, (vec3){0, 0, 1})),
                         vec3_normalize(n), 1e-14, "normal");
        assert_vec3_near(affine_point(&flat->world_from_object, (vec3){0, 0, 0}), (vec3){1, 2, 3}, 0,
                         "point");
        assert_near(vec3_length(affine_column(flat->world_from_object, 0)), i % 2 ? 2 : 1, 1e-14, "size");
        unload(&l);
    }
}

/* ---- Forms ---- */

static void a_quadric_takes_its_coefficients(void **state) {
    (void)state;
    struct loaded l;
    load_good(&l, "scene: [{quadric: {xx: 1, yy: 2, zz: 3, xy: 4, yz: 5, xz: 6, x: 7, y: 8, z: 9, constant: "
                  "10, open: true},\n"
                  "         bounds: {min: [-1, -2, -3], max: [1, 2, 3]}}, {quadric: {z: 1}}]");
    const struct quadric_form *f = l.scene.primitives.quadrics[0].form,
                              *g = l.scene.primitives.quadrics[1].form;
    const double got[] = {f->xx, f->yy, f->zz, f->xy, f->yz, f->zx, f->x, f->y, f->z, f->constant};
    for (int i = 0; i < 10; i++) assert_true(8.0 * got[i] == i + 1);
    assert_true(f->open);
    assert_vec3_near(f->clip.min, (vec3){-1, -2, -3}, 0, "least corner");
    assert_vec3_near(f->extent.max, (vec3){1, 2, 3}, 0, "greatest corner");
    assert_false(g->open);
    assert_true(isinf(g->clip.min.x) && isinf(g->extent.max.z));
    unload(&l);
}

/* The box of what is left of each form, open or closed. */
static void forms_reach_as_far_as_they_do(void **state) {
    (void)state;
    static const struct {
        const char *shape;
        double across, bottom, top;
        bool may_open;
    } want[] = {{"sphere", 1, -1, 1, false},      {"box", 0.5, -0.5, 0.5, false},
                {"cylinder", 1, -0.5, 0.5, true}, {"cone", 1, -1, 0, true},
                {"paraboloid", 1, 0, 1, true},    {"hyperboloid", 1.4142135623730951, -1, 1, true}};
    for (size_t i = 0; i < COUNT(want); i++)
        for (int open = 0; open <= want[i].may_open; open++) {
            char text[200];
            struct loaded l;
            snprintf(text, sizeof text, "scene: [{%s: {%s}, transform: {scale: [1, 2, 1]}}]", want[i].shape,
                     open ? "open: true" : "");
            load_good(&l, text);
            const box3 extent = l.scene.primitives.quadrics[0].form->extent;
            const double a = want[i].across;
            assert_vec3_near(extent.min, (vec3){-a, -a, want[i].bottom}, 3e-16, want[i].shape);
            assert_vec3_near(extent.max, (vec3){a, a, want[i].top}, 3e-16, want[i].shape);
            unload(&l);
        }
}

/* Whichever is the largest, of whichever sign and size: it comes to 1.5, as the others do beside it. */
static void a_quadric_is_scaled_by_a_power_of_two(void **state) {
    (void)state;
    static const char *const keys[] = {"xx", "yy", "zz", "xy", "yz", "xz", "x", "y", "z", "constant"};
    static const double sizes[] = {0x1p-600, -0x1p-40, -1, 0x1p600};
    for (size_t k = 0; k < COUNT(keys); k++)
        for (size_t i = 0; i < COUNT(sizes); i++) {
            char text[200];
            struct loaded l;
            snprintf(text, sizeof text, "scene: [{quadric: {%s: %.17g, %s: %.17g}}]", keys[k], 1.5 * sizes[i],
                     keys[(k + 1) % COUNT(keys)], 0.25 * sizes[i]);
            load_good(&l, text);
            const struct quadric_form *f = l.scene.primitives.quadrics[0].form;
            const double got[] = {f->xx, f->yy, f->zz, f->xy, f->yz, f->zx, f->x, f->y, f->z, f->constant};
            assert_true(got[k] == copysign(1.5, sizes[i]));
            assert_true(got[(k + 1) % COUNT(keys)] == copysign(0.25, sizes[i]));
            unload(&l);
        }
}

int main(void) {
    struct CMUnitTest tests[COUNT(revolutions) + 4];
    size_t n = 0;
    for (size_t i = 0; i < COUNT(revolutions); i++)
        tests[n++] = (struct CMUnitTest){revolutions[i].name, check_revolution, NULL, NULL, &revolutions[i]};
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(planes_and_discs_face_along_their_normal);
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(a_quadric_takes_its_coefficients);
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(forms_reach_as_far_as_they_do);
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(a_quadric_is_scaled_by_a_power_of_two);
    return cmocka_run_group_tests_name("shapes of scenes", tests, NULL, NULL);
}
