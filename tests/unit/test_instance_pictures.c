/* Pictures of instances: the same as of the scene with every instance carried out. */
#include <string.h>

#include "instance_pair.h"
#include "render/media.h"
#include "render/render.h"

static struct monge_film *render(const struct scene *scene, const struct accel *accel, unsigned threads) {
    const struct monge_job job = {.threads = threads};
    struct monge_stats stats;
    struct monge_film *film = film_new(
        &scene->settings, (struct monge_region){0, 0, scene->settings.width, scene->settings.height});
    assert_non_null(film);
    assert_true(render_film(scene, accel, &job, film, &stats, NULL));
    return film;
}

/* All settings of the two but the primitives are the same. Returns how often the colour changes in a row. */
static size_t assert_same_picture(struct pair *s, size_t allowed) {
    const struct monge_settings settings = s->instanced.settings;
    struct primitives own = s->flat.primitives;
    s->flat = s->instanced;
    s->flat.primitives = own;
    struct monge_film *one = render(&s->instanced, s->accel, 2), *two = render(&s->flat, s->flat_accel, 2);
    size_t different = 0, colors = 0;
    for (size_t i = 0; i < (size_t)settings.width * settings.height; i++) {
        bool same = true;
        for (size_t c = 0; c < 3; c++)
            same &= fabs((double)one->rgb[3 * i + c] - (double)two->rgb[3 * i + c]) < 1e-4;
        different += !same;
        colors += i > 0 && memcmp(&one->rgb[3 * i], &one->rgb[3 * i - 3], 3 * sizeof(float)) != 0;
    }
    monge_film_free(one);
    monge_film_free(two);
    if (different > allowed) fail_msg("%zu pixels differ", different);
    return colors;
}

static void the_same_pictures(void **state) {
    (void)state;
    struct random r = random_begin();
    size_t colors = 0;
    for (int round = 0; round < 6; round++) {
        struct pair *s = random_pair(&r, round == 5 ? 1e-5 : 1.0);
        if (round % 2) s->instanced.camera.projection = CAMERA_ORTHOGRAPHIC;
        colors += assert_same_picture(s, 6);
        pair_end(s);
    }
    assert_true(colors > 5000);
}

/* Balls of glass and water that overlap, in each other, and the camera in both; by instances of one ball. */
static struct pair *glass_pair(bool orthographic) {
    struct pair *s = pair_begin();
    add_sphere(add_geometry(s, 9), (vec3){0, 0, 0}, 1, FIRST);
    struct primitives *two = add_geometry(s, 9), *top = &s->instanced.primitives;
    add_instance(two, 0, affine_scale(vec3_all(3)), WATER);
    add_instance(
        two, 0, affine_compose(affine_translate((vec3){0.3, 0, 0}), affine_scale((vec3){1, 1.4, -1})), FIRST);
    add_instance(two, 0,
                 affine_compose(affine_translate((vec3){0.9, 0.2, -0.4}), affine_scale((vec3){1, 0.6, 1})),
                 WATER);
    add_instance(top, 1, AFFINE_IDENTITY, GLASS);
    add_instance(top, 1,
                 affine_compose(affine_translate((vec3){-4, 0, -5}), affine_rotate((vec3){0, 1, 0}, 40)),
                 GLASS);
    add_instance(top, 0, affine_translate((vec3){4, 0, -7}), CLAY);
    add_instance(top, 0, affine_translate((vec3){2, 3, -9}), MIRROR);
    add_flat(top, FLAT_PLANE,
             affine_compose(affine_translate((vec3){0, -3.5, 0}), affine_rotate((vec3){1, 0, 0}, -90)), CLAY);
    s->instanced.camera =
        (struct camera){.projection = orthographic ? CAMERA_ORTHOGRAPHIC : CAMERA_PERSPECTIVE,
                        .has_eye = true,
                        .has_direction = true,
                        .has_height = orthographic,
                        .height = 5,
                        .eye = {0.4, 0.1, 0.2},
                        .direction = {-0.1, 0, -1},
                        .up = {0, 1, 0},
                        .fov_deg = 60};
    pair_build(s);
    return s;
}

static void a_camera_in_glass(void **state) {
    (void)state;
    for (int orthographic = 0; orthographic < 2; orthographic++) {
        struct pair *s = glass_pair(orthographic);
        struct media_origin in, flat_in;
        const ray r = {s->instanced.camera.eye, s->instanced.camera.direction};
        media_at(&s->instanced, s->accel, NULL, r, &in);
        media_at(&s->flat, s->flat_accel, NULL, r, &flat_in);
        assert_int_equal(in.media.count, 3); /* the large ball, of water, and both small ones */
        assert_int_equal(flat_in.media.count, 3);
        for (int i = 0; i < in.media.count; i++) {
            assert_true(occurrence_equal(in.media.inside[i].which,
                                         &s->which[flat_in.media.inside[i].which->number[0]]));
            assert_true(in.media.inside[i].index == flat_in.media.inside[i].index);
        }
        assert_true(assert_same_picture(s, 6) > 3000);
        pair_end(s);
    }
}

static void threads_change_nothing(void **state) {
    (void)state;
    struct random r = random_begin();
    struct pair *s = random_pair(&r, 1.0);
    const unsigned counts[] = {2, 3, 64};
    struct monge_film *one = render(&s->instanced, s->accel, 1);
    for (size_t i = 0; i < COUNT(counts); i++) {
        struct monge_film *many = render(&s->instanced, s->accel, counts[i]);
        assert_memory_equal(one->rgb, many->rgb, 80 * 60 * 3 * sizeof(float));
        monge_film_free(many);
    }
    monge_film_free(one);
    pair_end(s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_same_pictures),
        cmocka_unit_test(a_camera_in_glass),
        cmocka_unit_test(threads_change_nothing),
    };
    return cmocka_run_group_tests_name("pictures of instances", tests, NULL, NULL);
}
