/* Where the things of a scene were written. */
#include <string.h>

#include "scene/builder.h"

uint32_t place_object(struct builder *b, const struct object_value *object) {
    const struct level *level = b->level;
    const char *name = object_text(object, KEY_OBJECT_NAME);
    const int key = object_alternative(object);
    const bool in_list = level->template == ORIGIN_NO_TEMPLATE, is_use = key == KEY_OBJECT_USE;
    const bool is_own =
        name ? in_list || !level->named_in_list : is_use && in_list && level->object == ORIGIN_NO_OBJECT;
    uint32_t number = 0;
    if (!is_own || key < 0) return level->object;
    return origins_add_object(&b->scene->origins, b->arena, object->span, name,
                              is_use ? "use of" : object->kind->keys[key].name,
                              is_use ? object_reference(object, key, &number) : NULL);
}

void place_origin(struct builder *b, const struct object_value *object) {
    const char *own = object_text(object, KEY_OBJECT_NAME);
    const struct object_value *shape = object_object(object, object_alternative(object));
    const long kind = shape ? shape->kind - grammar_kinds : KIND_TEMPLATE;
    const struct origin origin = {
        .name = own ? own : b->level->name, .kind = (uint32_t)kind & 0xff, .template = b->level->template};
    b->origin = origins_add(&b->scene->origins, b->arena, object->span, origin);
    b->object = shape ? place_object(b, object) : b->level->object;
}

uint32_t place_template(struct builder *b, const struct object_value *use) {
    struct scene *scene = b->scene;
    uint32_t number = 0;
    const char *name = object_reference(use, KEY_OBJECT_USE, &number);
    while (scene->template_count <= number) {
        scene->templates = builder_grow(b, scene->templates, scene->template_count, &b->template_room,
                                        sizeof *scene->templates);
        scene->templates[scene->template_count++] = NULL;
    }
    if (!scene->templates[number]) scene->templates[number] = arena_text(b->arena, name, strlen(name));
    return number;
}

/* The spans' sources become those of the origins, which places_keep has copied. */
static void keep_spans(struct builder *b, struct span **spans, uint32_t count) {
    struct origins *origins = &b->scene->origins;
    uint32_t *file = arena_array(b->arena, count + 1, sizeof *file);
    for (uint32_t i = 0; i < count; i++)
        if (spans[i]->source) file[i] = origins_file(origins, b->arena, spans[i]->source);
    origins_keep(origins, b->arena);
    for (uint32_t i = 0; i < count; i++)
        if (spans[i]->source) spans[i]->source = origins->files[file[i]];
}

void places_keep(struct builder *b) {
    struct scene *scene = b->scene;
    uint32_t count = 0;
    struct span **spans =
        arena_array(b->arena, 2 * scene->light_count + 2 * scene->material_count + 3, sizeof *spans);
    spans[count++] = &scene->camera_place;
    spans[count++] = &scene->camera_span;
    spans[count++] = &scene->eye_span;
    for (uint32_t i = 0; i < scene->light_count; i++) {
        spans[count++] = &scene->light_places[i];
        spans[count++] = &scene->light_spans[i];
    }
    for (uint32_t i = 0; i < scene->material_count; i++) {
        spans[count++] = &scene->material_info[i].span;
        spans[count++] = &scene->material_info[i].held;
    }
    keep_spans(b, spans, count);
}

const char *scene_kind_title(uint32_t kind) { return grammar_kinds[kind].title; }

const char *scene_kind_name(uint32_t kind) { return strchr(grammar_kinds[kind].title, ' ') + 1; }
