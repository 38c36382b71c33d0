#include "cli/aov.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/say.h"

char *aov_path(enum monge_layer layer, const char *picture) {
    const size_t size = monge_layer_path(layer, picture, NULL, 0) + 1;
    char *path = malloc(size);
    if (!path) say_no_memory();
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

/* ---- What their picture says of them ---- */

/* "depth 27f0..."; NULL: the file cannot be read. To be freed. */
static char *file_line(enum monge_layer layer, const char *picture) {
    char hash[MONGE_HASH_SIZE], *path = aov_path(layer, picture);
    struct monge_diagnostics *diag =
        monge_diagnostics_new(); /* one that is not there is not wrong, but to be made */
    const bool known = diag && access(path, F_OK) == 0 && monge_files_hash(path, "", NULL, diag, hash);
    monge_diagnostics_free(diag);
    free(path);
    return known ? say_text("%s %s", monge_layer_name(layer), hash) : NULL;
}

void aov_note(struct monge_film *film, unsigned set, const char *picture) {
    char *all = say_text("%s", "");
    for (enum monge_layer layer = 0; layer < MONGE_LAYERS; layer++) {
        char *line = set >> layer & 1 ? file_line(layer, picture) : NULL;
        if (!line) continue;
        char *longer = say_text("%s%s%s", all, *all ? "\n" : "", line);
        free(line);
        free(all);
        all = longer;
    }
    monge_film_note_passes(film, all); /* a picture that says nothing of them is made again another time */
    free(all);
}

bool aov_unchanged(const struct monge_picture *picture, unsigned set, const char *path) {
    const char *said = monge_picture_text(picture, "monge:passes");
    bool same = true;
    for (enum monge_layer layer = 0; layer < MONGE_LAYERS && same; layer++) {
        if (!(set >> layer & 1)) continue;
        char *line = said ? file_line(layer, path) : NULL;
        same = line && strstr(said, line);
        free(line);
    }
    return same;
}
