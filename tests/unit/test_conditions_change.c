/* What is told of two renderings of which lights or settings differ, and what files keep of these. */
#include <stdlib.h>
#include <string.h>

#include "changing.h"
#include "folder.h"
#include "image/conditions_change.h"
#include "image/layer_table.h"

/* ---- Rows ---- */

struct row {
    const char *name, *older, *newer;
    const char *want; /* the changes, a line each */
    unsigned without; /* layers that are not there */
};

/* On lines 1 to 4: settings, camera, lights, `scene:`; floor and ball are on 5 and 6. */
#define SCENE(image, lights, objects)                                                                        \
    image "\ncamera: {eye: [0, 3, 8], look_at: [0, 0.7, 0]}\nlights: [" lights "]\nscene:\n" objects
#define FLOOR          "  - {name: floor, plane: {normal: [0, 1, 0]}, material: {ambient: white, diffuse: '#aaa'}}\n"
#define BALL           "  - {name: ball, sphere: {center: [-1.5, 1, 0]}, material: {ambient: red, diffuse: red}}\n"
#define LIME           "  - {name: ball, sphere: {center: [-1.5, 1, 0]}, material: {ambient: red, diffuse: lime}}\n"
#define AWAY           "  - {name: ball, sphere: {center: [-1.5, 1, 1]}, material: {ambient: red, diffuse: red}}\n"
#define MIRROR         "  - {name: mirror, sphere: {center: [2, 1, 0]}, material: {reflection: 0.6}}\n"
#define TILE(x)        "  - {name: tile, box: {min: [-2, 0, -2], max: [" x ", 0.5, 2]}}\n"
#define LIT(lights)    SCENE("", lights, FLOOR BALL)
#define SET(image)     SCENE(image, KEY, FLOOR MIRROR)
#define KEY            "{point: {at: [-4, 8, 6], color: [0.7, 0.7, 0.7]}}"
#define FILL           "{point: {at: [6, 3, 4], color: [0.2, 0.2, 0.2]}}"
#define ELSEWHERE      "{point: {at: [4, 8, 6], color: [0.7, 0.7, 0.7]}}"
#define WARM           "{point: {at: [-4, 8, 6], color: [0.8, 0.7, 0.6]}}"
#define WARM_ELSEWHERE "{point: {at: [4, 8, 6], color: [0.8, 0.7, 0.6]}}"
#define AMBIENT        "{ambient: {color: [0.2, 0.2, 0.2]}}"
#define RING(turn)                                                                                           \
    "{for: {i: 3}, point: {at: [8 * cos(120 * i + " turn "), 8, 8 * sin(120 * i + " turn                     \
    ")], color: [0.3, 0.3, 0.3]}}"
#define PEARL(name, x, color)                                                                                \
    "  - {name: " name ", sphere: {center: [" x ", 0.4, 2], radius: 0.4}, material: {ambient: " color        \
    ", diffuse: " color "}}\n"
#define THREE PEARL("a", "-2", "red") PEARL("b", "-1", "red") PEARL("c", "0", "red")
#define BOTH(other)                                                                                          \
    "object \"floor\" (scene.yaml:5): shading changed, geometry equal\n"                                     \
    "object \"" other "\" (scene.yaml:6): shading changed, geometry equal\n"
#define GLOSS(name, x)                                                                                       \
    "  - {name: " name ", sphere: {center: [" x ", 1, 0], radius: 0.4}, material: {reflection: 0.6}}\n"
#define BALLS  GLOSS("a", "-2") GLOSS("b", "-1") GLOSS("c", "0") GLOSS("d", "1") GLOSS("e", "2")
#define SUM(n) "shading of " n " objects changed by that, geometry and materials equal\n"
#define OTHERS "other changes too, which cannot be told by object under another camera\n"

static struct row rows[] = {
    {"a light has moved", LIT(KEY), LIT(ELSEWHERE),
     "point light (scene.yaml:3): moved\n"
     "object \"floor\" (scene.yaml:5): shading changed, geometry equal\n"
     "object \"ball\" (scene.yaml:6): shading changed, geometry equal\n"
     "object \"floor\" (scene.yaml:5): shadow changed\n"
     "object \"ball\" (scene.yaml:6): shadow changed\n",
     0},
    {"a light has another colour", LIT(KEY), LIT(WARM),
     "point light (scene.yaml:3): colour or strength changed\n"
     "object \"floor\" (scene.yaml:5): shading changed, geometry equal\n"
     "object \"ball\" (scene.yaml:6): shading changed, geometry equal\n",
     0},
    {"a light has another place and colour", LIT(KEY), LIT(WARM_ELSEWHERE),
     "point light (scene.yaml:3): moved, colour or strength changed\n"
     "object \"floor\" (scene.yaml:5): shading changed, geometry equal\n"
     "object \"ball\" (scene.yaml:6): shading changed, geometry equal\n"
     "object \"floor\" (scene.yaml:5): shadow changed\n"
     "object \"ball\" (scene.yaml:6): shadow changed\n",
     0},
    {"a light has come, before another", LIT(KEY), LIT(FILL ", " KEY),
     "point light (scene.yaml:3): appeared\n"
     "object \"floor\" (scene.yaml:5): shadow changed\n"
     "object \"ball\" (scene.yaml:6): shadow changed\n",
     0},
    {"a light has gone, before another", LIT(FILL ", " KEY), "\n" LIT(KEY),
     "point light (was at scene.yaml:3): disappeared\n"
     "object \"floor\" (scene.yaml:6): shadow changed\n"
     "object \"ball\" (scene.yaml:7): shadow changed\n",
     0},
    {"all lights have gone", LIT(KEY ", " AMBIENT), LIT(""),
     "point light (was at scene.yaml:3): disappeared\n"
     "ambient light (was at scene.yaml:3): disappeared\n"
     "object \"floor\" (scene.yaml:5): shadow changed\n"
     "object \"ball\" (scene.yaml:6): shadow changed\n"
     "object \"floor\" (scene.yaml:5): shading changed, geometry equal\n"
     "object \"ball\" (scene.yaml:6): shading changed, geometry equal\n",
     0},
    {"the ambient light", LIT(KEY ", " AMBIENT), LIT(KEY ",\n {ambient: {color: [0.3, 0.3, 0.2]}}"),
     "ambient light (scene.yaml:4): colour or strength changed\n"
     "object \"floor\" (scene.yaml:6): shading changed, geometry equal\n"
     "object \"ball\" (scene.yaml:7): shading changed, geometry equal\n",
     0},
    {"two lights", LIT(KEY ",\n  " FILL),
     LIT(ELSEWHERE ",\n  {point: {at: [6, 3, 4], color: [0.3, 0.2, 0.2]}}"),
     "point light (scene.yaml:3): moved\n"
     "point light (scene.yaml:4): colour or strength changed\n"
     "object \"floor\" (scene.yaml:6): shading changed, geometry equal\n"
     "object \"ball\" (scene.yaml:7): shading changed, geometry equal\n"
     "object \"floor\" (scene.yaml:6): shadow changed\n"
     "object \"ball\" (scene.yaml:7): shadow changed\n",
     0},
    {"one of two lights of a colour has moved, the first", LIT(KEY ",\n " ELSEWHERE),
     LIT("{point: {at: [0, 9, 3], color: [0.7, 0.7, 0.7]}},\n " ELSEWHERE),
     "point light (scene.yaml:3): moved\n"
     "object \"floor\" (scene.yaml:6): shading changed, geometry equal\n"
     "object \"ball\" (scene.yaml:7): shading changed, geometry equal\n"
     "object \"floor\" (scene.yaml:6): shadow changed\n"
     "object \"ball\" (scene.yaml:7): shadow changed\n",
     0},
    {"one of two lights at one place has gone, the first", LIT(KEY ", " WARM), LIT(WARM),
     "point light (was at scene.yaml:3): disappeared\n"
     "object \"floor\" (scene.yaml:5): shadow changed\n"
     "object \"ball\" (scene.yaml:6): shadow changed\n",
     0},
    {"two lights are listed the other way round, and moved", LIT(KEY ",\n " FILL),
     LIT("{point: {at: [6, 5, 4], color: [0.2, 0.2, 0.2]}},\n " ELSEWHERE),
     "point light (scene.yaml:3): moved\n"
     "point light (scene.yaml:4): moved\n"
     "object \"floor\" (scene.yaml:6): shading changed, geometry equal\n"
     "object \"floor\" (scene.yaml:6): shadow changed\n"
     "object \"ball\" (scene.yaml:7): shading changed, geometry equal\n"
     "object \"ball\" (scene.yaml:7): shadow changed\n",
     0},
    {"two lights are listed the other way round, and of other colours", LIT(KEY ",\n " FILL),
     LIT("{point: {at: [6, 3, 4], color: [0.3, 0.2, 0.2]}},\n " WARM),
     "point light (scene.yaml:3): colour or strength changed\n"
     "point light (scene.yaml:4): colour or strength changed\n"
     "object \"floor\" (scene.yaml:6): shading changed, geometry equal\n"
     "object \"ball\" (scene.yaml:7): shading changed, geometry equal\n"
     "object \"floor\" (scene.yaml:6): shadow changed\n"
     "object \"ball\" (scene.yaml:7): shadow changed\n",
     0},
    {"a light over several lines, by where it begins", LIT(KEY),
     SCENE("", "\n  {\n  point: {\n    at: [4, 8, 6], color: [0.7, 0.7, 0.7]}}\n  ", FLOOR BALL),
     "point light (scene.yaml:4): moved\n"
     "object \"floor\" (scene.yaml:9): shading changed, geometry equal\n"
     "object \"ball\" (scene.yaml:10): shading changed, geometry equal\n"
     "object \"floor\" (scene.yaml:9): shadow changed\n"
     "object \"ball\" (scene.yaml:10): shadow changed\n",
     0},
    {"lights of a loop are told once", LIT(RING("0")), LIT(RING("30")),
     "point light (scene.yaml:3): moved\n"
     "object \"floor\" (scene.yaml:5): shading changed, geometry equal\n"
     "object \"floor\" (scene.yaml:5): shadow changed\n"
     "object \"ball\" (scene.yaml:6): shading changed, geometry equal\n"
     "object \"ball\" (scene.yaml:6): shadow changed\n",
     0},
    {"lights that only stand in another order and on another line", LIT(KEY ", " FILL),
     "\n" LIT(FILL ", " KEY), "", 0},
    {"lights instead of the default ones",
     "camera: {eye: [0, 3, 8], look_at: [0, 0.7, 0]}\nscene:\n" FLOOR BALL,
     "camera: {eye: [0, 3, 8], look_at: [0, 0.7, 0]}\nlights: [" KEY "]\nscene:\n" FLOOR BALL,
     "point light (scene.yaml:2): appeared\n"
     "default lights: disappeared\n"
     "object \"floor\" (scene.yaml:4): shadow changed\n"
     "object \"ball\" (scene.yaml:5): shadow changed\n",
     0},
    {"default lights follow the scene", "camera: {eye: [0, 3, 8], direction: [0, -1, -3]}\nscene:\n" BALL,
     "camera: {eye: [0, 3, 8], direction: [0, -1, -3]}\nscene:\n" AWAY,
     "object \"ball\" (scene.yaml:3): geometry moved\n", 0},

    {"a light has moved, and an object is of another material", LIT(KEY), SCENE("", ELSEWHERE, FLOOR LIME),
     "point light (scene.yaml:3): moved\n"
     "object \"ball\" (scene.yaml:6): shading changed, geometry equal: another material\n"
     "object \"floor\" (scene.yaml:5): shading changed, geometry equal\n"
     "object \"floor\" (scene.yaml:5): shadow changed\n",
     0},
    {"a light has another colour, and an object has moved", LIT(KEY), SCENE("", WARM, FLOOR AWAY),
     "point light (scene.yaml:3): colour or strength changed\n"
     "object \"ball\" (scene.yaml:6): geometry moved\n"
     "object \"floor\" (scene.yaml:5): shading changed, geometry equal\n"
     "object \"floor\" (scene.yaml:5): shadow changed\n",
     0},
    {"a light has moved, and an object", LIT(KEY), SCENE("", ELSEWHERE, FLOOR AWAY),
     "point light (scene.yaml:3): moved\n"
     "object \"ball\" (scene.yaml:6): geometry moved\n"
     "object \"floor\" (scene.yaml:5): shading changed, geometry equal\n"
     "object \"floor\" (scene.yaml:5): shadow changed\n",
     0},
    {"a light has another colour, and an object has moved in its own plane", SCENE("", KEY, FLOOR TILE("2")),
     SCENE("", WARM, FLOOR TILE("2.5")),
     "point light (scene.yaml:3): colour or strength changed\n"
     "object \"tile\" (scene.yaml:6): geometry moved\n"
     "object \"floor\" (scene.yaml:5): shading changed, geometry equal\n"
     "object \"floor\" (scene.yaml:5): shadow changed\n",
     0},
    {"without materials no object is let off", LIT(KEY), LIT(WARM),
     "point light (scene.yaml:3): colour or strength changed\n"
     "object \"floor\" (scene.yaml:5): shading changed, geometry equal\n"
     "object \"ball\" (scene.yaml:6): shading changed, geometry equal\n",
     1 << MONGE_LAYER_MATERIAL},
    {"four objects are told", SCENE("", KEY, FLOOR THREE), SCENE("", WARM, FLOOR THREE),
     "point light (scene.yaml:3): colour or strength changed\n"
     "object \"floor\" (scene.yaml:5): shading changed, geometry equal\n"
     "object \"a\" (scene.yaml:6): shading changed, geometry equal\n"
     "object \"c\" (scene.yaml:8): shading changed, geometry equal\n"
     "object \"b\" (scene.yaml:7): shading changed, geometry equal\n",
     0},
    {"five are summed up", SCENE("", KEY, FLOOR THREE PEARL("d", "1", "red")),
     SCENE("", ELSEWHERE, FLOOR THREE PEARL("d", "1", "red")), "point light (scene.yaml:3): moved\n" SUM("5"),
     0},
    {"shadows too where lights of other colours stand the other way round",
     SCENE("", KEY ", " FILL, FLOOR THREE PEARL("d", "1", "red")),
     SCENE("", "{point: {at: [6, 3, 4], color: [0.3, 0.2, 0.2]}}, " WARM, FLOOR THREE PEARL("d", "1", "red")),
     "point light (scene.yaml:3): colour or strength changed\n"
     "point light (scene.yaml:3): colour or strength changed\n" SUM("5"),
     0},
    {"but no shadow where colours alone have changed, and an object has moved",
     SCENE("", KEY, FLOOR THREE PEARL("d", "1", "red") PEARL("e", "2", "red")),
     SCENE("", WARM, FLOOR THREE PEARL("d", "1", "red") PEARL("e", "2.3", "red")),
     "point light (scene.yaml:3): colour or strength changed\n" /* and of five objects */
     SUM("5") "object \"e\" (scene.yaml:10): geometry moved\nobject \"floor\" (scene.yaml:5): shadow "
              "changed\n",
     0},
    {"but not where materials are not known", SCENE("", KEY, FLOOR THREE PEARL("d", "1", "red")),
     SCENE("", WARM, FLOOR THREE PEARL("d", "1", "red")),
     "point light (scene.yaml:3): colour or strength changed\n"
     "object \"floor\" (scene.yaml:5): shading changed, geometry equal\n"
     "object \"a\" (scene.yaml:6): shading changed, geometry equal\n"
     "object \"d\" (scene.yaml:9): shading changed, geometry equal\n"
     "object \"c\" (scene.yaml:8): shading changed, geometry equal\n"
     "object \"b\" (scene.yaml:7): shading changed, geometry equal\n",
     1 << MONGE_LAYER_MATERIAL},
    {"the background is no object", SCENE("image: {background: black}", KEY, BALLS),
     SCENE("image: {background: navy}", KEY, BALLS), "background: colour changed\n" SUM("5"), 0},
    {"but for one of another material, and one that has moved",
     SCENE("", KEY, FLOOR THREE PEARL("d", "1", "red") PEARL("e", "2", "red") PEARL("f", "3", "red")),
     SCENE("", WARM, FLOOR THREE PEARL("d", "1", "red") PEARL("e", "2", "lime") PEARL("f", "3.1", "red")),
     "point light (scene.yaml:3): colour or strength changed\n" /* and of five objects */
     SUM("5") "object \"e\" (scene.yaml:10): shading changed, geometry equal: another material\n"
              "object \"f\" (scene.yaml:11): geometry moved\n",
     0},
    {"the camera has moved, and a light", LIT(KEY),
     "\ncamera: {eye: [0, 3, 9], look_at: [0, 0.7, 0]}\nlights: [" ELSEWHERE "]\nscene:\n" FLOOR BALL,
     "camera (scene.yaml:2): moved\npoint light (scene.yaml:3): moved\n", 0},
    {"the camera has moved, a light and an object", LIT(KEY),
     "\ncamera: {eye: [0, 3, 9], look_at: [0, 0.7, 0]}\nlights: [" ELSEWHERE "]\nscene:\n" FLOOR LIME,
     "camera (scene.yaml:2): moved\npoint light (scene.yaml:3): moved\n" OTHERS, 0},
    {"the camera has moved, and a setting", SET(""),
     "render: {depth: 1}\ncamera: {eye: [0, 3, 9], look_at: [0, 0.7, 0]}\nlights: [" KEY
     "]\nscene:\n" FLOOR MIRROR,
     "camera (scene.yaml:2): moved\nsettings: depth 5 -> 1\n", 0},

    {"the background, and what mirrors it", SET("image: {background: black}"),
     SET("image: {background: navy}"),
     "background: colour changed\n"
     "object \"mirror\" (scene.yaml:6): shading changed, geometry equal\n",
     0},
    {"the top of the background, which is not seen", SET("image: {background: {bottom: black, top: black}}"),
     SET("image: {background: {bottom: black, top: navy}}"),
     "background: colour changed\n"
     "object \"mirror\" (scene.yaml:6): shading changed, geometry equal\n",
     0},
    {"the depth of rays", SET(""), SET("render: {depth: 1}"),
     "settings: depth 5 -> 1\n"
     "object \"mirror\" (scene.yaml:6): shading changed, geometry equal\n",
     0},
    {"shadows", SET(""), SET("render: {shadow: 0.3}"),
     "settings: shadow 0 -> 0.3\n"
     "object \"floor\" (scene.yaml:5): shading changed, geometry equal\n",
     0},
    {"the shading", SET(""), SET("render: {shading: diffuse}"),
     "settings: shading phong -> diffuse\n"
     "object \"mirror\" (scene.yaml:6): shading changed, geometry equal\n",
     0},
    {"one side, of which nothing is seen", SCENE("", "{point: {at: [0, -5, 5]}}, " AMBIENT, FLOOR BALL),
     SCENE("render: {two_sided: false}", "{point: {at: [0, -5, 5]}}, " AMBIENT, FLOOR BALL),
     "settings: two_sided true -> false\n", 0},
    {"two settings, a light and an object", SET("render: {depth: 2, shadow: 0.1}"),
     SCENE("render: {depth: 3, shadow: 0.2}", WARM, FLOOR MIRROR BALL),
     "point light (scene.yaml:3): colour or strength changed\n"
     "settings: depth 2 -> 3\n"
     "settings: shadow 0.1 -> 0.2\n"
     "object \"ball\" (scene.yaml:7): appeared\n"
     "object \"floor\" (scene.yaml:5): shading changed, geometry equal\n"
     "object \"mirror\" (scene.yaml:6): shading changed, geometry equal\n"
     "object \"floor\" (scene.yaml:5): shadow changed\n",
     0},
};

static void check_row(const struct row *row, uint32_t older_samples, uint32_t newer_samples) {
    const unsigned set = MONGE_LAYERS_ALL & ~row->without;
    struct rendered a = render_samples(row->older, older_samples, set),
                    b = render_samples(row->newer, newer_samples, set);
    static uint8_t differs[PIXELS];
    char got[2000];
    find_differences(&a, &b, differs);
    tell(a.layers, b.layers, differs, got, sizeof got);
    assert_string_equal(got, row->want);
    forget(&a);
    forget(&b);
}

static void test_row(void **state) { check_row(*state, 4, 4); }

static void test_samples(void **state) {
    (void)state;
    check_row(&(struct row){.older = LIT(KEY),
                            .newer = LIT(KEY),
                            .want = "settings: samples 1 -> 4\n" BOTH("ball")},
              1, 4);
}

/* ---- What is not known ---- */

/* A file of an older program tells neither: then each object is told. */
static void test_unknown(void **state) {
    (void)state;
    struct rendered a = render(SET(""), MONGE_LAYERS_ALL),
                    b = render(SCENE("render: {depth: 1}", WARM, FLOOR MIRROR), MONGE_LAYERS_ALL);
    static uint8_t differs[PIXELS];
    char got[2000];
    find_differences(&a, &b, differs);
    for (int side = 0; side < 2; side++) {
        struct layer_conditions *c = &(side ? &b : &a)->layers->conditions, kept = *c;
        *c = (struct layer_conditions){.lights = NULL};
        tell(a.layers, b.layers, differs, got, sizeof got);
        assert_string_equal(got, "object \"floor\" (scene.yaml:5): shading changed, geometry equal\n"
                                 "object \"mirror\" (scene.yaml:6): shading changed, geometry equal\n");
        c->settings = kept.settings; /* and of the settings alone, that of which both tell */
        c->setting_count = 6;
        tell(a.layers, b.layers, differs, got, sizeof got);
        assert_string_equal(got, "settings: depth 5 -> 1\n" BOTH("mirror"));
        *c = kept;
    }
    forget(&a);
    forget(&b);
}

/* What another program rounds is no change. */
static void test_tolerance(void **state) {
    (void)state;
    static const struct {
        double by;
        bool changed;
    } cases[] = {{0, false}, {1e-11, false}, {1e-6, true}, {-1e-6, true}};
    for (size_t k = 0; k < COUNT(cases); k++)
        for (int color = 0; color < 2; color++) {
            struct arena arena = {0};
            struct layer_light lights[2] = {{{.kind = "point light"}, {3, 4, 5}, {1, 1, 1}}};
            lights[1] = lights[0];
            *(color ? &lights[1].color.x : &lights[1].at.x) += cases[k].by;
            const struct layer_conditions a = {.lights = &lights[0], .light_count = 1},
                                          b = {.lights = &lights[1], .light_count = 1};
            const struct conditions_change c = conditions_change(&a, &b, &arena);
            assert_int_equal(c.count, cases[k].changed);
            if (c.count)
                assert_int_equal(c.list[0].kind, color ? MONGE_CHANGE_LIGHT_COLOR : MONGE_CHANGE_LIGHT_PLACE);
            arena_free(&arena);
        }
}

/* ---- Where, and how many ---- */

static void test_pixels(void **state) {
    (void)state;
    struct rendered a = render(SCENE("", KEY, FLOOR BALL THREE), MONGE_LAYERS_ALL),
                    b = render(SCENE("", WARM, FLOOR BALL THREE), MONGE_LAYERS_ALL);
    static uint8_t differs[PIXELS];
    uint32_t count_of = 0, left = 96, top = 72, right = 0, bottom = 0;
    struct monge_change changes[2] = {{.kind = MONGE_CHANGES}, {.kind = MONGE_CHANGES}};
    size_t count = 0;
    find_differences(&a, &b, differs);
    for (uint32_t i = 0; i < PIXELS; i++) {
        if (!differs[i]) continue;
        count_of++;
        left = i % 96 < left ? i % 96 : left, right = i % 96 > right ? i % 96 : right;
        top = i / 96 < top ? i / 96 : top, bottom = i / 96;
    }
    assert_true(changes_find(a.layers, b.layers, differs, changes, 1, &count));
    assert_int_equal(count, 2);
    assert_int_equal(changes[1].kind, MONGE_CHANGES); /* no room */
    assert_true(changes_find(a.layers, b.layers, differs, changes, 2, &count));
    for (int i = 0; i < 2; i++) {
        const struct monge_region r = changes[i].bounds;
        assert_int_equal(changes[i].kind, i == 0 ? MONGE_CHANGE_LIGHT_COLOR : MONGE_CHANGE_FOLLOWING);
        assert_int_equal(changes[i].pixels, count_of);
        assert_true(r.x == left && r.y == top && r.width == right - left + 1 && r.height == bottom - top + 1);
    }
    assert_string_equal(changes[0].object->kind, "point light");
    assert_int_equal(changes[1].objects, 5);
    forget(&a);
    forget(&b);
}

/* ---- In the layers ---- */

static void test_conditions(void **state) {
    (void)state;
    static const char *const settings[][2] = {
        {"samples", "4"},       {"bits", "16"},
        {"encoding", "linear"}, {"background", "bottom [0, 0.25, 1], top [0, 0.25, 1]"},
        {"shading", "diffuse"}, {"depth", "3"},
        {"shadow", "0.1"},      {"two_sided", "false"},
        {"highlight", "always"}};
    struct rendered r =
        render("image: {bits: 16, encoding: linear, background: [0, 0.25, 1]}\nlights:\n  - ambient: {color: "
               "[0.1, 0, 1]}\n"
               "  - point: {at: [1, 2, 3]}\nscene: [sphere: {}]\n"
               "render: {shading: diffuse, depth: 3, shadow: 0.1, two_sided: false, highlight: always}\n",
               1 << MONGE_LAYER_OBJECT);
    const struct layer_conditions *c = &r.layers->conditions;
    assert_int_equal(c->light_count, 2);
    assert_string_equal(c->lights[0].entry.kind, "ambient light");
    assert_vec3_near(c->lights[0].color, (vec3){0.1, 0, 1}, 0, "colour");
    assert_int_equal(c->lights[0].entry.line, 3);
    assert_int_equal(c->lights[0].entry.column, 5);
    assert_string_equal(c->lights[1].entry.kind, "point light");
    assert_vec3_near(c->lights[1].at, (vec3){1, 2, 3}, 0, "place");
    assert_vec3_near(c->lights[1].color, (vec3){1, 1, 1}, 0, "colour");
    assert_string_equal(c->lights[1].entry.file, "scene.yaml");
    assert_int_equal(c->setting_count, COUNT(settings));
    for (size_t i = 0; i < COUNT(settings); i++) {
        assert_string_equal(c->settings[i].name, settings[i][0]);
        assert_string_equal(c->settings[i].value, settings[i][1]);
    }
    forget(&r);
}

/* Of more lights than a file may have none is told. */
static void test_many_lights(void **state) {
    (void)state;
    for (int count = 500; count <= 501; count++) {
        char text[200];
        snprintf(text, sizeof text, "lights: [{for: {i: %d}, point: {at: [i, 9, 9]}}]\nscene: [sphere: {}]\n",
                 count);
        struct rendered r = render_samples(text, 1, 1 << MONGE_LAYER_OBJECT);
        assert_int_equal(r.layers->conditions.lights != NULL, count == 500);
        assert_int_equal(r.layers->conditions.light_count, count == 500 ? 500 : 0);
        assert_non_null(r.layers->conditions.settings);
        forget(&r);
    }
}

static struct monge_layers *write_and_read(const struct monge_layers *layers) {
    struct monge_diagnostics *diag = monge_diagnostics_new();
    for (enum monge_layer layer = MONGE_LAYER_OBJECT; layer <= MONGE_LAYER_MATERIAL; layer++) {
        char path[100];
        monge_layer_path(layer, "king.png", path, sizeof path);
        assert_true(monge_layer_write(layers, layer, path, diag));
    }
    struct monge_layers *again =
        monge_layers_read("king.png", 1 << MONGE_LAYER_OBJECT | 1 << MONGE_LAYER_MATERIAL, diag);
    monge_diagnostics_print(diag, stdout);
    assert_non_null(again);
    monge_diagnostics_free(diag);
    return again;
}

static void assert_same_conditions(const struct layer_conditions *a, const struct layer_conditions *b) {
    assert_int_equal(a->light_count, b->light_count);
    assert_int_equal(a->setting_count, b->setting_count);
    for (uint32_t i = 0; i < a->light_count; i++) {
        const struct monge_entry *p = &a->lights[i].entry, *q = &b->lights[i].entry;
        assert_memory_equal(&a->lights[i].at, &b->lights[i].at, sizeof(vec3));
        assert_memory_equal(&a->lights[i].color, &b->lights[i].color, sizeof(vec3));
        assert_string_equal(p->kind, q->kind);
        assert_string_equal(p->file ? p->file : "none", q->file ? q->file : "none");
        assert_int_equal(p->line, q->line);
        assert_int_equal(p->column, q->column);
    }
    for (uint32_t i = 0; i < a->setting_count; i++) {
        assert_string_equal(a->settings[i].name, b->settings[i].name);
        assert_string_equal(a->settings[i].value, b->settings[i].value);
    }
}

static void test_files(void **state) {
    (void)state;
    static const char *const texts[] = {
        LIT(RING("0.1") ", " AMBIENT), LIT(""), "scene:\n" BALL,
        "lights: [{for: {i: 500}, point: {at: [sin(i), 9, cos(i)], color: [sin(i)^2, 1 / (i + 1), 0.1]}}]\n"
        "scene: [sphere: {}]\n"};
    for (size_t i = 0; i < COUNT(texts); i++) {
        struct rendered r = render_samples(texts[i], 1, MONGE_LAYERS_ALL);
        struct monge_layers *again = write_and_read(r.layers);
        assert_non_null(again->conditions.lights);
        assert_same_conditions(&r.layers->conditions, &again->conditions);
        assert_string_equal(again->entries[MONGE_LAYER_MATERIAL].list[0].hash,
                            r.layers->entries[MONGE_LAYER_MATERIAL].list[0].hash);
        assert_string_equal(again->camera.objects, r.layers->camera.objects);
        monge_layers_free(again);
        forget(&r);
    }
}

/* ---- Texts ---- */

static void test_light_texts(void **state) {
    (void)state;
    static const struct {
        const char *text;
        int count; /* -1: wrong */
    } texts[] = {
        {"[]", 0},
        {" [ ]\n", 0},
        {"[{\"kind\": \"x\"}]", 1},
        {"[{\"kind\": \"x\", \"at\": [1, -2.5e-3, 3], \"color\": [1, 2, 3], \"new\": 3, \"newer\": \"x\", "
         "\"line\": 7, \"file\": null}, {\"kind\": \"y\"} ]",
         2},
        {"", -1},
        {"{}", -1},
        {"[", -1},
        {"[{}]", -1},
        {"[{\"kind\": null}]", -1},
        {"[{\"kind\": \"x\"},]", -1},
        {"[{\"kind\": \"x\"}] x", -1},
        {"[{\"kind\": \"x\", \"at\": [1, 2]}]", -1},
        {"[{\"kind\": \"x\", \"at\": [1, 2, inf]}]", -1},
        {"[{\"kind\": \"x\", \"color\": [1, 2, nan]}]", -1},
        {"[{\"kind\": \"x\", \"color\": \"red\"}]", -1},
        {"[{\"kind\": \"x\", \"at\": [1, 2, 3]", -1},
    };
    for (size_t i = 0; i < COUNT(texts); i++) {
        struct arena arena = {0};
        struct layer_conditions c = {.light_count = 9};
        const bool good = layer_lights_read(texts[i].text, &arena, &c);
        if (good != (texts[i].count >= 0)) fail_msg("%s: read: %d", texts[i].text, good);
        assert_int_equal(c.lights != NULL, good);
        assert_int_equal(c.light_count, good ? texts[i].count : 0);
        if (i == 3) {
            assert_vec3_near(c.lights[0].at, (vec3){1, -2.5e-3, 3}, 0, "place");
            assert_vec3_near(c.lights[0].color, (vec3){1, 2, 3}, 0, "colour");
            assert_int_equal(c.lights[0].entry.line, 7);
        }
        arena_free(&arena);
    }
}

static void test_setting_texts(void **state) {
    (void)state;
    static const struct {
        const char *text;
        int count; /* -1: wrong */
    } texts[] = {
        {"{\"depth\": \"5\"}", 1},
        {" { \"depth\" : \"5\" , \"new\": \"a\\n\" }\n", 2},
        {"", -1},
        {"{}", -1},
        {"[]", -1},
        {"{\"depth\": 5}", -1},
        {"{\"depth\": null}", -1},
        {"{null: \"5\"}", -1},
        {"{\"depth\": \"5\",}", -1},
        {"{\"depth\": \"5\"} x", -1},
        {"{\"depth\" \"5\"}", -1},
        {"{\"depth\": \"5", -1},
        {"{\"depth\": \"5\"", -1},
    };
    for (size_t i = 0; i < COUNT(texts); i++) {
        struct arena arena = {0};
        struct layer_conditions c = {.setting_count = 9};
        const bool good = layer_settings_read(texts[i].text, &arena, &c);
        if (good != (texts[i].count >= 0)) fail_msg("%s: read: %d", texts[i].text, good);
        assert_int_equal(c.settings != NULL, good);
        assert_int_equal(c.setting_count, good ? texts[i].count : 0);
        arena_free(&arena);
    }
}

/* One item after the first, `count` in all. To be freed. */
static char *repeat(const char *open, const char *item, int count, const char *close) {
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    fputs(open, out);
    for (int i = 0; i < count; i++) fprintf(out, "%s%s", i ? ", " : "", item);
    fputs(close, out);
    fclose(out);
    return text;
}

static void test_long_texts(void **state) {
    (void)state;
    for (int over = 0; over < 2; over++) {
        struct arena arena = {0};
        struct layer_conditions c = {.lights = NULL};
        char *lights = repeat("[", "{\"kind\": \"x\"}", 500 + over, "]"),
             *settings = repeat("{", "\"a\": \"1\"", 64 + over, "}");
        assert_int_equal(layer_lights_read(lights, &arena, &c), !over);
        assert_int_equal(layer_settings_read(settings, &arena, &c), !over);
        free(lights);
        free(settings);
        arena_free(&arena);
    }
}

/* Names and values come from files. */
static void test_terminal(void **state) {
    (void)state;
    const struct monge_change change = {
        .kind = MONGE_CHANGE_SETTING, .setting = "a\033[31m", .older = "1\n", .newer = "\xc2\x9b\x7f"};
    char text[100], cut[6];
    monge_change_text(&change, text, sizeof text);
    assert_string_equal(text, "settings: a [31m 1  ->    ");
    assert_int_equal(monge_change_text(&change, cut, sizeof cut), strlen(text));
    assert_string_equal(cut, "setti");
}

int main(void) {
    struct CMUnitTest tests[COUNT(rows) + 16];
    size_t count = 0;
    for (size_t i = 0; i < COUNT(rows); i++)
        tests[count++] = (struct CMUnitTest){rows[i].name, test_row, NULL, NULL, &rows[i]};
    const struct CMUnitTest others[] = {
        cmocka_unit_test(test_samples),
        cmocka_unit_test(test_unknown),
        cmocka_unit_test(test_tolerance),
        cmocka_unit_test(test_pixels),
        cmocka_unit_test(test_conditions),
        cmocka_unit_test(test_many_lights),
        cmocka_unit_test(test_light_texts),
        cmocka_unit_test(test_setting_texts),
        cmocka_unit_test(test_long_texts),
        cmocka_unit_test(test_terminal),
        cmocka_unit_test_setup_teardown(test_files, enter_folder, leave_folder)};
    for (size_t i = 0; i < COUNT(others); i++) tests[count++] = others[i];
    return _cmocka_run_group_tests("conditions_change", tests, count, NULL, NULL);
}
