/* What the book says of its scenes, seen through their import. */
#include <string.h>

#include "lang/file.h"
#include "lang/import.h"
#include "monge.h"
#include "near.h"

static const struct lang_limits limits = {.nesting = 100, .values = 1000000};

/* The pixel of a scene of the book, linear. */
static vec3 pixel_of(const char *book, uint32_t x, uint32_t y) {
    struct arena arena = {0};
    struct diagnostics diag = {0};
    const char *text = lang_import(&arena, &diag, file_from_memory(&arena, "t", book, strlen(book)), &limits);
    diag_print(&diag, stdout);
    if (!text) fail_msg("not imported: %s", book);
    struct monge_diagnostics *load_diag = monge_diagnostics_new();
    struct monge_scene *scene = monge_load_memory("t", text, strlen(text), NULL, load_diag);
    monge_diagnostics_print(load_diag, stdout);
    if (!scene) fail_msg("not loaded: %s", text);
    const struct monge_settings settings = monge_scene_settings(scene);
    const struct monge_region region = {x, y, 1, 1};
    const struct monge_job job = {.threads = 1};
    struct monge_film *film = monge_render(scene, &settings, &region, &job, NULL);
    assert_non_null(film);
    const float *pixel = monge_film_pixels(film);
    const vec3 color = {pixel[0], pixel[1], pixel[2]};
    monge_film_free(film);
    monge_scene_free(scene);
    monge_diagnostics_free(load_diag);
    diag_free(&diag);
    arena_free(&arena);
    return color;
}

/* ---- Colours that the book states, to its five digits ---- */

#define CAMERA(size, from, to)                                                                               \
    "- {add: camera, " size ", field-of-view: 1.5707963267948966, from: " from ", to: " to "}\n"
#define DEFAULT_SPHERES                                                                                      \
    "- {add: sphere, material: {color: [0.8, 1.0, 0.6], diffuse: 0.7, specular: 0.2}}\n"                     \
    "- {add: sphere, transform: [[scale, 0.5, 0.5, 0.5]]}\n"
#define DEFAULT_WORLD "- {add: light, at: [-10, 10, -10], intensity: [1, 1, 1]}\n" DEFAULT_SPHERES

static const struct stated {
    const char *name, *book;
    uint32_t x, y;
    vec3 color;
} stated[] = {
    {"rendering the default world",
     CAMERA("width: 11, height: 11", "[0, 0, -5]", "[0, 0, 0]") DEFAULT_WORLD,
     5,
     5,
     {0.38066, 0.47583, 0.2855}},
    {"shading from the inside",
     CAMERA("width: 1, height: 1", "[0, 0, 0]",
            "[0, 0, 1]") "- {add: light, at: [0, 0.25, 0], intensity: [1, 1, 1]}\n" DEFAULT_SPHERES,
     0,
     0,
     {0.90498, 0.90498, 0.90498}},
    {"a reflective floor",
     CAMERA("width: 1, height: 1", "[0, 0, -3]", "[0, -1, -2]") DEFAULT_WORLD
     "- {add: plane, material: {reflective: 0.5}, transform: [[translate, 0, -1, 0]]}\n",
     0,
     0,
     {0.87677, 0.92436, 0.82918}},
    {"a ray that misses",
     CAMERA("width: 11, height: 11", "[0, 0, -5]", "[0, 0, 0]") DEFAULT_WORLD,
     0,
     0,
     {0, 0, 0}},
};

static void stated_color(void **state) {
    const struct stated *row = *state;
    assert_vec3_near(pixel_of(row->book, row->x, row->y), row->color, 5e-5, row->name);
}

/* ---- Where things are: a camera looks from `from` to `to`, a white object is there or not ---- */

#define WHITE "material: {ambient: 1, diffuse: 0, specular: 0}"
#define BALL  "add: sphere, " WHITE ", transform: [[scale, 0.01, 0.01, 0.01], "

static const struct sight {
    const char *name, *object, *from, *to;
    bool seen;
} sights[] = {
    {"rotate-x takes y to z", BALL "[translate, 0, 1, 0], [rotate-x, 0.7853981633974483]]",
     "[5, 0.70711, 0.70711]", "[0, 0.70711, 0.70711]", true},
    {"rotate-y takes z to x", BALL "[translate, 0, 0, 1], [rotate-y, 0.7853981633974483]]",
     "[0.70711, 5, 0.70711]", "[0.70711, 0, 0.70711]", true},
    {"rotate-z takes y to -x", BALL "[translate, 0, 1, 0], [rotate-z, 0.7853981633974483]]",
     "[-0.70711, 0.70711, -5]", "[-0.70711, 0.70711, 0]", true},
    {"a chain of transforms",
     BALL "[translate, 1, 0, 1], [rotate-x, 1.5707963267948966], [scale, 5, 5, 5], [translate, 10, 5, 7]]",
     "[3, 0, -7]", "[15, 0, 7]", true},
    {"shear x by y", BALL "[translate, 2, 3, 4], [shear, 1, 0, 0, 0, 0, 0]]", "[9, 9, 9]", "[5, 3, 4]", true},
    {"shear x by z", BALL "[translate, 2, 3, 4], [shear, 0, 1, 0, 0, 0, 0]]", "[9, 9, 9]", "[6, 3, 4]", true},
    {"shear y by x", BALL "[translate, 2, 3, 4], [shear, 0, 0, 1, 0, 0, 0]]", "[9, 9, 9]", "[2, 5, 4]", true},
    {"shear y by z", BALL "[translate, 2, 3, 4], [shear, 0, 0, 0, 1, 0, 0]]", "[9, 9, 9]", "[2, 7, 4]", true},
    {"shear z by x", BALL "[translate, 2, 3, 4], [shear, 0, 0, 0, 0, 1, 0]]", "[9, 9, 9]", "[2, 3, 6]", true},
    {"shear z by y", BALL "[translate, 2, 3, 4], [shear, 0, 0, 0, 0, 0, 1]]", "[9, 9, 9]", "[2, 3, 7]", true},
    {"a cube to its corner", "add: cube, " WHITE, "[0.999, 0.999, -5]", "[0.999, 0.999, 0]", true},
    {"a cube no further", "add: cube, " WHITE, "[1.001, 0.999, -5]", "[1.001, 0.999, 0]", false},
    {"a plane in y = 0", "add: plane, " WHITE, "[0, 1, 0]", "[50, -0.1, -80]", true},
    {"nothing above it", "add: plane, " WHITE, "[0, 1, 0]", "[50, 1.1, -80]", false},
    {"a cylinder without end", "add: cylinder, " WHITE, "[0, 1e7, -5]", "[0.999, 1e7, 0]", true},
    {"its radius", "add: cylinder, " WHITE, "[1.001, 7, -5]", "[1.001, 7, 0]", false},
    {"a cut cylinder", "add: cylinder, min: 1, max: 2, " WHITE, "[0.999, 1.999, -5]", "[0.999, 1.999, 0]",
     true},
    {"above it", "add: cylinder, min: 1, max: 2, " WHITE, "[0, 2.001, -5]", "[0, 2.001, 0]", false},
    {"below it", "add: cylinder, min: 1, max: 2, " WHITE, "[0, 0.999, -5]", "[0, 0.999, 0]", false},
    {"through an open one", "add: cylinder, min: 1, max: 2, " WHITE, "[0, 5, 0.1]", "[0.01, 0, 0.1]", false},
    {"onto a closed one", "add: cylinder, min: 1, max: 2, closed: true, " WHITE, "[0, 5, 0.1]",
     "[0.01, 0, 0.1]", true},
    {"from 3 up", "add: cylinder, min: 3, " WHITE, "[0, 3.001, -5]", "[0, 3.001, 0]", true},
    {"not below 3", "add: cylinder, min: 3, " WHITE, "[0, 2.999, -5]", "[0, 2.999, 0]", false},
    {"a cone without end", "add: cone, " WHITE, "[49.9, 50, -90]", "[49.9, 50, 0]", true},
    {"its side", "add: cone, " WHITE, "[50.1, 50, -90]", "[50.1, 50, 0]", false},
    {"a hat", "add: cone, min: -1, max: 0, " WHITE, "[0.49, -0.5, -5]", "[0.49, -0.5, 0]", true},
    {"beside a hat", "add: cone, min: -1, max: 0, " WHITE, "[0.51, -0.5, -5]", "[0.51, -0.5, 0]", false},
    {"above a hat", "add: cone, min: -1, max: 0, " WHITE, "[0.05, 0.5, -5]", "[0.05, 0.5, 0]", false},
    {"a funnel", "add: cone, min: 0, max: 2, " WHITE, "[1.49, 1.5, -5]", "[1.49, 1.5, 0]", true},
    {"an hourglass, above", "add: cone, min: -1, max: 2, " WHITE, "[1.99, 1.995, -5]", "[1.99, 1.995, 0]",
     true},
    {"an hourglass, below", "add: cone, min: -1, max: 2, " WHITE, "[0.99, -0.995, -5]", "[0.99, -0.995, 0]",
     true},
    {"an hourglass, no further", "add: cone, min: -1, max: 2, " WHITE, "[0.99, -1.005, -5]",
     "[0.99, -1.005, 0]", false},
    {"a bucket", "add: cone, min: 1, max: 2, " WHITE, "[1.49, 1.5, -5]", "[1.49, 1.5, 0]", true},
    {"beside a bucket", "add: cone, min: 1, max: 2, " WHITE, "[1.51, 1.5, -5]", "[1.51, 1.5, 0]", false},
    {"below a bucket", "add: cone, min: 1, max: 2, " WHITE, "[0, 0.99, -5]", "[0, 0.99, 0]", false},
    {"through an open bucket", "add: cone, min: 1, max: 2, " WHITE, "[0.1, 5, 0.1]", "[0.11, 0, 0.1]", false},
    {"onto a closed bucket", "add: cone, min: 1, max: 2, closed: true, " WHITE, "[0.1, 5, 0.1]",
     "[0.11, 0, 0.1]", true},
    {"a group carries its members",
     "add: group, transform: [[translate, 0, 0, 3]], children: [{" BALL "[translate, 0, 2, 0]]}]",
     "[4, 4, 4]", "[0, 2, 3]", true},
};

static void sight(void **state) {
    const struct sight *row = *state;
    char book[1024];
    snprintf(
        book, sizeof book,
        "- {add: camera, width: 1, height: 1, field-of-view: 0.001, from: %s, to: %s, up: [0.1, 1, 0.2]}\n"
        "- {add: light, at: [0, 0, 0], intensity: [1, 1, 1]}\n- {%s}\n",
        row->from, row->to, row->object);
    assert_vec3_near(pixel_of(book, 0, 0), vec3_all(row->seen ? 1.0 : 0.0), 1e-12, row->name);
}

/* ---- The camera ---- */

/* The book's ray through the corner of a canvas of 201 x 101, and where it is in the picture: the axes are left-handed. */
static void corner_ray(void **state) {
    (void)state;
    static const char book[] = CAMERA("width: 201, height: 101", "[0, 0, 0]",
                                      "[0, 0, -1]") "- {add: light, at: [0, 0, 0], intensity: [1, 1, 1]}\n"
                                                    "- {" BALL "[translate, 6.6519, 3.3259, -6.6851]]}\n"
                                                    "- {" BALL "[translate, 0, 0, -10]]}\n";
    assert_vec3_near(pixel_of(book, 0, 0), vec3_all(1.0), 1e-12, "pixel (0, 0)");
    assert_vec3_near(pixel_of(book, 200, 0), vec3_all(0.0), 1e-12, "pixel (200, 0)");
    assert_vec3_near(pixel_of(book, 100, 50), vec3_all(1.0), 1e-12, "pixel (100, 50)");
}

/* 2 tan(fov / 2) over the height, at distance 1: 0.01 in the book for both. */
static void pixel_size(void **state) {
    (void)state;
    static const struct {
        const char *size;
        double height;
    } rows[] = {{"width: 200, height: 125", 125}, {"width: 125, height: 200", 200}};
    for (size_t i = 0; i < COUNT(rows); i++) {
        char book[200];
        struct arena arena = {0};
        struct diagnostics diag = {0};
        snprintf(book, sizeof book, CAMERA("%s", "[0, 0, 0]", "[0, 0, -1]"), rows[i].size);
        const char *text =
            lang_import(&arena, &diag, file_from_memory(&arena, "t", book, strlen(book)), &limits);
        assert_non_null(text);
        const char *fov = strstr(text, "fov: ");
        assert_non_null(fov);
        const double half = strtod(fov + 5, NULL) * 3.14159265358979323846 / 360.0;
        assert_near(2.0 * tan(half) / rows[i].height, 0.01, 1e-14, rows[i].size);
        diag_free(&diag);
        arena_free(&arena);
    }
}

int main(void) {
    struct CMUnitTest tests[COUNT(stated) + COUNT(sights) + 2] = {cmocka_unit_test(corner_ray),
                                                                  cmocka_unit_test(pixel_size)};
    size_t count = 2;
    for (size_t i = 0; i < COUNT(stated); i++)
        tests[count++] = (struct CMUnitTest){stated[i].name, stated_color, NULL, NULL, (void *)&stated[i]};
    for (size_t i = 0; i < COUNT(sights); i++)
        tests[count++] = (struct CMUnitTest){sights[i].name, sight, NULL, NULL, (void *)&sights[i]};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
