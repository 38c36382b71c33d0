/* Pictures of one pixel: the only ray goes straight from the camera along its direction, so that the colour has a closed
 * form. */
#ifndef MONGE_TESTS_PROBE_H
#define MONGE_TESTS_PROBE_H

#include <string.h>

#include "monge.h"
#include "near.h"

#define DARK              "image: {size: [1, 1], samples: 1, background: black}\n"
#define DOWN_Z            DARK "camera: {eye: [0, 0, 5], direction: [0, 0, -1]}\n"
#define WHITE_LIGHT       "lights: [{point: {at: [0, 0, 10]}}]\n"
#define GLOW(r, g, b)     "{ambient: [" #r ", " #g ", " #b "], diffuse: black}"
#define GLOW_LIGHT        "lights: [{ambient: {}}]\n" /* only `ambient` colours are seen: flat, without shadows */
#define WALL(at, r, g, b) "  - plane: {point: " at ", normal: [0, 0, 1]}\n    material: " GLOW(r, g, b) "\n"

static inline void render_probe(const char *text, double color[3]) {
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

/* A row of a table. */
struct probe {
    const char *name, *scene;
    double want[3];
    double tolerance; /* 0: 1e-6, as the film is float */
};

static inline void check_probe(void **state) {
    const struct probe *row = *state;
    double color[3];
    render_probe(row->scene, color);
    const double tolerance = row->tolerance > 0.0 ? row->tolerance : 1e-6;
    for (int i = 0; i < 3; i++)
        if (!(fabs(color[i] - row->want[i]) <= tolerance))
            fail_msg("%s: channel %d is %.9g, want %.9g", row->name, i, color[i], row->want[i]);
}

#endif
