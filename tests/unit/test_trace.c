/* Shading and optics, by pictures of one pixel: the only ray goes straight from the camera along its
 * direction, so its colour has a closed form. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "monge.h"

#define DARK              "image: {size: [1, 1], samples: 1, background: black}\n"
#define DOWN_Z            DARK "camera: {eye: [0, 0, 5], direction: [0, 0, -1]}\n"
#define WHITE_LIGHT       "lights: [{point: {at: [0, 0, 10]}}]\n"
#define GLOW(r, g, b)     "{ambient: [" #r ", " #g ", " #b "], diffuse: black}"
#define GLOW_LIGHT        "lights: [{ambient: {}}]\n" /* only `ambient` colours are seen: flat, without shadows */
#define WALL(at, r, g, b) "  - plane: {point: " at ", normal: [0, 0, 1]}\n    material: " GLOW(r, g, b) "\n"

struct row {
    const char *name, *scene;
    double want[3];
    double tolerance; /* 0: 1e-6, as the film is float */
};

static const struct row rows[] = {
    /* Phong, each term alone: light and eye on the axis, so N.L = R.V = 1 at the nearest point. */
    {"ambient",
     DOWN_Z "lights: [{ambient: {color: [0.5, 1, 2]}}]\nscene: [{sphere: {}, material: {ambient: [0.2, 0.4, "
            "0.1], diffuse: white}}]",
     {0.1, 0.4, 0.2},
     0},
    {"two ambient lights add up",
     DOWN_Z
     "lights: [{ambient: {}}, {ambient: {}}]\nscene: [{sphere: {}, material: {ambient: [0.2, 0.4, 0.1]}}]",
     {0.4, 0.8, 0.2},
     0},
    {"diffuse",
     DOWN_Z WHITE_LIGHT "scene: [{sphere: {}, material: {diffuse: [0.1, 0.2, 0.3]}}]",
     {0.1, 0.2, 0.3},
     0},
    {"specular",
     DOWN_Z WHITE_LIGHT "scene: [{sphere: {}, material: {diffuse: black, specular: [0.1, 0.2, 0.3]}}]",
     {0.1, 0.2, 0.3},
     0},
    {"Lambert's cosine at 60 degrees",
     DOWN_Z "lights: [{point: {at: [1.7320508075688772, 0, 1]}}]\nscene: [{plane: {}, material: {diffuse: "
            "[1, 0.5, 0]}}]",
     {0.5, 0.25, 0},
     0},
    {"highlight to a power: cos(60)^3",
     DOWN_Z "lights: [{point: {at: [1.7320508075688772, 0, 1]}}]\nscene: [{plane: {}, material: {diffuse: "
            "black, specular: [1, 1, 1], shininess: 3}}]",
     {0.125, 0.125, 0.125},
     0},
    {"highlight with exponent 0 is flat",
     DOWN_Z "lights: [{point: {at: [1.7320508075688772, 0, 1]}}]\nscene: [{plane: {}, material: {diffuse: "
            "black, specular: [1, 1, 1], shininess: 0}}]",
     {1, 1, 1},
     0},
    {"a highlight of next to exp(-40) is there: 1e24 / 2^79.8",
     DOWN_Z
     "lights: [{point: {at: [1.7320508075688772, 0, 1], color: [1e24, 1e24, 1e24]}}]\nscene: [{plane: {}, "
     "material: {diffuse: black, specular: [1, 1, 1], shininess: 79.8}}]",
     {0.95018, 0.95018, 0.95018},
     1e-5},
    {"beyond that it is none",
     DOWN_Z
     "lights: [{point: {at: [1.7320508075688772, 0, 1], color: [1e24, 1e24, 1e24]}}]\nscene: [{plane: {}, "
     "material: {diffuse: black, specular: [1, 1, 1], shininess: 80.2}}]",
     {0, 0, 0},
     0},
    {"nor just there: 100 * (1 - 0.6)",
     DOWN_Z
     "lights: [{point: {at: [0.8, 0, 0.6], color: [1e24, 1e24, 1e24]}}]\nscene: [{plane: {}, material: "
     "{diffuse: black, specular: [1, 1, 1], shininess: 100}}]",
     {0, 0, 0},
     0},
    {"no highlight at a right angle to the mirrored light",
     DARK "camera: {eye: [-5, 0, 5], direction: [1, 0, -1]}\nlights: [{point: {at: [-3, 0, 3]}}]\nscene: "
          "[{plane: {}, material: {diffuse: black, specular: white, shininess: 0}}]",
     {0, 0, 0},
     0},
    {"no highlight by a light in the plane of the surface",
     DARK
     "camera: {eye: [-5, 0, 5], direction: [1, 0, -1]}\nrender: {shadow: 1}\nlights: [{point: {at: [3, 0, "
     "0]}}]\nscene: [{plane: {}, material: {diffuse: black, specular: white, shininess: 2}}]",
     {0, 0, 0},
     0},
    {"two lights add up",
     DOWN_Z "lights: [{point: {at: [0, 0, 10]}}, {point: {at: [0, 0, 20], color: [0.5, 0, 0]}}]\nscene: "
            "[{plane: {}, material: {diffuse: [0.2, 0.2, 0.2]}}]",
     {0.3, 0.2, 0.2},
     0},
    {"a light over 1",
     DOWN_Z "lights: [{point: {at: [0, 0, 10], color: [5, 0, 0]}}]\nscene: [{plane: {}, material: {diffuse: "
            "[0.5, 0.5, 0.5]}}]",
     {2.5, 0, 0},
     0},
    {"diffuse shading has no highlight",
     DOWN_Z WHITE_LIGHT "render: {shading: diffuse}\nscene: [{sphere: {}, material: {diffuse: [0.1, 0.2, "
                        "0.3], specular: white}}]",
     {0.1, 0.2, 0.3},
     0},
    {"signature is the diffuse colour, unlit",
     DOWN_Z "lights: []\nrender: {shading: signature}\nscene: [{sphere: {}, material: {diffuse: [0.1, 0.2, "
            "0.3], specular: white, reflection: 0.5}}]",
     {0.1, 0.2, 0.3},
     0},

    /* The side that is lit. */
    {"a flat is lit from behind when seen from behind",
     DOWN_Z WHITE_LIGHT "scene: [{plane: {normal: [0, 0, -1]}, material: {diffuse: [1, 1, 1]}}]",
     {1, 1, 1},
     0},
    {"not when it has one side",
     DOWN_Z WHITE_LIGHT
     "render: {two_sided: false}\nscene: [{plane: {normal: [0, 0, -1]}, material: {diffuse: [1, 1, 1]}}]",
     {0, 0, 0},
     0},
    {"no light through a sheet",
     DOWN_Z "lights: [{point: {at: [0, 0, -10]}}]\nscene: [{plane: {}, material: {diffuse: [1, 1, 1], "
            "specular: white}}]",
     {0, 0, 0},
     0},
    {"no highlight behind the light",
     DOWN_Z "render: {shadow: 1}\nlights: [{point: {at: [1, 0, -0.0001]}}]\nscene: [{plane: {}, material: "
            "{diffuse: black, specular: [1, 1, 1], shininess: 0}}]",
     {0, 0, 0},
     0},
    {"unless it always shows: the mirrored light is seen at 45 degrees",
     DARK "camera: {eye: [-5, 0, 5], direction: [1, 0, -1]}\nrender: {shadow: 1, highlight: always}\nlights: "
          "[{point: {at: [1, 0, -0.0001]}}]\nscene: [{plane: {}, material: {diffuse: black, specular: [1, 1, "
          "1], shininess: 2}}]",
     {0.5, 0.5, 0.5},
     1e-3},
    {"the inside of a ball, two-sided",
     DARK "camera: {eye: [0, 0, 0], direction: [0, 0, -1]}\nlights: [{point: {at: [0, 0, 0.5]}}]\nscene: "
          "[{sphere: {}, material: {diffuse: [0.3, 0.6, 0.9]}}]",
     {0.3, 0.6, 0.9},
     0},

    /* Shadows. */
    {"in shadow, the physical answer",
     DOWN_Z "lights: [{ambient: {}}, {point: {at: [4, 0, 4]}}]\nscene:\n  - {plane: {}, material: {ambient: "
            "[0.1, 0.1, 0.1], diffuse: [0.5, 0.5, 0.5]}}\n  - sphere: {center: [2, 0, 2], radius: 0.5}",
     {0.1, 0.1, 0.1},
     0},
    {"half a shadow: 0.1 + 0.5 * 0.5 cos(45)",
     DOWN_Z "render: {shadow: 0.5}\nlights: [{ambient: {}}, {point: {at: [4, 0, 4]}}]\nscene:\n  - {plane: "
            "{}, material: {ambient: [0.1, 0.1, 0.1], diffuse: [0.5, 0.5, 0.5]}}\n  - sphere: {center: [2, "
            "0, 2], radius: 0.5}",
     {0.27677669529663687, 0.27677669529663687, 0.27677669529663687},
     0},
    {"no shadows",
     DOWN_Z "render: {shadow: 1}\nlights: [{point: {at: [4, 0, 4]}}]\nscene:\n  - {plane: {}, material: "
            "{diffuse: [0.5, 0.5, 0.5]}}\n  - sphere: {center: [2, 0, 2], radius: 0.5}",
     {0.35355339059327373, 0.35355339059327373, 0.35355339059327373},
     0},
    {"a body behind the light throws no shadow",
     DOWN_Z "lights: [{point: {at: [1, 0, 1]}}]\nscene:\n  - {plane: {}, material: {diffuse: [0.5, 0.5, "
            "0.5]}}\n  - sphere: {center: [2, 0, 2], radius: 0.5}",
     {0.35355339059327373, 0.35355339059327373, 0.35355339059327373},
     0},
    {"a sheet at the light throws none",
     DOWN_Z "lights: [{point: {at: [4, 0, 4]}}]\nscene:\n  - {plane: {}, material: {diffuse: [0.5, 0.5, "
            "0.5]}}\n  - disc: {center: [4, 0, 4], normal: [1, 0, 1]}",
     {0.35355339059327373, 0.35355339059327373, 0.35355339059327373},
     0},
    {"a sheet of glass at the light dims nothing",
     DOWN_Z "lights: [{point: {at: [4, 0, 4]}}]\nscene:\n  - {plane: {}, material: {diffuse: [0.5, 0.5, "
            "0.5]}}\n  - {disc: {center: [4, 0, 4], normal: [1, 0, 0]}, material: {diffuse: black, "
            "refraction: 0.5}}",
     {0.35355339059327373, 0.35355339059327373, 0.35355339059327373},
     0},
    {"two glass sheets let 0.5 * 0.8 of the light through",
     DOWN_Z "lights: [{point: {at: [4, 0, 4]}}]\nscene:\n  - {plane: {}, material: {diffuse: [1, 1, 1]}}\n  "
            "- {disc: {center: [2, 0, 2], normal: [1, 0, 1], radius: 0.5}, material: {diffuse: black, "
            "refraction: 0.5}}\n  - {disc: {center: [3, 0, 3], normal: [1, 0, 1], radius: 0.5}, material: "
            "{diffuse: black, refraction: [0.8, 0.8, 0]}}",
     {0.28284271247461906, 0.28284271247461906, 0},
     0},

    /* Secondary rays: a glowing wall is seen in or through something. */
    {"a mirror",
     DOWN_Z GLOW_LIGHT "scene:\n  - {plane: {}, material: {diffuse: black, reflection: [1, 0.5, 0]}}\n  - "
                       "{plane: {point: [0, 0, 9], normal: [0, 0, -1]}, material: " GLOW(0.2, 0.4, 0.6) "}",
     {0.2, 0.2, 0},
     0},
    {"a mirror adds to the surface's own colour",
     DOWN_Z GLOW_LIGHT "scene:\n  - {plane: {}, material: {ambient: [0.1, 0.1, 0.1], reflection: 0.5}}\n  - "
                       "{plane: {point: [0, 0, 9], normal: [0, 0, -1]}, material: " GLOW(0.2, 0.4, 0.6) "}",
     {0.2, 0.3, 0.4},
     0},
    {"depth 1 has no reflection",
     DOWN_Z GLOW_LIGHT
     "render: {depth: 1}\nscene:\n  - {plane: {}, material: {ambient: [0.1, 0.1, 0.1], reflection: 0.5}}\n  "
     "- {plane: {point: [0, 0, 9], normal: [0, 0, -1]}, material: " GLOW(0.2, 0.4, 0.6) "}",
     {0.1, 0.1, 0.1},
     0},
    {"two mirrors of a half, three generations",
     DOWN_Z GLOW_LIGHT
     "render: {depth: 3}\nscene:\n  - {plane: {}, material: {ambient: [1, 1, 1], reflection: 0.5}}\n  - "
     "{plane: {point: [0, 0, 9], normal: [0, 0, -1]}, material: {ambient: [1, 1, 1], reflection: 0.5}}",
     {1.75, 1.75, 1.75},
     0},
    {"a mirror at 45 degrees",
     DOWN_Z GLOW_LIGHT
     "scene:\n  - {square: {}, transform: [{rotate: {y: 45}}], material: {diffuse: black, reflection: 1}}\n  "
     "- {plane: {point: [9, 0, 0], normal: [-1, 0, 0]}, material: " GLOW(0.2, 0.4, 0.6) "}",
     {0.2, 0.4, 0.6},
     0},
    {"what weighs less than 1e-5 is not followed",
     DOWN_Z
     "lights: [{ambient: {color: [1e5, 1e5, 1e5]}}]\nscene:\n  - {plane: {}, material: {diffuse: black, "
     "reflection: 0.9e-5}}\n  - {plane: {point: [0, 0, 9], normal: [0, 0, -1]}, material: " GLOW(0.2, 0.4,
                                                                                                 0.6) "}",
     {0, 0, 0},
     0},
    {"what weighs a little more is",
     DOWN_Z
     "lights: [{ambient: {color: [1e5, 1e5, 1e5]}}]\nscene:\n  - {plane: {}, material: {diffuse: black, "
     "reflection: 1.1e-5}}\n  - {plane: {point: [0, 0, 9], normal: [0, 0, -1]}, material: " GLOW(0.2, 0.4,
                                                                                                 0.6) "}",
     {0.22, 0.44, 0.66},
     0},
    {"nor does light count through glass as dark as that",
     DOWN_Z "lights: [{point: {at: [4, 0, 4], color: [1e5, 1e5, 1e5]}}]\nscene:\n  - {plane: {}, material: "
            "{diffuse: [1, 1, 1]}}\n  - {disc: {center: [2, 0, 2], normal: [1, 0, 1], radius: 0.5}, "
            "material: {diffuse: black, refraction: 0.9e-5}}",
     {0, 0, 0},
     0},
    {"through glass a little clearer it does: 1.1 cos(45)",
     DOWN_Z "lights: [{point: {at: [4, 0, 4], color: [1e5, 1e5, 1e5]}}]\nscene:\n  - {plane: {}, material: "
            "{diffuse: [1, 1, 1]}}\n  - {disc: {center: [2, 0, 2], normal: [1, 0, 1], radius: 0.5}, "
            "material: {diffuse: black, refraction: 1.1e-5}}",
     {0.77781745930520227, 0.77781745930520227, 0.77781745930520227},
     0},
    {"what weighs just that is followed",
     DOWN_Z
     "lights: [{ambient: {color: [1e5, 1e5, 1e5]}}]\nscene:\n  - {plane: {}, material: {diffuse: black, "
     "reflection: 1e-5}}\n  - {plane: {point: [0, 0, 9], normal: [0, 0, -1]}, material: " GLOW(0.2, 0.4,
                                                                                               0.6) "}",
     {0.2, 0.4, 0.6},
     0},
    {"through glass of just that light counts: cos(45)",
     DOWN_Z "lights: [{point: {at: [4, 0, 4], color: [1e5, 1e5, 1e5]}}]\nscene:\n  - {plane: {}, material: "
            "{diffuse: [1, 1, 1]}}\n  - {disc: {center: [2, 0, 2], normal: [1, 0, 1], radius: 0.5}, "
            "material: {diffuse: black, refraction: 1e-5}}",
     {0.70710678118654757, 0.70710678118654757, 0.70710678118654757},
     0},
    {"lights however far away: no surface is in its own shadow",
     DARK
     "camera: {eye: [4, 2, 7], direction: [-4, -2, -7]}\nlights: [{point: {at: [4e6, 2e6, 7e6]}}, {point: "
     "{at: [4e9, 2e9, 7e9]}}, {point: {at: [4e12, 2e12, 7e12]}}, {point: {at: [4e15, 2e15, 7e15]}}]\nscene: "
     "[{sphere: {radius: 1.1}, transform: {scale: [1, 1.3, 0.7]}, material: {diffuse: black, "
     "specular: [0.1, 0.1, 0.1], shininess: 0}}]",
     {0.4, 0.4, 0.4},
     0},
    {"a body of index 1 is not seen",
     DOWN_Z GLOW_LIGHT "scene:\n  - {sphere: {}, material: {diffuse: black, refraction: 1, index: 1}}\n" WALL(
         "[0, 0, -3]", 0.2, 0.4, 0.6),
     {0.2, 0.4, 0.6},
     0},
    {"each surface takes its part",
     DOWN_Z GLOW_LIGHT
     "scene:\n  - {sphere: {}, material: {diffuse: black, refraction: 0.5, index: 1.5}}\n" WALL(
         "[0, 0, -3]", 0.2, 0.4, 0.6),
     {0.05, 0.1, 0.15},
     0},
    {"a camera inside of glass",
     DARK "camera: {eye: [0, 0, 0], direction: [0, 0, -1]}\n" GLOW_LIGHT
          "scene:\n  - {sphere: {}, material: {diffuse: black, refraction: 0.5, index: 1.5}}\n" WALL(
              "[0, 0, -3]", 0.2, 0.4, 0.6),
     {0.1, 0.2, 0.3},
     0},
    {"the background is flat when it has one colour",
     "image: {size: [1, 1], samples: 1, background: [0.1, 0.2, 0.3]}\ncamera: {eye: [0, 0, 5], direction: "
     "[0, 0.3, 1]}\nscene: [{sphere: {}}]",
     {0.1, 0.2, 0.3},
     0},
    {"the background straight up",
     "image: {size: [1, 1], samples: 1, background: {bottom: black, top: [0.4, 0.2, 0.1]}}\ncamera: {eye: "
     "[0, 5, 0], direction: [0, 1, 0]}\nscene: [{sphere: {}}]",
     {0.4, 0.2, 0.1},
     0},
    {"the background ahead",
     "image: {size: [1, 1], samples: 1, background: {bottom: black, top: [0.4, 0.2, 0.1]}}\ncamera: {eye: "
     "[0, 5, 0], direction: [0, 0, 1]}\nscene: [{sphere: {}}]",
     {0.2, 0.1, 0.05},
     0},
};

static void render_probe(const char *text, double color[3]) {
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_scene *scene = monge_load_memory("probe", text, strlen(text), NULL, diag);
    monge_diagnostics_print(diag, stderr);
    assert_non_null(scene);
    const struct monge_settings settings = monge_scene_settings(scene);
    struct monge_film *film = monge_render(scene, &settings, NULL, NULL, NULL);
    assert_non_null(film);
    for (int i = 0; i < 3; i++) color[i] = (double)monge_film_pixels(film)[i];
    monge_film_free(film);
    monge_scene_free(scene);
    monge_diagnostics_free(diag);
}

static void check_row(void **state) {
    const struct row *row = *state;
    double color[3];
    render_probe(row->scene, color);
    const double tolerance = row->tolerance > 0.0 ? row->tolerance : 1e-6;
    for (int i = 0; i < 3; i++)
        if (!(fabs(color[i] - row->want[i]) <= tolerance))
            fail_msg("%s: channel %d is %.9g, want %.9g", row->name, i, color[i], row->want[i]);
}

/* ---- Refraction against Snell's law ----
 * A wall whose colour is seen through a body tells where the refracted ray arrived: half of the wall
 * is white, and bisection finds where its edge must stand to be hit. */

static const double pi = 3.14159265358979323846;

/* Whether the ray from the camera arrives left of `edge` on the wall z = -10 (glowing squares). */
static bool arrives_left(const char *camera, const char *body, double edge) {
    char text[2000];
    snprintf(text, sizeof text,
             DARK
             "%s" GLOW_LIGHT
             "scene:\n%s  - square: {center: [%.17g, 0, -10], size: 100}\n    material: " GLOW(1, 1, 1) "\n",
             camera, body, edge - 50.0);
    double color[3];
    render_probe(text, color);
    return color[0] > 0.5;
}

static double arrival(const char *camera, const char *body) {
    double low = -40, high = 40;
    while (high - low > 1e-9) {
        const double middle = 0.5 * (low + high);
        if (arrives_left(camera, body, middle))
            high = middle;
        else
            low = middle;
    }
    return 0.5 * (low + high);
}

static const char slanted[] =
    "camera: {eye: [-5, 0, 5], direction: [1, 0, -1]}\n"; /* 45 degrees, through the origin */

static void check_arrival(const char *body, double want) {
    const double got = arrival(slanted, body);
    if (!(fabs(got - want) < 1e-6)) fail_msg("arrives at x = %.9f, want %.9f", got, want);
}

/* Through a slab of thickness d the ray goes on parallel to itself, moved by d (tan(out) - tan(in)). */
static void test_slab(void **state) {
    (void)state;
    const double inside = asin(sin(pi / 4) / 1.5);
    check_arrival("  - {box: {min: [-50, -50, -1], max: [50, 50, 0]}, material: {diffuse: black, refraction: "
                  "1, index: 1.5}}\n",
                  1.0 * tan(inside) + 9.0);
}

static void test_water_surface(void **state) {
    (void)state;
    const double inside = asin(sin(pi / 4) / 1.33);
    check_arrival("  - {plane: {}, material: {diffuse: black, refraction: 1, index: 1.33}}\n",
                  10.0 * tan(inside));
}

static void test_slab_in_water(void **state) {
    (void)state;
    const double water = asin(sin(pi / 4) / 1.33), glass = asin(sin(pi / 4) / 1.5);
    check_arrival("  - {plane: {}, material: {diffuse: black, refraction: 1, index: 1.33}}\n"
                  "  - {box: {min: [-50, -50, -3], max: [50, 50, -1]}, material: {diffuse: black, "
                  "refraction: 1, index: 1.5}}\n",
                  8.0 * tan(water) + 2.0 * tan(glass));
}

/* Where two bodies overlap the one entered last counts, also as the other is left. */
static void test_overlapping_slabs(void **state) {
    (void)state;
    const double water = asin(sin(pi / 4) / 1.33), glass = asin(sin(pi / 4) / 1.5);
    check_arrival("  - {box: {min: [-50, -50, -2], max: [50, 50, 0]}, material: {diffuse: black, "
                  "refraction: 1, index: 1.33}}\n"
                  "  - {box: {min: [-60, -60, -4], max: [60, 60, -1]}, material: {diffuse: black, "
                  "refraction: 1, index: 1.5}}\n",
                  1.0 * tan(water) + 3.0 * tan(glass) + 6.0);
}

static void test_same_index_inside(void **state) {
    (void)state;
    const double water = asin(sin(pi / 4) / 1.33);
    check_arrival(
        "  - {plane: {}, material: {diffuse: black, refraction: 1, index: 1.33}}\n"
        "  - {sphere: {center: [1, 0, -2]}, material: {diffuse: black, refraction: 1, index: 1.33}}\n",
        10.0 * tan(water));
}

static void test_mirrored_body(void **state) {
    (void)state;
    const double inside = asin(sin(pi / 4) / 1.5);
    check_arrival("  - {box: {min: [-50, -50, 0], max: [50, 50, 1]}, transform: {scale: [1, 1, -1]}, "
                  "material: {diffuse: black, refraction: 1, index: 1.5}}\n",
                  1.0 * tan(inside) + 9.0);
}

/* The camera in the glass of a slab from z = 0 down to z = -1, half a unit above its lower face. */
static void test_camera_in_nested_glass(void **state) {
    (void)state;
    const double out = asin(1.5 * sin(atan(0.5)));
    const double got = arrival("camera: {eye: [0, 0, -0.5], direction: [1, 0, -2]}\n",
                               "  - {box: {min: [-50, -50, -1], max: [50, 50, 0]}, material: {diffuse: "
                               "black, refraction: 1, index: 1.5}}\n"
                               "  - {box: {min: [-60, -60, -1.5], max: [60, 60, 1]}, material: {diffuse: "
                               "black, refraction: 1, index: 1}}\n");
    const double want = 0.25 + 9.0 * tan(out);
    if (!(fabs(got - want) < 1e-6)) fail_msg("arrives at x = %.9f, want %.9f", got, want);
}

/* At the critical angle itself light leaves along the surface: the sine is 4/5 at an index of 5/4, exactly. */
static void test_critical_angle(void **state) {
    (void)state;
    double color[3];
    render_probe("image: {size: [1, 1], samples: 1, background: [0, 0, 1]}\n"
                 "camera: {eye: [0, 0, -1], direction: [0.8, 0, 0.6]}\n" GLOW_LIGHT
                 "scene:\n  - {plane: {}, material: {diffuse: black, refraction: 0.75, index: 1.25}}\n" WALL(
                     "[0, 0, -9]", 1, 0, 0),
                 color);
    assert_true(fabs(color[0]) < 1e-6 && fabs(color[2] - 0.75) < 1e-6);
}

/* From water, light beyond the critical angle asin(1/1.33) = 48.75 degrees is mirrored whole. */
static void test_total_reflection(void **state) {
    (void)state;
    for (int deg = 40; deg <= 60; deg += 1) {
        char text[1000];
        snprintf(text, sizeof text,
                 "image: {size: [1, 1], samples: 1, background: [0, 0, 1]}\n"
                 "camera: {eye: [0, 0, -1], direction: [%.17g, 0, %.17g]}\n" GLOW_LIGHT
                 "scene:\n  - {plane: {}, material: {diffuse: black, refraction: 0.75, index: 1.33}}\n" WALL(
                     "[0, 0, -9]", 1, 0, 0),
                 sin(deg * pi / 180), cos(deg * pi / 180));
        double color[3];
        render_probe(text, color);
        const bool total = deg > 48;
        assert_true(fabs(color[0] - (total ? 0.75 : 0.0)) < 1e-6);
        assert_true(fabs(color[2] - (total ? 0.0 : 0.75)) < 1e-6);
    }
}

int main(void) {
    struct CMUnitTest tests[sizeof rows / sizeof *rows + 16];
    size_t count = 0;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        tests[count++] = (struct CMUnitTest){rows[i].name, check_row, NULL, NULL, (void *)&rows[i]};
    const struct CMUnitTest more[] = {
        cmocka_unit_test(test_slab),
        cmocka_unit_test(test_water_surface),
        cmocka_unit_test(test_slab_in_water),
        cmocka_unit_test(test_overlapping_slabs),
        cmocka_unit_test(test_same_index_inside),
        cmocka_unit_test(test_mirrored_body),
        cmocka_unit_test(test_camera_in_nested_glass),
        cmocka_unit_test(test_critical_angle),
        cmocka_unit_test(test_total_reflection),
    };
    for (size_t i = 0; i < sizeof more / sizeof *more; i++) tests[count++] = more[i];
    return _cmocka_run_group_tests("trace", tests, count, NULL, NULL);
}
