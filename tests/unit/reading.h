/* What a text says, as a text: the objects that reach the sink with all values that are given.
 *
 *     scene: [{for: {i: 2}, sphere: {radius: i + 1}}]     sphere{radius:1} sphere{radius:2}
 *
 * A group or a use is `group(...)`, `use(...)`; `name`, `material` and `transform` stand before it. */
#ifndef MONGE_TESTS_READING_H
#define MONGE_TESTS_READING_H

#include "loading.h"

struct reading {
    struct lang_memory memory;
    struct diagnostics diag;
    struct lang_result result;
    FILE *out;
    char *text; /* of the objects */
    size_t size;
    long marked;
};

static inline void say_object(FILE *out, const struct object_value *object);

static inline void say_value(FILE *out, const struct grammar_key *key, const struct value *value) {
    if (value->is_object) {
        if (value->object->name)
            fputs(value->object->name, out);
        else
            say_object(out, value->object);
        return;
    }
    switch (key->type) {
    case GRAMMAR_NUMBER:
    case GRAMMAR_INTEGER: fprintf(out, "%.15g", value->number); break;
    case GRAMMAR_BOOLEAN: fputs(value->choice ? "true" : "false", out); break;
    case GRAMMAR_CHOICE: fputs(key->choices[value->choice], out); break;
    case GRAMMAR_TEXT: fputs(value->text, out); break;
    case GRAMMAR_MATRIX: fputs("matrix", out); break;
    case GRAMMAR_LIST:
        for (uint32_t i = 0; i < value->list.count; i++) say_object(out, value->list.items[i]);
        break;
    default: fprintf(out, "[%.15g,%.15g,%.15g]", value->vector.x, value->vector.y, value->vector.z);
    }
}

static inline void say_object(FILE *out, const struct object_value *object) {
    const char *between = "";
    fputc('{', out);
    for (int i = 0; i < object->kind->key_count; i++) {
        const struct grammar_key *key = &object->kind->keys[i];
        if (!object->fields[i] || key->type == GRAMMAR_NAME) continue;
        fprintf(out, "%s%s:", between, key->name);
        say_value(out, key, object->fields[i]);
        between = ",";
    }
    fputc('}', out);
}

static inline void say_shape(void *context, const struct object_value *object) {
    static const int keys[] = {KEY_OBJECT_NAME, KEY_OBJECT_MATERIAL, KEY_OBJECT_TRANSFORM, KEY_OBJECT_BOUNDS};
    struct reading *r = context;
    const int shape = object_alternative(object);
    if (ftell(r->out) > 0) fputc(' ', r->out);
    for (size_t i = 0; i < COUNT(keys); i++) {
        if (!object->fields[keys[i]]) continue;
        fprintf(r->out, "%s:", object->kind->keys[keys[i]].name);
        say_value(r->out, &object->kind->keys[keys[i]], object->fields[keys[i]]);
        fputc(' ', r->out);
    }
    fputs(object->kind->keys[shape].name, r->out);
    if (shape == KEY_OBJECT_GROUP || shape == KEY_OBJECT_USE)
        fputc('(', r->out);
    else
        say_object(r->out, object_object(object, shape));
}
static inline enum lang_use say_use(void *context, const struct object_value *object,
                                    const struct hash *contents, bool exact) {
    (void)contents;
    (void)exact;
    say_shape(context, object);
    return LANG_USE_READ;
}
static inline void say_close(void *context) { fputs(" )", ((struct reading *)context)->out); }
static inline bool say_close_use(void *context) {
    say_close(context);
    return false;
}
static inline void say_mark(void *context) {
    ((struct reading *)context)->marked = ftell(((struct reading *)context)->out);
}
static inline void say_take_back(void *context) {
    fseek(((struct reading *)context)->out, ((struct reading *)context)->marked, SEEK_SET);
}

static inline struct lang_sink saying_sink(struct reading *r) {
    return (struct lang_sink){r,       say_shape,     say_shape, say_close,
                              say_use, say_close_use, say_mark,  say_take_back};
}

/* *adjust, which may be NULL, changes the input before it is read. */
static inline void read_with(struct reading *r, const char *text,
                             void (*adjust)(struct lang_input *input, const void *context),
                             const void *context) {
    *r = (struct reading){0};
    r->out = open_memstream(&r->text, &r->size);
    const struct lang_sink sink = saying_sink(r);
    struct lang_input input = loading_input(&r->memory, text, &sink);
    if (adjust) adjust(&input, context);
    r->result = lang_read(&r->memory, &r->diag, &input);
    fclose(r->out);
}

static inline void reading_free(struct reading *r) {
    lang_memory_free(&r->memory);
    diag_free(&r->diag);
    free(r->text);
}

/* Nothing may be wrong, and the objects are these. */
static inline void assert_read(const struct reading *r, const char *scene, const char *want) {
    if (r->diag.errors == 0 && r->diag.failures == 0 && strcmp(r->text, want) == 0) return;
    printf("%s\n", scene);
    diag_print(&r->diag, stdout);
    assert_string_equal(r->text, want);
    fail_msg("%u errors", r->diag.errors);
}

/* The first error has this code, and the message this part. */
static inline void assert_error(const struct reading *r, const char *code, const char *part) {
    const struct diagnostic *d = r->diag.first;
    while (d && d->severity == SEVERITY_WARNING) d = d->next;
    if (!d) fail_msg("there is no error where %s was expected", code);
    assert_string_equal(d->code, code);
    if (!strstr(d->message, part)) fail_msg("`%s` is not in: %s", part, d->message);
}

#endif
