/* The library's face: the files of layers, and what changed between pictures. */
#include <stdlib.h>
#include <string.h>

#include "face.h"
#include "image/changes.h"
#include "image/compare.h"
#include "image/layers_file.h"

bool monge_layer_write(const struct monge_layers *layers, enum monge_layer layer, const char *path,
                       struct monge_diagnostics *diag) {
    char message[1024];
    if (layer_file_write(layers, layer, path, message, sizeof message)) return true;
    diag_failure(&diag->list, "cannot-write", "%s", message);
    return false;
}

struct monge_layers *monge_layers_read(const char *picture, unsigned wanted, struct monge_diagnostics *diag) {
    char message[1024];
    struct monge_layers *layers = layer_files_read(picture, wanted, message, sizeof message);
    if (!layers && *message) diag_failure(&diag->list, "cannot-read", "%s", message);
    return layers;
}

/* ---- Changes ---- */

/* Which pixels of the pictures differ by more than how->max_delta; to be freed. NULL: the reason. */
static uint8_t *find_differences(struct monge_picture *older, struct monge_picture *newer,
                                 const struct monge_compare *how, char reason[PICTURE_REASON_SIZE],
                                 const struct monge_picture **about) {
    struct comparison c;
    const uint32_t width = older->width;
    uint8_t *differs = NULL;
    float *row = malloc(width * sizeof *row);
    snprintf(reason, PICTURE_REASON_SIZE, "out of memory");
    if (comparison_begin(&c, older, newer, how, reason, about))
        differs = malloc((size_t)width * older->height);
    for (uint32_t y = 0; row && differs && y < older->height; y++) {
        compare_row(&c, y, row);
        for (uint32_t x = 0; x < width; x++) differs[(size_t)y * width + x] = row[x] > (float)how->max_delta;
    }
    comparison_end(&c);
    if (!row) free(differs);
    const bool good = row;
    free(row);
    return good ? differs : NULL;
}

static bool fits(const struct monge_layers *layers, const struct monge_picture *picture) {
    const char *scene = monge_picture_text(picture, "monge:scene");
    return layers->region.width == picture->width && layers->region.height == picture->height &&
           layers->ids[MONGE_LAYER_OBJECT] &&
           (!scene || !*layers->scene || strcmp(layers->scene, scene) == 0);
}

static bool report(struct diagnostics *diag, const struct monge_picture *about, const char *reason) {
    diag_failure(diag, "bad-picture", "cannot tell what changed in %s: %s", about->name, reason);
    return false;
}

bool monge_changes(struct monge_picture *older, const struct monge_layers *older_layers,
                   struct monge_picture *newer, const struct monge_layers *newer_layers,
                   const struct monge_compare *how, struct monge_change *changes, size_t room, size_t *count,
                   struct monge_diagnostics *diag) {
    char reason[PICTURE_REASON_SIZE] = "";
    const struct monge_picture *about = newer;
    if (older->width != newer->width || older->height != newer->height)
        return report(&diag->list, newer, "the pictures are not of one size");
    if (!fits(older_layers, older)) return report(&diag->list, older, "its passes are not of this picture");
    if (!fits(newer_layers, newer)) return report(&diag->list, newer, "its passes are not of this picture");
    const bool comparable = compare_unlike(older, newer) == MONGE_UNLIKE_NOTHING;
    uint8_t *differs = comparable ? find_differences(older, newer, how, reason, &about) : NULL;
    if (comparable && !differs) return report(&diag->list, about, reason);
    const bool found = changes_find(older_layers, newer_layers, differs, changes, room, count);
    free(differs);
    return found || report(&diag->list, newer, "there is no memory, or an object is not in the table");
}
