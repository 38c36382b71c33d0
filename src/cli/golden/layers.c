/* What has changed: by the passes of a golden and of a new picture. */
#include <stdlib.h>
#include <string.h>

#include "cli/aov.h"
#include "cli/golden/run.h"
#include "cli/interrupt.h"
#include "cli/say.h"

static void add_change(struct golden_case *c, char *text) {
    char **changes = realloc(c->changes, (c->change_count + 1) * sizeof *changes);
    if (!changes) say_no_memory();
    c->changes = changes;
    c->changes[c->change_count++] = text;
}

/* ---- By objects ---- */

enum { MOST = 20 }; /* changes that are told */

static void add_found(struct golden_case *c, const struct monge_change *changes, size_t count) {
    for (size_t i = 0; i < count && i < MOST; i++) {
        char text[1000];
        monge_change_text(&changes[i], text, sizeof text);
        add_change(c, say_text("%s", text));
    }
    if (count > MOST) add_change(c, say_text("and %zu more", count - MOST));
}

static bool find_changes(struct golden_case *c, const struct monge_layers *new_layers,
                         struct monge_diagnostics *diag) {
    struct monge_change changes[MOST];
    const struct monge_compare how = {.max_delta = 0.0};
    size_t count = 0;
    struct monge_layers *old_layers = monge_layers_read(c->golden_path, MONGE_LAYERS_ALL, diag);
    struct monge_picture *old = old_layers ? monge_picture_read(c->golden_path, diag) : NULL;
    struct monge_picture *new = old ? monge_picture_read(c->new_path, diag) : NULL;
    const bool found =
        new &&monge_changes(old, old_layers, new, new_layers, &how, changes, MOST, &count, diag);
    if (found) add_found(c, changes, count);
    monge_picture_free(new);
    monge_picture_free(old);
    monge_layers_free(old_layers);
    return found;
}

/* ---- By hashes, of the whole picture ---- */

static void compare_hashes(struct golden_case *c) {
    bool geometry = true, all = true;
    for (int i = 0; i < GOLDEN_LAYERS; i++) {
        all &= *c->old.layers[i] && *c->now.layers[i];
        if (GOLDEN_LAYER[i] != MONGE_LAYER_SHADOW)
            geometry &= strcmp(c->old.layers[i], c->now.layers[i]) == 0;
    }
    if (!all || c->now.width != c->old.width || c->now.height != c->old.height) return;
    const bool shadow = strcmp(c->old.layers[GOLDEN_LAYERS - 1], c->now.layers[GOLDEN_LAYERS - 1]) == 0;
    add_change(c,
               say_text("%s", !geometry                    ? "geometry changed"
                              : !shadow                    ? "shadow changed, geometry equal"
                              : c->now.bits != c->old.bits ? "geometry and shadow equal"
                                                           : "shading changed, geometry and shadow equal"));
}

/* ---- The passes of the case ---- */

static struct monge_layers *make_layers(const struct golden_run *run, struct monge_scene *scene,
                                        const struct monge_settings *settings,
                                        const struct monge_region *region, struct golden_case *c,
                                        struct monge_diagnostics *diag) {
    const struct monge_job job = {.threads = run->threads, .cancel = interrupt_flag()};
    struct report report = {.format = MONGE_FORMAT_TEXT};
    if (!aov_write(scene, settings, region, MONGE_LAYERS_ALL, &job, c->new_path, &report)) return NULL;
    struct monge_layers *layers = monge_layers_read(c->new_path, MONGE_LAYERS_ALL, diag);
    for (int i = 0; layers && i < GOLDEN_LAYERS; i++)
        monge_layer_hash(layers, GOLDEN_LAYER[i], c->now.layers[i]);
    return layers;
}

void golden_judge_layers(const struct golden_run *run, struct monge_scene *scene,
                         const struct monge_settings *settings, const struct monge_region *region,
                         struct golden_case *c) {
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_layers *layers = diag ? make_layers(run, scene, settings, region, c, diag) : NULL;
    if (layers && c->status == GOLDEN_CHANGED && !(c->golden_path && find_changes(c, layers, diag)))
        compare_hashes(c);
    if (!layers && !interrupt_pending()) c->trouble = true;
    if (diag && monge_diagnostics_failures(diag) > 0) monge_diagnostics_print(diag, say_stream());
    monge_layers_free(layers);
    monge_diagnostics_free(diag);
}
