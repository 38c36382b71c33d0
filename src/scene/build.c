/* Takes the objects of a scene as they come, with the transform so far, and leaves flat arrays. */
#include <stdlib.h>
#include <string.h>

#include "scene/builder.h"

void *builder_grow(struct builder *b, void *array, uint32_t count, uint32_t *room, size_t size) {
    if (count < *room) return array;
    const uint32_t before = *room;
    *room = *room ? 2 * *room : 16;
    return arena_resize(b->arena, array, before * size, *room * size);
}

/* ---- Levels ---- */

static affine world_from_object(struct builder *b, const struct object_value *object) {
    if (!object_has(object, KEY_OBJECT_TRANSFORM)) return b->level->world_from_node;
    const affine parent_from_node = transform_build(b, object_list(object, KEY_OBJECT_TRANSFORM));
    return affine_compose(b->level->world_from_node, parent_from_node);
}

static const struct object_value *material_of_object(const struct builder *b,
                                                     const struct object_value *object) {
    const struct object_value *own = object_object(object, KEY_OBJECT_MATERIAL);
    return own ? own : b->level->material;
}

void level_push(struct builder *b, struct level level) {
    struct level *place = b->free_levels;
    if (place)
        b->free_levels = place->outer;
    else
        place = arena_alloc(b->arena, sizeof *place);
    *place = level;
    place->outer = b->level;
    b->level = place;
}

void level_open(struct builder *b, const struct object_value *object, struct placed *placed) {
    const char *name = object_text(object, KEY_OBJECT_NAME);
    const bool in_list = b->level->template == ORIGIN_NO_TEMPLATE;
    level_push(b, (struct level){.world_from_node = world_from_object(b, object),
                                 .material = material_of_object(b, object),
                                 .placed = placed,
                                 .own = object_object(object, KEY_OBJECT_MATERIAL),
                                 .own_span = object_span(object, KEY_OBJECT_MATERIAL),
                                 .count = b->set->primitives.count,
                                 .name = name ? name : b->level->name,
                                 .object = place_object(b, object),
                                 .named_in_list = b->level->named_in_list || (in_list && name),
                                 .template = object_has(object, KEY_OBJECT_USE) ? place_template(b, object)
                                                                                : b->level->template});
}

void level_close(struct builder *b) {
    struct level *level = b->level;
    if (level->own && b->set->primitives.count > level->count) material_hold(b, level->own, level->own_span);
    b->level = level->outer;
    level->outer = b->free_levels;
    b->free_levels = level;
}

/* ---- The sink ---- */

static void add_shape(void *context, const struct object_value *object) {
    struct builder *b = context;
    const struct object_value *bounds = object_object(object, KEY_OBJECT_BOUNDS);
    const struct object_value *shape = object_object(object, object_alternative(object));
    if (!shape) return;
    place_origin(b, object);
    shape_build(b, shape, bounds, world_from_object(b, object),
                material_index(b, material_of_object(b, object)));
}

static void open_group(void *context, const struct object_value *object) {
    struct builder *b = context;
    const struct object_value *bounds = object_object(object, KEY_OBJECT_BOUNDS);
    if (bounds)
        diag_help(b->diag,
                  diag_error(b->diag, bounds->span, "bounds-of-no-quadric",
                             "`bounds` cut a quadric; a group has none"),
                  "move them to the quadric");
    level_open(b, object, NULL);
}

static void close_group(void *context) { level_close(context); }

static enum lang_use open_use(void *context, const struct object_value *object, const struct hash *contents,
                              bool exact) {
    struct builder *b = context;
    const struct object_value *bounds = object_object(object, KEY_OBJECT_BOUNDS);
    if (bounds)
        diag_help(b->diag,
                  diag_error(b->diag, bounds->span, "bounds-of-no-quadric",
                             "`bounds` cut a quadric; a template has none"),
                  "move them to the quadric");
    return instances_open(b, object, contents, exact);
}

static bool close_use(void *context) { return instances_close(context); }

static void mark(void *context) {
    struct builder *b = context;
    b->marked = *b->set;
    b->marked_geometries = b->scene->geometry_count;
}

static void take_back(void *context) {
    struct builder *b = context;
    struct primitives *p = &b->set->primitives, *then = &b->marked.primitives;
    p->count = then->count;
    p->sphere_count = then->sphere_count;
    p->flat_count = then->flat_count;
    p->quadric_count = then->quadric_count;
    p->instance_count = then->instance_count;
    p->use_count = then->use_count;
    instances_take_back(b, b->marked_geometries);
}

/* ---- Building ---- */

struct builder *scene_begin(struct arena *arena, struct diagnostics *diag, struct scene *scene,
                            struct lang_sink *sink) {
    struct builder *b = arena_alloc(arena, sizeof *b);
    *scene = (struct scene){0};
    *b = (struct builder){.arena = arena, .diag = diag, .scene = scene, .default_material = NO_MATERIAL};
    b->set = arena_alloc(arena, sizeof *b->set);
    level_push(b, (struct level){.world_from_node = AFFINE_IDENTITY,
                                 .template = ORIGIN_NO_TEMPLATE,
                                 .object = ORIGIN_NO_OBJECT});
    *sink = (struct lang_sink){b, add_shape, open_group, close_group, open_use, close_use, mark, take_back};
    return b;
}

/* Warns of a picture that is the background alone, or black objects. */
static void warn_nothing_seen(struct builder *b, const struct object_value *file) {
    if (b->scene->primitives.count == 0) {
        struct diagnostic *d = diag_warning(b->diag, object_span(file, KEY_FILE_SCENE), "no-objects",
                                            "no objects: only the background will be seen");
        diag_help(b->diag, d, "add one, as in `- sphere: {}`");
    } else {
        lights_check(b, file);
    }
}

bool scene_end(struct builder *b, const struct lang_result *description) {
    const struct object_value *file = description->file;
    const unsigned errors = b->diag->errors;
    settings_build(b, file);
    camera_build(b, file);
    lights_build(b, file);
    for (uint32_t i = 0; i < description->materials.count; i++)
        material_add_named(b, description->materials.items[i]);
    b->scene->primitives = b->set->primitives;
    materials_check(b);
    places_keep(b);
    if (b->diag->errors == errors && !file->failed) warn_nothing_seen(b, file);
    return b->diag->errors == errors && !file->failed;
}
