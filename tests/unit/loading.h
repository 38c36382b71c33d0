/* Scenes from texts, for tests of what comes out of lang/ and scene/. */
#ifndef MONGE_TESTS_LOADING_H
#define MONGE_TESTS_LOADING_H

#include <string.h>

#include "lang/file.h"
#include "lang/lang.h"
#include "lang/node.h"
#include "near.h"
#include "scene/scene.h"

static const struct lang_limits loading_limits = {.file_bytes = 1 << 20,
                                                  .nesting = 100,
                                                  .values = 1000000,
                                                  .recursion = 100,
                                                  .steps = 1000000,
                                                  .objects = 1000000};

static inline struct lang_input loading_input(struct lang_memory *memory, const char *text,
                                              const struct lang_sink *sink) {
    return (struct lang_input){.source = file_from_memory(&memory->nodes, "t", text, strlen(text)),
                               .path = "t",
                               .limits = loading_limits,
                               .sink = sink};
}

/* ---- A whole scene ---- */

struct loaded {
    struct lang_memory memory;
    struct arena arena; /* of the scene */
    struct diagnostics diag;
    struct lang_result result; /* file NULL: no scene */
    struct scene scene;
    bool ok;
};

/* Beside what is in l->diag already; the rest of *l is new. */
static inline void load_after(struct loaded *l, const char *text) {
    const unsigned errors = l->diag.errors;
    struct lang_sink sink;
    struct builder *builder = scene_begin(&l->arena, &l->diag, &l->scene, &sink);
    const struct lang_input input = loading_input(&l->memory, text, &sink);
    l->result = lang_read(&l->memory, &l->diag, &input);
    l->ok = l->result.file && scene_end(builder, &l->result) && l->diag.errors == errors;
}

static inline void load_text(struct loaded *l, const char *text) {
    *l = (struct loaded){0};
    load_after(l, text);
}

/* The same of a text that must be right. */
static inline void load_good(struct loaded *l, const char *text) {
    load_text(l, text);
    if (l->ok) return;
    printf("%s\n", text);
    diag_print(&l->diag, stdout);
    fail_msg("the scene should have loaded");
}

static inline void unload(struct loaded *l) {
    lang_memory_free(&l->memory);
    arena_free(&l->arena);
    diag_free(&l->diag);
}

/* The hash of the scene of a text that must be right. */
static inline struct hash load_hash(const char *text) {
    struct loaded l;
    struct hash hash;
    load_good(&l, text);
    hash_begin(&hash);
    scene_hash(&l.scene, &hash);
    unload(&l);
    return hash;
}

/* ---- A sink that keeps the shapes and groups, as copies ---- */

struct collected {
    struct arena arena;
    struct object_value *items[64];
    uint32_t count, marked;
};

static inline struct object_value *copy_object(struct arena *arena, const struct object_value *object);

static inline struct value *copy_value(struct arena *arena, const struct grammar_key *key,
                                       const struct value *value) {
    struct value *copy = arena_alloc(arena, sizeof *copy);
    *copy = *value;
    if (value->is_object) {
        copy->object = copy_object(arena, value->object);
    } else if (key->type == GRAMMAR_TEXT) {
        copy->text = arena_text(arena, value->text, strlen(value->text));
    } else if (key->type == GRAMMAR_MATRIX) {
        affine *matrix = arena_alloc(arena, sizeof *matrix);
        *matrix = *value->matrix;
        copy->matrix = matrix;
    } else if (key->type == GRAMMAR_LIST && key->of != &grammar_kinds[KIND_OBJECT]) {
        copy->list.items = arena_array(arena, value->list.count, sizeof *copy->list.items);
        for (uint32_t i = 0; i < value->list.count; i++)
            copy->list.items[i] = copy_object(arena, value->list.items[i]);
    }
    return copy;
}

static inline struct object_value *copy_object(struct arena *arena, const struct object_value *object) {
    struct object_value *copy = arena_alloc(arena, sizeof *copy);
    *copy = *object;
    copy->fields = arena_array(arena, (size_t)object->kind->key_count, sizeof *copy->fields);
    for (int i = 0; i < object->kind->key_count; i++)
        if (object->fields[i]) copy->fields[i] = copy_value(arena, &object->kind->keys[i], object->fields[i]);
    return copy;
}

static inline void collect_object(void *context, const struct object_value *object) {
    struct collected *c = context;
    assert_true(c->count < COUNT(c->items));
    c->items[c->count++] = copy_object(&c->arena, object);
}
static inline enum lang_use collect_use(void *context, const struct object_value *object,
                                        const struct hash *contents, bool exact) {
    (void)contents;
    (void)exact;
    collect_object(context, object);
    return LANG_USE_READ;
}
static inline void collect_close(void *context) { (void)context; }
static inline bool collect_close_use(void *context) { return context == NULL; }
static inline void collect_mark(void *context) {
    ((struct collected *)context)->marked = ((struct collected *)context)->count;
}
static inline void collect_take_back(void *context) {
    ((struct collected *)context)->count = ((struct collected *)context)->marked;
}

static inline struct lang_sink collecting_sink(struct collected *c) {
    return (struct lang_sink){c,           collect_object,    collect_object, collect_close,
                              collect_use, collect_close_use, collect_mark,   collect_take_back};
}

#endif
