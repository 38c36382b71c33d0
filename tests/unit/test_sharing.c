/* Templates in use that differ in materials alone: one geometry, and the same bits as of a template of its own for
 * each, which has its materials written out. */
#include <string.h>

#include "loading.h"
#include "monge.h"

#define HEAD                                                                                                 \
    "image: {size: [72, 48], samples: 2}\n"                                                                  \
    "render: {depth: 4}\n"                                                                                   \
    "camera: {eye: [3, 4, 16], look_at: [3, 1.5, 0], fov: 40}\n"                                             \
    "lights: [{point: {at: [-6, 12, 9]}}, {ambient: {color: [0.2, 0.2, 0.2]}}]\n"                            \
    "materials: {glass: {diffuse: black, reflection: 0.1, refraction: 0.8, index: 1.3}, base: {diffuse: "    \
    "gray}}\n"

/* Twelve balls and eight boxes, the balls of one material and the boxes of another, and a foot. */
#define TOWER(balls, boxes)                                                                                  \
    "objects: [{for: {i: 12}, sphere: {radius: 0.4, center: [0, 0.4 * i, 0]}, material: " balls "}, "        \
    "{for: {i: 8}, box: {}, material: " boxes ", transform: [{scale: 0.4}, {translate: [1, 0.5 * i, 0]}]}, " \
    "{disc: {radius: 1.5, normal: [0, 1, 0]}, material: base}]"

#define SHARED_TOWER "define: {tower: {params: {one: {}, two: {}}, " TOWER("one", "two") "}}\n"
#define RED          "{diffuse: red}"
#define BLUE         "{diffuse: blue, reflection: 0.4}"

static struct row {
    const char *name, *shared, *written; /* the same scene */
    uint32_t geometries, written_geometries;
} rows[] = {
    {"several materials",
     HEAD SHARED_TOWER
     "scene:\n"
     "- {use: tower, with: {one: " RED ", two: " BLUE "}}\n"
     "- {use: tower, with: {one: " BLUE ", two: " RED "}, transform: {translate: [3, 0, 0]}}\n"
     "- {use: tower, with: {one: glass, two: " RED "}, transform: {translate: [6, 0, 0]}}\n"
     "- {use: tower, with: {one: " RED ", two: glass}, transform: {translate: [2, 0, -4]}}\n",
     HEAD "define: {a: {" TOWER(RED, BLUE) "}, b: {" TOWER(BLUE, RED) "}, c: {" TOWER(
         "glass", RED) "}, d: {" TOWER(RED, "glass") "}}\n"
                                                     "scene:\n"
                                                     "- {use: a}\n"
                                                     "- {use: b, transform: {translate: [3, 0, 0]}}\n"
                                                     "- {use: c, transform: {translate: [6, 0, 0]}}\n"
                                                     "- {use: d, transform: {translate: [2, 0, -4]}}\n",
     1, 4},
    {"as many materials as slots, and more",
     HEAD
     "define: {row: {params: {last: {}}, objects: [{for: {i: 80}, sphere: {radius: 0.3, center: [0.1 * i, "
     "i % 4, 0]}, material: {diffuse: 'hsv(4 * i, 1, 1)'}}, {for: {i: 9}, box: {}, transform: {translate: "
     "[i, "
     "-1, 0]}}, {sphere: {center: [2, 5, 0]}, material: last}]}}\n"
     "scene: [{use: row, with: {last: " RED "}, material: glass}, {use: row, with: {last: " RED
     "}, material: " BLUE ", transform: {translate: [0, 0, -3]}}]\n",
     HEAD
     "define: {row: {params: {rest: {}}, objects: [{for: {i: 80}, sphere: {radius: 0.3, center: [0.1 * i, "
     "i % 4, 0]}, material: {diffuse: 'hsv(4 * i, 1, 1)'}}, {for: {i: 9}, box: {}, transform: {translate: "
     "[i, "
     "-1, 0]}, material: rest}, {sphere: {center: [2, 5, 0]}, material: " RED "}]}}\n"
     "scene: [{use: row, with: {rest: glass}}, {use: row, with: {rest: " BLUE
     "}, transform: {translate: [0, 0, "
     "-3]}}]\n",
     1, 2},
    {"the material around, and a given one",
     HEAD "define: {tower: {params: {two: {}}, objects: [{for: {i: 20}, sphere: {radius: 0.4, center: [0, "
          "0.3 * i, "
          "0]}}, {box: {min: [0, 0, 0], max: [1, 2, 1]}, material: two}]}}\n"
          "scene:\n"
          "- {use: tower, with: {two: " RED "}, material: " BLUE "}\n"
          "- group: [{use: tower, with: {two: glass}, transform: {translate: [3, 0, 0]}}]\n"
          "  material: " RED "\n"
          "- {use: tower, with: {two: " BLUE "}, transform: {translate: [6, 0, 0]}}\n",
     HEAD
     "define: {tower: {params: {one: {}, two: {}, at: 0}, objects: [{for: {i: 20 + 0 * at}, sphere: {radius: "
     "0.4, "
     "center: [0, 0.3 * i, 0]}, material: one}, {box: {min: [0, 0, 0], max: [1, 2, 1]}, material: two}]}, "
     "last: {objects: [{for: {i: 20}, sphere: {radius: 0.4, center: [0, 0.3 * i, 0]}}, {box: {min: [0, 0, "
     "0], "
     "max: [1, 2, 1]}, material: " BLUE "}]}}\n"
     "scene:\n"
     "- {use: tower, with: {one: " BLUE ", two: " RED "}}\n"
     "- {use: tower, with: {one: " RED ", two: glass}, transform: {translate: [3, 0, 0]}}\n"
     "- {use: last, transform: {translate: [6, 0, 0]}}\n",
     1, 2},
    {"nested, with the materials the other way round",
     HEAD "define:\n"
          "  tower: {params: {one: {}, two: {}}, " TOWER(
              "one", "two") "}\n"
                            "  pair: {params: {left: {}, right: {}}, objects: [{use: tower, with: {one: "
                            "left, two: right}}, {use: "
                            "tower, with: {one: right, two: left}, transform: {translate: [2.5, 0, 0]}}, "
                            "{sphere: {center: [1, 5, 0]}, "
                            "material: right}]}\n"
                            "scene:\n"
                            "- {use: pair, with: {left: " RED ", right: " BLUE "}}\n"
                            "- {use: pair, with: {left: glass, right: " RED
                            "}, transform: {translate: [4, 0, 0]}}\n"
                            "- {use: pair, with: {left: " BLUE
                            ", right: glass}, transform: {translate: [2, 0, -4]}}\n",
     HEAD
     "define:\n"
     "  ab: {" TOWER(
         RED,
         BLUE) "}\n"
               "  ba: {" TOWER(
                   BLUE,
                   RED) "}\n"
                        "  ga: {" TOWER(
                            "glass",
                            RED) "}\n"
                                 "  ag: {" TOWER(
                                     RED,
                                     "glass") "}\n"
                                              "  bg: {" TOWER(
                                                  BLUE,
                                                  "glass") "}\n"
                                                           "  gb: {" TOWER(
                                                               "glass",
                                                               BLUE) "}\n"
                                                                     "  one: {objects: [{use: ab}, {use: ba, "
                                                                     "transform: {translate: [2.5, 0, 0]}}, "
                                                                     "{sphere: {center: [1, 5, "
                                                                     "0]}, material: " BLUE "}]}\n"
                                                                     "  two: {objects: [{use: ga}, {use: ag, "
                                                                     "transform: {translate: [2.5, 0, 0]}}, "
                                                                     "{sphere: {center: [1, 5, "
                                                                     "0]}, material: " RED "}]}\n"
                                                                     "  three: {objects: [{use: bg}, {use: "
                                                                     "gb, transform: {translate: [2.5, 0, "
                                                                     "0]}}, {sphere: {center: [1, 5, "
                                                                     "0]}, material: glass}]}\n"
                                                                     "scene:\n"
                                                                     "- {use: one}\n"
                                                                     "- {use: two, transform: {translate: "
                                                                     "[4, 0, 0]}}\n"
                                                                     "- {use: three, transform: {translate: "
                                                                     "[2, 0, -4]}}\n",
     2, 9},
    {"equal arguments within groups of other materials",
     HEAD
     "define: {tower: {objects: [{for: {i: 20}, sphere: {radius: 0.4, center: [0, 0.3 * i, 0]}}, {box: {min: "
     "[0, 0, 0], max: [1, 2, 1]}, material: base}]}}\n"
     "scene: [{use: tower, material: " RED "}, {use: tower, material: " BLUE
     ", transform: {translate: [3, 0, 0]}}, {use: tower, material: " RED
     ", transform: {translate: [6, 0, 0]}}]\n",
     HEAD "define: {tower: {params: {one: {}}, objects: [{for: {i: 20}, sphere: {radius: 0.4, center: [0, "
          "0.3 * i, "
          "0]}, material: one}, {box: {min: [0, 0, 0], max: [1, 2, 1]}, material: base}]}}\n"
          "scene: [{use: tower, with: {one: " RED "}}, {use: tower, with: {one: " BLUE
          "}, transform: {translate: [3, 0, 0]}}, {use: tower, with: {one: " RED
          "}, transform: {translate: [6, 0, 0]}}]\n",
     1, 1},
};

static uint32_t geometries_of(const char *text) {
    struct loaded l;
    load_good(&l, text);
    const uint32_t count = l.scene.geometry_count;
    unload(&l);
    return count;
}

static struct monge_film *render(const char *text) {
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_scene *scene = monge_load_memory("t", text, strlen(text), NULL, diag);
    if (!scene) monge_diagnostics_print(diag, stdout);
    assert_non_null(scene);
    const struct monge_settings settings = monge_scene_settings(scene);
    struct monge_film *film = monge_render(scene, &settings, NULL, NULL, NULL);
    assert_non_null(film);
    monge_scene_free(scene);
    monge_diagnostics_free(diag);
    return film;
}

static size_t colors_of(const float *rgb, size_t pixels) {
    size_t colors = 0;
    for (size_t i = 1; i < pixels; i++) colors += memcmp(&rgb[3 * i], &rgb[3 * i - 3], 3 * sizeof *rgb) != 0;
    return colors;
}

static void check_sharing(void **state) {
    const struct row *row = *state;
    const size_t pixels = 72 * 48;
    assert_int_equal(geometries_of(row->shared), row->geometries);
    assert_int_equal(geometries_of(row->written), row->written_geometries);
    struct monge_film *shared = render(row->shared), *written = render(row->written);
    assert_memory_equal(monge_film_pixels(shared), monge_film_pixels(written), pixels * 3 * sizeof(float));
    assert_true(colors_of(monge_film_pixels(shared), pixels) > pixels / 4);
    monge_film_free(shared);
    monge_film_free(written);
}

/* ---- What makes them differ ---- */

static void other_shapes_are_other_geometries(void **state) {
    (void)state;
    assert_int_equal(
        geometries_of(
            "define: {row: {params: {r: 1, one: {}, two: {}}, objects: [{for: {i: 20}, sphere: {center: [i, "
            "0, 0], radius: r}, material: one}, {box: {}, material: two}]}}\n"
            "scene: [{use: row, with: {one: " RED "}}, {use: row, with: {two: " RED "}}, "
            "{use: row, with: {r: 2, one: " RED "}}, {use: row, with: {r: 2, two: " RED "}}]"),
        2);
}

/* Slots tell which primitives have the same material. */
static void other_patterns_are_other_geometries(void **state) {
    (void)state;
    assert_int_equal(
        geometries_of(
            "define: {row: {params: {one: {}, two: {}}, objects: [{for: {i: 20}, sphere: {center: [i, 0, "
            "0]}, material: one}, {box: {}, material: two}]}}\n"
            "scene: [{use: row, with: {one: " RED "}}, {use: row, with: {one: " RED ", two: " RED "}}]"),
        2);
}

/* By what the materials are, not by their names. */
static void fingerprints_know_the_materials(void **state) {
    (void)state;
#define SCENE(one, two)                                                                                      \
    HEAD SHARED_TOWER "scene: [{use: tower, with: {one: " one ", two: " two "}}, {use: tower, with: "        \
                      "{one: base, two: " RED "}}]"
    const struct hash first = load_hash(SCENE(RED, BLUE)), same = load_hash(SCENE(RED, BLUE)),
                      turned = load_hash(SCENE(BLUE, RED)), other = load_hash(SCENE(RED, "{diffuse: blue}"));
    assert_memory_equal(&first, &same, sizeof first);
    assert_memory_not_equal(&first, &turned, sizeof first);
    assert_memory_not_equal(&first, &other, sizeof first);
}

/* Of a frame that the scene is moved to, and of one that it is loaded at. */
static void frames_have_their_own_materials(void **state) {
    (void)state;
    static const char text[] = HEAD SHARED_TOWER "animation: {frames: 2}\n"
                                                 "scene:\n"
                                                 "- {sphere: {}, material: " RED "}\n"
                                                 "- {box: {}, material: {diffuse: blue}}\n"
                                                 "- {use: tower, with: {one: {diffuse: 'i == 0 ? red : "
                                                 "blue'}, two: glass}, for: {i: 2}, when: i + 1 == "
                                                 "frame, transform: {translate: [3, 0, 0]}}\n";
    const struct monge_load_options second = {.frame = 2};
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_scene *moved = monge_load_memory("t", text, strlen(text), NULL, diag),
                       *loaded = monge_load_memory("t", text, strlen(text), &second, diag);
    assert_true(moved && loaded && monge_scene_prepare(moved) && monge_scene_set_frame(moved, 2, diag));
    const struct monge_settings settings = monge_scene_settings(moved);
    struct monge_film *one = monge_render(moved, &settings, NULL, NULL, NULL),
                      *two = monge_render(loaded, &settings, NULL, NULL, NULL);
    assert_memory_equal(monge_film_pixels(one), monge_film_pixels(two), 72 * 48 * 3 * sizeof(float));
    monge_film_free(one);
    monge_film_free(two);
    monge_scene_free(moved);
    monge_scene_free(loaded);
    monge_diagnostics_free(diag);
}

int main(void) {
    struct CMUnitTest tests[COUNT(rows) + 4];
    for (size_t i = 0; i < COUNT(rows); i++)
        tests[i] = (struct CMUnitTest){rows[i].name, check_sharing, NULL, NULL, &rows[i]};
    tests[COUNT(rows)] = (struct CMUnitTest)cmocka_unit_test(other_shapes_are_other_geometries);
    tests[COUNT(rows) + 1] = (struct CMUnitTest)cmocka_unit_test(other_patterns_are_other_geometries);
    tests[COUNT(rows) + 2] = (struct CMUnitTest)cmocka_unit_test(fingerprints_know_the_materials);
    tests[COUNT(rows) + 3] = (struct CMUnitTest)cmocka_unit_test(frames_have_their_own_materials);
    return cmocka_run_group_tests_name("sharing", tests, NULL, NULL);
}
