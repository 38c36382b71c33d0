/* Three doubles, by numbers that have exact answers. */
#include "near.h"

static const vec3 a = {1, 2, 4}, b = {8, -16, 32};

static void assert_same(vec3 got, double x, double y, double z) {
    assert_vec3_near(got, (vec3){x, y, z}, 0, "vector");
}

static void each_component_has_its_own(void **state) {
    (void)state;
    assert_same(vec3_add(a, b), 9, -14, 36);
    assert_same(vec3_sub(a, b), -7, 18, -28);
    assert_same(vec3_mul(a, b), 8, -32, 128);
    assert_same(vec3_scale(a, 3), 3, 6, 12);
    assert_same(vec3_madd(a, 0.5, b), 5, -6, 20);
    assert_same(vec3_neg(a), -1, -2, -4);
    assert_same(vec3_all(7), 7, 7, 7);
    assert_same(vec3_abs(b), 8, 16, 32);
    assert_same(vec3_abs((vec3){-8, 16, -32}), 8, 16, 32);
}

static void products(void **state) {
    (void)state;
    assert_true(vec3_dot(a, b) == 8 - 32 + 128);
    assert_same(vec3_cross(a, b), 2 * 32 + 4 * 16, 4 * 8 - 1 * 32, 1 * -16 - 2 * 8);
    assert_same(vec3_cross(b, a), -128, 0, 32);
}

static void the_largest_magnitude_is_found_anywhere(void **state) {
    (void)state;
    assert_true(vec3_max_abs((vec3){-3, 2, 1}) == 3);
    assert_true(vec3_max_abs((vec3){1, -3, 2}) == 3);
    assert_true(vec3_max_abs((vec3){2, 1, -3}) == 3);
    assert_true(vec3_max_abs((vec3){1, 2, 3}) == 3);
    assert_true(vec3_max_abs((vec3){0, 0, 0}) == 0);
}

static void plain_are_squares_with_all_their_digits(void **state) {
    (void)state;
    assert_true(vec3_is_plain(1) && vec3_is_plain(1.1e-280) && vec3_is_plain(0.9e280));
    assert_false(vec3_is_plain(0) || vec3_is_plain(1e-280) || vec3_is_plain(1e280) || vec3_is_plain(NAN));
}

/* (3, 4, 12) has length 13, in any order and of any size. */
static void lengths(void **state) {
    (void)state;
    const double sizes[] = {1, 1e-300, 1e-200, 1e-120, 1e120, 1e200, 1e300};
    for (size_t i = 0; i < COUNT(sizes); i++) {
        const double s = sizes[i];
        const vec3 turns[] = {
            {3 * s, 4 * s, 12 * s}, {12 * s, 3 * s, 4 * s}, {-4 * s, 12 * s, -3 * s}, {0, -5 * s, 12 * s}};
        for (size_t k = 0; k < COUNT(turns); k++) {
            const vec3 unit = vec3_normalize(turns[k]);
            assert_near(vec3_length(turns[k]) / s, 13, 1e-14, "length");
            assert_vec3_near(vec3_scale(unit, 13), vec3_scale(turns[k], 1 / s), 1e-14, "unit");
        }
    }
    assert_true(vec3_length((vec3){0, 0, 0}) == 0);
    assert_same(vec3_normalize((vec3){0, 0, 0}), 0, 0, 0);
    assert_true(vec3_length((vec3){0, 0, 5e-324}) == 5e-324);
}

static void finite_means_all_three(void **state) {
    (void)state;
    assert_true(vec3_is_finite(a));
    assert_false(vec3_is_finite((vec3){NAN, 0, 0}));
    assert_false(vec3_is_finite((vec3){0, INFINITY, 0}));
    assert_false(vec3_is_finite((vec3){0, 0, -INFINITY}));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_component_has_its_own),
        cmocka_unit_test(products),
        cmocka_unit_test(the_largest_magnitude_is_found_anywhere),
        cmocka_unit_test(plain_are_squares_with_all_their_digits),
        cmocka_unit_test(lengths),
        cmocka_unit_test(finite_means_all_three),
    };
    return cmocka_run_group_tests_name("vec3", tests, NULL, NULL);
}
