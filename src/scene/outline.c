#include "scene/outline.h"

#include <string.h>

static const char *keep(struct outline *o, const char *text) {
    return text ? arena_text(o->arena, text, strlen(text)) : NULL;
}

static const char *keep_file(struct outline *o, struct span span) {
    const struct outline_node *before = o->at->last ? o->at->last : o->at;
    return before->file && strcmp(before->file, span.source->name) == 0 ? before->file
                                                                        : keep(o, span.source->name);
}

/* ---- Nodes ---- */

static struct outline_node *find_member(const struct outline_node *parent, struct span span) {
    for (struct outline_node *n = parent->first; n; n = n->next)
        if (n->line == span.line + 1 && n->column == span.column + 1 &&
            strcmp(n->file, span.source->name) == 0)
            return n;
    return NULL;
}

static struct outline_node *add_member(struct outline *o, const struct object_value *object) {
    struct outline_node *parent = o->at;
    if (parent->listed == OUTLINE_LISTED || o->nodes == OUTLINE_NODES) {
        parent->more++;
        return NULL;
    }
    uint32_t number;
    struct outline_node *n = arena_alloc(o->arena, sizeof *n);
    const int key = object_alternative(object);
    const struct object_value *material = object_object(object, KEY_OBJECT_MATERIAL);
    const char *template = key == KEY_OBJECT_USE ? object_reference(object, key, &number) : NULL;
    *n = (struct outline_node){.what = template   ? keep(o, template)
                                       : key >= 0 ? object->kind->keys[key].name
                                                  : "",
                               .is_use = template != NULL,
                               .name = keep(o, object_text(object, KEY_OBJECT_NAME)),
                               .loop = object_names(o->arena, object, KEY_OBJECT_FOR),
                               .material = material ? keep(o, material->name) : NULL,
                               .file = keep_file(o, object->span),
                               .line = object->span.line + 1,
                               .column = object->span.column + 1,
                               .count = 1,
                               .outer = parent};
    if (parent->last)
        parent->last->next = n;
    else
        parent->first = n;
    parent->last = n;
    parent->listed++;
    o->nodes++;
    return n;
}

/* The node of what is placed now; NULL: it is not listed. */
static struct outline_node *note(struct outline *o, const struct object_value *object) {
    if (o->unlisted) return NULL;
    struct outline_node *n = find_member(o->at, object->span);
    if (n) n->count++;
    return n ? n : add_member(o, object);
}

static void descend(struct outline *o, struct outline_node *n) {
    if (n)
        o->at = n;
    else
        o->unlisted++;
}

static void ascend(struct outline *o) {
    if (o->unlisted)
        o->unlisted--;
    else
        o->at = o->at->outer;
}

/* ---- The sink ---- */

static void pass_shape(void *context, const struct object_value *object) {
    struct outline *o = context;
    note(o, object);
    o->sink.shape(o->sink.context, object);
}

static void pass_group(void *context, const struct object_value *object) {
    struct outline *o = context;
    descend(o, note(o, object));
    o->sink.open_group(o->sink.context, object);
}

static void pass_group_end(void *context) {
    struct outline *o = context;
    ascend(o);
    o->sink.close_group(o->sink.context);
}

/* Whether it is the first use at its place: else it has what the first has, or about that. */
static bool note_use(struct outline *o, struct outline_node *n, const struct hash *contents) {
    if (n->count == 1) {
        n->with = lang_use_arguments(o->arena, o->diag->frame);
        n->known = contents != NULL;
        if (contents) n->contents = *contents;
        return true;
    }
    n->varies |=
        !contents || !n->known || contents->high != n->contents.high || contents->low != n->contents.low;
    return false;
}

static enum lang_use pass_use(void *context, const struct object_value *object, const struct hash *contents,
                              bool exact) {
    struct outline *o = context;
    struct outline_node *n = note(o, object);
    const bool first = n && note_use(o, n, contents);
    const enum lang_use use = o->sink.open_use(o->sink.context, object, contents, exact);
    if (use == LANG_USE_READ) descend(o, first ? n : NULL);
    return use;
}

/* What is read a second time has been noted. */
static bool pass_use_end(void *context) {
    struct outline *o = context;
    const bool again = o->sink.close_use(o->sink.context);
    ascend(o);
    if (again) o->unlisted++;
    return again;
}

static void pass_mark(void *context) {
    struct outline *o = context;
    o->marked = o->root;
    o->sink.mark(o->sink.context);
}

/* Marks stand between the members of the scene. */
static void pass_take_back(void *context) {
    struct outline *o = context;
    o->root = o->marked;
    if (o->root.last) o->root.last->next = NULL;
    o->at = &o->root;
    o->unlisted = 0;
    o->sink.take_back(o->sink.context);
}

struct outline *outline_begin(struct arena *arena, struct diagnostics *diag, struct lang_sink *sink) {
    struct outline *o = arena_alloc(arena, sizeof *o);
    *o = (struct outline){.arena = arena, .diag = diag, .sink = *sink, .at = &o->root};
    *sink = (struct lang_sink){o,        pass_shape,   pass_group, pass_group_end,
                               pass_use, pass_use_end, pass_mark,  pass_take_back};
    return o;
}
