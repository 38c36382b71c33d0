/* Which shapes are solid, and what is inside of them. */
#include "near.h"
#include "shape_named.h"

static struct contains_row {
    const char *name;
    int shape;
    vec3 point;
    bool solid, inside;
} contains_rows[] = {
    {"sphere", SPHERE, {0.5, 0.5, 0.5}, true, true},
    {"on a sphere", SPHERE, {1, 0, 0}, true, false},
    {"outside a sphere", BALL_2, {0, 0, 0}, true, false},
    {"square", SQUARE, {0, 0, 0}, false, false},
    {"plane", PLANE, {0, 0, -1}, false, false},
    {"cylinder", CYLINDER, {0.9, 0, 0.4}, true, true},
    {"on a cylinder", CYLINDER, {0, 1, 0}, true, false},
    {"on its cap", CYLINDER, {0, 0, 0.5}, true, false},
    {"above its cap", CYLINDER, {0, 0, 0.6}, true, false},
    {"cone", CONE, {0.4, 0, -0.5}, true, true},
    {"the cone's other nappe", CONE, {0.4, 0, 0.5}, true, false},
    {"box", CUBE, {0.49, -0.49, 0.49}, true, true},
    {"beside a box", CUBE, {0.51, 0, 0}, true, false},
    {"stretched", STRETCHED, {0, 0, 2.9}, true, true},
    {"tube", TUBE, {0, 0, 0}, false, false},
    {"NaN", CYLINDER, {NAN, 0, 0}, true, false},
};

static void check_contains(void **state) {
    const struct contains_row *row = *state;
    struct alone a;
    make(&a, row->shape);
    assert_int_equal(shape_is_solid(&a.p, a.ref), row->solid);
    assert_int_equal(shape_contains(&a.p, a.ref, row->point), row->inside);
}

int main(void) {
    struct CMUnitTest tests[COUNT(contains_rows)];
    size_t n = 0;
    for (size_t i = 0; i < COUNT(contains_rows); i++)
        tests[n++] =
            (struct CMUnitTest){contains_rows[i].name, check_contains, NULL, NULL, &contains_rows[i]};
    return cmocka_run_group_tests_name("inside of shapes", tests, NULL, NULL);
}
