/* What must not change a picture (threads, regions, the size of the world), and where cameras look. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "monge.h"
#include "near.h"
#include "render/camera.h"

static struct monge_scene *load(const char *text) {
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_scene *scene = monge_load_memory("test", text, strlen(text), NULL, diag);
    monge_diagnostics_print(diag, stderr);
    monge_diagnostics_free(diag);
    assert_non_null(scene);
    return scene;
}

static struct monge_film *render(struct monge_scene *scene, const struct monge_region *region,
                                 unsigned threads) {
    const struct monge_settings settings = monge_scene_settings(scene);
    const struct monge_job job = {.threads = threads};
    struct monge_film *film = monge_render(scene, &settings, region, &job, NULL);
    assert_non_null(film);
    return film;
}

/* Spheres, an ellipsoid, mirrors, glass, shadows, all shapes; `%g` the size of the world. */
static char *busy_scene(double s, double size_x, double size_y) {
    static const char form[] =
        "image: {size: [%g, %g], samples: 1}\n"
        "camera: {eye: [%.17g, %.17g, %.17g], look_at: [0, 0, 0], fov: 40}\n"
        "lights: [{point: {at: [%.17g, %.17g, %.17g]}}, {point: {at: [%.17g, %.17g, 0], color: [0.3, 0.3, "
        "0.3]}}, {ambient: {}}]\n"
        "materials:\n"
        "  clay: {ambient: [0.1, 0.1, 0.1], diffuse: [0.7, 0.5, 0.3], specular: [0.4, 0.4, 0.4]}\n"
        "  chrome: {diffuse: [0.1, 0.1, 0.1], reflection: 0.8}\n"
        "  glass: {diffuse: black, reflection: 0.1, refraction: 0.85, index: 1.5}\n"
        "scene:\n"
        "  - group:\n"
        "      - {plane: {point: [0, -1, 0], normal: [0, 1, 0]}, material: clay}\n"
        "      - {sphere: {center: [-1.2, -0.2, -1], radius: 0.8}, material: chrome}\n"
        "      - {sphere: {center: [0.6, -0.4, 0.9], radius: 0.6}, material: glass}\n"
        "      - {sphere: {}, transform: [{scale: [0.3, 0.8, 0.4]}, {rotate: {z: 30}}, {translate: [0.6, "
        "-0.1, -0.9]}], material: clay}\n"
        "      - {cylinder: {from: [1.5, -1, 0], to: [1.7, 0.2, -0.5], radius: 0.3}, material: clay}\n"
        "      - {cone: {from: [-0.6, -1, 0.6], to: [-0.6, 0, 0.4], radius: 0.4}, material: chrome}\n"
        "      - {paraboloid: {from: [-1.6, -1, 0.8], to: [-1.6, -0.4, 0.8], radius: 0.3, open: true}, "
        "material: clay}\n"
        "      - {hyperboloid: {from: [1.4, -1, 1], to: [1.4, -0.4, 1], radius: 0.2}, material: clay}\n"
        "      - {box: {min: [-2.2, -1, -1], max: [-1.9, 0.8, 0]}, transform: {rotate: {y: 20}}, material: "
        "clay}\n"
        "    transform: {scale: %.17g}\n";
    const size_t room = sizeof form + 500;
    char *text = malloc(room);
    snprintf(text, room, form, size_x, size_y, 2 * s, 1.5 * s, 6 * s, 4 * s, 5 * s, 3 * s, -5 * s, 2 * s, s);
    return text;
}

static void test_threads(void **state) {
    (void)state;
    char *text = busy_scene(1, 173, 101);
    struct monge_scene *scene = load(text);
    struct monge_film *one = render(scene, NULL, 1);
    const unsigned counts[] = {2, 3, 7, 64, 1024};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        struct monge_film *many = render(scene, NULL, counts[i]);
        assert_memory_equal(monge_film_pixels(one), monge_film_pixels(many), 173 * 101 * 3 * sizeof(float));
        monge_film_free(many);
    }
    monge_film_free(one);
    monge_scene_free(scene);
    free(text);
}

static void test_regions(void **state) {
    (void)state;
    char *text = busy_scene(1, 120, 90);
    struct monge_scene *scene = load(text);
    struct monge_film *whole = render(scene, NULL, 2);
    const struct monge_region regions[] = {
        {0, 0, 1, 1}, {119, 89, 1, 1}, {17, 5, 40, 33}, {0, 33, 120, 57}, {64, 0, 56, 90}};
    for (size_t i = 0; i < sizeof regions / sizeof *regions; i++) {
        const struct monge_region *r = &regions[i];
        struct monge_film *part = render(scene, r, 2);
        for (uint32_t y = 0; y < r->height; y++)
            assert_memory_equal(monge_film_pixels(part) + 3 * y * r->width,
                                monge_film_pixels(whole) + 3 * ((r->y + y) * 120 + r->x),
                                3 * r->width * sizeof(float));
        monge_film_free(part);
    }
    monge_film_free(whole);
    monge_scene_free(scene);
    free(text);
}

/* Pixels that differ by more than rounding can explain; an outline may move a pixel in a thousand. */
static size_t count_different(const float *a, const float *b, size_t pixels) {
    size_t different = 0;
    for (size_t i = 0; i < pixels; i++) {
        bool same = true;
        for (size_t c = 0; c < 3; c++) same &= fabs((double)a[3 * i + c] - (double)b[3 * i + c]) < 1e-5;
        different += !same;
    }
    return different;
}

/* Somebody who keeps tiles: a film of which the rows up to `known` are there. */
struct keeper {
    const struct monge_film *film;
    uint32_t known;
    atomic_uint given, done, stopped;
    atomic_bool cancel; /* set when a tile is done */
    bool impatient;
};

static const float *keeper_pixel(const struct keeper *k, const struct monge_region *tile, uint32_t y) {
    const struct monge_region all = monge_film_region(k->film);
    return monge_film_pixels(k->film) + 3 * ((size_t)(tile->y - all.y + y) * all.width + tile->x - all.x);
}

static bool give_tile(void *context, const struct monge_region *tile, float *rgb, size_t stride) {
    struct keeper *k = context;
    if (tile->y + tile->height > k->known) return false;
    for (uint32_t y = 0; y < tile->height; y++)
        memcpy(rgb + y * stride, keeper_pixel(k, tile, y), 3 * tile->width * sizeof *rgb);
    atomic_fetch_add(&k->given, tile->width * tile->height);
    return true;
}

static void take_tile(void *context, const struct monge_region *tile, const float *rgb, size_t stride) {
    struct keeper *k = context;
    for (uint32_t y = 0; y < tile->height; y++)
        assert_memory_equal(rgb + y * stride, keeper_pixel(k, tile, y), 3 * tile->width * sizeof *rgb);
    atomic_fetch_add(&k->done, tile->width * tile->height);
    if (k->impatient) atomic_store(&k->cancel, true);
}

static void stop_tiles(void *context) { atomic_fetch_add(&((struct keeper *)context)->stopped, 1); }

/* Tiles that are known are not rendered, the others are told, and the picture is the same. */
static void test_tiles(void **state) {
    (void)state;
    char *text = busy_scene(1, 173, 101);
    struct monge_scene *scene = load(text);
    const struct monge_settings settings = monge_scene_settings(scene);
    const struct monge_region part = {9, 5, 120, 90};
    struct monge_film *whole = render(scene, &part, 2);
    for (uint32_t known = 0; known <= 95; known += 19) {
        struct keeper k = {.film = whole, .known = known};
        const struct monge_tiles tiles = {&k, give_tile, take_tile, stop_tiles};
        const struct monge_job job = {.threads = 3, .tiles = &tiles, .cancel = &k.cancel};
        struct monge_stats stats;
        struct monge_film *film = monge_render(scene, &settings, &part, &job, &stats);
        assert_non_null(film);
        assert_memory_equal(monge_film_pixels(film), monge_film_pixels(whole), 120 * 90 * 3 * sizeof(float));
        assert_int_equal(k.given + k.done, 120 * 90);
        assert_int_equal(stats.rays[MONGE_RAY_CAMERA], k.done);
        assert_int_equal(k.stopped, 0);
        assert_true(known < 95 || k.done == 0);
        monge_film_free(film);
    }
    struct keeper k = {.film = whole, .impatient = true};
    const struct monge_tiles tiles = {&k, give_tile, take_tile, stop_tiles};
    const struct monge_job job = {.threads = 2, .tiles = &tiles, .cancel = &k.cancel};
    assert_null(monge_render(scene, &settings, &part, &job, NULL));
    assert_true(k.done >= 1 && k.done < 120 * 90);
    assert_int_equal(k.stopped, 1);
    monge_film_free(whole);
    monge_scene_free(scene);
    free(text);
}

/* Somebody who has all tiles, and notes which are asked for. */
struct asking {
    size_t tiles, all; /* asked for; of the picture */
    double x, y;       /* sums over the first eighth: of the tiles' middles, as parts of the picture */
    double width, height;
};

static bool note_tile(void *context, const struct monge_region *tile, float *rgb, size_t stride) {
    struct asking *asking = context;
    (void)rgb, (void)stride;
    if (asking->tiles++ >= asking->all / 8) return true;
    asking->x += (tile->x + 0.5 * tile->width) / asking->width;
    asking->y += (tile->y + 0.5 * tile->height) / asking->height;
    return true;
}

/* The first tiles are spread over the picture: their mean is its middle. So what they took tells what the others will. */
static void test_first_tiles(void **state) {
    (void)state;
    static const uint32_t sizes[][2] = {{640, 480}, {512, 512}, {1920, 64}, {96, 1600}, {1057, 737}};
    char *text = busy_scene(1, 32, 32);
    struct monge_scene *scene = load(text);
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        struct monge_settings settings = monge_scene_settings(scene);
        settings.width = sizes[i][0], settings.height = sizes[i][1];
        struct asking asking = {.width = settings.width, .height = settings.height};
        const struct monge_tiles tiles = {&asking, note_tile, NULL, NULL};
        const struct monge_job job = {.threads = 1, .tiles = &tiles};
        monge_film_free(monge_render(scene, &settings, NULL, &job, NULL)); /* to count them */
        asking.all = asking.tiles;
        asking.tiles = 0;
        struct monge_film *film = monge_render(scene, &settings, NULL, &job, NULL);
        assert_non_null(film);
        const double first = (double)(asking.all / 8);
        assert_near(asking.x / first, 0.5, 0.1, "their middle along x");
        assert_near(asking.y / first, 0.5, 0.1, "their middle along y");
        monge_film_free(film);
    }
    monge_scene_free(scene);
    free(text);
}

static void test_scale_of_the_world(void **state) {
    (void)state;
    char *text = busy_scene(1, 160, 120);
    struct monge_scene *scene = load(text);
    struct monge_film *plain = render(scene, NULL, 2);
    const double scales[] = {1e-4, 1e6, 1e-30, 1e30, 3.7};
    for (size_t i = 0; i < sizeof scales / sizeof *scales; i++) {
        char *scaled_text = busy_scene(scales[i], 160, 120);
        struct monge_scene *scaled = load(scaled_text);
        struct monge_film *film = render(scaled, NULL, 2);
        const size_t different =
            count_different(monge_film_pixels(plain), monge_film_pixels(film), 160 * 120);
        if (different > 3) fail_msg("at scale %g %zu pixels differ", scales[i], different);
        monge_film_free(film);
        monge_scene_free(scaled);
        free(scaled_text);
    }
    monge_film_free(plain);
    monge_scene_free(scene);
    free(text);
}

/* ---- Samples ---- */

static double reversed_bits(unsigned i) {
    double sum = 0;
    for (int bit = 0; bit < 20; bit++) sum += (i >> bit & 1) * pow(0.5, bit + 1);
    return sum;
}

/* A pixel of Hammersley's points by how many of them lie left of and above a corner, for random corners: i of n is in the
 * middle of the i-th column, and of one of as many rows as the next power of two. */
static void test_samples(void **state) {
    (void)state;
    struct random r = random_begin();
    for (int trial = 0; trial < 400; trial++) {
        const unsigned n = 1 + random_below(&r, trial % 2 ? 70 : 9);
        const double x = random_between(&r, 0, 3), y = random_between(&r, 0, 2);
        char text[400];
        snprintf(text, sizeof text,
                 "image: {size: [3, 2], samples: %u, background: black}\nrender: {shading: signature}\n"
                 "camera: {projection: orthographic, height: 2, eye: [1.5, -1, 5], direction: [0, 0, -1]}\n"
                 "scene: [{square: {center: [%.17g, %.17g, 0], size: 100}, material: {diffuse: white}}]\n",
                 n, x - 50, 50 - y);
        struct monge_scene *scene = load(text);
        struct monge_film *film = render(scene, NULL, 1);
        double rows = 1;
        while (rows < n) rows *= 2;
        for (unsigned i = 0; i < 6; i++) {
            unsigned count = 0;
            for (unsigned k = 0; k < n; k++)
                count += i % 3 + (k + 0.5) / n < x && i / 3 + reversed_bits(k) + 0.5 / rows < y;
            assert_near((double)monge_film_pixels(film)[3 * i], (double)count / n, 1e-6, "samples");
        }
        monge_film_free(film);
        monge_scene_free(scene);
    }
}

/* ---- What is told of a rendering ---- */

#define FACING_A_PLANE                                                                                       \
    "image: {size: [7, 5], samples: 3}\ncamera: {projection: orthographic, height: 1, eye: [0, 0, 2], "      \
    "direction: [0, 0, -1]}\n"
enum { RAYS = 7 * 5 * 3 };

static struct counts {
    const char *name, *scene;
    uint64_t rays[MONGE_RAY_KINDS];
} counts[] = {
    {"rays of a lit plane", "lights: [{point: {at: [0, 0, 9]}}]\nscene: [{plane: {}}]", {RAYS, RAYS, 0, 0}},
    {"two lights, two shadow rays",
     "lights: [{point: {at: [0, 0, 9]}}, {point: {at: [0, 1, 9]}}, {ambient: {}}]\nscene: [{plane: {}}]",
     {RAYS, 2 * RAYS, 0, 0}},
    {"none to a light behind", "lights: [{point: {at: [0, 0, -9]}}]\nscene: [{plane: {}}]", {RAYS, 0, 0, 0}},
    {"none without shadows",
     "render: {shadow: 1}\nlights: [{point: {at: [0, 0, 9]}}]\nscene: [{plane: {}}]",
     {RAYS, 0, 0, 0}},
    {"none for the background",
     "lights: [{point: {at: [0, 0, 9]}}]\nscene: [{plane: {point: [0, 0, 3]}}]",
     {RAYS, 0, 0, 0}},
    {"a mirror",
     "lights: []\nscene: [{plane: {}, material: {diffuse: black, reflection: 0.5}}]",
     {RAYS, 0, RAYS, 0}},
    {"a sheet of glass",
     "lights: []\nscene: [{plane: {}, material: {diffuse: black, reflection: 0.5, refraction: 0.5}}]",
     {RAYS, 0, RAYS, RAYS}},
    {"no deeper than the depth",
     "render: {depth: 4}\nlights: []\nmaterials: {m: {diffuse: black, reflection: 1}}\nscene: [{plane: {}, "
     "material: m}, {plane: {point: [0, 0, 3]}, material: m}]",
     {RAYS, 0, 3 * RAYS, 0}},
    {"signatures ask for nothing more",
     "render: {shading: signature}\nlights: [{point: {at: [0, 0, 9]}}]\nscene: [{plane: {}, material: "
     "{reflection: 1}}]",
     {RAYS, 0, 0, 0}},
};

static void check_counts(void **state) {
    const struct counts *row = *state;
    char text[1000];
    snprintf(text, sizeof text, "%s%s\n", FACING_A_PLANE, row->scene);
    struct monge_scene *scene = load(text);
    const struct monge_settings settings = monge_scene_settings(scene);
    const struct monge_job job = {.threads = 3};
    struct monge_stats stats = {0};
    monge_film_free(monge_render(scene, &settings, NULL, &job, &stats));
    for (int kind = 0; kind < MONGE_RAY_KINDS; kind++) assert_int_equal(stats.rays[kind], row->rays[kind]);
    monge_scene_free(scene);
}

struct told {
    uint64_t done, total;
    unsigned calls;
};

static void tell(void *context, uint64_t done, uint64_t total) {
    struct told *told = context;
    assert_true(told->done < done && done <= total);
    *told = (struct told){done, total, told->calls + 1};
}

static void test_progress(void **state) {
    (void)state;
    struct monge_scene *scene = load("image: {size: [100, 70], samples: 1}\nscene: [{sphere: {}}]\n");
    const struct monge_settings settings = monge_scene_settings(scene);
    const struct monge_region regions[] = {{0, 0, 100, 70}, {3, 5, 64, 32}, {9, 9, 1, 1}};
    const unsigned rows[] = {4 * 70, 2 * 32, 1}; /* of tiles */
    for (size_t i = 0; i < sizeof regions / sizeof *regions; i++) {
        const uint64_t pixels = (uint64_t)regions[i].width * regions[i].height;
        struct told told = {0};
        const struct monge_job job = {.threads = 1, .progress = tell, .context = &told};
        struct monge_stats stats;
        monge_film_free(monge_render(scene, &settings, &regions[i], &job, &stats));
        assert_int_equal(told.done, pixels);
        assert_int_equal(told.total, pixels);
        assert_int_equal(stats.rays[MONGE_RAY_CAMERA], pixels);
        assert_int_equal(stats.threads, 1);
        assert_true(told.calls == pixels || told.calls == rows[i]);
    }
    monge_scene_free(scene);
}

static void test_no_more_threads_than_tiles(void **state) {
    (void)state;
    struct monge_scene *scene = load("image: {size: [9, 9], samples: 1}\nscene: [{sphere: {}}]\n");
    const struct monge_settings settings = monge_scene_settings(scene);
    const struct monge_region one = {3, 3, 1, 1};
    const struct monge_job job = {.threads = 8};
    struct monge_stats stats;
    monge_film_free(monge_render(scene, &settings, &one, &job, &stats));
    assert_int_equal(stats.threads, 1);
    monge_scene_free(scene);
}

#ifdef __GLIBC__
/* The film is all that a rendering leaves, once malloc has filled its own caches. */
static void test_memory(void **state) {
    (void)state;
    struct monge_scene *scene = load("image: {size: [9, 9], samples: 1}\nscene: [{sphere: {}}]\n");
    size_t used[40];
    for (int i = 0; i < 40; i++) {
        monge_film_free(render(scene, NULL, 1));
        used[i] = mallinfo2().uordblks;
    }
    assert_int_equal(used[20], used[39]);
    monge_scene_free(scene);
}
#endif

/* ---- Cameras ---- */

static void assert_vec3(vec3 got, vec3 want, double tolerance) {
    if (!(vec3_max_abs(vec3_sub(got, want)) <= tolerance))
        fail_msg("(%g, %g, %g), want (%g, %g, %g)", got.x, got.y, got.z, want.x, want.y, want.z);
}

/* The view of a scene without objects. */
static struct view view_of(const struct scene *scene, uint32_t width, uint32_t height) {
    struct arena arena = {0};
    const struct accel *accel = accel_build(&arena, &scene->primitives, NULL, 0, NULL);
    const struct view view = camera_view(scene, accel, width, height);
    arena_free(&arena);
    return view;
}

static void test_perspective(void **state) {
    (void)state;
    const struct scene scene = {.camera = {.has_eye = true,
                                           .has_look_at = true,
                                           .eye = {0, 0, 1},
                                           .look_at = {0, 0, -1},
                                           .up = {0, 1, 0},
                                           .fov_deg = 60}};
    const struct view view = view_of(&scene, 320, 240);
    const double tan30 = 0.57735026918962576;
    assert_vec3(camera_ray(&view, 0.5, 0.5).dir, (vec3){0, 0, -1}, 1e-15);
    assert_vec3(camera_ray(&view, 0.5, 0).dir, (vec3){0, tan30, -1}, 1e-15); /* top */
    assert_vec3(camera_ray(&view, 1, 0.5).dir, (vec3){tan30 * 4 / 3, 0, -1},
                1e-15); /* right: square pixels */
    assert_vec3(camera_ray(&view, 0, 1).org, (vec3){0, 0, 1}, 0);
}

static void test_orthographic(void **state) {
    (void)state;
    const struct scene scene = {.camera = {.projection = CAMERA_ORTHOGRAPHIC,
                                           .has_eye = true,
                                           .has_direction = true,
                                           .has_height = true,
                                           .eye = {0, 10, 0},
                                           .direction = {0, -2, 0},
                                           .up = {0, 0, -1},
                                           .has_up = true,
                                           .height = 4}};
    const struct view view = view_of(&scene, 200, 100);
    assert_vec3(camera_ray(&view, 0.5, 0.5).org, (vec3){0, 10, 0}, 1e-15);
    assert_vec3(camera_ray(&view, 1, 0).org, (vec3){4, 10, -2}, 1e-15);
    assert_vec3(camera_ray(&view, 0, 1).dir, (vec3){0, -1, 0}, 1e-15);
}

static void test_straight_down(void **state) {
    (void)state;
    const struct scene scene = {.camera = {.has_eye = true,
                                           .has_look_at = true,
                                           .eye = {0, 5, 0},
                                           .look_at = {0, 0, 0},
                                           .up = {0, 1, 0},
                                           .fov_deg = 90}};
    const struct view view = view_of(&scene, 100, 100);
    assert_vec3(camera_ray(&view, 0.5, 0).dir, (vec3){0, -1, -1}, 1e-15); /* what is far is up */
}

/* No pixel of the border shows the object, and some pixel within a fifth of it does. */
static void check_framed(const char *text) {
    struct monge_scene *scene = load(text);
    struct monge_film *film = render(scene, NULL, 1);
    const struct monge_region r = monge_film_region(film);
    double border = 0, inner = 0;
    for (uint32_t y = 0; y < r.height; y++)
        for (uint32_t x = 0; x < r.width; x++) {
            const double v = (double)monge_film_pixels(film)[3 * (y * r.width + x)];
            const uint32_t right = r.width - 1 - x, below = r.height - 1 - y;
            if (x == 0 || y == 0 || right == 0 || below == 0)
                border += v;
            else if (5 * x < r.width || 5 * y < r.height || 5 * right < r.width || 5 * below < r.height)
                inner += v;
        }
    if (border > 0) fail_msg("cut off: %s", text);
    if (!(inner > 0)) fail_msg("too small: %s", text);
    monge_film_free(film);
    monge_scene_free(scene);
}

/* Whatever the file leaves open, all of the scene is in the picture and fills a good part of it. */
static void test_framing(void **state) {
    (void)state;
    static const char *const objects[] = {
        "{sphere: {}}",
        "{sphere: {center: [100, -50, 3], radius: 0.001}}",
        "{square: {center: [1, 2, 3], size: 4}, transform: [{rotate: {x: -30}}, {rotate: {y: -20}}]}",
        "{disc: {center: [5, 0, 0], radius: 3}, transform: [{rotate: {x: -30}}, {rotate: {y: -20}}]}",
        "{box: {max: [50, 0.5, 0.5]}}",
        "{box: {max: [0.5, 50, 0.5]}}",
        "{box: {min: [-40, -0.5, -0.5]}, transform: {rotate: {y: 70}}}",
        "{group: [{sphere: {}}, {sphere: {center: [0, 9, 0]}}, {cone: {from: [5, 0, 0], to: [5, 0, -9]}}]}",
    };
    static const char *const cameras[] = {
        "{}",
        "{fov: 5}",
        "{fov: 120}",
        "{projection: orthographic}",
        "{direction: [1, -1, 0.3]}",
        "{direction: [0, -1, 0]}",
        "{direction: [0, 0, 1], projection: orthographic}",
    };
    static const double sizes[][2] = {{48, 36}, {90, 20}, {20, 90}};
    for (size_t i = 0; i < sizeof objects / sizeof *objects; i++)
        for (size_t j = 0; j < sizeof cameras / sizeof *cameras; j++)
            for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++) {
                char text[1000];
                snprintf(text, sizeof text,
                         "image: {size: [%g, %g], background: black}\nrender: {shading: signature}\ncamera: "
                         "%s\nscene: [%s]\n",
                         sizes[k][0], sizes[k][1], cameras[j], objects[i]);
                check_framed(text);
            }
}

/* From within a ball of glass in a larger one of the same glass, whose centre is the eye: nothing is bent where it goes on
 * in the same, nor where it leaves straight. So the sky is as without them. */
static void test_eye_in_glass(void **state) {
    (void)state;
    static const char form[] =
        "image: {size: [24, 16], samples: 1, background: {bottom: '#204060', top: '#f0c080'}}\n"
        "camera: {eye: [0, 0, 0], look_at: [0.2, 0.3, -1], fov: 100}\n"
        "lights: []\n"
        "scene:\n"
        "  - group: [{sphere: {radius: %g}}, {sphere: {center: [%g, 0, 0], radius: %g}}]\n"
        "    material: {diffuse: black, refraction: 1, index: 1.5}\n";
    char glass[600], sky[600];
    snprintf(glass, sizeof glass, form, 5.0, 0.6, 1.0);
    snprintf(sky, sizeof sky, form, 1e-3, 0.0, 2e-3); /* the eye is in the middle of both: straight again */
    struct monge_scene *scenes[] = {load(glass), load(sky)};
    struct monge_film *films[] = {render(scenes[0], NULL, 1), render(scenes[1], NULL, 1)};
    for (size_t i = 0; i < 24 * 16 * 3; i++)
        assert_near((double)monge_film_pixels(films[0])[i], (double)monge_film_pixels(films[1])[i], 1e-6,
                    "the sky");
    for (int i = 0; i < 2; i++) {
        monge_film_free(films[i]);
        monge_scene_free(scenes[i]);
    }
}

int main(void) {
    struct CMUnitTest rows[sizeof counts / sizeof *counts];
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++)
        rows[i] = (struct CMUnitTest){counts[i].name, check_counts, NULL, NULL, &counts[i]};
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_progress),
        cmocka_unit_test(test_no_more_threads_than_tiles),
#ifdef __GLIBC__
        cmocka_unit_test(test_memory),
#endif
        cmocka_unit_test(test_threads),
        cmocka_unit_test(test_regions),
        cmocka_unit_test(test_tiles),
        cmocka_unit_test(test_first_tiles),
        cmocka_unit_test(test_samples),
        cmocka_unit_test(test_eye_in_glass),
        cmocka_unit_test(test_scale_of_the_world),
        cmocka_unit_test(test_perspective),
        cmocka_unit_test(test_orthographic),
        cmocka_unit_test(test_straight_down),
        cmocka_unit_test(test_framing),
    };
    return cmocka_run_group_tests_name("rays", rows, NULL, NULL) +
           cmocka_run_group_tests_name("render", tests, NULL, NULL);
}
