/* What the camera decides where the scene leaves it open, in closed form. A scene without bounded primitives
 * is framed as the unit ball at the origin would be. */
#include "near.h"
#include "render/camera.h"

static const double margin = 1.2;

static struct view view_of(struct camera camera, uint32_t width, uint32_t height) {
    struct arena arena = {0};
    const struct scene scene = {.camera = camera};
    const struct accel *accel = accel_build(&arena, &scene.primitives, NULL, 0, NULL);
    const struct view view = camera_view(&scene, accel, width, height);
    arena_free(&arena);
    return view;
}

static const struct camera down_z = {
    .has_direction = true, .direction = {0, 0, -3}, .up = {0, 1, 0}, .fov_deg = 90};

static struct camera orthographic_down_z(void) {
    struct camera camera = down_z;
    camera.projection = CAMERA_ORTHOGRAPHIC;
    return camera;
}

/* The sides that just hold a ball: at the distance sqrt(1 + t^2) / t where t is half the width at one. */
static double stand_back(double tangent) { return sqrt(1 + tangent * tangent) / tangent; }

static void perspective_frames_the_ball(void **state) {
    (void)state;
    const double t = 1 / margin;
    const struct view square = view_of(down_z, 100, 100), wide = view_of(down_z, 200, 100),
                      high = view_of(down_z, 100, 200);
    assert_vec3_near(square.eye, (vec3){0, 0, stand_back(t)}, 1e-14, "eye");
    assert_vec3_near(wide.eye, (vec3){0, 0, stand_back(t)}, 1e-14, "eye, wide");
    assert_vec3_near(high.eye, (vec3){0, 0, stand_back(t / 2)}, 1e-14, "eye, high");
    assert_near(square.distance, stand_back(t), 1e-14, "distance");
    assert_vec3_near(wide.right, (vec3){2, 0, 0}, 1e-15, "right");
    assert_vec3_near(wide.up, (vec3){0, 1, 0}, 1e-15, "up");
}

static void perspective_keeps_what_it_looks_at_in_the_middle(void **state) {
    (void)state;
    const double t = 1 / margin;
    struct camera camera = down_z;
    camera.has_look_at = true;
    camera.look_at = (vec3){0.5, -0.25, -7};
    const struct view view = view_of(camera, 100, 100);
    const double back = stand_back(t) + 0.5 / t;
    assert_vec3_near(view.eye, (vec3){0.5, -0.25, back}, 1e-14, "eye");
    assert_near(view.distance, back + 7, 1e-14, "distance");
    camera.look_at = (vec3){-0.25, 0.5, 0};
    assert_vec3_near(view_of(camera, 100, 100).eye, (vec3){-0.25, 0.5, back}, 1e-14, "eye, upwards");
}

/* However wide the view: the ball is from 1 to -1 along it. */
static void perspective_stays_in_front_of_the_ball(void **state) {
    (void)state;
    struct camera camera = down_z;
    camera.fov_deg = 179;
    assert_vec3_near(view_of(camera, 100, 100).eye, (vec3){0, 0, 1.02}, 1e-15, "eye");
}

static void orthographic_stands_in_front_of_the_ball(void **state) {
    (void)state;
    const struct view wide = view_of(orthographic_down_z(), 200, 100),
                      high = view_of(orthographic_down_z(), 100, 200);
    assert_true(wide.orthographic);
    assert_vec3_near(wide.eye, (vec3){0, 0, 3}, 1e-15, "eye");
    assert_vec3_near(wide.up, (vec3){0, margin, 0}, 1e-15, "up, wide");
    assert_vec3_near(wide.right, (vec3){2 * margin, 0, 0}, 1e-15, "right, wide");
    assert_vec3_near(high.right, (vec3){margin, 0, 0}, 1e-15, "right, high");
    assert_vec3_near(high.up, (vec3){0, 2 * margin, 0}, 1e-15, "up, high");
}

static void orthographic_keeps_what_it_looks_at_in_the_middle(void **state) {
    (void)state;
    struct camera camera = orthographic_down_z();
    camera.has_look_at = true;
    camera.look_at = (vec3){0.5, 0.25, 7};
    const struct view view = view_of(camera, 100, 100);
    assert_vec3_near(view.eye, (vec3){0.5, 0.25, 3}, 1e-14, "eye");
    assert_vec3_near(view.up, (vec3){0, 1.5 * margin, 0}, 1e-14, "up");
    camera.look_at = (vec3){-0.25, -0.5, 0};
    assert_vec3_near(view_of(camera, 100, 100).up, (vec3){0, 1.5 * margin, 0}, 1e-14, "up, downwards");
    camera.has_eye = true;
    camera.eye = (vec3){-0.25, 0, 9};
    assert_vec3_near(view_of(camera, 100, 100).right, (vec3){1.25 * margin, 0, 0}, 1e-14, "right, by eye");
}

static void an_eye_alone_looks_at_the_origin(void **state) {
    (void)state;
    struct camera camera = {.has_eye = true, .eye = {4, 0, 3}, .up = {0, 1, 0}, .fov_deg = 90};
    const struct view view = view_of(camera, 100, 100);
    assert_vec3_near(view.forward, (vec3){-0.8, 0, -0.6}, 1e-15, "forward");
    assert_near(view.distance, 5, 1e-15, "distance");
    camera.eye = (vec3){0, 0, 0};
    assert_vec3_near(view_of(camera, 100, 100).forward, (vec3){0, 0, -1}, 0, "forward from the origin");
}

static void nothing_given_looks_from_the_right_and_above(void **state) {
    (void)state;
    const struct view view = view_of((struct camera){.up = {0, 1, 0}, .fov_deg = 90}, 100, 100);
    const vec3 forward = vec3_normalize((vec3){-0.45, -0.38, -1});
    assert_vec3_near(view.forward, forward, 1e-15, "forward");
    assert_vec3_near(view.eye, vec3_scale(forward, -stand_back(1 / margin)), 1e-14, "eye");
}

static void an_up_along_the_view_gives_way(void **state) {
    (void)state;
    struct camera camera = down_z;
    camera.up = (vec3){0, 0, 1};
    assert_vec3_near(view_of(camera, 100, 100).right, (vec3){1, 0, 0}, 1e-15, "right, along z");
    assert_vec3_near(view_of(camera, 100, 100).up, (vec3){0, 1, 0}, 1e-15, "up, along z");
    camera.direction = camera.up = (vec3){0, 2, 0};
    assert_vec3_near(view_of(camera, 100, 100).up, (vec3){0, 0, -1}, 1e-15, "up, along y");
    camera.up = (vec3){1e-8, 1, 0}; /* enough to tell */
    assert_vec3_near(view_of(camera, 100, 100).up, (vec3){1, 0, 0}, 2e-8, "up, nearly along y");
    camera.up = (vec3){1.1e-9, 1, 0};
    assert_vec3_near(view_of(camera, 100, 100).up, (vec3){1, 0, 0}, 2e-8, "up, as little as tells");
    camera.up = (vec3){1e-9, 1, 0};
    assert_vec3_near(view_of(camera, 100, 100).up, (vec3){1, 0, 0}, 2e-8, "up, exactly the least that tells");
    camera.up = (vec3){0.9e-9, 1, 0};
    assert_vec3_near(view_of(camera, 100, 100).up, (vec3){0, 0, -1}, 2e-8, "up, too little to tell");
    camera.up = (vec3){0, 0, 1};
    camera.direction = (vec3){1.1e-9, 0, 1};
    assert_vec3_near(view_of(camera, 100, 100).right, (vec3){0, -1, 0}, 2e-8, "right, as little as tells");
    camera.direction = (vec3){0.9e-9, 0, 1};
    assert_vec3_near(view_of(camera, 100, 100).right, (vec3){1, 0, 0}, 2e-8, "right, too little to tell");
    camera.direction = camera.up = (vec3){1e-9, 0, 1};
    assert_vec3_near(view_of(camera, 100, 100).right, (vec3){0, 1, 0}, 2e-8,
                     "right, exactly the least that tells");
}

static void directions_are_of_any_length(void **state) {
    (void)state;
    const double lengths[] = {1e-120, 1e-12, 1e12, 1e120};
    const vec3 up = {0.2, 1, 0.1}, direction = {1, -0.5, 2};
    struct camera camera = down_z;
    camera.up = up;
    camera.direction = direction;
    const struct view want = view_of(camera, 100, 100);
    for (size_t i = 0; i < COUNT(lengths); i++)
        for (size_t k = 0; k < COUNT(lengths); k++) {
            camera.up = vec3_scale(up, lengths[i]);
            camera.direction = vec3_scale(direction, lengths[k]);
            const struct view view = view_of(camera, 100, 100);
            assert_vec3_near(view.up, want.up, 1e-15, "up");
            assert_vec3_near(view.right, want.right, 1e-15, "right");
            assert_vec3_near(view.eye, want.eye, 1e-14, "eye");
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(perspective_frames_the_ball),
        cmocka_unit_test(perspective_keeps_what_it_looks_at_in_the_middle),
        cmocka_unit_test(perspective_stays_in_front_of_the_ball),
        cmocka_unit_test(orthographic_stands_in_front_of_the_ball),
        cmocka_unit_test(orthographic_keeps_what_it_looks_at_in_the_middle),
        cmocka_unit_test(an_eye_alone_looks_at_the_origin),
        cmocka_unit_test(nothing_given_looks_from_the_right_and_above),
        cmocka_unit_test(an_up_along_the_view_gives_way),
        cmocka_unit_test(directions_are_of_any_length),
    };
    return cmocka_run_group_tests_name("camera", tests, NULL, NULL);
}
