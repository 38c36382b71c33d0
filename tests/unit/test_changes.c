/* What is told of two renderings of scenes that differ in one thing. */
#include <string.h>
#include <unistd.h>

#include "changing.h"
#include "folder.h"
#include "image/camera_change.h"

/* ---- Rows ---- */

struct row {
    const char *name, *older, *newer;
    const char *want; /* the changes, a line each */
    unsigned without; /* layers that are not there */
};

#define HEAD                                                                                                 \
    "camera: {eye: [0, 3, 8], look_at: [0, 0.7, 0]}\n"                                                       \
    "lights: [{point: {at: [-4, 8, 6]}}, {ambient: {color: [0.2, 0.2, 0.2]}}]\n"
#define FLOOR "  - {name: floor, plane: {normal: [0, 1, 0]}, material: {ambient: white, diffuse: '#aaa'}}\n"
#define BALL  "  - {name: ball, sphere: {center: [-1.5, 1, 0]}, material: {ambient: red, diffuse: red}}\n"
#define BOX   "  - {box: {min: [0.6, 0, -0.5], max: [1.6, 1, 0.5]}, material: {ambient: blue, diffuse: blue}}\n"
#define SCENE "scene:\n"
#define TOWER                                                                                                \
    "define: {tower: {objects: [{cylinder: {from: [0, 0, 0], to: [0, 2, 0], radius: 0.4}}, {sphere: "        \
    "{center: [0, 2, 0], radius: 0.6}}]}}\n"
#define CAMERA(rest)                                                                                         \
    "camera: {eye: [0, 3, 8], " rest "}\nlights: [{point: {at: [-4, 8, 6]}}]\n" SCENE FLOOR BALL
#define OTHERS "other changes too, which cannot be told by object under another camera\n"
/* So many that it becomes a geometry of its own. */
#define STACK "define: {stack: {objects: [{for: {i: 20}, sphere: {center: [0, 0.1 * i, 0], radius: 0.5}}]}}\n"

static struct row rows[] = {
    {"nothing", HEAD SCENE FLOOR BALL BOX, HEAD SCENE FLOOR BALL BOX, "", 0},
    {"a ball has moved", HEAD SCENE FLOOR BALL BOX,
     HEAD SCENE FLOOR
     "  - {name: ball, sphere: {center: [-1.5, 1, 0.6]}, material: {ambient: red, diffuse: red}}\n" BOX,
     "object \"ball\" (scene.yaml:5): geometry moved\n"
     "object \"floor\" (scene.yaml:4): shadow changed\n",
     0},
    {"in front of another", HEAD SCENE FLOOR BALL BOX,
     HEAD SCENE FLOOR
     "  - {name: ball, sphere: {center: [0.8, 1, 2]}, material: {ambient: red, diffuse: red}}\n" BOX,
     "object \"ball\" (scene.yaml:5): geometry moved\n"
     "object \"floor\" (scene.yaml:4): shadow changed\n",
     0},
    {"another colour", HEAD SCENE FLOOR BALL BOX,
     HEAD SCENE FLOOR
     "  - {name: ball, sphere: {center: [-1.5, 1, 0]}, material: {ambient: red, diffuse: lime}}\n" BOX,
     "object \"ball\" (scene.yaml:5): shading changed, geometry equal: another material\n", 0},
    {"a named material for another",
     "materials: {a: {diffuse: red}, b: {diffuse: lime}}\n" HEAD SCENE FLOOR
     "  - {name: ball, sphere: {center: [0, 1, 0]}, material: a}\n  - {sphere: "
     "{center: [2, 1, 0], radius: 0.2}, material: b}\n",
     "materials: {a: {diffuse: red}, b: {diffuse: lime}}\n" HEAD SCENE FLOOR
     "  - {name: ball, sphere: {center: [0, 1, 0]}, material: b}\n  - {sphere: {center: [2, 1, 0], radius: "
     "0.2}, material: b}\n",
     "object \"ball\" (scene.yaml:6): shading changed, geometry equal: another material\n", 0},
    {"one has come", HEAD SCENE FLOOR BALL, HEAD SCENE FLOOR BALL BOX,
     "box (scene.yaml:6): appeared\n"
     "object \"floor\" (scene.yaml:4): shadow changed\n",
     0},
    {"one has gone", HEAD SCENE FLOOR BALL BOX, HEAD SCENE FLOOR BOX,
     "object \"ball\" (was at scene.yaml:5): disappeared\n"
     "object \"floor\" (scene.yaml:4): shadow changed\n",
     0},
    {"the light has moved", HEAD SCENE FLOOR BALL,
     "camera: {eye: [0, 3, 8], look_at: [0, 0.7, 0]}\n"
     "lights: [{point: {at: [4, 8, 6]}}, {ambient: {color: [0.2, 0.2, 0.2]}}]\n" SCENE FLOOR BALL,
     "point light (scene.yaml:2): moved\n"
     "object \"floor\" (scene.yaml:4): shading changed, geometry equal\n"
     "object \"ball\" (scene.yaml:5): shading changed, geometry equal\n"
     "object \"floor\" (scene.yaml:4): shadow changed\nobject \"ball\" (scene.yaml:5): shadow changed\n",
     0},
    {"lines have shifted, one of three without names has moved",
     HEAD SCENE
     "  - sphere: {center: [-2, 1, 0], radius: 0.7}\n  - sphere: {center: [0, 1, 0], radius: 0.7}\n"
     "  - sphere: {center: [2, 1, 0], radius: 0.7}\n",
     "# a line\n\n" HEAD SCENE
     "  - sphere: {center: [-2, 1, 0], radius: 0.7}\n  - sphere: {center: [0, 1.8, 0], radius: 0.7}\n"
     "  - sphere: {center: [2, 1, 0], radius: 0.7}\n",
     "sphere (scene.yaml:7): geometry moved\n", 0},
    {"one is new before the others of its kind",
     HEAD SCENE
     "  - sphere: {center: [-2, 1, 0], radius: 0.7}\n  - sphere: {center: [0, 1, 0], radius: 0.7}\n",
     HEAD SCENE
     "  - sphere: {center: [2, 1, 0], radius: 0.7}\n"
     "  - sphere: {center: [-2, 1, 0], radius: 0.7}\n  - sphere: {center: [0, 1, 0], radius: 0.7}\n",
     "sphere (scene.yaml:4): appeared\n", 0},
    {"another name", HEAD SCENE FLOOR BALL,
     HEAD SCENE FLOOR
     "  - {name: globe, sphere: {center: [-1.5, 1, 0]}, material: {ambient: red, diffuse: lime}}\n",
     "object \"globe\" (scene.yaml:5): shading changed, geometry equal: another material\n", 0},
    {"what a mirror shows",
     HEAD SCENE "  - {name: mirror, sphere: {center: [0, 1, 0]}, material: {diffuse: black, reflection: 1}}\n"
                "  - {name: far, sphere: {center: [0, 1, 12]}, material: {ambient: red}}\n",
     HEAD SCENE "  - {name: mirror, sphere: {center: [0, 1, 0]}, material: {diffuse: black, reflection: 1}}\n"
                "  - {name: far, sphere: {center: [1, 1, 12]}, material: {ambient: red}}\n",
     "object \"mirror\" (scene.yaml:4): shading changed, geometry equal\n", 0},
    {"the background", "image: {background: black}\n" HEAD SCENE BALL,
     "image: {background: navy}\n" HEAD SCENE BALL, "background: colour changed\n", 0},
    {"of a template in use, the use",
     TOWER HEAD SCENE "  - {use: tower, transform: [{translate: [-2, 0, 0]}]}\n"
                      "  - {use: tower, transform: [{translate: [1, 0, 0]}]}\n",
     TOWER HEAD SCENE "  - {use: tower, transform: [{translate: [-2, 0, 0]}]}\n"
                      "  - {use: tower, transform: [{translate: [2, 0, 0]}]}\n",
     "use of tower (scene.yaml:6): geometry moved\n", 0},
    {"of a template that is shared, the use",
     STACK HEAD SCENE "  - {use: stack, transform: [{translate: [-2, 0, 0]}]}\n"
                      "  - {name: right, use: stack, transform: [{translate: [1, 0, 0]}]}\n",
     STACK HEAD SCENE
     "  - {use: stack, transform: [{translate: [-2.5, 0, 0]}]}\n"
     "  - {name: right, use: stack, material: {diffuse: red}, transform: [{translate: [1, 0, 0]}]}\n",
     "use of stack (scene.yaml:5): geometry moved\n"
     "object \"right\" (scene.yaml:6): shading changed, geometry equal: another material\n",
     0},
    {"two of one name, the second has gone",
     HEAD SCENE "  - {name: ball, sphere: {center: [-2, 1, 0], radius: 0.7}}\n"
                "  - {name: ball, sphere: {center: [0, 1, 0], radius: 0.7}}\n",
     HEAD SCENE "  - {name: ball, sphere: {center: [0, 1, 0], radius: 0.7}}\n",
     "object \"ball\" (was at scene.yaml:4): disappeared\n", 0},
    {"two have changed places",
     HEAD SCENE "  - {name: a, sphere: {center: [-2, 1, 0], radius: 0.7}, material: {ambient: red}}\n"
                "  - {name: b, sphere: {center: [2, 1, 0], radius: 0.7}, material: {ambient: blue}}\n",
     HEAD SCENE "  - {name: a, sphere: {center: [2, 1, 0], radius: 0.7}, material: {ambient: red}}\n"
                "  - {name: b, sphere: {center: [-2, 1, 0], radius: 0.7}, material: {ambient: blue}}\n",
     "object \"b\" (scene.yaml:5): geometry moved\n"
     "object \"a\" (scene.yaml:4): geometry moved\n",
     0},
    {"something thin beside what has changed too",
     HEAD SCENE FLOOR
     "  - {name: wire, cylinder: {from: [0, 0, 0], to: [0, 2, 0], radius: 0.05}, material: {ambient: red}}\n",
     HEAD SCENE "  - {name: floor, plane: {normal: [0, 1, 0]}, material: {ambient: white, diffuse: '#888'}}\n"
                "  - {name: wire, cylinder: {from: [0, 0, 0], to: [0, 2, 0], radius: 0.05}, material: "
                "{ambient: lime}}\n",
     "object \"floor\" (scene.yaml:4): shading changed, geometry equal: another material\n"
     "object \"wire\" (scene.yaml:5): shading changed, geometry equal: another material\n",
     0},
    {"what has moved in its own plane, under another shadow",
     HEAD SCENE "  - {name: tile, box: {min: [-2, -1, -2], max: [2, 0, 2]}, material: {reflection: 0.5}}\n"
                "  - {name: ball, sphere: {center: [0, 1, 0], radius: 0.6}}\n",
     HEAD SCENE "  - {name: tile, box: {min: [-2, -1, -2], max: [2.5, 0, 2]}, material: {reflection: 0.5}}\n"
                "  - {name: ball, sphere: {center: [0.2, 1, 0], radius: 0.6}}\n",
     "object \"tile\" (scene.yaml:4): geometry moved\n"
     "object \"ball\" (scene.yaml:5): geometry moved\n",
     0},
    {"the camera has moved, seen by its place", "# a line\n" HEAD SCENE FLOOR BALL BOX,
     "lights: [{point: {at: [-4, 8, 6]}}, {ambient: {color: [0.2, 0.2, 0.2]}}]\n"
     "camera:\n  eye: [0.5, 3, 8]\n  look_at: [0, 0.7, 0]\n" SCENE FLOOR BALL BOX,
     "camera (scene.yaml:3): moved\n", 0},
    {"the camera has turned", CAMERA("look_at: [0, 0.7, 0]"), CAMERA("look_at: [0.2, 0.7, 0]"),
     "camera (scene.yaml:1): view changed\n", 0},
    {"the camera is tilted", CAMERA("look_at: [0, 0.7, 0]"), CAMERA("look_at: [0, 0.7, 0], up: [0.1, 1, 0]"),
     "camera (scene.yaml:1): view changed\n", 0},
    {"the camera has another angle", CAMERA("look_at: [0, 0.7, 0]"),
     CAMERA("look_at: [0, 0.7, 0], fov: 41.5"), "camera (scene.yaml:1): view changed\n", 0},
    {"the camera has another projection, of the same height at the eye",
     CAMERA("direction: [0, 0, -1], fov: 90"),
     CAMERA("direction: [0, 0, -1], projection: orthographic, height: 2"),
     "camera (scene.yaml:1): view changed\n", 0},
    {"the camera has the same rays by other words", CAMERA("look_at: [0, 0, 0]"),
     CAMERA("direction: [0, -30, -80], up: [0, 2, 0]"), "", 0},
    {"the camera and the ball have moved", HEAD SCENE FLOOR BALL BOX,
     "camera: {eye: [0, 3, 9], look_at: [0, 0.7, 0]}\n"
     "lights: [{point: {at: [-4, 8, 6]}}, {ambient: {color: [0.2, 0.2, 0.2]}}]\n" SCENE FLOOR
     "  - {name: ball, sphere: {center: [-1.5, 1, 0.6]}, material: {ambient: red, diffuse: red}}\n" BOX,
     "camera (scene.yaml:1): moved\n" OTHERS, 0},
    {"the camera has moved, and one has gone", HEAD SCENE FLOOR BALL BOX,
     "camera: {eye: [0, 3, 9], look_at: [0, 0.7, 0]}\n"
     "lights: [{point: {at: [-4, 8, 6]}}, {ambient: {color: [0.2, 0.2, 0.2]}}]\n" SCENE FLOOR BALL,
     "camera (scene.yaml:1): moved\n" OTHERS, 0},
    {"the camera has moved, and the light", HEAD SCENE FLOOR BALL,
     "camera: {eye: [0, 3, 9], look_at: [0, 0.7, 0]}\n"
     "lights: [{point: {at: [4, 8, 6]}}, {ambient: {color: [0.2, 0.2, 0.2]}}]\n" SCENE FLOOR BALL,
     "camera (scene.yaml:1): moved\n"
     "point light (scene.yaml:2): moved\n",
     0},
    {"no camera, and what is framed has moved", SCENE FLOOR BALL BOX,
     SCENE FLOOR
     "  - {name: ball, sphere: {center: [-1.8, 1, 0]}, material: {ambient: red, diffuse: red}}\n" BOX,
     "camera: framing by the scene's bounds changed\n" OTHERS, 0},
    {"a camera that looks at the middle", "camera: {eye: [0, 3, 8]}\n" SCENE BALL BOX,
     "camera: {eye: [0, 3, 8]}\n" SCENE
     "  - {name: ball, sphere: {center: [-1.8, 1, 0]}, material: {ambient: red, diffuse: red}}\n" BOX,
     "camera (scene.yaml:1): framing by the scene's bounds changed\n" OTHERS, 0},
    {"no camera, and what has moved is within the bounds",
     SCENE FLOOR BALL BOX "  - {sphere: {radius: 0.2}}\n",
     SCENE FLOOR BALL BOX "  - {sphere: {center: [0.1, 0, 0], radius: 0.2}}\n",
     "sphere (scene.yaml:5): geometry moved\n", 0},
    {"a camera has come", SCENE BALL, "camera: {eye: [0, 3, 8]}\n" SCENE BALL,
     "camera (scene.yaml:1): moved\n", 0},
    {"a camera has gone", "camera: {eye: [0, 3, 8]}\n" SCENE BALL, SCENE BALL, "camera: moved\n", 0},
    {"without depth and normals", HEAD SCENE FLOOR BALL, HEAD SCENE FLOOR BALL BOX,
     "box (scene.yaml:6): appeared\n"
     "object \"floor\" (scene.yaml:4): shadow changed\n",
     1 << MONGE_LAYER_DEPTH | 1 << MONGE_LAYER_NORMAL},
};

static void test_row(void **state) {
    const struct row *row = *state;
    const unsigned set = MONGE_LAYERS_ALL & ~row->without;
    struct rendered a = render(row->older, set), b = render(row->newer, set);
    static uint8_t differs[PIXELS];
    char got[2000];
    find_differences(&a, &b, differs);
    tell(a.layers, b.layers, differs, got, sizeof got);
    assert_string_equal(got, row->want);
    forget(&a);
    forget(&b);
}

/* ---- The camera ---- */

/* What an older program has written does not tell its camera. */
static void test_unknown_camera(void **state) {
    (void)state;
    struct rendered a = render(CAMERA("look_at: [0, 0.7, 0]"), MONGE_LAYERS_ALL),
                    b = render(CAMERA("look_at: [0, 0.8, 0]"), MONGE_LAYERS_ALL);
    static uint8_t differs[PIXELS];
    char got[2000];
    find_differences(&a, &b, differs);
    for (int side = 0; side < 2; side++) {
        struct layer_camera *camera = &(side ? &b : &a)->layers->camera, kept = *camera;
        *camera = (struct layer_camera){.entry = {.kind = NULL}};
        tell(a.layers, b.layers, differs, got, sizeof got);
        assert_string_equal(got, "object \"floor\" (scene.yaml:4): geometry moved\n"
                                 "object \"ball\" (scene.yaml:5): geometry moved\n"
                                 "background: colour changed\n");
        *camera = kept;
    }
    forget(&a);
    forget(&b);
}

/* What moves by another program's rounding has not moved. */
static void test_camera_tolerance(void **state) {
    (void)state;
    static const struct {
        double by;
        bool moved;
    } cases[] = {{0, false}, {1e-11, false}, {1e-6, true}, {-1e-6, true}};
    struct rendered r = render(HEAD SCENE BALL, MONGE_LAYERS_ALL);
    const struct layer_camera *camera = &r.layers->camera;
    for (size_t k = 0; k < COUNT(cases); k++) {
        struct layer_camera other = *camera;
        enum monge_change_kind kind = MONGE_CHANGES;
        strcpy(other.given, "other");
        other.view.eye.x += cases[k].by;
        assert_int_equal(camera_change(camera, &other, &kind), cases[k].moved);
        if (cases[k].moved) assert_int_equal(kind, MONGE_CHANGE_CAMERA);
        other.view.eye.x = camera->view.eye.x;
        other.view.up.y += cases[k].by;
        assert_int_equal(camera_change(camera, &other, &kind), cases[k].moved);
        if (cases[k].moved) assert_int_equal(kind, MONGE_CHANGE_VIEW);
    }
    forget(&r);
}

/* Of the camera all pixels that differ; of what else there is nobody knows. */
static void test_camera_pixels(void **state) {
    (void)state;
    static const char head[] = "camera: {projection: orthographic, eye: [0, 0, 5], look_at: [0, 0, 0], "
                               "height: 7.2}\nscene: [{square: {center: [-3, 0, 0], size: 2}}]\n",
                      moved[] = "camera: {projection: orthographic, eye: [1, 0, 5], look_at: [1, 0, 0], "
                                "height: 7.2}\nscene: [{square: {center: [-3, 1, 0], size: 2}}]\n";
    struct rendered a = render(head, MONGE_LAYERS_ALL), b = render(moved, MONGE_LAYERS_ALL);
    static uint8_t differs[PIXELS];
    struct monge_change changes[2] = {{.kind = MONGE_CHANGES}, {.kind = MONGE_CHANGES}};
    size_t count = 0;
    differs[30 * 96 + 20] = differs[33 * 96 + 10] = 1;
    assert_true(changes_find(a.layers, b.layers, differs, changes, 1, &count));
    assert_int_equal(count, 2);
    assert_int_equal(changes[1].kind, MONGE_CHANGES); /* no room */
    assert_true(changes_find(a.layers, b.layers, differs, changes, 2, &count));
    const struct monge_region r = changes[0].bounds;
    assert_true(r.x == 10 && r.y == 30 && r.width == 11 && r.height == 4);
    assert_int_equal(changes[0].pixels, 2);
    assert_int_equal(changes[0].kind, MONGE_CHANGE_CAMERA);
    assert_int_equal(changes[1].kind, MONGE_CHANGE_OTHERS);
    assert_null(changes[1].object);
    assert_int_equal(changes[1].pixels, 0);
    forget(&a);
    forget(&b);
}

/* ---- Where, and how many ---- */

static void test_bounds(void **state) {
    (void)state;
    static const char
        older[] = "camera: {projection: orthographic, eye: [0, 0, 5], look_at: [0, 0, 0], height: 7.2}\n"
                  "scene: [{square: {center: [-3, 0, 0], size: 2}}, {sphere: {center: [3, 3, 0], "
                  "radius: 0.5}}]\n",
        newer[] = "camera: {projection: orthographic, eye: [0, 0, 5], look_at: [0, 0, 0], height: 7.2}\n"
                  "scene: [{square: {center: [-3, 0, 0], size: 2}, material: {diffuse: red}}, {sphere: "
                  "{center: [3, 2, 0], radius: 0.5}}]\n";
    struct rendered a = render(older, MONGE_LAYERS_ALL), b = render(newer, MONGE_LAYERS_ALL);
    static uint8_t differs[PIXELS];
    struct monge_change changes[2];
    size_t count = 0;
    find_differences(&a, &b, differs);
    assert_true(changes_find(a.layers, b.layers, differs, changes, 1, &count));
    assert_int_equal(count, 2);
    assert_string_equal(changes[0].object->kind, "square");
    assert_int_equal(changes[0].pixels, 400);
    const struct monge_region r = changes[0].bounds; /* ten pixels a unit, (48, 36) in the middle */
    assert_true(r.x == 8 && r.y == 26 && r.width == 20 && r.height == 20);
    assert_true(changes_find(a.layers, b.layers, differs, changes, 2, &count));
    assert_string_equal(changes[1].object->kind, "sphere");
    assert_true(changes[1].bounds.y == 1 && changes[1].bounds.height == 20);
    assert_true(changes[1].bounds.x == 73 && changes[1].bounds.width == 10);
    forget(&a);
    forget(&b);
}

/* What moves by less than another program's rounding has not moved. */
static void test_tolerance(void **state) {
    (void)state;
    static const struct {
        float depth;
        uint16_t normal;
        size_t count;
    } cases[] = {{10.0f, 500, 0}, {10.00001f, 500, 0}, {10.0001f, 500, 1}, {10.0f, 502, 0}, {10.0f, 503, 1}};
    static struct monge_entry entry = {1, "ball", "sphere", "scene.yaml", 1, 1, NULL};
    static const uint8_t differs[9];
    for (size_t k = 0; k < COUNT(cases); k++) {
        struct monge_layers *layers[2];
        for (int side = 0; side < 2; side++) {
            layers[side] = layers_new(3, 3, (struct monge_region){0, 0, 3, 3}, MONGE_LAYERS_ALL);
            layers[side]->entries[0] = (struct layer_entries){&entry, 1, 1};
            for (int i = 0; i < 9; i++) {
                layers[side]->ids[0][i] = 1;
                layers[side]->depth[i] = side ? cases[k].depth : 10.0f;
                layers[side]->normals[3 * i + 1] = side ? cases[k].normal : 500;
            }
        }
        struct monge_change change;
        size_t count;
        assert_true(changes_find(layers[0], layers[1], differs, &change, 1, &count));
        assert_int_equal(count, cases[k].count);
        monge_layers_free(layers[0]);
        monge_layers_free(layers[1]);
    }
}

static void test_refused(void **state) {
    (void)state;
    static const uint8_t differs[PIXELS];
    struct rendered a = render(HEAD SCENE BALL, MONGE_LAYERS_ALL),
                    b = render(HEAD SCENE BALL, 1 << MONGE_LAYER_DEPTH);
    struct monge_change change;
    size_t count;
    assert_true(changes_find(a.layers, a.layers, differs, &change, 1, &count));
    assert_false(changes_find(a.layers, b.layers, differs, &change, 1, &count));
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_scene *scene = monge_load_memory("t", HEAD SCENE BALL, strlen(HEAD SCENE BALL), NULL, diag);
    const struct monge_settings settings = monge_scene_settings(scene);
    const struct monge_region region = {0, 0, 96, 71};
    struct monge_layers *smaller = monge_render_layers(scene, &settings, &region, MONGE_LAYERS_ALL, NULL);
    assert_false(changes_find(a.layers, smaller, differs, &change, 1, &count));
    monge_layers_free(smaller);
    monge_scene_free(scene);
    monge_diagnostics_free(diag);
    forget(&a);
    forget(&b);
}

/* ---- From files ---- */

static void write_files(const struct rendered *r, const char *picture, struct monge_diagnostics *diag) {
    assert_true(monge_film_write_png(r->film, picture, diag));
    for (enum monge_layer layer = 0; layer < MONGE_LAYERS; layer++) {
        char path[100];
        monge_layer_path(layer, picture, path, sizeof path);
        assert_true(monge_layer_write(r->layers, layer, path, diag));
    }
}

static void test_files(void **state) {
    (void)state;
    const struct row *row = &rows[1];
    struct rendered a = render(row->older, MONGE_LAYERS_ALL), b = render(row->newer, MONGE_LAYERS_ALL);
    struct monge_diagnostics *diag = monge_diagnostics_new();
    write_files(&a, "a.png", diag);
    write_files(&b, "b.png", diag);
    struct monge_picture *p = monge_picture_read("a.png", diag), *q = monge_picture_read("b.png", diag);
    struct monge_layers *of_p = monge_layers_read("a.png", MONGE_LAYERS_ALL, diag),
                        *of_q = monge_layers_read("b.png", MONGE_LAYERS_ALL, diag);
    struct monge_change changes[ROOM];
    const struct monge_compare how = {.max_delta = 0.0}, loose = {.max_delta = 1.0};
    size_t count;
    assert_true(monge_changes(p, of_p, q, of_q, &how, changes, ROOM, &count, diag));
    assert_int_equal(count, 2);
    assert_string_equal(changes[0].object->name, "ball");
    assert_int_equal(changes[0].kind, MONGE_CHANGE_GEOMETRY);
    assert_int_equal(changes[1].kind, MONGE_CHANGE_SHADOW);
    assert_true(monge_changes(p, of_p, q, of_q, &loose, changes, ROOM, &count, diag));
    assert_int_equal(count, 1);
    assert_int_equal(monge_diagnostics_failures(diag), 0);
    assert_false(
        monge_changes(p, of_p, q, of_p, &how, changes, ROOM, &count, diag)); /* passes of another picture */
    assert_int_equal(monge_diagnostics_failures(diag), 1);
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    monge_diagnostics_print(diag, out);
    fclose(out);
    assert_non_null(strstr(text, "cannot tell what changed in b.png: its passes are not of this picture"));
    free(text);
    monge_layers_free(of_p);
    monge_layers_free(of_q);
    monge_picture_free(p);
    monge_picture_free(q);
    monge_diagnostics_free(diag);
    forget(&a);
    forget(&b);
}

static void test_terminal(void **state) {
    (void)state;
    const struct monge_entry entry = {1, "a\033[31m\n\xc2\x9b\x7f\xc3\xa9", "sphere", "s.yaml", 4, 1, NULL};
    const struct monge_change change = {.kind = MONGE_CHANGE_SHADOW, .object = &entry};
    char text[100], cut[6];
    monge_change_text(&change, text, sizeof text);
    assert_string_equal(text, "object \"a [31m    \xc3\xa9\" (s.yaml:4): shadow changed");
    assert_int_equal(monge_change_text(&change, cut, sizeof cut), strlen(text));
    assert_string_equal(cut, "objec");
    assert_int_equal(monge_change_text(&change, NULL, 0), strlen(text));
    const struct monge_entry nowhere = {0, NULL, "s\033[31m", NULL, 0, 0, NULL};
    const struct monge_change other = {.kind = MONGE_CHANGE_SHADOW, .object = &nowhere};
    monge_change_text(&other, text, sizeof text);
    assert_string_equal(text, "s [31m: shadow changed");
}

/* ---- Why ---- */

static void assert_causes(struct monge_stamp older, struct monge_stamp newer, const char *want) {
    char got[200];
    const struct monge_causes causes = monge_causes(&older, &newer);
    const size_t length = monge_causes_text(&causes, got, sizeof got);
    assert_string_equal(got, want);
    assert_int_equal(length, strlen(want));
    assert_int_equal(monge_causes_text(&causes, got, 4), strlen(want));
    assert_int_equal(strlen(got), 3);
}

static void test_causes(void **state) {
    (void)state;
    const struct monge_stamp first = {"p1", "s1", "t1", ""};
    assert_causes(first, first, "the scene's text, the options and the program are the same");
    assert_causes(first, (struct monge_stamp){"p1", "s2", "t2", ""},
                  "the scene's text differs; the options and the program are the same");
    assert_causes(
        first, (struct monge_stamp){"p1", "s1", "t2", ""},
        "the scene's text, but not what it means, differs; the options and the program are the same");
    assert_causes(first, (struct monge_stamp){"p2", "s1", "t1", "--samples 4"},
                  "the options and the program differ; the scene's text is the same");
    assert_causes(first, (struct monge_stamp){"p1", "s1", "t1", NULL},
                  "the scene's text and the program are the same; the options are not known");
    assert_causes(first, (struct monge_stamp){NULL, "s1", NULL, "--samples 4"},
                  "the options differ; the scene's text and the program are not known");
}

int main(void) {
    struct CMUnitTest tests[COUNT(rows) + 16];
    size_t count = 0;
    for (size_t i = 0; i < COUNT(rows); i++)
        tests[count++] = (struct CMUnitTest){rows[i].name, test_row, NULL, NULL, &rows[i]};
    const struct CMUnitTest others[] = {
        cmocka_unit_test(test_unknown_camera),
        cmocka_unit_test(test_camera_tolerance),
        cmocka_unit_test(test_camera_pixels),
        cmocka_unit_test(test_bounds),
        cmocka_unit_test(test_refused),
        cmocka_unit_test(test_tolerance),
        cmocka_unit_test(test_causes),
        cmocka_unit_test(test_terminal),
        cmocka_unit_test_setup_teardown(test_files, enter_folder, leave_folder)};
    for (size_t i = 0; i < COUNT(others); i++) tests[count++] = others[i];
    return _cmocka_run_group_tests("changes", tests, count, NULL, NULL);
}
