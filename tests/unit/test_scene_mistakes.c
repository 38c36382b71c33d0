/* What is wrong with a scene, and what is odd. That each is told in the right words, tests/errors/ sees to. */
#include "loading.h"
#include "scene/builder.h"

static struct verdict {
    const char *name, *text;
    unsigned errors, warnings;
} verdicts[] = {
    {"verdict: a flat scale", "scene: [{sphere: {}, transform: {scale: [1, 0, 1]}}]", 1, 0},
    {"verdict: a flat step and a flat group",
     "scene: [{group: [{sphere: {}, transform: {scale: 0}}], transform: [{scale: 0}, {shear: {xy: 1, yx: "
     "1}}]}]",
     3, 0},
    {"verdict: flat only together",
     "scene: [{group: [{sphere: {}, transform: {scale: 1e-60}}], transform: {scale: 1e-60}}]", 1, 0},
    {"verdict: out of all bounds together",
     "scene: [{group: [{group: [{sphere: {}, transform: {scale: 1e90}}], transform: {scale: 1e90}}, {sphere: "
     "{}, transform: {translate: [1e90, 0, 0]}}], transform: {scale: 1e90}}]",
     2, 0},
    {"verdict: infinite times zero",
     "scene: [{group: [{group: [{group: [{group: [{sphere: {}, transform: {translate: [1e90, 0, 0]}}], "
     "transform: {scale: [1e90, 1, 1]}}], transform: {scale: [1e90, 1, 1]}}], transform: {scale: [1e90, 1, "
     "1]}}], transform: {rotate: {z: 90}}}]",
     1, 0},
    {"verdict: look_at is eye", "camera: {eye: [1, 2, 3], look_at: [1, 2, 3]}\nscene: [{sphere: {}}]", 1, 0},
    {"verdict: up along the view",
     "camera: {eye: [0, 0, 5], look_at: [0, 0, 0], up: [0, 0, 2]}\nscene: [{sphere: {}}]", 1, 0},
    {"verdict: up against the view", "camera: {direction: [0, 0, -1], up: [0, 0, 2]}\nscene: [{sphere: {}}]",
     1, 0},
    {"verdict: a view straight down needs no up", "camera: {direction: [0, -1, 0]}\nscene: [{sphere: {}}]", 0,
     0},
    {"verdict: height in perspective", "camera: {height: 3}\nscene: [{sphere: {}}]", 1, 0},
    {"verdict: fov in an orthographic view",
     "camera: {projection: orthographic, fov: 30}\nscene: [{sphere: {}}]", 1, 0},
    {"verdict: too many pixels", "image: {size: [65535, 65535]}\nscene: [{sphere: {}}]", 1, 0},
    {"verdict: reflection and refraction over 1",
     "scene: [{sphere: {}, material: {reflection: 0.6, refraction: 0.6}}]", 1, 0},
    {"verdict: in a named material",
     "materials: {m: {reflection: 0.6, refraction: [0, 0, 0.6]}}\nscene: [{sphere: {}, material: m}]", 1, 0},
    {"verdict: together 1", "scene: [{sphere: {}, material: {reflection: 0.9, refraction: 0.1}}]", 0, 0},
    {"verdict: a box without an inside", "scene: [{box: {min: [0, 0, 0], max: [1, 1, 0]}}]", 1, 0},
    {"verdict: bounds without an inside",
     "scene: [{quadric: {xx: 1}, bounds: {min: [1, 0, 0], max: [0, 1, 1]}}]", 1, 0},
    {"verdict: bounds of a sphere", "scene: [{sphere: {}, bounds: {min: [-1, -1, -1], max: [1, 1, 1]}}]", 1,
     0},
    {"verdict: bounds of a group",
     "scene: [{group: [{sphere: {}}], bounds: {min: [-1, -1, -1], max: [1, 1, 1]}}]", 1, 0},
    {"verdict: a cylinder without a length", "scene: [{cylinder: {from: [1, 1, 1], to: [1, 1, 1]}}]", 1, 0},
    {"verdict: an empty quadric", "scene: [{quadric: {constant: 1}}]", 1, 0},
    {"verdict: radians",
     "scene: [{sphere: {}, transform: [{rotate: {x: 1.5708}}, {rotate: {axis: [1, 0, 0], angle: -3.1416}}]}]",
     0, 2},
    {"verdict: degrees",
     "scene: [{sphere: {}, transform: [{rotate: {x: 1.5}}, {rotate: {x: 3}}, {rotate: {x: 90}}]}]", 0, 0},
    {"verdict: no objects", "scene: []", 0, 1},
    {"verdict: no objects but groups", "scene: [{group: []}]", 0, 1},
    {"verdict: no light", "lights: []\nscene: [{sphere: {}}]", 0, 1},
    {"verdict: no light, unlit", "lights: []\nrender: {shading: signature}\nscene: [{sphere: {}}]", 0, 0},
    {"verdict: no light but mirrors", "lights: []\nscene: [{sphere: {}, material: {reflection: 1}}]", 0, 0},
    {"verdict: black lights",
     "lights: [{point: {at: [0, 5, 0], color: black}}, {ambient: {color: black}}]\nscene: [{sphere: {}}]", 0,
     1},
    {"verdict: ambient light that nothing gives back",
     "lights: [{ambient: {}}]\nscene: [{sphere: {}, material: {diffuse: red}}]", 0, 1},
    {"verdict: ambient light that something gives back",
     "lights: [{ambient: {}}]\nscene: [{sphere: {}, material: {diffuse: red}}, {box: {}, material: {ambient: "
     "red}}]",
     0, 0},
    {"verdict: no warning beside an error", "lights: []\nscene: [{sphere: {r: 1}}]", 1, 0},
    {"verdict: errors of lang and of scene in one run",
     "scene: [{sphere: {radius: x}}, {box: {}, transform: {scale: 0}}]", 2, 0},
};

static void check_verdict(void **state) {
    const struct verdict *row = *state;
    struct loaded l;
    load_text(&l, row->text);
    if (l.diag.errors != row->errors || l.diag.warnings != row->warnings) {
        diag_print(&l.diag, stdout);
        fail_msg("%u errors and %u warnings", l.diag.errors, l.diag.warnings);
    }
    assert_int_equal(l.ok, row->errors == 0);
    unload(&l);
}

static void errors_of_an_earlier_scene_do_not_stop_this_one(void **state) {
    (void)state;
    struct loaded l = {0};
    diag_error(&l.diag, (struct span){0}, "code", "of another file");
    load_after(&l, "scene: [{sphere: {}}]");
    assert_true(l.ok);
    unload(&l);
}

/* As if a scene had as many of each kind as there may be already. */
static void one_more_than_may_be_of_a_kind(void **state) {
    (void)state;
    static const char text[] = "define: {row: {objects: [{for: {i: 20}, sphere: {center: [i, 0, 0]}}]}}\n"
                               "scene: [{sphere: {}}, {square: {}}, {cone: {}}, {use: row}]";
    struct loaded l = {0};
    struct lang_sink sink;
    struct builder *builder = scene_begin(&l.arena, &l.diag, &l.scene, &sink);
    struct primitives *p = &builder->set->primitives;
    p->sphere_count = p->flat_count = p->quadric_count = p->instance_count = PRIMITIVE_MAX - 1;
    const struct lang_input input = loading_input(&l.memory, text, &sink);
    assert_non_null(lang_read(&l.memory, &l.diag, &input).file);
    assert_int_equal(l.diag.errors, 4);
    for (const struct diagnostic *d = l.diag.first; d; d = d->next) {
        assert_string_equal(d->code, "limit-objects");
        assert_string_equal(d->message, "more than 1073741823 primitives of one kind");
        assert_int_equal(d->place.line, 2);
    }
    assert_int_equal(p->count, 0);
    assert_true(p->sphere_count == PRIMITIVE_MAX - 1 && p->flat_count == PRIMITIVE_MAX - 1 &&
                p->quadric_count == PRIMITIVE_MAX - 1 && p->instance_count == PRIMITIVE_MAX - 1);
    unload(&l);
}

static void what_is_wrong_adds_nothing(void **state) {
    (void)state;
    static const struct {
        const char *object, *code;
    } wrong[] = {
        {"{cylinder: {from: [1, 2, 3], to: [1, 2, 3]}}", "no-length"},
        {"{cone: {from: [1, 2, 3], to: [1, 2, 3]}}", "no-length"},
        {"{paraboloid: {from: [1, 2, 3], to: [1, 2, 3]}}", "no-length"},
        {"{hyperboloid: {from: [1, 2, 3], to: [1, 2, 3]}}", "no-length"},
        {"{box: {min: [0, 0, 0], max: [1, 1, 0]}}", "min-over-max"},
        {"{quadric: {constant: 1}}", "no-surface"},
        {"{quadric: {xx: 1}, bounds: {min: [0, 0, 0], max: [0, 1, 1]}}", "min-over-max"},
        {"{sphere: {}, bounds: {min: [0, 0, 0], max: [1, 1, 1]}}", "bounds-of-no-quadric"},
        {"{sphere: {radius: 1e99}, transform: {scale: 1e99}}", "flat-transform"},
        {"{square: {}, transform: [{scale: 1e99}, {scale: 1e99}]}", "flat-transform"},
        {"{box: {}, transform: [{scale: 1e-99}, {scale: 1e-99}]}", "flat-transform"},
    };
    for (size_t i = 0; i < COUNT(wrong); i++) {
        struct loaded l = {0};
        struct lang_sink sink;
        struct builder *b = scene_begin(&l.arena, &l.diag, &l.scene, &sink);
        char text[200];
        snprintf(text, sizeof text, "scene: [%s]\n", wrong[i].object);
        const struct lang_input input = loading_input(&l.memory, text, &sink);
        lang_read(&l.memory, &l.diag, &input);
        if (l.diag.errors != 1 || strcmp(l.diag.first->code, wrong[i].code) != 0) {
            diag_print(&l.diag, stdout);
            fail_msg("%s: want one error, %s", wrong[i].object, wrong[i].code);
        }
        assert_int_equal(b->set->primitives.count, 0);
        unload(&l);
    }
}

int main(void) {
    struct CMUnitTest tests[COUNT(verdicts) + 3];
    size_t n = 0;
    for (size_t i = 0; i < COUNT(verdicts); i++)
        tests[n++] = (struct CMUnitTest){verdicts[i].name, check_verdict, NULL, NULL, &verdicts[i]};
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(errors_of_an_earlier_scene_do_not_stop_this_one);
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(one_more_than_may_be_of_a_kind);
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(what_is_wrong_adds_nothing);
    return cmocka_run_group_tests_name("mistakes of scenes", tests, NULL, NULL);
}
