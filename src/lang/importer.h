/* What the files of the import share; for lang/ alone. */
#ifndef MONGE_LANG_IMPORTER_H
#define MONGE_LANG_IMPORTER_H

#include "base/affine.h"
#include "base/table.h"
#include "lang/node.h"

/* ---- import_text.c: YAML in our style ---- */

/* A text that grows in the arena; zero-terminated. */
struct text {
    struct arena *arena;
    char *bytes;
    size_t size, room;
};

void text_add(struct text *text, const char *format, ...) __attribute__((format(printf, 2, 3)));
void text_cut(struct text *text, size_t size); /* back to a size that it had */

/* The shortest decimal that reads back as the same number. */
const char *number_text(struct arena *arena, double value);
const char *vec3_text(struct arena *arena, vec3 v); /* "[1, 2, 3]" */

/* A result of arithmetic at 15 digits: the last bits of 0.7 * 0.1 would be noise in the file. */
double tidy(double computed);
vec3 tidy_vec3(vec3 computed);

/* The node as flow YAML in printable ASCII on one line, for comments; long ones are cut. */
const char *node_text(struct arena *arena, const struct node *node);

enum { BLOCK_MAX_ENTRIES = 16 };

/* A value of several entries "key: value". */
struct block {
    const char *entries[BLOCK_MAX_ENTRIES];
    int count;
};

void block_add(struct block *block, struct arena *arena, const char *key, const char *value);

/* "head: {a: 1, b: 2}" at the indent, or a line for each where that is too wide. */
void text_block(struct text *text, int indent, const char *head, const struct block *block);

/* "head: [{a: 1}, {b: 2}]", or a line for each. */
void text_list(struct text *text, int indent, const char *head, const char *const *entries, size_t count);

/* ---- import_values.c: definitions and single values ---- */

extern const char *const IMPORT_NO_WORDS[]; /* lists of words end with NULL */

struct book_definition {
    const char *name;
    struct span span; /* of the name */
    const struct node *value;
    const struct node *extend; /* NULL: extends nothing */
    uint32_t number;           /* from 1, in the order of the file: it knows those before it alone */
    bool used;
    const char *material;           /* its name in our `materials`; NULL: not written yet */
    struct book_definition *before; /* an earlier one of the same name, or NULL */
    struct book_definition *next;
};

struct importer {
    struct arena *arena;
    struct diagnostics *diag;
    struct table definitions;
    struct book_definition *first, **end;
    uint32_t defined; /* so far */
    struct table material_names;
    struct text view, lights, materials, objects; /* the parts of the result */
    vec3 ambient;                                 /* the light of all lights together */
    const struct node *camera;                    /* NULL: none yet */
    const char *plain_material;                   /* the name of the book's default; NULL: not written yet */
    bool shadow_told;                             /* that light passes glass */
    int parts;                                    /* objects and transforms entered so far */
    int depth;                                    /* of those entered and not left */
};

/* A node, and how many definitions it knows. */
struct place_in_book {
    const struct node *node; /* NULL: nothing there */
    uint32_t knows;
};

/* A mapping, and below it those that it extends: a key is looked for from the top down. */
struct layer {
    const struct node *mapping;
    uint32_t knows;
    struct layer *under; /* or NULL */
};

void import_define(struct importer *im, const struct node *item);

/* The definition of the name, marked as used. NULL: there is none before; not reported. */
struct book_definition *import_definition(struct importer *im, const char *name, uint32_t knows);

/* Reports a name that nothing has; `also`: what else might be meant. */
void import_unknown_name(struct importer *im, const struct node *name, const char *what,
                         const char *const *also);

/* A mapping and what it extends: by `extend`, or by the key of that name where that is NULL. NULL
 * when one of them is no mapping; reported. */
struct layer *import_layers(struct importer *im, struct place_in_book at, const struct node *extend);

const struct node *mapping_find(const struct node *mapping, const char *key); /* the value, or NULL */
struct place_in_book layer_find(const struct layer *layer, const char *key);

/* Warns of every key of the layers that is in none of the lists. */
void import_check_keys(struct importer *im, const struct layer *layers, const char *what,
                       const char *const *known, const char *const *also);

/* Each reads a value, which may be the name of a definition. False: it is something else, reported;
 * *out untouched. `what` names it in messages. */
bool import_number(struct importer *im, const char *what, struct place_in_book at, double *out);
bool import_extent(struct importer *im, const char *what, struct place_in_book at,
                   double *out); /* or infinite */
bool import_vec3(struct importer *im, const char *what, struct place_in_book at, vec3 *out);
bool import_color(struct importer *im, const char *what, struct place_in_book at, vec3 *out); /* made >= 0 */
bool import_boolean(struct importer *im, const char *what, struct place_in_book at, bool *out);

/* What stands there: the value of the definition that is named, if one is. */
struct place_in_book import_named(struct importer *im, struct place_in_book at);

/* "a list of 3", "`abc`": what was found, for messages. */
const char *found_in_book(struct importer *im, const struct node *node);

/* Around an object or a transform, which definitions may multiply and nest. False, reported, when
 * there are too many, or too many within each other; then there is nothing to leave. */
bool import_enter(struct importer *im, const struct node *node);
void import_leave(struct importer *im);

/* Whether so many may be within each other; reported if not. */
bool import_depth(struct importer *im, const struct node *node, int depth);

/* ---- import_material.c ---- */

/* Each writes "material: ..." at the indent: for the value of a `material` key, and the one that the
 * book gives to what has none. */
void import_material(struct importer *im, struct text *text, int indent, struct place_in_book at);
void import_plain_material(struct importer *im, struct text *text, int indent);

/* ---- import_transform.c ---- */

/* The steps of one object, the first acts first. */
struct steps {
    const char **entries;
    size_t count, room;
    affine map; /* all of them, in the axes of the book; begins as the identity */
};

/* Adds the steps of a transform: a list of steps and of names, or a name. */
void import_transform(struct importer *im, struct steps *steps, struct place_in_book at);
void steps_write(struct text *text, int indent, const struct steps *steps); /* nothing where there is none */

/* ---- import_camera.c: what is not in the scene itself ---- */

void import_camera(struct importer *im, const struct layer *camera);
void import_light(struct importer *im, const struct layer *light);

/* ---- import_object.c ---- */

/* One `- add: ...`: an object, a light or the camera. */
void import_add(struct importer *im, struct place_in_book item);

/* ---- import_shape.c ---- */

/* Writes "- cylinder: ..." or what else it becomes. False: there is nothing of it, reported. `kind` is
 * sphere, plane, cube, cylinder or cone. */
bool import_shape(struct importer *im, struct text *text, int indent, const char *kind,
                  const struct layer *layers);

#endif
