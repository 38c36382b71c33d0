/* An instance is no shape: what it places is met elsewhere. */
#include "near.h"
#include "shape/shape.h"

static void check_instance(void **state) {
    (void)state;
    struct instance placed = {AFFINE_IDENTITY, AFFINE_IDENTITY, NULL, 0};
    const struct primitives p = {.instances = &placed, .instance_count = 1};
    const primitive_ref ref = primitive_ref_make(PRIMITIVE_INSTANCE, 0);
    const ray r = {{0, 0, 3}, {0, 0, -2}};
    struct crossing c[SHAPE_MAX_CROSSINGS], first = {7, SHAPE_SIDE};
    assert_int_equal(shape_crossings(&p, ref, r, c), 0);
    assert_false(shape_first_crossing(&p, ref, r, -INFINITY, INFINITY, &first));
    assert_true(first.t == 7);
    assert_false(shape_is_solid(&p, ref));
    assert_false(shape_contains(&p, ref, (vec3){0, 0, 0}));
    assert_true(shape_support(&p, ref, (vec3){0, 1, 0}) == INFINITY);
    assert_memory_equal(&(box3[]){shape_bounds(&p, ref)}, &(box3[]){BOX3_ALL}, sizeof(box3));
    const struct surface at = shape_surface(&p, ref, r, (struct crossing){1, SHAPE_SIDE});
    assert_vec3_near(at.point, (vec3){0, 0, 1}, 0, "point");
    assert_vec3_near(at.normal, (vec3){0, 0, 1}, 0, "normal");
    assert_true(at.error == 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {{"an instance", check_instance, NULL, NULL, NULL}};
    return cmocka_run_group_tests_name("an instance as a shape", tests, NULL, NULL);
}
