/* Where the report is wrong: for each slip a test that fails on it. grammar/errata.md lists them by the
 * names of these tests. Pictures of cylinders, cones and ellipsoids are worked out here in long double,
 * by the right formulas and by the report's, which must not give the same. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "monge.h"

typedef long double real;

static const real pi = 3.14159265358979323846264338327950288L;

#define PIXEL "image: {size: [1, 1], samples: 1, background: black}\n"
#define GLOW(color)                                                                                          \
    "{ambient: " color ", diffuse: black}" /* its colour is seen under GLOW_LIGHT alone, flat */
#define GLOW_LIGHT "lights: [{ambient: {}}]\n"
#define GLASS      "{diffuse: black, refraction: 1, index: 1.5}"
#define SLANTED    "camera: {eye: [-5, 0, 5], direction: [1, 0, -1]}\n" /* at 45 degrees through the origin */

static struct monge_film *render(const char *text, const double *shadow) {
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_scene *scene = monge_load_memory("errata", text, strlen(text), NULL, diag);
    monge_diagnostics_print(diag, stderr);
    assert_non_null(scene);
    struct monge_settings settings = monge_scene_settings(scene);
    if (shadow) settings.shadow = *shadow;
    struct monge_film *film = monge_render(scene, &settings, NULL, NULL, NULL);
    assert_non_null(film);
    monge_scene_free(scene);
    monge_diagnostics_free(diag);
    return film;
}

/* The colour of the one pixel of a scene. */
static void probe(const char *text, double color[3]) {
    struct monge_film *film = render(text, NULL);
    for (int i = 0; i < 3; i++) color[i] = (double)monge_film_pixels(film)[i];
    monge_film_free(film);
}

static void assert_color(const char *text, double red, double green, double blue) {
    double got[3];
    const double want[3] = {red, green, blue};
    probe(text, got);
    for (int i = 0; i < 3; i++)
        if (!(fabs(got[i] - want[i]) < 1e-6)) fail_msg("channel %d is %.9g, want %.9g", i, got[i], want[i]);
}

static void assert_near(double got, double want, double tolerance, const char *what) {
    if (!(fabs(got - want) <= tolerance)) fail_msg("%s is %.12g, want %.12g", what, got, want);
}

/* ---- A: which vector a mirror mirrors ---- */

/* The view, mirrored, meets the red wall; the light, mirrored, would meet the blue one. */
static void test_view_is_mirrored(void **state) {
    (void)state;
    assert_color(
        PIXEL SLANTED
        "lights: [{ambient: {}}, {point: {at: [5, 0, 1], color: black}}]\n"
        "scene:\n"
        "  - {plane: {}, material: {diffuse: black, reflection: 1}}\n"
        "  - {square: {size: 12}, transform: [{rotate: {y: 90}}, {translate: [9, 0, 6.5]}], material: " GLOW(
            "red") "}\n"
                   "  - {square: {size: 2}, transform: [{rotate: {y: 90}}, {translate: [-9, 0, 1.8]}], "
                   "material: " GLOW("blue") "}\n",
        1, 0, 0);
}

/* r = d - 2 (n.d) n whatever the length of a normal or the scale of what carries it. */
static void test_mirror_under_a_scale(void **state) {
    (void)state;
    assert_color(
        PIXEL SLANTED GLOW_LIGHT
        "scene:\n"
        "  - {square: {}, transform: {scale: [7, 3, 0.01]}, material: {diffuse: black, reflection: 1}}\n"
        "  - {disc: {center: [4, 0, 4], normal: [1, 0, 1], radius: 0.001}, material: " GLOW("red") "}\n",
        1, 0, 0);
}

/* ---- A: the offset of secondary rays ---- */

static const char *const bodies[] = {
    "sphere: {}",
    "sphere: {}, transform: {scale: [1, 1.5, 0.5]}",
    "cylinder: {}, transform: [{scale: [1, 1, 2]}, {rotate: {x: 70}}, {rotate: {y: 25}}]",
    "cone: {}, transform: [{translate: [0, 0, 0.5]}, {scale: 1.5}, {rotate: {x: -60}}, {rotate: {y: 25}}]",
    "box: {}, transform: [{scale: 1.4}, {rotate: {x: 30}}, {rotate: {y: 30}}]",
};

/* One convex body of `size`, about (at, at, at), seen and lit from direction `side` in x, y and z. */
static char *lone_body(const char *body, double size, double at, const double side[3]) {
    static char text[1000];
    char moved[300];
    const char *steps = strstr(body, "transform: ");
    const int shape = steps ? (int)(steps - body - 2) : (int)strlen(body);
    snprintf(moved, sizeof moved, "group: [{%.*s%s%s}]", shape, body, steps ? ", " : "", steps ? steps : "");
    snprintf(text, sizeof text,
             "image: {size: [48, 48], samples: 1, background: black}\n"
             "camera: {eye: [%.17g, %.17g, %.17g], look_at: [%.17g, %.17g, %.17g], fov: 30}\n"
             "lights: [{point: {at: [%.17g, %.17g, %.17g]}}]\n"
             "scene: [{%s, transform: [{scale: %.17g}, {translate: [%.17g, %.17g, %.17g]}], material: "
             "{diffuse: white}}]\n",
             at + 5 * size * side[0], at + 5 * size * side[1], at + 5 * size * side[2], at, at, at,
             at + 20 * size * side[0], at + 2 * size * side[1], at + 20 * size * side[2], moved, size, at, at,
             at);
    return text;
}

/* A convex body throws no shadow on itself: with shadows and without them its picture is the same. */
static void no_shadow_on_itself(double size, double at) {
    static const double sides[][3] = {{1, 1, 1}, {-1, 1, 1}, {1, -1, -1}, {-1, -1, -1}, {0.1, 0.2, -1.5}};
    const double black = 0, none = 1;
    for (size_t i = 0; i < sizeof bodies / sizeof *bodies; i++)
        for (size_t j = 0; j < sizeof sides / sizeof *sides; j++) {
            const char *text = lone_body(bodies[i], size, at, sides[j]);
            struct monge_film *with = render(text, &black), *without = render(text, &none);
            const float *a = monge_film_pixels(with), *b = monge_film_pixels(without);
            double sum = 0;
            for (size_t k = 0; k < (size_t)48 * 48 * 3; k++) {
                sum += (double)b[k];
                if (fabsf(a[k] - b[k]) > 1e-4f)
                    fail_msg("{%s}, size %g at %g, side %zu: value %zu is %g in shadow, %g without",
                             bodies[i], size, at, j, k, (double)a[k], (double)b[k]);
            }
            assert_true(sum > 100);
            monge_film_free(with);
            monge_film_free(without);
        }
}

static void test_offset_at_size_one(void **state) {
    (void)state;
    no_shadow_on_itself(1, 0);
}

static void test_offset_small(void **state) {
    (void)state;
    no_shadow_on_itself(1e-4, 0);
}

static void test_offset_large(void **state) {
    (void)state;
    no_shadow_on_itself(1e6, 0);
}

static void test_offset_far_away(void **state) {
    (void)state;
    no_shadow_on_itself(1, 1e5);
    no_shadow_on_itself(1e-4, 10);
}

/* Mirrors, glass and shadows on a scale that a fixed offset would drown in, or would not leave. */
static char *scaled_world(double s) {
    static char text[2000];
    snprintf(
        text, sizeof text,
        "image: {size: [96, 72], samples: 1, background: {bottom: white, top: black}}\n"
        "camera: {eye: [%.17g, %.17g, %.17g], look_at: [0, 0, 0], fov: 40}\n"
        "lights: [{point: {at: [%.17g, %.17g, %.17g]}}, {ambient: {}}]\n"
        "scene:\n"
        "  - group:\n"
        "      - {plane: {point: [0, -1, 0], normal: [0, 1, 0]}, material: {diffuse: [0.8, 0.8, 0.7], "
        "reflection: 0.1}}\n"
        "      - {sphere: {center: [-1.1, 0, 0]}, material: {diffuse: [0.1, 0.1, 0.1], reflection: 0.8}}\n"
        "      - {sphere: {center: [1, -0.2, 0.3], radius: 0.8}, material: " GLASS "}\n"
        "      - {cylinder: {from: [0.2, -1, -1], to: [0.2, 1, -1.4], radius: 0.3}, material: {diffuse: "
        "[0.8, 0.2, 0.1]}}\n"
        "      - {cone: {from: [-0.2, -1, 1], to: [-0.2, 0, 1], radius: 0.4}, material: {diffuse: [0.1, 0.6, "
        "0.3], reflection: 0.2}}\n"
        "    transform: {scale: %.17g}\n",
        1 * s, 2 * s, 7 * s, -4 * s, 6 * s, 5 * s, s);
    return text;
}

static size_t pixels_that_differ(const char *text, const struct monge_film *want, float tolerance) {
    struct monge_film *film = render(text, NULL);
    const float *a = monge_film_pixels(want), *b = monge_film_pixels(film);
    size_t count = 0;
    for (size_t i = 0; i < 96 * 72; i++) {
        bool same = true;
        for (size_t c = 0; c < 3; c++) same = same && fabsf(a[3 * i + c] - b[3 * i + c]) <= tolerance;
        count += !same;
    }
    monge_film_free(film);
    return count;
}

static void test_same_picture_at_any_scale(void **state) {
    (void)state;
    struct monge_film *one = render(scaled_world(1), NULL);
    assert_int_equal(pixels_that_differ(scaled_world(0x1p-13), one, 0), 0); /* powers of two round alike */
    assert_int_equal(pixels_that_differ(scaled_world(0x1p20), one, 0), 0);
    assert_int_equal(pixels_that_differ(scaled_world(1e-4), one, 1e-4f), 0);
    assert_int_equal(pixels_that_differ(scaled_world(1e6), one, 1e-4f), 0);
    monge_film_free(one);
}

/* ---- C, D and normals: pictures against closed forms ---- */

typedef struct {
    real x, y, z;
} vec;

static vec add(vec a, vec b) { return (vec){a.x + b.x, a.y + b.y, a.z + b.z}; }
static vec times(real s, vec a) { return (vec){s * a.x, s * a.y, s * a.z}; }
static vec minus(vec a, vec b) { return add(a, times(-1, b)); }
static real dot(vec a, vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static vec unit(vec a) { return times(1 / sqrtl(dot(a, a)), a); }

enum kind { ELLIPSOID, CYLINDER, CONE };

enum slip {
    NO_SLIP,
    NO_RADIUS,        /* C without - R^2 */
    FACTOR_TWO,       /* B doubled, in roots that want it single */
    ROOT_SIGN,        /* (B +- ...) / 2A */
    FLAT_CONE_NORMAL, /* the position minus (0, 0, z) */
    NORMAL_BY_MATRIX, /* as a direction, not by the inverse transpose */
    NOT_NORMALIZED,   /* the inverse transpose alone */
    INSIDE_OUT,       /* a mirrored transform turns the normals */
};

enum step_kind { END, SCALE, ROTATE_X, ROTATE_Y, ROTATE_Z, TRANSLATE };
struct step {
    enum step_kind kind;
    double x, y, z; /* a rotation: x alone, degrees */
};

/* A canonical body under steps, the first first. */
static const struct row {
    const char *name;
    enum kind kind;
    enum slip slip; /* must give another picture */
    struct step steps[4];
} rows[] = {
    {"cylinder: the equation has - R^2", CYLINDER, NO_RADIUS, {{ROTATE_X, 50, 0, 0}, {ROTATE_Y, 20, 0, 0}}},
    {"cylinder: a factor 2 in B is one in the roots too",
     CYLINDER,
     FACTOR_TWO,
     {{ROTATE_X, 50, 0, 0}, {ROTATE_Y, 20, 0, 0}}},
    {"cylinder: the roots have - B", CYLINDER, ROOT_SIGN, {{ROTATE_X, 50, 0, 0}, {ROTATE_Y, 20, 0, 0}}},
    {"cone: the roots have - B", CONE, ROOT_SIGN, {{ROTATE_X, -60, 0, 0}, {ROTATE_Y, 20, 0, 0}}},
    {"cone: its normal has a z component",
     CONE,
     FLAT_CONE_NORMAL,
     {{ROTATE_X, -60, 0, 0}, {ROTATE_Y, 20, 0, 0}}},
    {"cone: and keeps it under a scale",
     CONE,
     FLAT_CONE_NORMAL,
     {{SCALE, 0.8, 0.6, 1.5}, {ROTATE_X, -50, 0, 0}}},
    {"normals: by the inverse transpose, ellipsoid",
     ELLIPSOID,
     NORMAL_BY_MATRIX,
     {{SCALE, 0.6, 1.4, 0.8}, {ROTATE_Z, 40, 0, 0}, {ROTATE_X, -45, 0, 0}}},
    {"normals: by the inverse transpose, cylinder",
     CYLINDER,
     NORMAL_BY_MATRIX,
     {{SCALE, 1.2, 0.5, 1.2}, {ROTATE_X, 60, 0, 0}, {ROTATE_Y, 30, 0, 0}}},
    {"normals: by the inverse transpose, cone",
     CONE,
     NORMAL_BY_MATRIX,
     {{SCALE, 1.3, 0.6, 1.2}, {ROTATE_X, -60, 0, 0}, {ROTATE_Y, 30, 0, 0}}},
    {"normals: normalized after that",
     ELLIPSOID,
     NOT_NORMALIZED,
     {{SCALE, 0.6, 1.4, 0.8}, {ROTATE_Z, 40, 0, 0}}},
    {"normals: outwards under one mirroring",
     ELLIPSOID,
     INSIDE_OUT,
     {{SCALE, -0.6, 1.4, 0.8}, {ROTATE_Z, 40, 0, 0}}},
    {"normals: outwards under three mirrorings",
     CYLINDER,
     INSIDE_OUT,
     {{SCALE, -1.1, -0.7, -1.2}, {ROTATE_X, 60, 0, 0}, {ROTATE_Y, 30, 0, 0}}},
    {"normals: outwards from a mirrored cone",
     CONE,
     INSIDE_OUT,
     {{SCALE, 1.1, 0.9, -1.4}, {ROTATE_X, 120, 0, 0}, {TRANSLATE, 0.1, -0.5, 0.2}}},
};

enum { WIDTH = 64, HEIGHT = 48 };

static vec turn(enum step_kind axis, real deg, vec p) {
    const real c = cosl(deg * pi / 180), s = sinl(deg * pi / 180);
    if (axis == ROTATE_X) return (vec){p.x, c * p.y - s * p.z, s * p.y + c * p.z};
    if (axis == ROTATE_Y) return (vec){c * p.x + s * p.z, p.y, c * p.z - s * p.x};
    return (vec){c * p.x - s * p.y, s * p.x + c * p.y, p.z};
}

/* A point (w = 1) or a direction (w = 0) of the world, in the space of the body. */
static vec to_object(const struct row *row, vec p, real w) {
    int last = 0;
    while (last < 4 && row->steps[last].kind != END) last++;
    while (last-- > 0) {
        const struct step *s = &row->steps[last];
        if (s->kind == SCALE)
            p = (vec){p.x / (real)s->x, p.y / (real)s->y, p.z / (real)s->z};
        else if (s->kind == TRANSLATE)
            p = minus(p, times(w, (vec){(real)s->x, (real)s->y, (real)s->z}));
        else
            p = turn(s->kind, -(real)s->x, p);
    }
    return p;
}

/* A normal of the body in the world. A rotation is its own inverse transpose, a scale is inverted. */
static vec normal_to_world(const struct row *row, vec n, enum slip slip) {
    real det = 1;
    for (int i = 0; i < 4 && row->steps[i].kind != END; i++) {
        const struct step *s = &row->steps[i];
        if (s->kind == TRANSLATE) continue;
        if (s->kind != SCALE) {
            n = turn(s->kind, (real)s->x, n);
            continue;
        }
        const vec by = {(real)s->x, (real)s->y, (real)s->z};
        n = slip == NORMAL_BY_MATRIX ? (vec){n.x * by.x, n.y * by.y, n.z * by.z}
                                     : (vec){n.x / by.x, n.y / by.y, n.z / by.z};
        det *= by.x * by.y * by.z;
    }
    if (slip == INSIDE_OUT && det < 0) n = times(-1, n);
    return slip == NOT_NORMALIZED ? n : unit(n);
}

/* The quadric without its constant, as a symmetric form. */
static real form(enum kind kind, vec a, vec b) {
    return a.x * b.x + a.y * b.y + (kind == ELLIPSOID ? a.z * b.z : kind == CONE ? -a.z * b.z : 0);
}

struct meeting {
    real t; /* infinite: a miss */
    vec normal;
};

static void meet_side(const struct row *row, vec o, vec d, enum slip slip, struct meeting *nearest) {
    const real low = row->kind == CONE ? -1 : -0.5L, high = row->kind == CONE ? 0 : 0.5L;
    const real a = form(row->kind, d, d),
               c = form(row->kind, o, o) - (row->kind == CONE || slip == NO_RADIUS ? 0 : 1);
    real b = form(row->kind, o, d);
    if (slip == FACTOR_TWO) b *= 2;
    const real disc = b * b - a * c;
    if (!(disc > 0)) return;
    for (int i = -1; i <= 1; i += 2) {
        const real t = slip == ROOT_SIGN ? (b + i * sqrtl(disc)) / (2 * a) : (-b + i * sqrtl(disc)) / a;
        const vec p = add(o, times(t, d));
        if (!(t > 0 && t < nearest->t) || (row->kind != ELLIPSOID && !(p.z >= low && p.z <= high))) continue;
        const real z = row->kind == ELLIPSOID                              ? p.z
                       : row->kind == CYLINDER || slip == FLAT_CONE_NORMAL ? 0
                                                                           : -p.z;
        *nearest = (struct meeting){t, {p.x, p.y, z}};
    }
}

static void meet_cap(real z, vec o, vec d, struct meeting *nearest) {
    const real t = (z - o.z) / d.z;
    const vec p = add(o, times(t, d));
    if (t > 0 && t < nearest->t && p.x * p.x + p.y * p.y <= 1) *nearest = (struct meeting){t, {0, 0, z}};
}

/* Lambert's cosine at each pixel: eye (0, 0, 6), field of view 30, light (3, 4, 8). */
static void oracle(const struct row *row, enum slip slip, real picture[HEIGHT][WIDTH]) {
    const vec eye = {0, 0, 6}, light = {3, 4, 8};
    const real pixel = tanl(15 * pi / 180) / (HEIGHT / 2.0L);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            const vec dir = {(x + 0.5L - WIDTH / 2.0L) * pixel, (HEIGHT / 2.0L - y - 0.5L) * pixel, -1};
            const vec o = to_object(row, eye, 1), d = to_object(row, dir, 0);
            struct meeting m = {INFINITY, {0, 0, 0}};
            meet_side(row, o, d, slip, &m);
            if (row->kind == CYLINDER) meet_cap(0.5L, o, d, &m), meet_cap(-0.5L, o, d, &m);
            if (row->kind == CONE) meet_cap(-1, o, d, &m);
            picture[y][x] = 0;
            if (!(m.t < INFINITY)) continue;
            const vec to_light = unit(minus(light, add(eye, times(m.t, dir))));
            picture[y][x] = fmaxl(0, dot(normal_to_world(row, m.normal, slip), to_light));
        }
}

static void print_scene(const struct row *row, char *text, size_t size) {
    static const char *const kinds[] = {"sphere", "cylinder", "cone"};
    static const char axes[] = "xyz";
    int at = snprintf(text, size,
                      "image: {size: [%d, %d], samples: 1, background: black}\n"
                      "camera: {eye: [0, 0, 6], direction: [0, 0, -1], fov: 30}\n"
                      "render: {shadow: 1, two_sided: false}\n"
                      "lights: [{point: {at: [3, 4, 8]}}]\n"
                      "scene: [{%s: {}, material: {diffuse: white}, transform: [",
                      WIDTH, HEIGHT, kinds[row->kind]);
    for (int i = 0; i < 4 && row->steps[i].kind != END; i++) {
        const struct step *s = &row->steps[i];
        const char *form =
            s->kind == SCALE ? "{scale: [%.17g, %.17g, %.17g]}, " : "{translate: [%.17g, %.17g, %.17g]}, ";
        if (s->kind == SCALE || s->kind == TRANSLATE)
            at += snprintf(text + at, size - (size_t)at, form, s->x, s->y, s->z);
        else
            at += snprintf(text + at, size - (size_t)at, "{rotate: {%c: %.17g}}, ", axes[s->kind - ROTATE_X],
                           s->x);
    }
    snprintf(text + at, size - (size_t)at, "]}]\n");
}

static void check_row(void **state) {
    const struct row *row = *state;
    char text[1000];
    static real want[HEIGHT][WIDTH], slipped[HEIGHT][WIDTH];
    print_scene(row, text, sizeof text);
    struct monge_film *film = render(text, NULL);
    const float *got = monge_film_pixels(film);
    oracle(row, NO_SLIP, want);
    oracle(row, row->slip, slipped);
    int lit = 0, differ = 0;
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++, got += 3) {
            lit += want[y][x] > 0;
            differ += fabsl(want[y][x] - slipped[y][x]) > 0.05L;
            if (!(fabsl((real)*got - want[y][x]) < 1e-6L))
                fail_msg("pixel %d %d is %.9g, want %.9Lg; by the slip %.9Lg", x, y, (double)*got, want[y][x],
                         slipped[y][x]);
        }
    assert_true(lit > 250);
    assert_true(differ > 100);
    monge_film_free(film);
}

/* ---- C: equal hits ---- */

static const char *const coincident[][2] = {
    {"sphere: {}", "sphere: {radius: 1}"},
    {"square: {size: 4}", "square: {size: 4}"},
    {"square: {size: 4}", "plane: {}"},
    {"plane: {}", "disc: {radius: 2}"},
    {"cylinder: {}", "cylinder: {from: [0, 0, -0.5], to: [0, 0, 0.5]}"},
    {"box: {}", "box: {}"},
    {"sphere: {}, transform: {scale: [1, 2, 1]}", "sphere: {}, transform: {scale: [1, 2, 1]}"},
};

/* Thirty pairs with the second of each in `order` among the others, so that the hierarchy meets them
 * in many orders; in view is the pair that is number `seen`. */
static void equal_hits(const char *first, const char *second, int seen, bool reversed) {
    enum { PAIRS = 30 };
    static char text[16000];
    int at = snprintf(text, sizeof text,
                      PIXEL "camera: {eye: [0.1, 0.05, 5], direction: [0, 0, -1]}\n" GLOW_LIGHT "scene:\n");
    for (int half = 0; half < 2; half++)
        for (int i = 0; i < PAIRS; i++) {
            const int pair = half && reversed ? PAIRS - 1 - i : i;
            const int column = pair == seen ? 0 : 10 + 7 * (pair * 11 % PAIRS);
            at += snprintf(text + at, sizeof text - (size_t)at,
                           "  - {group: [{%s}], transform: {translate: [%d, 0, %d]}, material: %s}\n",
                           half ? second : first, column, pair == seen ? 0 : -pair - 20,
                           half ? GLOW("blue") : GLOW("red"));
        }
    assert_color(text, 1, 0, 0);
}

static void test_first_listed_wins(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof coincident / sizeof *coincident; i++)
        for (int seen = 0; seen < 30; seen += 7)
            for (int turned = 0; turned < 4; turned++)
                equal_hits(coincident[i][turned & 1], coincident[i][!(turned & 1)], seen, turned & 2);
}

/* ---- E: refraction ----
 * Where a ray arrives behind a body: half of the wall z = -depth glows, and bisection finds the edge. */

static double arrival(const char *camera, const char *body, double depth) {
    double low = -90, high = 90;
    while (high - low > 1e-9) {
        const double middle = 0.5 * (low + high);
        char text[2000];
        double color[3];
        snprintf(text, sizeof text,
                 PIXEL "%s" GLOW_LIGHT
                       "scene:\n%s  - {square: {center: [%.17g, 0, %.17g], size: 200}, material: " GLOW(
                           "white") "}\n",
                 camera, body, middle - 100, -depth);
        probe(text, color);
        if (color[0] > 0.5)
            high = middle;
        else
            low = middle;
    }
    return 0.5 * (low + high);
}

/* Entering: sin(out) = sin(45) / 1.5, the smaller angle. */
static void test_entering(void **state) {
    (void)state;
    const double inside = asin(sqrt(0.5) / 1.5);
    assert_near(arrival(SLANTED, "  - {plane: {}, material: " GLASS "}\n", 10), 10 * tan(inside), 1e-6,
                "in glass, x");
}

/* Leaving, the camera inside of the glass: sin(out) = 1.5 sin(30), the greater angle. */
static void test_leaving(void **state) {
    (void)state;
    const double outside = asin(1.5 * 0.5);
    assert_near(
        arrival("camera: {eye: [-0.57735026918962573, 0, 1], direction: [0.57735026918962573, 0, -1]}\n",
                "  - {plane: {normal: [0, 0, -1]}, material: " GLASS "}\n", 10),
        10 * tan(outside), 1e-6, "out of glass, x");
}

/* Through a slab, from either of its sides: parallel to itself, and moved by what the angle inside says. */
static void test_slab(void **state) {
    (void)state;
    const double inside = asin(sqrt(0.5) / 1.5), moved = 2 * (1 - tan(inside));
    const char slab[] = "  - {box: {min: [-50, -50, -2], max: [50, 50, 0]}, material: " GLASS "}\n";
    const double near = arrival(SLANTED, slab, 10), far = arrival(SLANTED, slab, 30);
    assert_near(near, 10 - moved, 1e-6, "behind the slab, x");
    assert_near(far - near, 20, 1e-6, "the way along x on 20 along z");
}

/* A ball of radius 1 as a lens, a ray at height h: in at the angle i, sin i = h, on at r, sin r = h / n;
 * it leaves at the angle 2 r - i from the axis, turned by 2 (i - r) in all. */
static void test_ball_lens(void **state) {
    (void)state;
    for (int k = -9; k <= 9; k += 2) {
        const double h = 0.1 * k, i = asin(h), r = asin(h / 1.5), turned = 2 * (i - r);
        char camera[100];
        snprintf(camera, sizeof camera, "camera: {eye: [%.17g, 0, 5], direction: [0, 0, -1]}\n", h);
        const double want = sin(2 * r - i) - tan(turned) * (4 - cos(2 * r - i));
        assert_near(arrival(camera, "  - {sphere: {}, material: " GLASS "}\n", 4), want, 1e-6,
                    "behind the ball, x");
    }
}

/* Glass in glass of a higher index, and a bubble in it: c1/c2 goes by what is on each side. */
static void test_bubble(void **state) {
    (void)state;
    const double glass = asin(sqrt(0.5) / 1.5);
    const char bubble[] = "  - {box: {min: [-50, -50, -6], max: [50, 50, 0]}, material: " GLASS "}\n"
                          "  - {box: {min: [-40, -40, -4], max: [40, 40, -2]}, material: {diffuse: black, "
                          "refraction: 1, index: 1}}\n";
    assert_near(arrival(SLANTED, bubble, 10), 4 * tan(glass) + 2 + 4, 1e-6, "behind the bubble, x");
}

/* The critical angle of index 1.5 is 41.81 degrees: short of it light leaves, beyond it all is mirrored. */
static void test_total_reflection(void **state) {
    (void)state;
    const double critical = asin(1 / 1.5) * 180 / (double)pi;
    for (double deg = critical - 30; deg<89; deg += deg> critical - 0.5 && deg < critical + 0.5 ? 0.02 : 3) {
        char text[1000];
        snprintf(text, sizeof text,
                 "image: {size: [1, 1], samples: 1, background: blue}\ncamera: {eye: [0, 0, -1], direction: "
                 "[%.17g, 0, %.17g]}\n" GLOW_LIGHT
                 "scene:\n  - {plane: {}, material: {diffuse: black, refraction: 0.75, index: 1.5}}\n"
                 "  - {plane: {point: [0, 0, -3]}, material: " GLOW("red") "}\n",
                 sin(deg * (double)pi / 180), cos(deg * (double)pi / 180));
        if (fabs(deg - critical) < 1e-6) continue;
        assert_color(text, deg > critical ? 0.75 : 0, 0, deg > critical ? 0 : 0.75);
    }
}

/* Refraction goes the right way in a body that a transform has mirrored. */
static void test_mirrored_glass(void **state) {
    (void)state;
    const double inside = asin(sqrt(0.5) / 1.5);
    const char slab[] =
        "  - {box: {min: [-50, -50, 0], max: [50, 50, 2]}, transform: {scale: [1, 1, -1]}, material: " GLASS
        "}\n";
    assert_near(arrival(SLANTED, slab, 10), 10 - 2 * (1 - tan(inside)), 1e-6, "behind the slab, x");
}

int main(void) {
    const struct CMUnitTest others[] = {
        {"reflection: the view is mirrored, not the light", test_view_is_mirrored, NULL, NULL, NULL},
        {"reflection: a mirror under a scale", test_mirror_under_a_scale, NULL, NULL, NULL},
        {"offset: no speckles at size 1, from any side", test_offset_at_size_one, NULL, NULL, NULL},
        {"offset: no speckles at size 1e-4", test_offset_small, NULL, NULL, NULL},
        {"offset: no speckles at size 1e6", test_offset_large, NULL, NULL, NULL},
        {"offset: no speckles far from the origin", test_offset_far_away, NULL, NULL, NULL},
        {"offset: the same picture at any scale", test_same_picture_at_any_scale, NULL, NULL, NULL},
        {"equal hits: the first listed wins", test_first_listed_wins, NULL, NULL, NULL},
        {"refraction: entering", test_entering, NULL, NULL, NULL},
        {"refraction: leaving", test_leaving, NULL, NULL, NULL},
        {"refraction: a slab", test_slab, NULL, NULL, NULL},
        {"refraction: a ball lens", test_ball_lens, NULL, NULL, NULL},
        {"refraction: a bubble in glass", test_bubble, NULL, NULL, NULL},
        {"refraction: total internal reflection", test_total_reflection, NULL, NULL, NULL},
        {"refraction: a mirrored body", test_mirrored_glass, NULL, NULL, NULL},
    };
    enum { ROWS = sizeof rows / sizeof *rows, OTHERS = sizeof others / sizeof *others };
    struct CMUnitTest tests[ROWS + OTHERS];
    for (size_t i = 0; i < ROWS; i++)
        tests[i] = (struct CMUnitTest){rows[i].name, check_row, NULL, NULL, (void *)&rows[i]};
    for (size_t i = 0; i < OTHERS; i++) tests[ROWS + i] = others[i];
    return cmocka_run_group_tests(tests, NULL, NULL);
}
