#include "cli/aov.h"

#include <stdlib.h>

#include "cli/say.h"

char *aov_path(enum monge_layer layer, const char *picture) {
    const size_t size = monge_layer_path(layer, picture, NULL, 0) + 1;
    char *path = malloc(size);
    if (!path) {
        say_error("out of memory");
        exit(STATUS_TROUBLE);
    }
    monge_layer_path(layer, picture, path, size);
    return path;
}

static bool write_layers(const struct monge_layers *layers, const char *picture,
                         struct monge_diagnostics *diag) {
    bool written = true;
    for (enum monge_layer layer = 0; layer < MONGE_LAYERS && written; layer++) {
        if (!(monge_layers_set(layers) >> layer & 1)) continue;
        char *path = aov_path(layer, picture);
        written = monge_layer_write(layers, layer, path, diag);
        free(path);
    }
    return written;
}

bool aov_write(struct monge_scene *scene, const struct monge_settings *settings,
               const struct monge_region *region, unsigned set, const struct monge_job *job,
               const char *picture, struct report *report) {
    struct monge_layers *layers = monge_render_layers(scene, settings, region, set, job);
    const bool cancelled = job->cancel && atomic_load(job->cancel);
    if (!layers && !cancelled) report_failure(report, "out-of-memory", "%s: out of memory", picture);
    struct monge_diagnostics *diag = layers ? report_open(report) : NULL;
    const bool written = diag && write_layers(layers, picture, diag);
    if (diag) report_close(report, diag, !cancelled);
    monge_layers_free(layers);
    return written;
}
