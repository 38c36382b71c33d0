/* What the files of the checker share; for lang/ alone. */
#ifndef MONGE_LANG_CHECKER_H
#define MONGE_LANG_CHECKER_H

#include "base/table.h"
#include "lang/description.h"
#include "lang/lang.h"
#include "lang/node.h"

/* A name that the file defines, for values that refer to it. */
struct definition {
    const char *name;
    struct object_value *object;
    struct span span; /* of the name */
    bool used;
    struct definition *next; /* in the order of the file */
};

struct checker {
    struct arena *arena;
    struct diagnostics *diag;
    const struct lang_limits *limits;
    size_t values; /* seen so far, those behind aliases each time */
    struct table names;             /* of definitions; one table serves as long as one kind is defined */
    struct definition *definitions, **definitions_end;
};

/* ---- scalars.c: one value each. False when it was reported as wrong; *out is then untouched. ---- */

bool check_number(struct checker *ck, const struct grammar_key *key, const struct node *node, double *out);
bool check_integer(struct checker *ck, const struct grammar_key *key, const struct node *node, double *out);
bool check_boolean(struct checker *ck, const struct grammar_key *key, const struct node *node, int *out);
bool check_choice(struct checker *ck, const struct grammar_key *key, const struct node *node, int *out);
bool check_text(struct checker *ck, const struct grammar_key *key, const struct node *node, const char **out);

/* Three numbers in range; a direction is not null. */
bool check_vector(struct checker *ck, const struct grammar_key *key, const struct node *node, vec3 *out);
bool check_size(struct checker *ck, const struct grammar_key *key, const struct node *node, vec3 *out);
bool check_matrix(struct checker *ck, const struct grammar_key *key, const struct node *node, const affine **out);

/* ---- colors.c ---- */

bool check_color(struct checker *ck, const struct grammar_key *key, const struct node *node, vec3 *out);

/* ---- check.c ---- */

/* Counts a value against the limit. False when there are too many; reported once. */
bool check_count(struct checker *ck, const struct node *node);

/* "a list of 3", "the text `abc`": what was found, for messages. In the arena of the diagnostics. */
const char *check_found(struct checker *ck, const struct node *node);

#endif
