#include "lang/description.h"

#include <string.h>

#include "lang/checker.h"

bool object_has(const struct object_value *object, int key) { return object->fields[key] != NULL; }

double object_number(const struct object_value *object, int key) {
    return object->fields[key] ? object->fields[key]->number : object->kind->keys[key].value[0];
}

int object_choice(const struct object_value *object, int key) {
    return object->fields[key] ? object->fields[key]->choice : (int)object->kind->keys[key].value[0];
}

vec3 object_vec3(const struct object_value *object, int key) {
    const double *otherwise = object->kind->keys[key].value;
    const struct value *value = object->fields[key];
    return value && !value->is_object ? value->vector : (vec3){otherwise[0], otherwise[1], otherwise[2]};
}

const char *object_text(const struct object_value *object, int key) {
    return object->fields[key] ? object->fields[key]->text : NULL;
}

const char *object_reference(const struct object_value *object, int key, uint32_t *number) {
    const struct definition *definition = object->fields[key] ? object->fields[key]->definition : NULL;
    if (definition) *number = definition->number;
    return definition ? definition->name : NULL;
}

const char *object_names(struct arena *arena, const struct object_value *object, int key) {
    const struct node *node = object->fields[key] ? node_resolve(object->fields[key]->node) : NULL;
    const char *text = "";
    if (!node || node->kind != NODE_MAPPING) return NULL;
    for (const struct node *name = node->first; name; name = name->next->next)
        text = arena_format(arena, "%s%s%s", text, *text ? ", " : "", node_resolve(name)->text);
    return text;
}

const char *const *object_texts(struct arena *arena, const struct object_value *object, int key) {
    const struct node *node = object->fields[key] ? node_resolve(object->fields[key]->node) : NULL;
    if (!node || node->kind == NODE_MAPPING) return NULL;
    const bool one = node->kind == NODE_SCALAR;
    const char **texts = arena_array(arena, one ? 2 : node->count + 1, sizeof *texts);
    size_t count = 0;
    for (const struct node *item = one ? node : node->first; item; item = one ? NULL : item->next) {
        const struct node *text = node_resolve(item);
        if (text->kind != NODE_SCALAR || text->count == 0) return NULL;
        texts[count++] = text->text;
    }
    return count ? texts : NULL;
}

const affine *object_matrix(const struct object_value *object, int key) {
    return object->fields[key] ? object->fields[key]->matrix : NULL;
}

struct object_value *object_object(const struct object_value *object, int key) {
    return object->fields[key] && object->fields[key]->is_object ? object->fields[key]->object : NULL;
}

struct object_list object_list(const struct object_value *object, int key) {
    return object->fields[key] ? object->fields[key]->list : (struct object_list){NULL, 0};
}

struct span object_span(const struct object_value *object, int key) {
    return object->fields[key] ? object->fields[key]->span : object->span;
}

int object_alternative(const struct object_value *object) {
    for (int i = 0; i < object->kind->key_count; i++)
        if (object->kind->keys[i].alternative && object->fields[i]) return i;
    return -1;
}

int grammar_find_key(const struct grammar_kind *kind, const char *name) {
    for (int i = 0; i < kind->key_count; i++)
        if (kind->keys[i].name[0] == name[0] && strcmp(kind->keys[i].name, name) == 0) return i;
    return -1;
}
