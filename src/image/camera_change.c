#include "image/camera_change.h"

#include <string.h>

#include "base/same.h"

/* In pictures of one size `right` follows from the others. */
static bool same_axes(const struct view *a, const struct view *b) {
    return a->orthographic == b->orthographic && same_vector(a->forward, b->forward) &&
           same_vector(a->up, b->up);
}

bool camera_change(const struct layer_camera *older, const struct layer_camera *newer,
                   enum monge_change_kind *kind) {
    if (!older->entry.kind || !newer->entry.kind) return false;
    const bool stays = same_vector(older->view.eye, newer->view.eye);
    *kind = strcmp(older->given, newer->given) == 0 ? MONGE_CHANGE_FRAMING
            : !stays                                ? MONGE_CHANGE_CAMERA
                                                    : MONGE_CHANGE_VIEW;
    return !stays || !same_axes(&older->view, &newer->view);
}

static bool tells_all(const struct monge_layers *layers) {
    return layers->conditions.lights && layers->conditions.settings && *layers->camera.objects;
}

bool camera_others_changed(const struct monge_layers *older, const struct monge_layers *newer) {
    const struct layer_camera *a = &older->camera, *b = &newer->camera;
    if (tells_all(older) && tells_all(newer)) return strcmp(a->objects, b->objects) != 0;
    return strcmp(a->others, b->others) != 0;
}
