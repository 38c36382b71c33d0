/* Which instances a point is within, and in which order. */
#include "instance_pair.h"
#include "render/media.h"

/* More bodies around the eye than are kept: those that end first stay, in whatever order they are found. */
static void too_many_media(void **state) {
    (void)state;
    struct pair *s = pair_begin();
    add_sphere(add_geometry(s, 9), (vec3){0, 0, 0}, 1, FIRST);
    for (int i = 0; i < 40; i++)
        add_instance(&s->instanced.primitives, 0, affine_scale(vec3_all(1 + (i * 7) % 40)), GLASS);
    pair_build(s);
    struct media_origin in;
    media_at(&s->instanced, s->accel, NULL, (ray){{0, 0, 0.5}, {0, 1, 1}}, &in);
    assert_int_equal(in.media.count, MEDIA_MAX);
    for (uint32_t i = 0; i < MEDIA_MAX; i++) {
        assert_int_equal(in.media.inside[i].which->depth, 1);
        assert_int_equal(in.media.inside[i].which->number[0] * 7 % 40, MEDIA_MAX - 1 - i);
    }
    pair_end(s);
}

/* Balls at one place, some within instances at one place within such: the first as they are written is the outermost, in
 * whatever order the trees have them. */
static void media_that_end_together(void **state) {
    (void)state;
    struct pair *s = pair_begin();
    struct primitives *one = add_geometry(s, 9), *two = add_geometry(s, 9), *top = &s->instanced.primitives;
    add_quadric(one, &forms[ELLIPSOID], AFFINE_IDENTITY, FIRST);
    add_sphere(one, (vec3){0, 0, 0}, 1, FIRST);
    add_quadric(two, &forms[ELLIPSOID], AFFINE_IDENTITY, FIRST);
    add_instance(two, 0, AFFINE_IDENTITY, FIRST);
    add_sphere(two, (vec3){0, 0, 0}, 1, FIRST);
    add_instance(two, 0, AFFINE_IDENTITY, FIRST);
    add_instance(top, 1, AFFINE_IDENTITY, GLASS);
    add_quadric(top, &forms[ELLIPSOID], AFFINE_IDENTITY, GLASS);
    add_instance(top, 1, AFFINE_IDENTITY, GLASS);
    add_sphere(top, (vec3){0, 0, 0}, 1, GLASS);
    pair_build(s);
    struct media_origin in;
    media_at(&s->instanced, s->accel, NULL, (ray){{0, 0, 0.5}, {0, 0, 2}}, &in);
    assert_int_equal(s->flat.primitives.count, 14);
    assert_int_equal(in.media.count, 14);
    for (int i = 0; i < 14; i++) assert_true(occurrence_equal(in.media.inside[i].which, &s->which[i]));
    pair_end(s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(too_many_media),
        cmocka_unit_test(media_that_end_together),
    };
    return cmocka_run_group_tests_name("media of instances", tests, NULL, NULL);
}
