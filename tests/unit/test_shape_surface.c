/* Points and normals of surfaces, where they are known in closed form. */
#include "near.h"
#include "shape_named.h"

#define R2  0.70710678118654752
#define R15 0.83205029433784372 /* 1.5 : 1, at length one */
#define R04 0.55470019622522915

/* The surface at the first crossing in front of the ray. */
static struct surface_row {
    const char *name;
    int shape;
    ray r;
    vec3 point, normal;
} surface_rows[] = {
    {"sphere", BALL_2, {{1, 2, -9}, {0, 0, 1}}, {1, 2, 1}, {0, 0, -1}},
    {"sphere from inside", BALL_2, {{1, 2, 3}, {0, 3, 0}}, {1, 4, 3}, {0, 1, 0}},
    {"square from above", SQUARE, {{0.25, 0, 3}, {0, 0, -1}}, {0.25, 0, 0}, {0, 0, 1}},
    {"square from below", SQUARE, {{0.25, 0, -3}, {0, 0, 1}}, {0.25, 0, 0}, {0, 0, 1}},
    {"square turned, its +z", SLANTED, {{0.25, 3, 0}, {0, -1, 0}}, {0.25, 0, 0}, {0, -1, 0}},
    {"ellipsoid at its long end", STRETCHED, {{0, 0, -9}, {0, 0, 1}}, {0, 0, -3}, {0, 0, -1}},
    {"ellipsoid, by the inverse transpose",
     STRETCHED,
     {{0.6, 9, 0}, {0, -1, 0}},
     {0.6, 1.6, 0},
     {R15, R04, 0}},
    {"cylinder, its side", CYLINDER, {{0.6, 9, 0.25}, {0, -1, 0}}, {0.6, 0.8, 0.25}, {0.6, 0.8, 0}},
    {"cylinder, upper cap", CYLINDER, {{0.5, 0, 9}, {0, 0, -1}}, {0.5, 0, 0.5}, {0, 0, 1}},
    {"cylinder, lower cap", CYLINDER, {{0.5, 0, -9}, {0, 0, 1}}, {0.5, 0, -0.5}, {0, 0, -1}},
    {"cone, its normal has a z", CONE, {{9, 0, -0.5}, {-1, 0, 0}}, {0.5, 0, -0.5}, {R2, 0, R2}},
    {"cone, its base", CONE, {{0.5, 0, -9}, {0, 0, 1}}, {0.5, 0, -1}, {0, 0, -1}},
    {"cone, its apex from above", CONE, {{0, 0, 9}, {0, 0, -1}}, {0, 0, 0}, {0, 0, 1}},
    {"cone mirrored", MIRRORED, {{9, 0, 0.5}, {-1, 0, 0}}, {0.5, 0, 0.5}, {R2, 0, -R2}},
    {"paraboloid", PARABOLOID, {{0.5, 0, -9}, {0, 0, 1}}, {0.5, 0, 0.25}, {R2, 0, -R2}},
    {"box, -x", CUBE, {{-9, 0.1, 0.2}, {1, 0, 0}}, {-0.5, 0.1, 0.2}, {-1, 0, 0}},
    {"box, +y", CUBE, {{0.1, 9, 0.2}, {0, -1, 0}}, {0.1, 0.5, 0.2}, {0, 1, 0}},
    {"hyperboloid", HYPERBOLOID, {{9, 0, 0}, {-1, 0, 0}}, {1, 0, 0}, {1, 0, 0}},
    {"tube from inside, still outwards", TUBE, {{0, 0, 0}, {0, 1, 0}}, {0, 1, 0}, {0, 1, 0}},
};

static void check_surface(void **state) {
    const struct surface_row *row = *state;
    struct alone a;
    make(&a, row->shape);
    struct crossing crossing;
    assert_true(shape_first_crossing(&a.p, a.ref, row->r, 0, INFINITY, &crossing));
    const struct surface got = shape_surface(&a.p, a.ref, row->r, crossing);
    assert_vec3_near(got.point, row->point, 1e-15, "point");
    assert_vec3_near(got.normal, row->normal, 1e-15, "normal");
    assert_true(got.error >= 0 && got.error <= 1e-13);
}

/* On the apex itself, where there is no normal, any will do that is one. */
static void check_apex(void **state) {
    (void)state;
    const ray rays[] = {
        {{-3, 0, -1e-9}, {1, 0, 0}}, {{-9, 3, -1e-300}, {3, -1, 0}}, {{1, 2, 3}, {-1, -2, -3}}};
    struct alone a;
    make(&a, CONE);
    for (size_t i = 0; i < COUNT(rays); i++) {
        struct crossing crossing = {i == 2 ? 1 : 3, SHAPE_SIDE};
        const struct surface got = shape_surface(&a.p, a.ref, rays[i], crossing);
        assert_near(vec3_length(got.normal), 1, 1e-15, "length of the normal");
        assert_vec3_near(got.point, (vec3){0, 0, 0}, 2e-9, "point");
        assert_true(got.error > 0 && got.error < 1e-7);
        if (i == 2)
            assert_true(vec3_dot(got.normal, rays[i].dir) < 0); /* at the apex itself it faces the ray */
    }
}

/* Of a sphere so small that the ray meets its centre there is no normal either. */
static void check_small_sphere(void **state) {
    (void)state;
    struct alone a;
    alone_sphere(&a, (vec3){1e6, 0, 0}, 1e-15);
    const ray r = {{1e6 - 3, 0, 0}, {2, 0, 0}};
    const struct surface got = shape_surface(&a.p, a.ref, r, (struct crossing){1.5, SHAPE_SIDE});
    assert_vec3_near(got.normal, (vec3){-1, 0, 0}, 0, "normal");
    assert_vec3_near(got.point, (vec3){1e6, 0, 0}, 0, "point");
    assert_near(got.error, 16 * 0x1p-52 * 1e6, 1e-15, "error");
}

int main(void) {
    struct CMUnitTest tests[COUNT(surface_rows) + 2];
    size_t n = 0;
    for (size_t i = 0; i < COUNT(surface_rows); i++)
        tests[n++] = (struct CMUnitTest){surface_rows[i].name, check_surface, NULL, NULL, &surface_rows[i]};
    tests[n++] = (struct CMUnitTest){"the apex of a cone has a normal", check_apex, NULL, NULL, NULL};
    tests[n++] = (struct CMUnitTest){"a sphere like a point", check_small_sphere, NULL, NULL, NULL};
    return cmocka_run_group_tests_name("surfaces", tests, NULL, NULL);
}
