/* Where a point is brought to, and how exact it is said to be: on its way to an apex, at one, and where all terms of the
 * form are known. */
#include "near.h"
#include "shape/patch.h"

/* 16 units in the last place of 1 are counted for each number that has a part. */
static const double unit = 16 * 0x1p-52;

static const struct quadric_form cone = {.xx = 1, .yy = 1, .zz = -1};

static struct surface surface_at(const struct quadric_form *form, double scale, vec3 reach, vec3 point) {
    const struct patch patch = {.form = form};
    const affine object_from_world = affine_scale(vec3_all(scale));
    return patch_surface(&patch, &object_from_world, reach, (ray){point, {1, 2, 3}}, 0);
}

/* ---- To the surface ---- */

/* However close to the apex, from either side and in a space of any scale: a step divides the value by 4 at least. */
static void check_steps(void **state) {
    (void)state;
    struct random r = random_begin();
    for (int i = 0; i < 20000; i++) {
        const double scale = pow(2, random_below(&r, 9) - 4.0);
        const vec3 from = vec3_scale(random_vec3(&r, -1, 1), pow(10, random_between(&r, -9, 0)));
        const vec3 at = surface_at(&cone, scale, (vec3){1, 1, 1}, from).point;
        const double before = form_value(&cone, from), after = form_value(&cone, at);
        const double rounding = 1e-14 * vec3_dot(from, from);
        if (!(fabs(after) <= fabs(before) / 16 + rounding))
            fail_msg("value %g after %g, from (%g, %g, %g)", after, before, from.x, from.y, from.z);
    }
}

/* On the axes about it no step is known to lead there: the point stays. */
static void check_no_steps(void **state) {
    (void)state;
    for (int i = 0; i < 18; i++) {
        const double size = i < 6 ? 1 : i < 12 ? 0x1p-30 : 0x1p-300, out = i & 1 ? size : -size;
        const vec3 from = {i / 2 % 3 == 0 ? out : 0, i / 2 % 3 == 1 ? out : 0, i / 2 % 3 == 2 ? out : 0};
        const struct surface at = surface_at(&cone, 1, (vec3){1, 1, 1}, from);
        assert_vec3_near(at.point, from, 0, "point");
        assert_near(fabs(vec3_dot(at.normal, from)), size, 1e-15 * size, "along the normal");
    }
}

/* ---- Errors ---- */

/* At an apex nothing but the square of what the map rounds: the error is twice that. */
static void check_apex(void **state) {
    (void)state;
    const vec3 reach = {2, 3, 6};
    for (double scale = 0x1p-4; scale <= 16; scale *= 2)
        assert_near(surface_at(&cone, scale, reach, (vec3){0, 0, 0}).error, 2 * unit * 7, 1e-6 * unit,
                    "error");
}

/* The apex of a cone elsewhere: twice the root of the rounding of all terms, divided by the second derivative. */
static void check_apex_elsewhere(void **state) {
    (void)state;
    static const struct {
        struct quadric_form form;
        double terms, bend;
    } rows[] = {
        {{.xx = 1, .yy = 1, .zz = -1, .z = 2, .constant = -1}, 1 + 2 + 1, 2},
        {{.xx = 1, .yy = -2, .zz = 1, .z = -2, .constant = 1}, 2 + 2 + 1, 4}, /* the largest for each */
        {{.xx = 3, .yy = 1, .zz = -1, .z = 2, .constant = -1}, 3 + 2 + 1, 6},
        {{.xy = 1, .zz = -1, .z = 2, .constant = -1}, 1 + 1 + 2 + 1, 2 * (1 + 1)},
        {{.yz = 1, .y = -1, .xx = 1}, 1 + 1 + 1, 2 * (1 + 1)},
        {{.zx = 1, .x = -1, .yy = -1}, 1 + 1 + 1, 2 * (1 + 1)},
    };
    for (size_t i = 0; i < COUNT(rows); i++) {
        const struct surface at = surface_at(&rows[i].form, 1, (vec3){0, 0, 0}, (vec3){0, 0, 1});
        assert_vec3_near(at.point, (vec3){0, 0, 1}, 0, "point");
        const double want = 2 * sqrt(unit * rows[i].terms / rows[i].bend);
        assert_near(at.error, want, 1e-6 * want, "error");
    }
}

static vec3 along(int axis, double x) {
    return (vec3){axis == 0 ? x : 0, axis == 1 ? x : 0, axis == 2 ? x : 0};
}

/* A form of one variable, far from where its slope is 0: the error is that of its terms, and of what the map rounds where
 * the ray ends, divided by the slope. */
static void check_terms(void **state) {
    (void)state;
    struct random r = random_begin();
    for (int i = 0; i < 3000; i++) {
        const int axis = i % 3;
        const double x = random_between(&r, 0.5, 5) * (random_below(&r, 2) ? 1 : -1);
        const double a = random_below(&r, 3) - 1.0, b = random_below(&r, 7) - 3.0, slope = 2 * a * x + b;
        if (fabs(slope) < 0.1) continue;
        struct quadric_form form = {.constant = -(a * x + b) * x};
        *(axis == 0 ? &form.xx : axis == 1 ? &form.yy : &form.zz) = a;
        *(axis == 0 ? &form.x : axis == 1 ? &form.y : &form.z) = b;
        const double width = random_below(&r, 2) ? random_between(&r, 0, 9) : 0;
        const struct surface at = surface_at(&form, 1, along(axis, width), along(axis, x));
        const double terms = fabs(a * x * x) + fabs(b * x) + fabs(form.constant);
        const double want = unit * (fabs(x) + width + terms / fabs(slope));
        assert_vec3_near(at.normal, along(axis, slope > 0 ? 1 : -1), 1e-15, "normal");
        assert_near(at.error, want, 1e-9 * want, "error");
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(check_steps), cmocka_unit_test(check_no_steps),
        cmocka_unit_test(check_apex),  cmocka_unit_test(check_apex_elsewhere),
        cmocka_unit_test(check_terms),
    };
    return cmocka_run_group_tests_name("patch", tests, NULL, NULL);
}
