/* Affine maps against long double arithmetic, and where the answer is exact. */
#include <float.h>

#include "base/affine.h"
#include "near.h"

static const vec3 X = {1, 0, 0}, Y = {0, 1, 0}, Z = {0, 0, 1};

static void assert_vec3_same(vec3 got, vec3 want) { assert_vec3_near(got, want, 0, "vector"); }

/* ---- Rotations by special angles ---- */

static struct turn {
    const char *name;
    vec3 axis;
    double angle_deg;
    vec3 from, to;
} turns[] = {
    {"no turn", {0, 0, 1}, 0, {1, 2, 3}, {1, 2, 3}},
    {"x by 90: y to z", {1, 0, 0}, 90, {0, 1, 0}, {0, 0, 1}},
    {"x by 90: z to -y", {1, 0, 0}, 90, {0, 0, 1}, {0, -1, 0}},
    {"y by 90: z to x", {0, 1, 0}, 90, {0, 0, 1}, {1, 0, 0}},
    {"z by 90: x to y", {0, 0, 1}, 90, {1, 0, 0}, {0, 1, 0}},
    {"z by -90", {0, 0, 1}, -90, {1, 0, 0}, {0, -1, 0}},
    {"z by 180", {0, 0, 1}, 180, {1, 2, 3}, {-1, -2, 3}},
    {"z by 270", {0, 0, 1}, 270, {1, 0, 0}, {0, -1, 0}},
    {"z by 360", {0, 0, 1}, 360, {1, 2, 3}, {1, 2, 3}},
    {"z by 36000090", {0, 0, 1}, 36000090, {1, 0, 0}, {0, 1, 0}},
    {"the axis need not be unit", {0, 0, 8}, 90, {1, 0, 0}, {0, 1, 0}},
    {"a negative axis turns back", {0, 0, -2}, 90, {1, 0, 0}, {0, -1, 0}},
    {"a huge axis", {1e300, 0, 0}, 90, {0, 1, 0}, {0, 0, 1}},
    {"a tiny axis", {0, 1e-300, 0}, 90, {0, 0, 1}, {1, 0, 0}},
};

static void check_turn(void **state) {
    const struct turn *row = *state;
    const affine map = affine_rotate(row->axis, row->angle_deg);
    assert_vec3_same(affine_direction(&map, row->from), row->to);
    assert_vec3_same(affine_point(&map, row->from), row->to);
}

static void thirty_degrees_have_an_exact_half(void **state) {
    (void)state;
    const affine by30 = affine_rotate(Z, 30), by60 = affine_rotate(X, -60);
    assert_true(affine_direction(&by30, X).y == 0.5);
    assert_true(affine_direction(&by60, Y).y == 0.5);
    assert_near(affine_direction(&by30, X).x, sqrt(0.75), 2e-16, "cos 30");
}

static void a_third_turn_about_the_diagonal_permutes_the_axes(void **state) {
    (void)state;
    const affine map = affine_rotate((vec3){1, 1, 1}, 120);
    assert_vec3_near(affine_direction(&map, X), Y, 1e-15, "x to y");
    assert_vec3_near(affine_direction(&map, Y), Z, 1e-15, "y to z");
    assert_vec3_near(affine_direction(&map, Z), X, 1e-15, "z to x");
}

/* v cos a + (n x v) sin a + n (n . v) (1 - cos a), in long double. */
static vec3 turn_long(vec3 axis, double angle_deg, vec3 v) {
    const long double length =
        sqrtl((long double)axis.x * axis.x + (long double)axis.y * axis.y + (long double)axis.z * axis.z);
    const long double n[3] = {axis.x / length, axis.y / length, axis.z / length}, p[3] = {v.x, v.y, v.z};
    const long double a = angle_deg * acosl(-1.0L) / 180.0L, c = cosl(a), s = sinl(a);
    const long double dot = n[0] * p[0] + n[1] * p[1] + n[2] * p[2];
    long double q[3];
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        q[i] = p[i] * c + (n[j] * p[k] - n[k] * p[j]) * s + n[i] * dot * (1 - c);
    }
    return (vec3){(double)q[0], (double)q[1], (double)q[2]};
}

static void random_rotations(void **state) {
    (void)state;
    struct random r = random_begin();
    for (int i = 0; i < 20000; i++) {
        const vec3 axis = vec3_scale(random_vec3(&r, -1, 1), exp2((double)random_below(&r, 200) - 100)),
                   v = random_vec3(&r, -1, 1);
        const double angle = random_between(&r, -720, 720);
        const affine map = affine_rotate(axis, angle);
        double factor = 0;
        assert_vec3_near(affine_direction(&map, v), turn_long(axis, angle, v), 2e-15, "rotated vector");
        assert_true(affine_is_similarity(map, &factor));
        assert_near(factor, 1, 3e-15, "factor");
    }
}

/* ---- Order, points, directions, normals ---- */

static affine random_affine(struct random *r) {
    affine map;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++) map.m[i][j] = random_between(r, -3, 3);
    return map;
}

static void compose_applies_the_second_argument_first(void **state) {
    (void)state;
    struct random r = random_begin();
    const affine move_then_scale =
        affine_compose(affine_scale(vec3_all(2)), affine_translate((vec3){1, 2, 3}));
    assert_vec3_same(affine_point(&move_then_scale, (vec3){0, 0, 0}), (vec3){2, 4, 6});
    for (int i = 0; i < 1000; i++) {
        const affine a = random_affine(&r), b = random_affine(&r), ab = affine_compose(a, b);
        const vec3 p = random_vec3(&r, -5, 5);
        assert_vec3_near(affine_point(&ab, p), affine_point(&a, affine_point(&b, p)), 1e-12, "point");
        assert_vec3_near(affine_direction(&ab, p), affine_direction(&a, affine_direction(&b, p)), 1e-12,
                         "direction");
    }
}

static void the_simplest_maps(void **state) {
    (void)state;
    const vec3 p = {1, 2, 4}, by = {8, 16, 32};
    const affine moved = affine_translate(by), scaled = affine_scale(by);
    assert_vec3_same(affine_point(&AFFINE_IDENTITY, p), p);
    assert_vec3_same(affine_point(&moved, p), vec3_add(p, by));
    assert_vec3_same(affine_direction(&moved, p), p);
    assert_vec3_same(affine_point(&scaled, p), vec3_mul(p, by));
}

static void columns_are_images_of_the_axes(void **state) {
    (void)state;
    const affine map = affine_columns((vec3){1, 2, 3}, (vec3){4, 5, 6}, (vec3){7, 8, 10}, (vec3){-1, -2, -3});
    assert_vec3_same(affine_direction(&map, Y), (vec3){4, 5, 6});
    assert_vec3_same(affine_point(&map, Z), (vec3){6, 6, 7});
    assert_vec3_same(affine_column(map, 3), (vec3){-1, -2, -3});
    const ray moved = affine_ray(&map, (ray){X, Z});
    assert_vec3_same(moved.org, (vec3){0, 0, 0});
    assert_vec3_same(moved.dir, (vec3){7, 8, 10});
}

/* A plane's normal stays across the plane, on the same side. */
static void normals_stay_across_their_planes(void **state) {
    (void)state;
    struct random r = random_begin();
    for (int i = 0; i < 1000; i++) {
        const affine map = random_affine(&r);
        affine inverse;
        if (!affine_invert(map, &inverse)) continue;
        const vec3 u = random_vec3(&r, -1, 1), v = random_vec3(&r, -1, 1), n = vec3_cross(u, v);
        const vec3 moved = vec3_normalize(affine_normal(&inverse, n));
        assert_near(vec3_dot(moved, vec3_normalize(affine_direction(&map, u))), 0, 1e-9, "across u");
        assert_near(vec3_dot(moved, vec3_normalize(affine_direction(&map, v))), 0, 1e-9, "across v");
        assert_true(vec3_dot(moved, affine_direction(&map, n)) > 0);
    }
}

static void magnitude_bounds_the_sum(void **state) {
    (void)state;
    const affine map = {{{1, -2, 3, -4}, {0, 0, 0, 5}, {-1, -1, -1, -1}}};
    assert_vec3_same(affine_magnitude(&map, (vec3){-1, 1, 2}), (vec3){13, 5, 5});
}

/* ---- Inverses ---- */

/* By Gauss and Jordan with pivots, in long double. False: singular. */
static bool invert_long(affine map, long double out[3][4]) {
    long double a[3][6];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 6; j++) a[i][j] = j < 3 ? map.m[i][j] : j - 3 == i;
    for (int c = 0; c < 3; c++) {
        int best = c;
        for (int i = c; i < 3; i++)
            if (fabsl(a[i][c]) > fabsl(a[best][c])) best = i;
        for (int j = 0; j < 6; j++) {
            const long double t = a[c][j];
            a[c][j] = a[best][j];
            a[best][j] = t;
        }
        if (a[c][c] == 0) return false;
        const long double pivot = a[c][c];
        for (int j = 0; j < 6; j++) a[c][j] /= pivot;
        for (int i = 0; i < 3; i++) {
            const long double f = a[i][c];
            for (int j = 0; j < 6 && i != c; j++) a[i][j] -= f * a[c][j];
        }
    }
    for (int i = 0; i < 3; i++) {
        out[i][3] = 0;
        for (int j = 0; j < 3; j++) {
            out[i][j] = a[i][j + 3];
            out[i][3] -= out[i][j] * map.m[j][3];
        }
    }
    return true;
}

/* How much an inverse magnifies errors, whatever the lengths of the columns are. */
static long double condition(affine map, long double inverse[3][4]) {
    long double most = 0;
    for (int k = 0; k < 3; k++) {
        long double column = 0, row = 0;
        for (int i = 0; i < 3; i++) {
            column = fmaxl(column, fabsl((long double)map.m[i][k]));
            row = fmaxl(row, fabsl(inverse[k][i]));
        }
        most = fmaxl(most, column * row);
    }
    return most;
}

static void random_inverses(void **state) {
    (void)state;
    struct random r = random_begin();
    int inverted = 0;
    for (int i = 0; i < 20000; i++) {
        affine map = random_affine(&r), inverse;
        const double size = exp2((double)random_below(&r, 200) - 100);
        for (int row = 0; row < 3; row++)
            for (int column = 0; column < 3; column++) map.m[row][column] *= size * exp2(10.0 * column);
        long double want[3][4];
        if (!affine_invert(map, &inverse) || !invert_long(map, want)) continue;
        inverted++;
        const double tolerance = 16 * DBL_EPSILON * (double)condition(map, want);
        for (int row = 0; row < 3; row++) {
            long double largest = 0;
            for (int c = 0; c < 3; c++) largest = fmaxl(largest, fabsl(want[row][c]));
            for (int c = 0; c < 4; c++) {
                const long double scale = c < 3 ? largest : largest * 9;
                assert_near((double)((inverse.m[row][c] - want[row][c]) / scale), 0, tolerance,
                            "entry of the inverse");
            }
        }
    }
    assert_true(inverted > 19900);
}

static struct singular {
    const char *name;
    affine map;
} singulars[] = {
    {"singular: flat", {{{1, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 1, 0}}}},
    {"singular: two equal columns", {{{1, 1, 0, 0}, {2, 2, 0, 0}, {3, 3, 1, 0}}}},
    {"singular: columns in a plane", {{{1, 4, 5, 0}, {2, 5, 7, 0}, {3, 6, 9, 0}}}},
    {"singular: zero", {{{0}}}},
    {"singular: NaN", {{{NAN, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}}},
    {"singular: NaN in the translation", {{{1, 0, 0, NAN}, {0, 1, 0, 0}, {0, 0, 1, 0}}}},
    {"singular: infinite", {{{1, 0, 0, 0}, {0, INFINITY, 0, 0}, {0, 0, 1, 0}}}},
    {"singular: too large", {{{1e101, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}}},
    {"singular: too small", {{{1e-101, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}}},
    {"singular: too far", {{{1, 0, 0, 1e101}, {0, 1, 0, 0}, {0, 0, 1, 0}}}},
};

static void check_singular(void **state) {
    const struct singular *row = *state;
    affine inverse = {{{7}}};
    assert_false(affine_invert(row->map, &inverse));
    assert_true(inverse.m[0][0] == 7);
}

static void extreme_sizes_have_inverses(void **state) {
    (void)state;
    const double sizes[] = {1e-99, 1e-50, 1e-10, 1, 1e10, 1e50, 1e99};
    for (size_t i = 0; i < COUNT(sizes); i++) {
        const affine map =
            affine_compose(affine_rotate((vec3){1, 2, 3}, 40), affine_scale((vec3){sizes[i], 1, -1}));
        affine inverse;
        assert_true(affine_invert(map, &inverse));
        const affine one = affine_compose(inverse, map);
        for (int c = 0; c < 3; c++) assert_near(one.m[c][c], 1, 1e-14, "diagonal of inverse times map");
    }
}

static void nearly_flat_is_not_flat(void **state) {
    (void)state;
    const double shears[] = {1e3, 1e6, 1e9, 1e11};
    for (size_t i = 0; i < COUNT(shears); i++) {
        affine map = AFFINE_IDENTITY, inverse;
        map.m[0][1] = shears[i];
        assert_true(affine_invert(map, &inverse));
        assert_near(inverse.m[0][1] / -shears[i], 1, 1e-4, "the shear back");
    }
}

/* Just within and just beyond what is said, and there itself: of sizes, of places, and of determinants. */
static void limits_are_where_they_are(void **state) {
    (void)state;
    affine inverse;
    for (int i = 0; i < 3; i++)
        for (int beyond = 0; beyond < 3; beyond++) {
            static const double factors[] = {0.99, 1, 1.01};
            const double more = factors[beyond], less = factors[2 - beyond];
            const double columns[] = {less * 1e-100, more * 1e100};
            for (int k = 0; k < 2; k++) {
                affine sized = AFFINE_IDENTITY;
                sized.m[i][i] = columns[k];
                assert_int_equal(affine_invert(sized, &inverse), !beyond);
            }
            for (int side = -1; side < 2; side += 2) {
                affine placed = AFFINE_IDENTITY, sheared = AFFINE_IDENTITY;
                placed.m[i][3] = side * more * 1e100;
                assert_int_equal(affine_invert(placed, &inverse), !beyond);
                sheared.m[i][(i + 1) % 3] = side * more * 1e12;
                assert_int_equal(affine_invert(sheared, &inverse), !beyond);
            }
        }
}

/* ---- Similarities ---- */

static struct similar {
    const char *name;
    double scale[3], shear;
    double factor; /* 0: none */
} similars[] = {
    {"similar: identity", {1, 1, 1}, 0, 1},
    {"similar: uniform", {2, 2, 2}, 0, 2},
    {"similar: mirrored", {-3, 3, 3}, 0, 3},
    {"similar: turned inside out", {-3, -3, -3}, 0, 3},
    {"similar: tiny", {1e-90, 1e-90, 1e-90}, 0, 1e-90},
    {"similar: huge", {1e90, 1e90, 1e90}, 0, 1e90},
    {"not similar: stretched", {1, 1, 1.0001}, 0, 0},
    {"not similar: stretched a little", {1, 1 + 1e-11, 1}, 0, 0},
    {"similar: to rounding", {1, 1 + 0.9e-12, 1}, 0.9e-12, 1},
    {"not similar: stretched no more than that", {1, 1, 1 - 1.1e-12}, 0, 0},
    {"not similar: sheared no more", {1, 1, 1}, 1.1e-12, 0},
    {"not similar: sheared", {1, 1, 1}, 1e-10, 0},
    {"not similar: null", {0, 0, 0}, 0, 0},
    {"not similar: NaN", {NAN, NAN, NAN}, 0, 0},
};

static void check_similar(void **state) {
    const struct similar *row = *state;
    affine map = affine_scale((vec3){row->scale[0], row->scale[1], row->scale[2]});
    map.m[0][1] = row->shear;
    map = affine_compose(affine_rotate((vec3){3, 1, 2}, 77),
                         affine_compose(affine_translate((vec3){5, 6, 7}), map));
    double factor = -1;
    assert_int_equal(affine_is_similarity(map, &factor), row->factor != 0);
    if (row->factor != 0)
        assert_near(factor / row->factor, 1, 1e-14, "factor");
    else
        assert_true(factor == -1);
}

/* At a size of 1e12 lengths may differ by 1, and a column may lean to another by 1: all of that is exact. */
static void similar_up_to_the_tolerance(void **state) {
    (void)state;
    static const double most[] = {-1.001, -1, 1, 1.001};
    for (size_t k = 0; k < COUNT(most); k++)
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) {
                affine map = affine_scale(vec3_all(1e12));
                double factor = 0;
                map.m[i][j] += most[k];
                if (i == 0 && j == 0) continue; /* the length that the others are compared with */
                assert_int_equal(affine_is_similarity(map, &factor), fabs(most[k]) == 1);
                assert_true(factor == (fabs(most[k]) == 1 ? 1e12 : 0));
            }
}

static void finite_means_all_twelve(void **state) {
    (void)state;
    assert_true(affine_is_finite(AFFINE_IDENTITY));
    for (int i = 0; i < 12; i++) {
        affine map = AFFINE_IDENTITY;
        map.m[i / 4][i % 4] = i & 1 ? NAN : -INFINITY;
        assert_false(affine_is_finite(map));
    }
}

int main(void) {
    struct CMUnitTest tests[COUNT(turns) + COUNT(singulars) + COUNT(similars)];
    size_t n = 0;
    for (size_t i = 0; i < COUNT(turns); i++)
        tests[n++] = (struct CMUnitTest){turns[i].name, check_turn, NULL, NULL, &turns[i]};
    for (size_t i = 0; i < COUNT(singulars); i++)
        tests[n++] = (struct CMUnitTest){singulars[i].name, check_singular, NULL, NULL, &singulars[i]};
    for (size_t i = 0; i < COUNT(similars); i++)
        tests[n++] = (struct CMUnitTest){similars[i].name, check_similar, NULL, NULL, &similars[i]};
    const struct CMUnitTest others[] = {
        cmocka_unit_test(thirty_degrees_have_an_exact_half),
        cmocka_unit_test(a_third_turn_about_the_diagonal_permutes_the_axes),
        cmocka_unit_test(random_rotations),
        cmocka_unit_test(compose_applies_the_second_argument_first),
        cmocka_unit_test(the_simplest_maps),
        cmocka_unit_test(columns_are_images_of_the_axes),
        cmocka_unit_test(normals_stay_across_their_planes),
        cmocka_unit_test(magnitude_bounds_the_sum),
        cmocka_unit_test(random_inverses),
        cmocka_unit_test(extreme_sizes_have_inverses),
        cmocka_unit_test(nearly_flat_is_not_flat),
        cmocka_unit_test(limits_are_where_they_are),
        cmocka_unit_test(similar_up_to_the_tolerance),
        cmocka_unit_test(finite_means_all_twelve),
    };
    return cmocka_run_group_tests_name("rows", tests, NULL, NULL) +
           cmocka_run_group_tests_name("affine", others, NULL, NULL);
}
