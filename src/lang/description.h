/* A scene file, checked and evaluated: objects of the grammar's kinds with typed values, each with the
 * place it was written at. A stage after this one never sees YAML.
 *
 *     object_value (kind sphere)
 *       fields[KEY_SPHERE_CENTER] -> NULL: not given, the accessors return the default
 *       fields[KEY_SPHERE_RADIUS] -> value {number 2, span 4:13}
 */
#ifndef MONGE_LANG_DESCRIPTION_H
#define MONGE_LANG_DESCRIPTION_H

#include "base/affine.h"
#include "base/diag.h"
#include "grammar_tables.h"
#include "lang/grammar.h"

struct object_value;
struct node;
struct definition;

/* Items may be shared by several lists, and fields by several objects: those behind aliases. */
struct object_list {
    struct object_value **items;
    uint32_t count;
};

struct value {
    struct span span; /* of the value, not the key */
    union {
        double number;                 /* number, integer */
        int choice;                    /* choice, boolean */
        vec3 vector;                   /* point, direction, factors, color (linear), amount, size (x, y) */
        const affine *matrix;          /* matrix */
        const char *text;              /* text */
        struct object_value *object;   /* object; color or amount where is_object */
        struct object_list list;       /* list, but of objects */
        const struct node *node;       /* lang/: list of objects, any, values, ranges, condition, files */
        struct definition *definition; /* lang/: name */
    };
    bool is_object; /* a mapping stands where a colour might */
    bool computed;  /* a number that is not written as such: by an expression, a variable or keyframes */
};

struct object_value {
    const struct grammar_kind *kind;
    struct span span;
    const char *name;    /* of a definition, else NULL */
    uint32_t definition; /* of a definition: its number among its kind, from 0 */
    bool failed; /* some key of it was reported as wrong; its field is NULL. Of the file: anything in it */
    struct value **fields; /* kind->key_count; NULL where not given */
};

/* `key` is one of the generated KEY_ numbers of the object's kind, of the type that the name says.
 * Where the key is not given: the grammar's default, or zero where it has none. */
bool object_has(const struct object_value *object, int key);
double object_number(const struct object_value *object, int key); /* also integers */
int object_choice(const struct object_value *object, int key);    /* also booleans: 0 or 1 */
vec3 object_vec3(const struct object_value *object, int key);
const char *object_text(const struct object_value *object, int key); /* NULL: not given */
/* The name of a definition that a key of type name gives, and its number among its kind; NULL: not given. */
const char *object_reference(const struct object_value *object, int key, uint32_t *number);
/* The names in a value of type ranges or values, as "i, j", in the arena; NULL: not given. */
const char *object_names(struct arena *arena, const struct object_value *object, int key);

/* The texts of a value of type files, up to a NULL, in the arena; NULL: not given, or something in it is no text. */
const char *const *object_texts(struct arena *arena, const struct object_value *object, int key);
const affine *object_matrix(const struct object_value *object, int key); /* NULL: not given */
struct object_value *object_object(const struct object_value *object,
                                   int key); /* NULL: not given, or not a mapping */
struct object_list object_list(const struct object_value *object, int key);

/* Of the value; of the object where it is not given. */
struct span object_span(const struct object_value *object, int key);

/* The first alternative that is given (a shape of a node, a step of a transform); -1: none. */
int object_alternative(const struct object_value *object);

#endif
