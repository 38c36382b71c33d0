/* Values of every type of the grammar: what is taken and as what, and what is refused. The texts of
 * the refusals are in tests/errors/; here is that there is exactly one. */
#include <locale.h>
#include <string.h>

#include "loading.h"

struct checked {
    struct lang_memory memory;
    struct diagnostics diag;
    struct collected objects;
    const struct object_value *file;
};

/* Beside what was checked before. */
static void check_after(struct checked *c, const char *text) {
    const struct lang_sink sink = collecting_sink(&c->objects);
    struct lang_input input = loading_input(&c->memory, text, &sink);
    input.limits.values = 10000000;
    c->file = lang_read(&c->memory, &c->diag, &input).file;
}

static void check_text_as_scene(struct checked *c, const char *text) {
    *c = (struct checked){0};
    check_after(c, text);
}

static void checked_free(struct checked *c) {
    lang_memory_free(&c->memory);
    arena_free(&c->objects.arena);
    diag_free(&c->diag);
}

static void fail_with_messages(const struct checked *c, const char *text) {
    printf("%s\n", text);
    diag_print(&c->diag, stdout);
    fail_msg("%u errors", c->diag.errors);
}

/* ---- Single values: `text` stands in place of the @ ---- */

#define NUMBER    "scene: [{square: {size: @}}]"
#define SIGNED    "scene: [{quadric: {xx: @}}]"
#define INTEGER   "image: {samples: @}\nscene: []"
#define BOOLEAN   "scene: [{cone: {open: @}}]"
#define CHOICE    "render: {shading: @}\nscene: []"
#define TEXT      "scene: [{sphere: {}, name: @}]"
#define POINT     "scene: [{sphere: {center: @}}]"
#define DIRECTION "scene: [{plane: {normal: @}}]"
#define FACTORS   "scene: [{sphere: {}, transform: {scale: @}}]"
#define COLOR     "lights: [{ambient: {color: @}}]\nscene: []"
#define SIZE      "image: {size: @}\nscene: []"
#define AMOUNT    "scene: [{sphere: {}, material: {reflection: @}}]"

/* The value in the form above, as three numbers. */
static vec3 value_in(const struct checked *c, const char *form) {
    const struct object_value *file = c->file, *node = c->objects.items[0];
    if (strcmp(form, COLOR) == 0)
        return object_vec3(object_object(object_list(file, KEY_FILE_LIGHTS).items[0], KEY_LIGHT_AMBIENT),
                           KEY_AMBIENT_LIGHT_COLOR);
    if (strcmp(form, SIZE) == 0) return object_vec3(object_object(file, KEY_FILE_IMAGE), KEY_IMAGE_SIZE);
    if (strcmp(form, INTEGER) == 0)
        return vec3_all(object_number(object_object(file, KEY_FILE_IMAGE), KEY_IMAGE_SAMPLES));
    if (strcmp(form, CHOICE) == 0)
        return vec3_all(object_choice(object_object(file, KEY_FILE_RENDER), KEY_RENDER_SHADING));
    if (strcmp(form, NUMBER) == 0)
        return vec3_all(object_number(object_object(node, KEY_OBJECT_SQUARE), KEY_SQUARE_SIZE));
    if (strcmp(form, SIGNED) == 0)
        return vec3_all(object_number(object_object(node, KEY_OBJECT_QUADRIC), KEY_QUADRIC_XX));
    if (strcmp(form, BOOLEAN) == 0)
        return vec3_all(object_choice(object_object(node, KEY_OBJECT_CONE), KEY_CONE_OPEN));
    if (strcmp(form, POINT) == 0)
        return object_vec3(object_object(node, KEY_OBJECT_SPHERE), KEY_SPHERE_CENTER);
    if (strcmp(form, DIRECTION) == 0)
        return object_vec3(object_object(node, KEY_OBJECT_PLANE), KEY_PLANE_NORMAL);
    if (strcmp(form, AMOUNT) == 0)
        return object_vec3(object_object(node, KEY_OBJECT_MATERIAL), KEY_MATERIAL_REFLECTION);
    if (strcmp(form, FACTORS) == 0)
        return object_vec3(object_list(node, KEY_OBJECT_TRANSFORM).items[0], KEY_STEP_SCALE);
    assert_string_equal(form, TEXT);
    return vec3_all((double)strlen(object_text(node, KEY_OBJECT_NAME)));
}

static struct row {
    const char *form, *text;
    vec3 want; /* x NAN: an error */
} rows[] = {
#define WRONG                                                                                                \
    { NAN, 0, 0 }
    {NUMBER, "1", {1, 1, 1}},
    {NUMBER, "0.5", {.5, .5, .5}},
    {NUMBER, ".5", {.5, .5, .5}},
    {NUMBER, "5.", {5, 5, 5}},
    {NUMBER, "+2", {2, 2, 2}},
    {NUMBER, "1e3", {1000, 1000, 1000}},
    {NUMBER, "1E-2", {.01, .01, .01}},
    {NUMBER, "1.5e+2", {150, 150, 150}},
    {NUMBER, "\"2\"", {2, 2, 2}},
    {NUMBER, "0.1", {0.1, 0.1, 0.1}},
    {NUMBER, "1e-310", {1e-310, 1e-310, 1e-310}},
    {NUMBER,
     "1.7976931348623157e308",
     {1.7976931348623157e308, 1.7976931348623157e308, 1.7976931348623157e308}},
    {NUMBER, "0", WRONG},
    {NUMBER, "-1", WRONG},
    {NUMBER, "-0.0", WRONG},
    {NUMBER, "1e-400", WRONG},
    {NUMBER, "1e309", WRONG},
    {SIGNED, ".", WRONG},
    {SIGNED, "+", WRONG},
    {SIGNED, "'-'", WRONG},
    {SIGNED, "'-.'", WRONG},
    {SIGNED, "e5", WRONG},
    {SIGNED, ".e5", WRONG},
    {NUMBER, "1e", WRONG},
    {NUMBER, "1e+", WRONG},
    {NUMBER, "1.2.3", WRONG},
    {NUMBER, "--1", {1, 1, 1}},
    {NUMBER, "0x10", WRONG},
    {NUMBER, "0x1p3", WRONG},
    {NUMBER, "inf", WRONG},
    {NUMBER, "nan", WRONG},
    {NUMBER, ".inf", WRONG},
    {NUMBER, "1_000", WRONG},
    {NUMBER, "010", WRONG},
    {NUMBER, "' 1'", {1, 1, 1}},
    {NUMBER, "1 2", WRONG},
    {NUMBER, "true", WRONG},
    {NUMBER, "[1]", WRONG},
    {NUMBER, "{}", WRONG},
    {NUMBER, "~", WRONG},
    {NUMBER, "''", WRONG},
    {SIGNED, "-1", {-1, -1, -1}},
    {SIGNED, "-.5e1", {-5, -5, -5}},
    {SIGNED, "-0", {-0.0, -0.0, -0.0}},
    {SIGNED, "-07", WRONG},
    {INTEGER, "1", {1, 1, 1}},
    {INTEGER, "16", {16, 16, 16}},
    {INTEGER, "4.0", {4, 4, 4}},
    {INTEGER, "1e2", {100, 100, 100}},
    {INTEGER, "65536", {65536, 65536, 65536}},
    {INTEGER, "65537", WRONG},
    {INTEGER, "0", WRONG},
    {INTEGER, "2.5", WRONG},
    {INTEGER, "-4", WRONG},
    {INTEGER, "1e300", WRONG},
    {INTEGER, "many", WRONG},
    {BOOLEAN, "true", {1, 1, 1}},
    {BOOLEAN, "false", {0, 0, 0}},
    {BOOLEAN, "yes", WRONG},
    {BOOLEAN, "True", WRONG},
    {BOOLEAN, "1", WRONG},
    {BOOLEAN, "[]", WRONG},
    {CHOICE, "phong", {0, 0, 0}},
    {CHOICE, "diffuse", {1, 1, 1}},
    {CHOICE, "'signature'", {2, 2, 2}},
    {CHOICE, "Phong", WRONG},
    {CHOICE, "[phong]", WRONG},
    {CHOICE, "''", WRONG},
    {TEXT, "ball", {4, 4, 4}},
    {TEXT, "5", {1, 1, 1}},
    {TEXT, "\"a b\"", {3, 3, 3}},
    {TEXT, "''", WRONG},
    {TEXT, "[a]", WRONG},
    {POINT, "[1, 2, 3]", {1, 2, 3}},
    {POINT, "[-1.5, 0, 1e2]", {-1.5, 0, 100}},
    {POINT, "[0, 0, 0]", {0, 0, 0}},
    {POINT, "[1, 2]", WRONG},
    {POINT, "[1, 2, 3, 4]", WRONG},
    {POINT, "[]", WRONG},
    {POINT, "1", WRONG},
    {POINT, "{x: 1}", WRONG},
    {POINT, "[1, [2], 3]", WRONG},
    {DIRECTION, "[0, 0, -2]", {0, 0, -2}},
    {DIRECTION, "[1e-300, 0, 0]", {1e-300, 0, 0}},
    {DIRECTION, "[0, 0, 0]", WRONG},
    {DIRECTION, "[0, -0, 0.0]", WRONG},
    {FACTORS, "2", {2, 2, 2}},
    {FACTORS, "-2", {-2, -2, -2}},
    {FACTORS, "[1, -2, 3]", {1, -2, 3}},
    {FACTORS, "[1, 2]", WRONG},
    {FACTORS, "x", WRONG},
    {COLOR, "[0.1, 0.2, 3]", {0.1, 0.2, 3}},
    {COLOR, "black", {0, 0, 0}},
    {COLOR, "white", {1, 1, 1}},
    {COLOR, "'#fff'", {1, 1, 1}},
    {COLOR, "'#FFFFFF'", {1, 1, 1}},
    {COLOR, "red", {1, 0, 0}},
    {COLOR, "ReD", {1, 0, 0}},
    {COLOR, "'#f00'", {1, 0, 0}},
    {COLOR, "'#00ff00'", {0, 1, 0}},
    {COLOR, "'#808080'", {0.21586050011389923, 0.21586050011389923, 0.21586050011389923}},
    {COLOR, "gray", {0.21586050011389923, 0.21586050011389923, 0.21586050011389923}},
    {COLOR, "'#0a0a0a'", {0.0030352698354883752, 0.0030352698354883752, 0.0030352698354883752}},
    {COLOR, "'#888'", {0.24620132670783548, 0.24620132670783548, 0.24620132670783548}},
    {COLOR, "gold", {1, 0.6795424696330938, 0}},
    {COLOR, "rebeccapurple", {0.13286832155381798, 0.033104766570885055, 0.31854677812509186}},
    {COLOR, "[-0.1, 0, 0]", WRONG},
    {COLOR, "[1, 1]", WRONG},
    {COLOR, "0.5", WRONG},
    {COLOR, "'#ff'", WRONG},
    {COLOR, "'#ggg'", WRONG},
    {COLOR, "'#'", WRONG},
    {COLOR, "'#ff00ff00'", WRONG},
    {COLOR, "golden", WRONG},
    {COLOR, "{r: 1}", WRONG},
    {COLOR, "''", WRONG},
    {COLOR, "transparent", WRONG},
    {COLOR, "[a, 0, 0]", WRONG},
    {AMOUNT, "0.25", {.25, .25, .25}},
    {AMOUNT, "0", {0, 0, 0}},
    {AMOUNT, "1", {1, 1, 1}},
    {AMOUNT, "[0.1, 0.2, 0.3]", {.1, .2, .3}},
    {AMOUNT, "red", {1, 0, 0}},
    {AMOUNT, "1.1", WRONG},
    {AMOUNT, "-0.1", WRONG},
    {AMOUNT, "[0.5, 1.5, 0]", WRONG},
    {AMOUNT, "half", WRONG},
    {AMOUNT, "{}", WRONG},
    {AMOUNT, "[255, 0, 0]", WRONG},
    {SIZE, "[1, 1]", {1, 1, 0}},
    {SIZE, "[1920, 1080]", {1920, 1080, 0}},
    {SIZE, "[65535, 1]", {65535, 1, 0}},
    {SIZE, "[0, 1]", WRONG},
    {SIZE, "[1, 65536]", WRONG},
    {SIZE, "[1.5, 1]", WRONG},
    {SIZE, "[1]", WRONG},
    {SIZE, "640", WRONG},
    {SIZE, "[1, 2, 3]", WRONG},
};

static void check_row(void **state) {
    const struct row *row = *state;
    char text[400];
    const int before = (int)(strchr(row->form, '@') - row->form);
    snprintf(text, sizeof text, "%.*s%s%s", before, row->form, row->text, row->form + before + 1);
    struct checked c;
    check_text_as_scene(&c, text);
    const bool wrong = isnan(row->want.x);
    if (c.diag.errors != wrong || !c.file || c.file->failed != wrong) fail_with_messages(&c, text);
    if (!wrong) {
        const vec3 got = value_in(&c, row->form);
        assert_near(got.x, row->want.x, 1e-15 * fabs(row->want.x), "x");
        assert_near(got.y, row->want.y, 1e-15 * fabs(row->want.y), "y");
        assert_near(got.z, row->want.z, 1e-15 * fabs(row->want.z), "z");
    }
    checked_free(&c);
}

/* ---- Whole files: how many errors and warnings ---- */

static struct scene_row {
    const char *name, *text;
    unsigned errors, warnings;
} scene_rows[] = {
    {"one sphere", "scene: [{sphere: {}}]", 0, 0},
    {"nothing but the scene", "scene: []", 0, 0},
    {"no scene", "monge: 1", 1, 0},
    {"no mapping", "[1, 2]", 1, 0},
    {"every unknown key", "scene: []\nfoo: 1\nbar: 2\nbaz: 3", 3, 0},
    {"a key twice, and thrice", "scene: []\nmonge: 1\nmonge: 1\nmonge: 1", 2, 0},
    {"twice and unknown", "scene: []\nquux: 1\nquux: 1", 2, 0},
    {"errors in every item", "scene: [{sphere: {radius: 0}}, {sphere: {radius: -1}}, {box: 3}, 4]", 4, 0},
    {"errors in groups", "scene: [{group: [{group: [{sphere: {r: 1}}]}, {disc: {radius: a}}]}]", 2, 0},
    {"a misspelt key is checked as what was meant", "scen: [{spere: {raduis: x}}]", 4, 0},
    {"but not where that is given too", "scene: []\nscen: [{spere: {raduis: x}}]", 1, 0},
    {"nor twice", "scene: []\ncamra: {fov: 0}\ncamea: {fov: 0}", 3, 0},
    {"a key of another kind is reported alone", "scene: []\nfov: 0", 1, 0},
    {"a required key under another name is reported once", "objects: [{sphere: {}}]", 1, 0},
    {"a shape in place of the scene is reported once", "sphere: {}", 1, 0},
    {"a companion under another name is reported once",
     "scene: [{sphere: {}, transform: {rotate: {axis: [1, 0, 0], deg: 3}}}]", 1, 0},
    {"materials before their use", "materials: {gold: {}}\nscene: [{sphere: {}, material: gold}]", 0, 0},
    {"materials after their use", "scene: [{sphere: {}, material: gold}]\nmaterials: {gold: {}}", 0, 0},
    {"no such material",
     "materials: {gold: {}}\nscene: [{sphere: {}, material: gild}, {box: {}, material: gold}]", 1, 0},
    {"a broken material is known", "materials: {gold: 5}\nscene: [{sphere: {}, material: gold}]", 1, 0},
    {"broken materials are not asked for names", "materials: 5\nscene: [{sphere: {}, material: gold}]", 1, 0},
    {"materials without a value are not asked for names", "materials:\nscene: [{sphere: {}, material: gold}]",
     1, 0},
    {"misspelt materials are known", "material: {gold: {}}\nscene: [{sphere: {}, material: gold}]", 1, 0},
    {"a material defined twice", "materials: {gold: {}, gold: {}}\nscene: [{sphere: {}, material: gold}]", 1,
     0},
    {"a material never used", "materials: {gold: {}, jade: {}}\nscene: [{sphere: {}, material: gold}]", 0, 1},
    {"no such warning beside an error",
     "materials: {gold: {}, jade: {}}\nscene: [{sphere: {r: 1}, material: gold}]", 1, 0},
    {"two shapes in one object", "scene: [{sphere: {}, box: {}}]", 1, 0},
    {"three shapes in one object", "scene: [{sphere: {}, box: {}, cone: {}}]", 2, 0},
    {"no shape", "scene: [{}]", 1, 0},
    {"an unknown shape is reported once", "scene: [{torus: {}}]", 1, 0},
    {"a later word", "scene: [{ellipsoid: {}}]", 1, 0},
    {"later words", "scene: [{saddle: {}}, {frustum: {}}]", 2, 0},
    {"a loop without variables", "scene: [{for: x, when: y, sphere: {}}]", 1, 0},
    {"both of two that exclude each other", "camera: {look_at: [0, 0, 1], direction: [0, 0, 1]}\nscene: []",
     1, 0},
    {"an angle without an axis", "scene: [{sphere: {}, transform: {rotate: {angle: 3}}}]", 1, 0},
    {"an axis without an angle", "scene: [{sphere: {}, transform: {rotate: {axis: [1, 0, 0]}}}]", 1, 0},
    {"the same error behind aliases counts once", "scene: [{sphere: &s {r: 1}}, {sphere: *s}, {sphere: *s}]",
     1, 0},
    {"an alias of another kind", "scene: [{sphere: &s {radius: 1}}, {box: *s}]", 1, 0},
    {"a merged mapping of another kind", "scene: [{sphere: &s {radius: 1}}, {box: {<<: *s}}]", 1, 0},
    {"what is written wins over what is merged, errors too",
     "scene: [{sphere: &s {radius: 2}}, {sphere: {<<: *s, radius: 3}}]", 0, 0},
    {"an over-bright material is a warning", "scene: [{sphere: {}, material: {diffuse: [2, 0, 0]}}]", 0, 1},
    {"an over-bright light is not", "lights: [{ambient: {color: [2, 0, 0]}}]\nscene: []", 0, 0},
};

static void check_scene_row(void **state) {
    const struct scene_row *row = *state;
    struct checked c;
    check_text_as_scene(&c, row->text);
    if (c.diag.errors != row->errors || c.diag.warnings != row->warnings) fail_with_messages(&c, row->text);
    if (c.file) assert_int_equal(c.file->failed, row->errors > 0);
    checked_free(&c);
}

/* ---- Spans and accessors ---- */

static void every_value_keeps_its_place(void **state) {
    (void)state;
    struct checked c;
    check_text_as_scene(&c, "scene:\n  - sphere:\n      radius: 2\n    name: ball\n");
    const struct object_value *node = c.objects.items[0], *sphere = object_object(node, KEY_OBJECT_SPHERE);
    const struct span radius = object_span(sphere, KEY_SPHERE_RADIUS),
                      whole = object_span(sphere, KEY_SPHERE_CENTER);
    assert_int_equal(radius.line, 2);
    assert_int_equal(radius.column, 14);
    assert_int_equal(whole.line, 2); /* of the object, where the key is not given */
    assert_int_equal(whole.column, 6);
    assert_true(object_has(sphere, KEY_SPHERE_RADIUS));
    assert_false(object_has(sphere, KEY_SPHERE_CENTER));
    assert_int_equal(object_alternative(node), KEY_OBJECT_SPHERE);
    assert_null(object_text(node, KEY_OBJECT_MATERIAL));
    assert_null(object_object(node, KEY_OBJECT_MATERIAL));
    assert_int_equal(object_list(node, KEY_OBJECT_TRANSFORM).count, 0);
    assert_null(object_matrix(node, KEY_OBJECT_TRANSFORM));
    checked_free(&c);
}

static void errors_of_an_earlier_load_are_not_those_of_this_one(void **state) {
    (void)state;
    struct checked c;
    check_text_as_scene(&c, "scene: 5");
    struct lang_memory first = c.memory;
    c.memory = (struct lang_memory){0};
    check_after(&c, "materials: {gold: {}}\nscene: []");
    assert_false(c.file->failed);
    assert_int_equal(c.diag.errors, 1);
    assert_int_equal(c.diag.warnings, 1);
    lang_memory_free(&first);
    checked_free(&c);
}

/* A program may have a locale with a decimal comma. */
static void a_point_is_a_point_in_every_locale(void **state) {
    (void)state;
    const char *const names[] = {"de_DE.UTF-8", "de_DE.utf8", "de_DE", "fr_FR.UTF-8", "fr_FR.utf8"};
    const char *set = NULL;
    for (size_t i = 0; i < COUNT(names) && !set; i++) set = setlocale(LC_NUMERIC, names[i]);
    if (!set) skip();
    struct checked c;
    check_text_as_scene(&c, "scene: [{square: {size: 12.75e1}}]");
    setlocale(LC_NUMERIC, "C");
    assert_true(value_in(&c, NUMBER).x == 127.5);
    checked_free(&c);
}

/* They cost no memory but that of the text's nodes. */
static void mistakes_past_the_kept_ones_are_counted(void **state) {
    (void)state;
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    fputs("scene: [{sphere: {}", out);
    for (int i = 0; i < 100000; i++) fprintf(out, ", k%d: 1, sphere: x", i);
    fputs("}]", out);
    fclose(out);
    struct checked c;
    check_text_as_scene(&c, text);
    assert_int_equal(c.diag.errors, 200000);
    assert_int_equal(c.diag.kept, DIAG_MAX_KEPT);
    assert_true(c.diag.arena.total < 300000);
    assert_true(c.memory.nodes.total < 100 << 20); /* the nodes, and no texts */
    checked_free(&c);
    free(text);
}

int main(void) {
    struct CMUnitTest tests[COUNT(rows) + COUNT(scene_rows)];
    char names[COUNT(rows)][64];
    size_t n = 0;
    for (size_t i = 0; i < COUNT(rows); i++) {
        snprintf(names[i], sizeof names[i], "%.20s... %s", rows[i].form, rows[i].text);
        for (char *c = names[i]; *c; c++)
            if (*c == '\n' || *c == '#') *c = ' ';
        tests[n++] = (struct CMUnitTest){names[i], check_row, NULL, NULL, &rows[i]};
    }
    for (size_t i = 0; i < COUNT(scene_rows); i++)
        tests[n++] = (struct CMUnitTest){scene_rows[i].name, check_scene_row, NULL, NULL, &scene_rows[i]};
    const struct CMUnitTest others[] = {
        cmocka_unit_test(every_value_keeps_its_place),
        cmocka_unit_test(errors_of_an_earlier_load_are_not_those_of_this_one),
        cmocka_unit_test(a_point_is_a_point_in_every_locale),
        cmocka_unit_test(mistakes_past_the_kept_ones_are_counted),
    };
    return cmocka_run_group_tests_name("values", tests, NULL, NULL) +
           cmocka_run_group_tests_name("check", others, NULL, NULL);
}
