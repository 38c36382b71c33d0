/* The report's default scene against an oracle of its own: every pixel of both views worked out in long
 * double from the figures of the course, with nothing of Monge's, and rounded down to bytes as there. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "monge.h"

typedef long double real;
typedef struct {
    real x, y, z;
} vec;

static const real pi = 3.14159265358979323846264338327950288L;

static vec add(vec a, vec b) { return (vec){a.x + b.x, a.y + b.y, a.z + b.z}; }
static vec times(real s, vec a) { return (vec){s * a.x, s * a.y, s * a.z}; }
static vec minus(vec a, vec b) { return add(a, times(-1, b)); }
static real dot(vec a, vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static vec unit(vec a) { return times(1 / sqrtl(dot(a, a)), a); }
static vec cross(vec a, vec b) {
    return (vec){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static vec turn_x(real deg, vec p) {
    const real c = cosl(deg * pi / 180), s = sinl(deg * pi / 180);
    return (vec){p.x, c * p.y - s * p.z, s * p.y + c * p.z};
}

static vec turn_z(real deg, vec p) {
    const real c = cosl(deg * pi / 180), s = sinl(deg * pi / 180);
    return (vec){c * p.x - s * p.y, s * p.x + c * p.y, p.z};
}

/* ---- The scene in figures ---- */

struct material {
    vec ambient, diffuse, specular;
    real exponent;
};

static const struct material gold = {
    {0.3L, 0.3L, 0.3L}, {0.75164L, 0.60648L, 0.22648L}, {0.628281L, 0.555802L, 0.366065L}, 51.2L};
static const struct material jade = {
    {0, 0, 0}, {0.54L, 0.89L, 0.63L}, {0.316228L, 0.316228L, 0.316228L}, 12.8L};
static const vec light = {0, 0, 5};
static const real light_color = 0.9L;

/* T(0, 0, -5) Rx(-45) Rz(45) S(1, 2, 1) backwards, for the direction d. */
static vec into_ellipsoid(vec d) {
    d = turn_z(-45, turn_x(45, d));
    return (vec){d.x, d.y / 2, d.z};
}

/* The inverse transpose of the same, for a normal: the turns as they are, the scale inverted. */
static vec normal_of_ellipsoid(vec n) { return unit(turn_x(-45, turn_z(45, (vec){n.x, n.y / 2, n.z}))); }

struct hit {
    real t;
    vec normal;
    const struct material *material; /* NULL: nothing was hit */
};

static struct hit trace(vec eye, vec dir) {
    struct hit hit = {INFINITY, {0, 0, 0}, NULL};
    const vec o = into_ellipsoid(minus(eye, (vec){0, 0, -5})), d = into_ellipsoid(dir);
    const real a = dot(d, d), b = dot(o, d), c = dot(o, o) - 1, disc = b * b - a * c;
    const real sphere_t = disc > 0 ? (-b - sqrtl(disc)) / a : -1; /* both eyes are outside */
    if (sphere_t > 0) hit = (struct hit){sphere_t, normal_of_ellipsoid(add(o, times(sphere_t, d))), &gold};
    const real square_t = (-7 - eye.z) / dir.z;
    const vec p = times(1 / 6.0L, turn_z(-45, add(eye, times(square_t, dir)))); /* z aside */
    if (square_t > 0 && square_t < hit.t && fabsl(p.x) <= 0.5L && fabsl(p.y) <= 0.5L)
        hit = (struct hit){square_t, {0, 0, 1}, &jade};
    return hit;
}

static vec shade(const struct hit *hit, vec eye, vec dir, enum monge_shading shading) {
    const struct material *m = hit->material;
    if (!m) return (vec){0, 0, 0};
    if (shading == MONGE_SHADING_SIGNATURE) return m->diffuse;
    const vec to_light = unit(minus(light, add(eye, times(hit->t, dir))));
    const real cosine = dot(hit->normal, to_light);
    const vec mirrored = minus(times(2 * cosine, hit->normal), to_light);
    const real shine = fmaxl(0, -dot(mirrored, unit(dir)));
    vec color = add(m->ambient, times(fmaxl(0, cosine), m->diffuse));
    if (shading == MONGE_SHADING_PHONG && shine > 0)
        color = add(color, times(powl(shine, m->exponent), m->specular));
    return times(light_color, color);
}

/* ---- Both pictures ---- */

static const struct view {
    const char *file;
    vec eye, direction;
} views[] = {
    {"scenes/report/view1.yaml", {0, 0, 1}, {0, 0, -1}},
    {"scenes/report/view2.yaml", {4, 2, 1}, {-4, -2, -6}},
};

static const struct row {
    const char *name;
    int view;
    enum monge_shading shading;
    uint32_t width, height; /* 0: those of the file */
} rows[] = {
    {"view 1", 0, MONGE_SHADING_PHONG, 0, 0},
    {"view 2", 1, MONGE_SHADING_PHONG, 0, 0},
    {"view 1, diffuse", 0, MONGE_SHADING_DIFFUSE, 0, 0},
    {"view 2, diffuse", 1, MONGE_SHADING_DIFFUSE, 0, 0},
    {"view 1, signature", 0, MONGE_SHADING_SIGNATURE, 0, 0},
    {"view 2, signature", 1, MONGE_SHADING_SIGNATURE, 0, 0},
    {"view 1, half as large", 0, MONGE_SHADING_PHONG, 160, 120},
    {"view 2, half as large", 1, MONGE_SHADING_PHONG, 160, 120},
    {"view 1, odd", 0, MONGE_SHADING_PHONG, 101, 77},
    {"view 2, odd", 1, MONGE_SHADING_PHONG, 101, 77},
    {"view 1, tall", 0, MONGE_SHADING_PHONG, 90, 250},
    {"view 2, wide", 1, MONGE_SHADING_PHONG, 333, 100},
    {"view 1, one pixel", 0, MONGE_SHADING_PHONG, 1, 1},
};

static vec oracle(const struct view *view, enum monge_shading shading, uint32_t width, uint32_t height,
                  uint32_t x, uint32_t y) {
    const vec forward = unit(view->direction), right = unit(cross(forward, (vec){0, 1, 0})),
              up = cross(right, forward);
    const real pixel = tanl(30 * pi / 180) / (height / 2.0L);
    const vec dir = add(forward, add(times((x + 0.5L - width / 2.0L) * pixel, right),
                                     times((height / 2.0L - y - 0.5L) * pixel, up)));
    const struct hit hit = trace(view->eye, dir);
    return shade(&hit, view->eye, dir, shading);
}

static real clamped(real value) { return value < 0 ? 0 : value > 1 ? 1 : value; }

static void check_pixel(const char *name, uint32_t x, uint32_t y, const float *got, vec want) {
    const real wants[3] = {want.x, want.y, want.z};
    for (int i = 0; i < 3; i++) {
        const int byte = (int)(clamped((real)got[i]) * 255 + 0.5L), course = (int)(clamped(wants[i]) * 255);
        if (abs(byte - course) <= 1 && fabsl((real)got[i] - wants[i]) < 1e-6L) continue;
        fail_msg("%s, pixel %u %u, channel %d: %d (%.9g), want %d (%.9Lg)", name, x, y, i, byte,
                 (double)got[i], course, wants[i]);
    }
}

static void check_row(void **state) {
    const struct row *row = *state;
    const struct view *view = &views[row->view];
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_scene *scene = monge_load_file(view->file, NULL, diag);
    monge_diagnostics_print(diag, stderr);
    assert_non_null(scene);
    struct monge_settings settings = monge_scene_settings(scene);
    settings.shading = row->shading;
    if (row->width)
        settings.width = row->width, settings.height = row->height;
    else
        assert_true(settings.width == 320 && settings.height == 240 &&
                    settings.encoding == MONGE_ENCODING_LINEAR);
    struct monge_film *film = monge_render(scene, &settings, NULL, NULL, NULL);
    assert_non_null(film);
    const float *pixel = monge_film_pixels(film);
    for (uint32_t y = 0; y < settings.height; y++)
        for (uint32_t x = 0; x < settings.width; x++, pixel += 3)
            check_pixel(row->name, x, y, pixel,
                        oracle(view, row->shading, settings.width, settings.height, x, y));
    monge_film_free(film);
    monge_scene_free(scene);
    monge_diagnostics_free(diag);
}

int main(void) {
    struct CMUnitTest tests[sizeof rows / sizeof *rows];
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        tests[i] = (struct CMUnitTest){rows[i].name, check_row, NULL, NULL, (void *)&rows[i]};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
