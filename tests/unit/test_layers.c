/* Layers in closed form, where every pixel can be told by hand; and their files. */
#include <math.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "folder.h"
#include "image/layer_table.h"
#include "image/pfm.h"
#include "monge.h"
#include "near.h"
#include "render/layers.h"

/* ---- Rendering ---- */

static struct monge_layers *render(const char *text, uint32_t width, uint32_t height,
                                   const struct monge_region *region, const struct monge_job *job) {
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_scene *scene = monge_load_memory("scene.yaml", text, strlen(text), NULL, diag);
    monge_diagnostics_print(diag, stdout);
    assert_non_null(scene);
    struct monge_settings settings = monge_scene_settings(scene);
    settings.width = width;
    settings.height = height;
    struct monge_layers *layers = monge_render_layers(scene, &settings, region, MONGE_LAYERS_ALL, job);
    monge_scene_free(scene);
    monge_diagnostics_free(diag);
    return layers;
}

static struct monge_layers *render_good(const char *text, uint32_t width, uint32_t height) {
    struct monge_layers *layers = render(text, width, height, NULL, NULL);
    assert_non_null(layers);
    return layers;
}

static vec3 normal_at(const struct monge_layers *layers, size_t i) {
    const uint16_t *n = monge_layers_normals(layers) + 3 * i;
    return (vec3){n[0] / 32767.5 - 1.0, n[1] / 32767.5 - 1.0, n[2] / 32767.5 - 1.0};
}

static const struct monge_entry *entry_at(const struct monge_layers *layers, enum monge_layer layer,
                                          size_t i) {
    return monge_layers_entry(layers, layer, monge_layers_ids(layers, layer)[i]);
}

/* ---- One sphere: 5 x 5 pixels, the middle one at (2, 2) ---- */

#define LIT                                                                                                  \
    "lights: [{point: {at: [0, 0, 50]}}, {ambient: {}}, {point: {at: [0, 50, 0]}}, {point: {at: [0, 0, "     \
    "-50]}}]\n"
#define PERSPECTIVE  "camera: {eye: [0, 0, 10], look_at: [0, 0, 0], fov: 20}\n"
#define ORTHOGRAPHIC "camera: {projection: orthographic, eye: [0, 0, 10], look_at: [0, 0, 0], height: 5}\n"

static void check_sphere(const char *camera) {
    char text[500];
    snprintf(text, sizeof text,
             "%smaterials: {jade: {diffuse: lime}}\n%sscene: [{sphere: {radius: 1.25}, material: jade, name: "
             "ball}]\n",
             camera, LIT);
    struct monge_layers *layers = render_good(text, 5, 5);
    const enum { MIDDLE = 12, CORNER = 0 } middle = MIDDLE;
    assert_int_equal(monge_layers_set(layers), MONGE_LAYERS_ALL);
    assert_near((double)monge_layers_depth(layers)[middle], 8.75, 1e-6, "depth");
    assert_vec3_near(normal_at(layers, middle), (vec3){0, 0, 1}, 2e-5, "normal");
    assert_int_equal(monge_layers_lights(layers)[middle],
                     1); /* the second is at its horizon, the third behind */
    const struct monge_entry *object = entry_at(layers, MONGE_LAYER_OBJECT, middle),
                             *material = entry_at(layers, MONGE_LAYER_MATERIAL, middle);
    assert_string_equal(object->name, "ball");
    assert_string_equal(object->kind, "sphere");
    assert_string_equal(object->file, "scene.yaml");
    assert_int_equal(object->line, 4);
    assert_int_equal(object->column, 9);
    assert_string_equal(material->name, "jade");
    assert_int_equal(material->line, 2);

    assert_true(isinf(monge_layers_depth(layers)[CORNER]));
    assert_int_equal(monge_layers_ids(layers, MONGE_LAYER_OBJECT)[CORNER], 0);
    assert_int_equal(monge_layers_ids(layers, MONGE_LAYER_MATERIAL)[CORNER], 0);
    assert_int_equal(monge_layers_lights(layers)[CORNER], 0);
    for (int c = 0; c < 3; c++) assert_int_equal(monge_layers_normals(layers)[c], 0);
    assert_null(monge_layers_entry(layers, MONGE_LAYER_OBJECT, 0));
    assert_null(monge_layers_entry(layers, MONGE_LAYER_OBJECT, 2));
    monge_layers_free(layers);
}

static void test_perspective(void **state) {
    (void)state;
    check_sphere(PERSPECTIVE);
}

/* Beside the middle the depth is along the view, and the normal that of the sphere there. */
static void test_orthographic(void **state) {
    (void)state;
    check_sphere(ORTHOGRAPHIC);
    struct monge_layers *layers = render_good(ORTHOGRAPHIC LIT "scene: [{sphere: {radius: 1.25}}]\n", 5, 5);
    const vec3 point = {0, 1, 0.75}; /* (3/4, 1, 5/4) is a right triangle */
    assert_near((double)monge_layers_depth(layers)[7], 9.25, 1e-6, "depth above the middle");
    assert_vec3_near(normal_at(layers, 7), vec3_scale(point, 0.8), 2e-5, "normal above the middle");
    assert_int_equal(monge_layers_lights(layers)[7], 3);
    monge_layers_free(layers);
}

/* Depth is not the length of the ray: it is the same all over a wall across the view. */
static void test_planar_depth(void **state) {
    (void)state;
    struct monge_layers *layers = render_good(
        "camera: {eye: [0, 0, 10], look_at: [0, 0, 0], fov: 90}\nscene: [{plane: {normal: [0, 0, -1]}}]\n", 8,
        6);
    for (size_t i = 0; i < 48; i++) {
        assert_near((double)monge_layers_depth(layers)[i], 10.0, 1e-5, "depth of a wall");
        assert_vec3_near(normal_at(layers, i), (vec3){0, 0, 1}, 2e-5, "the side that is seen");
    }
    monge_layers_free(layers);
}

/* From behind, right before the eye, the side of a slanting plane that is seen. */
static void test_slanting(void **state) {
    (void)state;
    struct monge_layers *layers = render_good("camera: {eye: [0, 0, 0.5], look_at: [0, 0, 0], fov: 20}\n"
                                              "scene: [{plane: {normal: [1, 0, -1]}}]\n",
                                              1, 1);
    assert_near((double)monge_layers_depth(layers)[0], 0.5, 1e-6, "depth");
    assert_vec3_near(normal_at(layers, 0), vec3_scale((vec3){-1, 0, 1}, sqrt(0.5)), 2e-5, "normal");
    monge_layers_free(layers);
}

/* ---- Shadows ---- */

/* In the plane of the surface there is no light, and beyond the first ones none is told of. */
static void test_lights_without_a_bit(void **state) {
    (void)state;
    static char text[8000];
    const int head = snprintf(text, sizeof text, ORTHOGRAPHIC "scene: [{plane: {}}]\nlights:\n");
    size_t used = (size_t)head;
    for (int i = 0; i < MONGE_LAYER_LIGHTS + 2; i++)
        used += (size_t)snprintf(text + used, sizeof text - used, "  - point: {at: [5, %d, %d]}\n", i,
                                 i < MONGE_LAYER_LIGHTS ? 0 : 7);
    struct monge_layers *layers = render_good(text, 1, 1);
    assert_int_equal(monge_layers_lights(layers)[0], 0);
    monge_layers_free(layers);
}

static void test_shadow(void **state) {
    (void)state;
    struct monge_layers *layers = render_good(
        "camera: {projection: orthographic, eye: [0, 10, 0], look_at: [0, 0, 0], up: [0, 0, -1], height: 5}\n"
        "lights: [{point: {at: [-2, 4, 0]}}, {point: {at: [2, 4, 0]}}, {point: {at: [0, -4, 0]}}]\n"
        "scene:\n"
        "  - plane: {normal: [0, 1, 0]}\n"
        "  - {sphere: {center: [0, 2, 0], radius: 0.1}}\n"
        "  - {sphere: {center: [-2, 2, 2], radius: 0.3}, material: {refraction: white}}\n",
        5, 5);
    const uint64_t *lights = monge_layers_lights(layers);
    assert_int_equal(lights[14], 2); /* (2, 0, 0): the ball is in the way of the first light */
    assert_int_equal(lights[10], 1); /* (-2, 0, 0): of the second */
    assert_int_equal(lights[4], 3);
    assert_int_equal(monge_layers_lights(layers)[22], 3); /* (0, 0, 2) */
    monge_layers_free(layers);
}

enum { LAMPS = 4, LAMPS_WIDTH = 30, LAMPS_HEIGHT = 20, LAMPS_PIXELS = LAMPS_WIDTH * LAMPS_HEIGHT };

/* Some balls, of glass too, over a floor, and lamps around them. */
struct lamp_scene {
    vec3 at;
    char shapes[3000], lamps[LAMPS][200];
    char text[6000]; /* with the lamps of lamp_text */
};

static void random_lamp_scene(struct random *r, struct lamp_scene *s) {
    size_t used = 0;
    s->at = random_vec3(r, -40, 40);
    for (int i = 0; i < 12; i++) {
        const vec3 c = vec3_add(s->at, random_vec3(r, -4, 4));
        used += (size_t)snprintf(s->shapes + used, sizeof s->shapes - used,
                                 "  - {sphere: {center: [%g, %g, %g], radius: %g}, material: %s}\n", c.x, c.y,
                                 c.z, random_between(r, 0.4, 1.5), i % 4 ? "m" : "glass");
    }
    for (int i = 0; i < LAMPS; i++) {
        const vec3 c = vec3_add(s->at, random_vec3(r, -12, 12));
        snprintf(s->lamps[i], sizeof *s->lamps, "  - point: {at: [%g, %g, %g], color: [1e6, 1e6, 1e6]}\n",
                 c.x, c.y, c.z);
    }
}

/* The scene with the lamps first .. last. */
static const char *lamp_text(struct lamp_scene *s, int first, int last) {
    size_t used = (size_t)snprintf(
        s->text, sizeof s->text,
        "image: {size: [%d, %d], samples: 1, background: black}\nrender: {depth: 1}\n"
        "camera: {look_at: [%g, %g, %g]}\n"
        "materials: {m: {diffuse: white, specular: black}, glass: {extends: m, refraction: white}}\n"
        "scene:\n%s  - plane: {point: [0, %g, 0], normal: [0, 1, 0]}\n    material: m\n"
        "lights:\n",
        LAMPS_WIDTH, LAMPS_HEIGHT, s->at.x, s->at.y, s->at.z, s->shapes, s->at.y - 4);
    for (int i = first; i <= last; i++)
        used += (size_t)snprintf(s->text + used, sizeof s->text - used, "%s", s->lamps[i]);
    return s->text;
}

/* How many pixels the picture has that are not black: those with the bit in lights[], and no others. */
static int check_lit(const char *text, const uint64_t *lights, int bit) {
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_scene *scene = monge_load_memory("scene.yaml", text, strlen(text), NULL, diag);
    assert_non_null(scene);
    const struct monge_settings settings = monge_scene_settings(scene);
    struct monge_film *film = monge_render(scene, &settings, NULL, NULL, NULL);
    int lit = 0;
    for (size_t i = 0; i < LAMPS_PIXELS; i++) {
        const bool reached = monge_film_pixels(film)[3 * i] > 0;
        assert_int_equal(lights[i] >> bit & 1, reached);
        lit += reached;
    }
    monge_film_free(film);
    monge_scene_free(scene);
    monge_diagnostics_free(diag);
    return lit;
}

/* A light reaches a pixel where the picture by that light alone is not black. */
static void test_shadow_against_pictures(void **state) {
    (void)state;
    enum { ROUNDS = 6 };
    struct random r = random_begin();
    int lit = 0;
    for (int round = 0; round < ROUNDS; round++) {
        static struct lamp_scene s;
        random_lamp_scene(&r, &s);
        struct monge_layers *layers = render_good(lamp_text(&s, 0, LAMPS - 1), LAMPS_WIDTH, LAMPS_HEIGHT);
        for (int i = 0; i < LAMPS; i++) lit += check_lit(lamp_text(&s, i, i), monge_layers_lights(layers), i);
        monge_layers_free(layers);
    }
    assert_true(lit > 3000 && ROUNDS * LAMPS * LAMPS_PIXELS - lit > 3000);
}

/* ---- Objects ---- */

struct object_row {
    const char *name, *scene;
    const char *left, *right; /* "name|kind|line" of what stands there */
};

#define STACK                                                                                                \
    "define: {stack: {objects: [{for: {i: 20}, sphere: {radius: 1}}]},\n  single: {objects: [{sphere: "      \
    "{}}]},\n"                                                                                               \
    "  parts: {objects: [{name: part, sphere: {}}]},\n  many: {objects: [{for: {i: 20}, sphere: {radius: "   \
    "0.5}}, {name: part, sphere: {}}]}}\n"
#define LEFT  ", transform: [{translate: [-2, 0, 0]}]}\n"
#define RIGHT ", transform: [{translate: [2, 0, 0]}]}\n"

static struct object_row object_rows[] = {
    {"shapes", "scene:\n  - {sphere: {}" LEFT "  - {box: {min: [-1, -1, -1], max: [1, 1, 1]}" RIGHT,
     "|sphere|2", "|box|3"},
    {"a named group",
     "scene:\n  - name: pair\n    group:\n      - {sphere: {}" LEFT "      - {sphere: {}" RIGHT,
     "pair|group|2", "pair|group|2"},
    {"the innermost name",
     "scene:\n  - name: pair\n    group:\n      - {sphere: {}" LEFT "      - {name: own, sphere: {}" RIGHT,
     "pair|group|2", "own|sphere|5"},
    {"a group without a name", "scene:\n  - group:\n      - {sphere: {}" LEFT "      - {sphere: {}" RIGHT,
     "|sphere|3", "|sphere|4"},
    {"a loop", "scene:\n  - {for: {i: 2}, sphere: {}, transform: [{translate: ['4 * i - 2', 0, 0]}]}\n",
     "|sphere|2", "|sphere|2"},
    {"uses carried out", STACK "scene:\n  - {use: single" LEFT "  - {name: right, use: single" RIGHT,
     "|use of single|6", "right|use of single|7"},
    {"uses of a geometry", STACK "scene:\n  - {use: stack" LEFT "  - {name: right, use: stack" RIGHT,
     "|use of stack|6", "right|use of stack|7"},
    {"a name within a template", STACK "scene:\n  - {use: parts" LEFT "  - {name: right, use: parts" RIGHT,
     "part|sphere|3", "right|use of parts|7"},
    {"a name within a geometry", STACK "scene:\n  - {use: many" LEFT "  - {name: right, use: many" RIGHT,
     "part|sphere|4", "right|use of many|7"},
    {"a use in a named group",
     STACK "scene:\n  - name: pair\n    group:\n      - {use: stack" LEFT "      - {use: single" RIGHT,
     "pair|group|6", "pair|group|6"},
};

static void assert_entry(const struct monge_layers *layers, size_t i, const char *want) {
    const struct monge_entry *e = entry_at(layers, MONGE_LAYER_OBJECT, i);
    char got[100] = "the background";
    if (e) snprintf(got, sizeof got, "%s|%s|%u", e->name ? e->name : "", e->kind, e->line);
    assert_string_equal(got, want);
}

static void test_objects(void **state) {
    const struct object_row *row = *state;
    char text[1500];
    const char *camera = "camera: {projection: orthographic, eye: [0, 0, 10], look_at: [0, 0, 0], height: 5}";
    snprintf(text, sizeof text, "%s", row->scene);
    strcat(text, camera);
    struct monge_layers *layers = render_good(text, 5, 5);
    assert_entry(layers, 10, row->left);
    assert_entry(layers, 14, row->right);
    const uint32_t *ids = monge_layers_ids(layers, MONGE_LAYER_OBJECT);
    assert_int_equal(ids[10] == ids[14], strcmp(row->left, row->right) == 0);
    monge_layers_free(layers);
}

/* A loop over so many objects that they are forgotten before they come again. */
static void test_long_loop(void **state) {
    (void)state;
    static char text[40000];
    int length =
        snprintf(text, sizeof text,
                 ORTHOGRAPHIC
                 "scene:\n  - for: {i: 2}\n    transform: [{translate: ['4 * i - 2', 0, 0]}]\n    group:\n");
    for (int k = 0; k < 600; k++)
        length += snprintf(text + length, sizeof text - (size_t)length, "      - sphere: {radius: %s}\n",
                           k ? "0.1" : "1");
    struct monge_layers *layers = render_good(text, 5, 5);
    const uint32_t *ids = monge_layers_ids(layers, MONGE_LAYER_OBJECT);
    assert_int_equal(ids[10], 1);
    assert_int_equal(ids[14], 1);
    assert_int_equal(layers->entries[MONGE_LAYER_OBJECT].highest, 600);
    monge_layers_free(layers);
}

/* ---- The same in every way to render ---- */

#define MANY                                                                                                 \
    "camera: {eye: [0, 0, 12], look_at: [0, 0, 0]}\n"                                                        \
    "scene:\n  - {for: {x: 7, y: 7}, sphere: {center: ['x - 3', 'y - 3', 0], radius: 0.3 + 0.02 * x}}\n"     \
    "  - {name: last, box: {}, transform: [{translate: [0.5, 0.5, 1]}]}\n"

static void assert_same_pixel(const struct monge_layers *a, size_t i, const struct monge_layers *b,
                              size_t j) {
    assert_int_equal(a->ids[0][i], b->ids[0][j]);
    assert_int_equal(a->ids[1][i], b->ids[1][j]);
    assert_memory_equal(&a->depth[i], &b->depth[j], sizeof *a->depth);
    assert_memory_equal(&a->normals[3 * i], &b->normals[3 * j], 3 * sizeof *a->normals);
    assert_int_equal(a->lights[i], b->lights[j]);
}

static void test_regions(void **state) {
    (void)state;
    const struct monge_region region = {50, 30, 41, 37};
    const struct monge_job one = {.threads = 1}, four = {.threads = 4};
    struct monge_layers *whole = render(MANY, 100, 80, NULL, &one),
                        *part = render(MANY, 100, 80, &region, &four);
    const struct monge_region got = monge_layers_region(part);
    assert_memory_equal(&got, &region, sizeof region);
    for (uint32_t y = 0; y < region.height; y++)
        for (uint32_t x = 0; x < region.width; x++)
            assert_same_pixel(whole, (size_t)(y + 30) * 100 + x + 50, part, (size_t)y * 41 + x);
    const struct monge_region outside = {90, 0, 11, 10};
    assert_null(render(MANY, 100, 80, &outside, NULL));
    atomic_bool cancel = true;
    assert_null(render(MANY, 100, 80, NULL, &(struct monge_job){.cancel = &cancel}));
    monge_layers_free(whole);
    monge_layers_free(part);
}

/* ---- Files ---- */

static void write_all(const struct monge_layers *layers, const char *picture) {
    struct monge_diagnostics *diag = monge_diagnostics_new();
    for (enum monge_layer layer = 0; layer < MONGE_LAYERS; layer++) {
        char path[100];
        assert_true(monge_layer_path(layer, picture, path, sizeof path) < sizeof path);
        assert_true(monge_layer_write(layers, layer, path, diag));
    }
    monge_diagnostics_free(diag);
}

/* Reads those of `wanted`; where one is wrong, NULL, and *failed. */
static struct monge_layers *read_back(const char *picture, unsigned wanted, bool *failed) {
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_layers *layers = monge_layers_read(picture, wanted, diag);
    *failed = monge_diagnostics_failures(diag) > 0;
    if (*failed) monge_diagnostics_print(diag, stdout);
    monge_diagnostics_free(diag);
    return layers;
}

static void assert_same_entries(const struct monge_layers *a, const struct monge_layers *b,
                                enum monge_layer layer) {
    const struct layer_entries *p = &a->entries[layer], *q = &b->entries[layer];
    assert_int_equal(p->count, q->count);
    for (uint32_t i = 0; i < p->count; i++) {
        assert_int_equal(p->list[i].id, q->list[i].id);
        assert_int_equal(p->list[i].line, q->list[i].line);
        assert_int_equal(p->list[i].column, q->list[i].column);
        assert_string_equal(p->list[i].kind, q->list[i].kind);
        assert_int_equal(p->list[i].name != NULL, q->list[i].name != NULL);
        if (p->list[i].name) assert_string_equal(p->list[i].name, q->list[i].name);
        assert_int_equal(p->list[i].file != NULL, q->list[i].file != NULL);
        if (p->list[i].file) assert_string_equal(p->list[i].file, q->list[i].file);
        assert_int_equal(p->list[i].hash != NULL, layer == MONGE_LAYER_MATERIAL);
        if (p->list[i].hash) assert_string_equal(p->list[i].hash, q->list[i].hash);
    }
}

static void assert_same_camera(const struct layer_camera *a, const struct layer_camera *b) {
    assert_int_equal(a->view.orthographic, b->view.orthographic);
    assert_memory_equal(&a->view.eye, &b->view.eye, 4 * sizeof a->view.eye); /* forward, right and up too */
    assert_string_equal(a->given, b->given);
    assert_string_equal(a->others, b->others);
    assert_string_equal(a->objects, b->objects);
    assert_string_equal(a->entry.kind, b->entry.kind);
    assert_string_equal(a->entry.file ? a->entry.file : "none", b->entry.file ? b->entry.file : "none");
    assert_int_equal(a->entry.line, b->entry.line);
    assert_int_equal(a->entry.column, b->entry.column);
}

static void test_files(void **state) {
    (void)state;
    bool failed;
    const struct monge_region region = {50, 30, 41, 37};
    struct monge_layers *layers = render(MANY, 100, 80, &region, NULL);
    assert_null(read_back("king.png", MONGE_LAYERS_ALL, &failed));
    assert_false(failed);
    write_all(layers, "king.png");
    assert_int_equal(access("king.depth.pfm", F_OK) | access("king.object.png", F_OK), 0);
    struct monge_layers *again = read_back("king.png", MONGE_LAYERS_ALL, &failed);
    assert_non_null(again);
    assert_int_equal(monge_layers_set(again), MONGE_LAYERS_ALL);
    const struct monge_region got = monge_layers_region(again);
    assert_memory_equal(&got, &region, sizeof region);
    for (size_t i = 0; i < layers_pixels(layers); i++) assert_same_pixel(layers, i, again, i);
    assert_same_entries(layers, again, MONGE_LAYER_OBJECT);
    assert_same_entries(layers, again, MONGE_LAYER_MATERIAL);
    assert_same_camera(&layers->camera, &again->camera);
    monge_layers_free(again);

    unlink("king.normal.png");
    again = read_back("king.png", MONGE_LAYERS_ALL, &failed);
    assert_int_equal(monge_layers_set(again), MONGE_LAYERS_ALL & ~(1u << MONGE_LAYER_NORMAL));
    assert_null(monge_layers_normals(again));
    monge_layers_free(again);
    again = read_back("king.png", 1 << MONGE_LAYER_DEPTH, &failed);
    assert_int_equal(monge_layers_set(again), 1 << MONGE_LAYER_DEPTH);
    monge_layers_free(again);
    monge_layers_free(layers);
}

/* Numbers that do not fit 16 bits take three channels. */
static void test_large_numbers(void **state) {
    (void)state;
    bool failed;
    struct monge_layers *layers = layers_new(2, 1, (struct monge_region){0, 0, 2, 1}, MONGE_LAYERS_ALL);
    static struct monge_entry entries[] = {{1, "a\n\"\\\xc3\xa9", "sphere", "f", 1, 2, NULL},
                                           {0x12345678, NULL, "box", NULL, 0, 0, NULL}};
    layers->ids[0][0] = 1;
    layers->ids[0][1] = 0x12345678;
    layers->entries[0] = (struct layer_entries){entries, 2, 0x12345678};
    layers->entries[1] = (struct layer_entries){NULL, 0, 0};
    layers->lights[0] = 0x8123456789ab & 0xffffffffffff;
    layers->light_count = 100;
    write_all(layers, "king");
    struct monge_layers *again = read_back("king", MONGE_LAYERS_ALL, &failed);
    assert_non_null(again);
    assert_int_equal(again->ids[0][1], 0x12345678);
    assert_true(again->lights[0] == layers->lights[0]);
    assert_same_entries(layers, again, MONGE_LAYER_OBJECT);
    assert_null(again->camera.entry.kind); /* as of an older program */
    monge_layers_free(again);
    monge_layers_free(layers);
}

static void write_bytes(const char *path, const char *bytes, size_t size) {
    FILE *file = fopen(path, "wb");
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    fclose(file);
}

static void test_broken_files(void **state) {
    (void)state;
    bool failed;
    struct monge_layers *layers = render_good(MANY, 20, 16), *other = render_good(MANY, 20, 17);
    struct monge_layers *third = render_good(MANY "  - sphere: {}\n", 20, 16);
    struct monge_diagnostics *diag = monge_diagnostics_new();
    write_all(layers, "a");
    monge_layer_write(other, MONGE_LAYER_NORMAL, "a.normal.png", diag);
    assert_null(read_back("a", MONGE_LAYERS_ALL, &failed)); /* of another size */
    assert_true(failed);
    monge_layer_write(third, MONGE_LAYER_NORMAL, "a.normal.png", diag);
    assert_null(read_back("a", MONGE_LAYERS_ALL, &failed)); /* of another scene */
    assert_true(failed);
    monge_layer_write(layers, MONGE_LAYER_NORMAL, "a.object.png", diag);
    assert_null(read_back("a", 1 << MONGE_LAYER_OBJECT, &failed)); /* without a table */
    assert_true(failed);
    monge_layer_write(layers, MONGE_LAYER_OBJECT, "a.normal.png", diag);
    assert_null(read_back("a", 1 << MONGE_LAYER_NORMAL, &failed)); /* of one channel */
    assert_true(failed);
    write_bytes("a.depth.pfm", "Pf\n20 16\n-1.0\n1234", 18);
    assert_null(read_back("a", 1 << MONGE_LAYER_DEPTH, &failed));
    assert_true(failed);
    assert_false(monge_layer_write(layers, MONGE_LAYER_DEPTH, "none/a.depth.pfm", diag));
    assert_false(monge_layer_write(layers, MONGE_LAYER_OBJECT, "none/a.object.png", diag));
    assert_int_equal(monge_diagnostics_failures(diag), 2);
    monge_diagnostics_free(diag);
    monge_layers_free(layers);
    monge_layers_free(other);
    monge_layers_free(third);
}

static void flip_byte(const char *path, long from_end) {
    FILE *file = fopen(path, "r+b");
    assert_int_equal(fseek(file, -from_end, SEEK_END), 0);
    const int byte = fgetc(file);
    assert_int_equal(fseek(file, -from_end, SEEK_END), 0);
    assert_int_equal(fputc(byte ^ 1, file), byte ^ 1);
    fclose(file);
}

static void assert_depth_reads(unsigned wanted, bool good) {
    bool failed;
    struct monge_layers *layers = read_back("a", wanted, &failed);
    assert_int_equal(layers != NULL, good);
    assert_int_equal(failed, !good);
    monge_layers_free(layers);
}

/* Each bit of the depth counts where the objects have its hash; where they have none, as of older programs, none does. */
static void test_damaged_depth(void **state) {
    (void)state;
    enum { DEPTH = 1 << MONGE_LAYER_DEPTH, BOTH = DEPTH | 1 << MONGE_LAYER_OBJECT };
    struct monge_layers *layers = render_good(MANY, 20, 16), *none = render_good(MANY, 20, 16);
    struct monge_diagnostics *diag = monge_diagnostics_new();
    for (long at = 1; at <= 20 * 16 * 4; at += 263) {
        write_all(layers, "a");
        assert_depth_reads(DEPTH, true);
        flip_byte("a.depth.pfm", at);
        assert_depth_reads(DEPTH, false);
        assert_depth_reads(BOTH, false);
        assert_depth_reads(1 << MONGE_LAYER_OBJECT, true);
    }
    none->set &= ~(unsigned)DEPTH;
    assert_true(monge_layer_write(none, MONGE_LAYER_OBJECT, "a.object.png", diag));
    assert_depth_reads(BOTH, true);
    assert_true(monge_layer_write(layers, MONGE_LAYER_OBJECT, "a.object.png", diag));
    assert_depth_reads(BOTH, false);
    unlink("a.object.png");
    assert_depth_reads(BOTH, true);
    none->set |= DEPTH;
    monge_diagnostics_free(diag);
    monge_layers_free(layers);
    monge_layers_free(none);
}

static void test_pfm(void **state) {
    (void)state;
    static const char least[] = "Pf\n2 2\n-1.0\n\0\0\x80\x3f\0\0\0\x40\0\0\x40\x40\0\0\x80\x7f",
                      most[] = "Pf 2 2 1.0\n\x3f\x80\0\0\x40\0\0\0\x40\x40\0\0\x7f\x80\0\0";
    char message[200];
    const float values[] = {3, INFINITY, 1, 2};
    uint32_t width, height;
    float *got;
    assert_true(pfm_write("a.pfm", 2, 2, values, message, sizeof message));
    char bytes[64];
    FILE *file = fopen("a.pfm", "rb");
    assert_int_equal(fread(bytes, 1, sizeof bytes, file), sizeof least - 1);
    fclose(file);
    assert_memory_equal(bytes, least, sizeof least - 1);
    write_bytes("b.pfm", most, sizeof most - 1);
    assert_true(pfm_read("b.pfm", 4, &width, &height, &got, message, sizeof message));
    assert_true(width == 2 && height == 2);
    assert_memory_equal(got, values, sizeof values);
    free(got);
    static const char *const wrong[] = {"",
                                        "PF\n1 1\n-1.0\n1234",
                                        "Pf\n0 1\n-1.0\n",
                                        "Pf\n4294967295 4294967295\n-1\n",
                                        "Pf\n1 1\n-1.0\n123",
                                        "Pf\n1 1\n-1.0\n12345",
                                        "Pf\n3 2\n-1\n"};
    for (size_t i = 0; i < COUNT(wrong); i++) {
        write_bytes("c.pfm", wrong[i], strlen(wrong[i]));
        assert_false(pfm_read("c.pfm", 4, &width, &height, &got, message, sizeof message));
        assert_non_null(strstr(message, "c.pfm"));
        assert_null(got);
    }
    assert_false(pfm_read("none.pfm", 4, &width, &height, &got, message, sizeof message));
}

static void test_tables(void **state) {
    (void)state;
    static const struct {
        const char *text;
        int count; /* -1: wrong */
    } texts[] = {
        {"[]", 0},
        {" [ ]\n", 0},
        {"[{\"id\": 1, \"kind\": \"box\"}, "
         "{\"kind\":\"box\",\"id\":7,\"name\":null,\"new\":\"x\",\"newer\":3}]",
         2},
        {"[{\"id\": 1, \"kind\": \"\\u00e9\\ud800\\/\\n\"}]", 1},
        {"", -1},
        {"[", -1},
        {"[{\"id\": 1}]", -1},
        {"[{\"id\": 0, \"kind\": \"box\"}]", -1},
        {"[{\"id\": 2, \"kind\": \"box\"}, {\"id\": 2, \"kind\": \"box\"}]", -1},
        {"[{\"id\": 4294967296, \"kind\": \"box\"}]", -1},
        {"[{\"id\": 1, \"kind\": \"box}]", -1},
        {"[{\"id\": 1, \"kind\": \"box\\", -1},
        {"[{\"id\": 1, \"kind\": \"\\u12", -1},
        {"[{\"id\": 1, \"kind\": \"\\u0000\"}]", -1},
        {"[{\"id\": 1, \"kind\": \"box\"}] x", -1},
        {"[{\"id\": 1, \"kind\": \"box\"},]", -1},
    };
    for (size_t i = 0; i < COUNT(texts); i++) {
        struct arena arena = {0};
        struct layer_entries entries;
        const bool good = layer_table_read(texts[i].text, &arena, &entries);
        if (good != (texts[i].count >= 0)) fail_msg("%s: read: %d", texts[i].text, good);
        if (good) assert_int_equal(entries.count, texts[i].count);
        arena_free(&arena);
    }
}

/* ---- Cameras ---- */

/* In closed form: half the height of the picture at the distance of `forward`, and half its width. */
static void test_camera(void **state) {
    (void)state;
    static const struct {
        const char *head;
        bool orthographic;
        double half;
        unsigned line, column;
    } cases[] = {{PERSPECTIVE, false, 0.17632698070846498, 1, 9},
                 {"# a line\ncamera:\n  eye: [0, 0, 10]\n  look_at: [0, 0, 0]\n  fov: 20\n", false,
                  0.17632698070846498, 3, 3},
                 {ORTHOGRAPHIC, true, 2.5, 1, 9}};
    for (size_t i = 0; i < COUNT(cases); i++) {
        char text[300];
        snprintf(text, sizeof text, "%sscene: [{sphere: {}}]\n", cases[i].head);
        struct monge_layers *layers = render_good(text, 20, 10);
        const struct layer_camera *camera = &layers->camera;
        assert_int_equal(camera->view.orthographic, cases[i].orthographic);
        assert_vec3_near(camera->view.eye, (vec3){0, 0, 10}, 1e-15, "eye");
        assert_vec3_near(camera->view.forward, (vec3){0, 0, -1}, 1e-15, "forward");
        assert_vec3_near(camera->view.right, (vec3){2 * cases[i].half, 0, 0}, 1e-12, "right");
        assert_vec3_near(camera->view.up, (vec3){0, cases[i].half, 0}, 1e-12, "up");
        assert_string_equal(camera->entry.kind, "camera");
        assert_string_equal(camera->entry.file, "scene.yaml");
        assert_int_equal(camera->entry.line, cases[i].line);
        assert_int_equal(camera->entry.column, cases[i].column);
        monge_layers_free(layers);
    }
    struct monge_layers *framed = render_good("scene: [{sphere: {}}]\n", 20, 10);
    assert_string_equal(framed->camera.entry.kind, "camera");
    assert_null(framed->camera.entry.file);
    monge_layers_free(framed);
}

#define HASH   "0123456789abcdef0123456789abcdef"
#define AXES   "\"forward\": [0, 0, -1], \"right\": [1, 0, 0], \"up\": [0, 1, 0], "
#define HASHES "\"given\": \"" HASH "\", \"others\": \"" HASH "\""
#define KIND   "\"projection\": \"perspective\", "

static void test_camera_texts(void **state) {
    (void)state;
    static const struct {
        const char *text;
        bool good;
    } texts[] = {
        {"{" KIND "\"eye\": [1, -2.5e-3, 3], " AXES HASHES "}", true},
        {" { " AXES HASHES ", \"new\": 3, \"newer\": \"x\", \"line\": 7, \"file\": null } \n", true},
        {"", false},
        {"{}", false},
        {"{" AXES HASHES, false},
        {"{" AXES HASHES "} x", false},
        {"{" AXES HASHES ",}", false},
        {"{" AXES "\"given\": \"" HASH "\"}", false},
        {"{" AXES "\"given\": \"" HASH "\", \"others\": \"01\"}", false},
        {"{" AXES "\"given\": \"" HASH "\", \"others\": null}", false},
        {"{\"forward\": [0, 0, -1], \"up\": [0, 1, 0], " HASHES "}", false},
        {"{\"eye\": [0, 0], " AXES HASHES "}", false},
        {"{\"eye\": [0, 0, inf], " AXES HASHES "}", false},
        {"{\"eye\": [0, 0, x], " AXES HASHES "}", false},
        {"{\"projection\": \"fisheye\", " AXES HASHES "}", false},
    };
    for (size_t i = 0; i < COUNT(texts); i++) {
        struct arena arena = {0};
        struct layer_camera camera;
        const bool good = layer_camera_read(texts[i].text, &arena, &camera);
        if (good != texts[i].good) fail_msg("%s: read: %d", texts[i].text, good);
        assert_int_equal(camera.entry.kind != NULL, good);
        if (good) assert_vec3_near(camera.view.forward, (vec3){0, 0, -1}, 0, "forward");
        if (i == 0) assert_vec3_near(camera.view.eye, (vec3){1, -2.5e-3, 3}, 0, "eye");
        if (i == 1) assert_int_equal(camera.entry.line, 7);
        arena_free(&arena);
    }
}

int main(void) {
    struct CMUnitTest tests[COUNT(object_rows) + 20];
    size_t count = 0;
    for (size_t i = 0; i < COUNT(object_rows); i++)
        tests[count++] = (struct CMUnitTest){object_rows[i].name, test_objects, NULL, NULL, &object_rows[i]};
    const struct CMUnitTest others[] = {
        cmocka_unit_test(test_perspective),
        cmocka_unit_test(test_orthographic),
        cmocka_unit_test(test_planar_depth),
        cmocka_unit_test(test_slanting),
        cmocka_unit_test(test_lights_without_a_bit),
        cmocka_unit_test(test_shadow),
        cmocka_unit_test(test_shadow_against_pictures),
        cmocka_unit_test(test_regions),
        cmocka_unit_test(test_long_loop),
        cmocka_unit_test(test_tables),
        cmocka_unit_test(test_camera),
        cmocka_unit_test(test_camera_texts),
        cmocka_unit_test_setup_teardown(test_files, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(test_large_numbers, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(test_broken_files, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(test_damaged_depth, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(test_pfm, enter_folder, leave_folder),
    };
    for (size_t i = 0; i < COUNT(others); i++) tests[count++] = others[i];
    return _cmocka_run_group_tests("layers", tests, count, NULL, NULL);
}
