/* A scene that is moved to another frame is what it would be if it had been loaded there. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "monge.h"

#define HEAD "animation: {frames: 5}\nimage: {size: [24, 16]}\n"

struct row {
    const char *name, *text;
    bool keeps; /* the acceleration structure, from one frame to the next */
};

static const struct row rows[] = {
    {"the camera moves", HEAD "camera: {eye: [2 + t, 1, 4], look_at: [0, 0, 0]}\nscene: [{sphere: {}}]\n",
     true},
    {"the lights move", HEAD "lights: [{point: {at: [4 * t, 3, 3]}}]\nscene: [{sphere: {}}, {box: {}}]\n",
     true},
    {"the background moves",
     "animation: {frames: 5}\nimage: {size: [24, 16], background: [t, 0, 0]}\nscene: [{sphere: {}}]\n", true},
    {"by a parameter", HEAD "params: {far: 4 + t}\ncamera: {eye: [0, 1, far]}\nscene: [{sphere: {}}]\n",
     true},
    {"a material moves", HEAD "materials: {m: {diffuse: [t, 1, 0]}}\nscene: [{sphere: {}, material: m}]\n",
     true},
    {"a material becomes clear",
     HEAD
     "scene: [{sphere: {}, material: {refraction: 'frame == 1 || frame % 2 == 0 ? 0.3 : 0'}}, {box: {}}]\n",
     false},
    {"a sphere moves", HEAD "scene: [{sphere: {center: [t, 0, 0]}}]\n", false},
    {"a quadric moves", HEAD "scene: [{cone: {radius: 1 + t}}]\n", false},
    {"it is sheared", HEAD "scene: [{cylinder: {}, transform: [{shear: {xy: t}}]}]\n", false},
    {"a flat moves", HEAD "scene: [{square: {}, transform: [{rotate: {y: 90 * t}}]}]\n", false},
    {"one more of them",
     HEAD "scene: [{sphere: {center: [i, 0, 0], radius: 0.4}, for: {i: {from: 1, to: frame}}}]\n", false},
    {"keyframes", HEAD "scene: [{box: {}, transform: [{translate: {keys: {1: [0, 0, 0], 5: [1, 0, 0]}}}]}]\n",
     false},
    {"an instance moves",
     HEAD
     "define: {row: {objects: [{sphere: {center: [i, 0, 0], radius: 0.4}, for: {i: {from: 1, to: 20}}}]}}\n"
     "scene: [{use: row}, {use: row, transform: [{translate: [0, t, 0]}]}]\n",
     false},
    {"a geometry moves",
     HEAD "define: {row: {objects: [{sphere: {center: [i, 0, 0], radius: 0.4 + 0.1 * t}, for: {i: {from: 1, "
          "to: 20}}}]}}\n"
          "scene: [{use: row}, {use: row, transform: [{translate: [0, 2, 0]}]}]\n",
     false},
};

static struct monge_scene *load(const char *text, unsigned frame, struct monge_diagnostics *diag) {
    const struct monge_load_options options = {.frame = frame};
    char *copy = malloc(strlen(text));
    memcpy(copy, text, strlen(text));
    struct monge_scene *scene = monge_load_memory("t", copy, strlen(text), &options, diag);
    memset(copy, '?', strlen(text)); /* it is free to go */
    free(copy);
    if (!scene) monge_diagnostics_print(diag, stdout);
    assert_non_null(scene);
    return scene;
}

/* The pixels of the scene, and whether its acceleration structure was there before. */
static struct monge_film *render(struct monge_scene *scene, bool *kept) {
    const struct monge_settings settings = monge_scene_settings(scene);
    struct monge_stats stats;
    struct monge_film *film = monge_render(scene, &settings, NULL, NULL, &stats);
    assert_non_null(film);
    *kept = stats.build_seconds == 0.0;
    return film;
}

static void assert_same(const struct monge_film *a, const struct monge_film *b) {
    const struct monge_region region = monge_film_region(a);
    assert_memory_equal(monge_film_pixels(a), monge_film_pixels(b),
                        3u * region.width * region.height * sizeof(float));
}

static void check_frame(struct monge_scene *scene, const struct row *row, unsigned frame,
                        struct monge_diagnostics *diag) {
    bool kept, ignored;
    struct monge_film *film = render(scene, &kept);
    struct monge_scene *other = load(row->text, frame, diag);
    struct monge_film *alone = render(other, &ignored);
    assert_same(film, alone);
    assert_int_equal(kept, row->keeps && frame > 1);
    assert_int_equal(monge_scene_frames(other), 5);
    monge_film_free(film);
    monge_film_free(alone);
    monge_scene_free(other);
}

static void check_row(void **state) {
    const struct row *row = *state;
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_scene *scene = load(row->text, 0, diag);
    check_frame(scene, row, 1, diag);
    for (unsigned frame = 5; frame >= 2; frame--) {
        assert_true(monge_scene_set_frame(scene, frame, diag));
        check_frame(scene, row, frame, diag);
    }
    assert_int_equal(monge_diagnostics_errors(diag), 0);
    monge_scene_free(scene);
    monge_diagnostics_free(diag);
}

static const char *const breaking[] = {
    HEAD "camera: {fov: 90 - 30 * frame}\nscene: [{sphere: {}}]\n",
    HEAD "scene: [{sphere: {radius: 3 - frame}}]\n",
};

static void stays_where_it_was(void **state) {
    bool kept;
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_scene *scene = load(*state, 0, diag);
    assert_true(monge_scene_set_frame(scene, 2, diag));
    struct monge_film *before = render(scene, &kept);
    assert_false(monge_scene_set_frame(scene, 3, diag));
    assert_int_equal(monge_diagnostics_errors(diag), 1);
    assert_int_equal(monge_diagnostics_failures(diag), 0);
    struct monge_film *after = render(scene, &kept);
    assert_true(kept);
    assert_same(before, after);
    assert_true(monge_scene_set_frame(scene, 1, diag));
    monge_film_free(before);
    monge_film_free(after);
    monge_scene_free(scene);
    monge_diagnostics_free(diag);
}

/* What `print` writes, to be freed. */
static char *printed(struct monge_diagnostics *diag,
                     void (*print)(struct monge_diagnostics *diag, FILE *out)) {
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    print(diag, out);
    fclose(out);
    return text;
}

static void print_all(struct monge_diagnostics *diag, FILE *out) { monge_diagnostics_print(diag, out); }

static void a_warning_is_told_once(void **state) {
    (void)state;
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_scene *scene =
        load(HEAD "materials: {unused: {}}\nscene: [{sphere: {radius: 1 + t}}]\n", 0, diag);
    char *first = printed(diag, monge_diagnostics_print_new);
    assert_non_null(strstr(first, "unused-definition"));
    assert_true(monge_scene_set_frame(scene, 2, diag));
    char *second = printed(diag, monge_diagnostics_print_new), *all = printed(diag, print_all);
    assert_string_equal(second, "");
    assert_string_equal(all, first);
    assert_int_equal(monge_diagnostics_warnings(diag), 2);
    free(first);
    free(second);
    free(all);
    monge_scene_free(scene);
    monge_diagnostics_free(diag);
}

int main(void) {
    struct CMUnitTest tests[64];
    size_t count = 0;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        tests[count++] = (struct CMUnitTest){rows[i].name, check_row, NULL, NULL, (void *)&rows[i]};
    for (size_t i = 0; i < sizeof breaking / sizeof *breaking; i++)
        tests[count++] =
            (struct CMUnitTest){"stays where it was", stays_where_it_was, NULL, NULL, (void *)breaking[i]};
    tests[count++] = (struct CMUnitTest)cmocka_unit_test(a_warning_is_told_once);
    return _cmocka_run_group_tests("frames", tests, count, NULL, NULL);
}
