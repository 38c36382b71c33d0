/* What is told of two renderings of scenes. */
#ifndef MONGE_TESTS_CHANGING_H
#define MONGE_TESTS_CHANGING_H

#include <string.h>

#include "image/changes.h"
#include "image/encode.h"
#include "near.h"

struct rendered {
    struct monge_film *film;
    struct monge_layers *layers;
};

static inline struct rendered render_samples(const char *text, uint32_t samples, unsigned set) {
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_scene *scene = monge_load_memory("scene.yaml", text, strlen(text), NULL, diag);
    monge_diagnostics_print(diag, stdout);
    assert_non_null(scene);
    struct monge_settings settings = monge_scene_settings(scene);
    settings.width = 96;
    settings.height = 72;
    settings.samples = samples;
    struct rendered r = {monge_render(scene, &settings, NULL, NULL, NULL),
                         monge_render_layers(scene, &settings, NULL, set, NULL)};
    assert_non_null(r.film);
    assert_non_null(r.layers);
    monge_scene_free(scene);
    monge_diagnostics_free(diag);
    return r;
}

static inline struct rendered render(const char *text, unsigned set) { return render_samples(text, 4, set); }

static inline void forget(struct rendered *r) {
    monge_film_free(r->film);
    monge_layers_free(r->layers);
}

enum { PIXELS = 96 * 72, ROOM = 8 };

static inline void find_differences(const struct rendered *a, const struct rendered *b,
                                    uint8_t differs[PIXELS]) {
    const float *p = monge_film_pixels(a->film), *q = monge_film_pixels(b->film);
    for (int i = 0; i < PIXELS; i++) {
        differs[i] = 0;
        for (int c = 3 * i; c < 3 * i + 3; c++)
            differs[i] |=
                encode_channel(p[c], MONGE_ENCODING_SRGB, 8) != encode_channel(q[c], MONGE_ENCODING_SRGB, 8);
    }
}

/* Tells the changes, a line each. */
static inline void tell(const struct monge_layers *older, const struct monge_layers *newer,
                        const uint8_t *differs, char *text, size_t size) {
    struct monge_change changes[ROOM];
    size_t count = 0, length = 0;
    assert_true(changes_find(older, newer, differs, changes, ROOM, &count));
    assert_true(count <= ROOM);
    *text = '\0';
    for (size_t i = 0; i < count; i++) {
        length += monge_change_text(&changes[i], text + length, size - length);
        assert_true(length + 1 < size);
        strcpy(text + length++, "\n");
    }
}

#endif
