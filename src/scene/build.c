/* Walks the description's nodes once, with the transform so far, and leaves flat arrays. */
#include <string.h>

#include "scene/builder.h"

void *builder_grow(struct builder *b, void *array, uint32_t count, uint32_t *room, size_t size) {
    if (count < *room) return array;
    *room = *room ? 2 * *room : 16;
    void *larger = arena_array(b->arena, *room, size);
    if (count) memcpy(larger, array, count * size);
    return larger;
}

/* `inherited`: the material of the groups around, or NULL. */
static void node_build(struct builder *b, const struct object_value *node, affine world_from_parent, const struct object_value *inherited) {
    affine parent_from_node = AFFINE_IDENTITY;
    transform_build(b, object_list(node, KEY_OBJECT_TRANSFORM), &parent_from_node); /* a wrong one is reported: go on */
    const affine world_from_node = affine_compose(world_from_parent, parent_from_node);
    const struct object_value *own = object_object(node, KEY_OBJECT_MATERIAL), *material = own ? own : inherited;
    const struct object_value *bounds = object_object(node, KEY_OBJECT_BOUNDS);
    const int key = object_alternative(node);
    if (key < 0) return;
    if (key != KEY_OBJECT_GROUP) {
        shape_build(b, object_object(node, key), bounds, world_from_node, material_index(b, material));
        return;
    }
    if (bounds) diag_help(b->diag, diag_error(b->diag, bounds->span, "bounds-of-no-quadric", "`bounds` cut a quadric; a group has none"), "move them to the quadric");
    const struct object_list members = object_list(node, key);
    for (uint32_t i = 0; i < members.count; i++) node_build(b, members.items[i], world_from_node, material);
}

/* Warns of a picture that is the background alone, or black objects. */
static void warn_nothing_seen(struct builder *b, const struct object_value *file) {
    if (b->scene->primitives.count == 0) {
        struct diagnostic *d = diag_warning(b->diag, object_span(file, KEY_FILE_SCENE), "no-objects", "no objects: only the background will be seen");
        diag_help(b->diag, d, "add one, as in `- sphere: {}`");
    } else {
        lights_check(b, file);
    }
}

bool scene_build(struct arena *arena, struct diagnostics *diag, const struct object_value *file, struct scene *scene) {
    const unsigned errors = diag->errors;
    struct builder b = {.arena = arena, .diag = diag, .scene = scene, .default_material = NO_MATERIAL};
    *scene = (struct scene){0};
    settings_build(&b, file);
    camera_build(&b, file);
    lights_build(&b, file);
    materials_build(&b, file);
    const struct object_list nodes = object_list(file, KEY_FILE_SCENE);
    for (uint32_t i = 0; i < nodes.count; i++) node_build(&b, nodes.items[i], AFFINE_IDENTITY, NULL);
    if (diag->errors == errors && !file->failed) warn_nothing_seen(&b, file);
    return diag->errors == errors;
}
