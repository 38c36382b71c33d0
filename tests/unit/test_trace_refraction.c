/* What is seen through glass and water. */
#include <math.h>

#include "probe.h"

/* ---- A glowing wall, seen straight through ---- */

static struct probe bodies[] = {
    {"a body of index 1 is not seen",
     DOWN_Z GLOW_LIGHT "scene:\n  - {sphere: {}, material: {diffuse: black, refraction: 1, index: 1}}\n" WALL(
         "[0, 0, -3]", 0.2, 0.4, 0.6),
     {0.2, 0.4, 0.6},
     0},
    {"each surface takes its part",
     DOWN_Z GLOW_LIGHT
     "scene:\n  - {sphere: {}, material: {diffuse: black, refraction: 0.5, index: 1.5}}\n" WALL(
         "[0, 0, -3]", 0.2, 0.4, 0.6),
     {0.05, 0.1, 0.15},
     0},
    {"a camera inside of glass",
     DARK "camera: {eye: [0, 0, 0], direction: [0, 0, -1]}\n" GLOW_LIGHT
          "scene:\n  - {sphere: {}, material: {diffuse: black, refraction: 0.5, index: 1.5}}\n" WALL(
              "[0, 0, -3]", 0.2, 0.4, 0.6),
     {0.1, 0.2, 0.3},
     0},
};

/* ---- Refraction against Snell's law ----
 * A wall whose colour is seen through a body tells where the refracted ray arrived: half of the wall
 * is white, and bisection finds where its edge must stand to be hit. */

static const double pi = 3.14159265358979323846;

/* Whether the ray from the camera arrives left of `edge` on the wall z = -10 (glowing squares). */
static bool arrives_left(const char *camera, const char *body, double edge) {
    char text[2000];
    snprintf(text, sizeof text,
             DARK
             "%s" GLOW_LIGHT
             "scene:\n%s  - square: {center: [%.17g, 0, -10], size: 100}\n    material: " GLOW(1, 1, 1) "\n",
             camera, body, edge - 50.0);
    double color[3];
    render_probe(text, color);
    return color[0] > 0.5;
}

static double arrival(const char *camera, const char *body) {
    double low = -40, high = 40;
    while (high - low > 1e-9) {
        const double middle = 0.5 * (low + high);
        if (arrives_left(camera, body, middle))
            high = middle;
        else
            low = middle;
    }
    return 0.5 * (low + high);
}

static const char slanted[] =
    "camera: {eye: [-5, 0, 5], direction: [1, 0, -1]}\n"; /* 45 degrees, through the origin */

static void check_arrival(const char *body, double want) {
    const double got = arrival(slanted, body);
    if (!(fabs(got - want) < 1e-6)) fail_msg("arrives at x = %.9f, want %.9f", got, want);
}

/* Through a slab of thickness d the ray goes on parallel to itself, moved by d (tan(out) - tan(in)). */
static void test_slab(void **state) {
    (void)state;
    const double inside = asin(sin(pi / 4) / 1.5);
    check_arrival("  - {box: {min: [-50, -50, -1], max: [50, 50, 0]}, material: {diffuse: black, refraction: "
                  "1, index: 1.5}}\n",
                  1.0 * tan(inside) + 9.0);
}

static void test_water_surface(void **state) {
    (void)state;
    const double inside = asin(sin(pi / 4) / 1.33);
    check_arrival("  - {plane: {}, material: {diffuse: black, refraction: 1, index: 1.33}}\n",
                  10.0 * tan(inside));
}

static void test_slab_in_water(void **state) {
    (void)state;
    const double water = asin(sin(pi / 4) / 1.33), glass = asin(sin(pi / 4) / 1.5);
    check_arrival("  - {plane: {}, material: {diffuse: black, refraction: 1, index: 1.33}}\n"
                  "  - {box: {min: [-50, -50, -3], max: [50, 50, -1]}, material: {diffuse: black, "
                  "refraction: 1, index: 1.5}}\n",
                  8.0 * tan(water) + 2.0 * tan(glass));
}

/* Where two bodies overlap the one entered last counts, also as the other is left. */
static void test_overlapping_slabs(void **state) {
    (void)state;
    const double water = asin(sin(pi / 4) / 1.33), glass = asin(sin(pi / 4) / 1.5);
    check_arrival("  - {box: {min: [-50, -50, -2], max: [50, 50, 0]}, material: {diffuse: black, "
                  "refraction: 1, index: 1.33}}\n"
                  "  - {box: {min: [-60, -60, -4], max: [60, 60, -1]}, material: {diffuse: black, "
                  "refraction: 1, index: 1.5}}\n",
                  1.0 * tan(water) + 3.0 * tan(glass) + 6.0);
}

static void test_same_index_inside(void **state) {
    (void)state;
    const double water = asin(sin(pi / 4) / 1.33);
    check_arrival(
        "  - {plane: {}, material: {diffuse: black, refraction: 1, index: 1.33}}\n"
        "  - {sphere: {center: [1, 0, -2]}, material: {diffuse: black, refraction: 1, index: 1.33}}\n",
        10.0 * tan(water));
}

static void test_mirrored_body(void **state) {
    (void)state;
    const double inside = asin(sin(pi / 4) / 1.5);
    check_arrival("  - {box: {min: [-50, -50, 0], max: [50, 50, 1]}, transform: {scale: [1, 1, -1]}, "
                  "material: {diffuse: black, refraction: 1, index: 1.5}}\n",
                  1.0 * tan(inside) + 9.0);
}

/* The camera in the glass of a slab from z = 0 down to z = -1, half a unit above its lower face. */
static void test_camera_in_nested_glass(void **state) {
    (void)state;
    const double out = asin(1.5 * sin(atan(0.5)));
    const double got = arrival("camera: {eye: [0, 0, -0.5], direction: [1, 0, -2]}\n",
                               "  - {box: {min: [-50, -50, -1], max: [50, 50, 0]}, material: {diffuse: "
                               "black, refraction: 1, index: 1.5}}\n"
                               "  - {box: {min: [-60, -60, -1.5], max: [60, 60, 1]}, material: {diffuse: "
                               "black, refraction: 1, index: 1}}\n");
    const double want = 0.25 + 9.0 * tan(out);
    if (!(fabs(got - want) < 1e-6)) fail_msg("arrives at x = %.9f, want %.9f", got, want);
}

/* At the critical angle itself light leaves along the surface: the sine is 4/5 at an index of 5/4, exactly. */
static void test_critical_angle(void **state) {
    (void)state;
    double color[3];
    render_probe("image: {size: [1, 1], samples: 1, background: [0, 0, 1]}\n"
                 "camera: {eye: [0, 0, -1], direction: [0.8, 0, 0.6]}\n" GLOW_LIGHT
                 "scene:\n  - {plane: {}, material: {diffuse: black, refraction: 0.75, index: 1.25}}\n" WALL(
                     "[0, 0, -9]", 1, 0, 0),
                 color);
    assert_true(fabs(color[0]) < 1e-6 && fabs(color[2] - 0.75) < 1e-6);
}

/* From water, light beyond the critical angle asin(1/1.33) = 48.75 degrees is mirrored whole. */
static void test_total_reflection(void **state) {
    (void)state;
    for (int deg = 40; deg <= 60; deg += 1) {
        char text[1000];
        snprintf(text, sizeof text,
                 "image: {size: [1, 1], samples: 1, background: [0, 0, 1]}\n"
                 "camera: {eye: [0, 0, -1], direction: [%.17g, 0, %.17g]}\n" GLOW_LIGHT
                 "scene:\n  - {plane: {}, material: {diffuse: black, refraction: 0.75, index: 1.33}}\n" WALL(
                     "[0, 0, -9]", 1, 0, 0),
                 sin(deg * pi / 180), cos(deg * pi / 180));
        double color[3];
        render_probe(text, color);
        const bool total = deg > 48;
        assert_true(fabs(color[0] - (total ? 0.75 : 0.0)) < 1e-6);
        assert_true(fabs(color[2] - (total ? 0.0 : 0.75)) < 1e-6);
    }
}

int main(void) {
    struct CMUnitTest tests[COUNT(bodies) + 9];
    size_t n = 0;
    for (size_t i = 0; i < COUNT(bodies); i++)
        tests[n++] = (struct CMUnitTest){bodies[i].name, check_probe, NULL, NULL, &bodies[i]};
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(test_slab);
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(test_water_surface);
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(test_slab_in_water);
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(test_overlapping_slabs);
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(test_same_index_inside);
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(test_mirrored_body);
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(test_camera_in_nested_glass);
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(test_critical_angle);
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(test_total_reflection);
    return cmocka_run_group_tests_name("refraction", tests, NULL, NULL);
}
