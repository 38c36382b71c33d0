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

/* What a node that an anchor names was read as, for its aliases. */
struct reading {
    const void *as;              /* the kind of an object, the key of a list */
    struct object_value *object; /* of a mapping */
    struct object_list list;     /* of a sequence */
    struct reading *next;        /* of the same node, as something else */
};

/* Where an object stands: the value of `key` in a mapping of `kind`. Both NULL: the file itself. */
struct surrounding {
    const struct grammar_kind *kind;
    const struct grammar_key *key;
};

struct checker {
    struct arena *arena;
    struct diagnostics *diag;
    struct surrounding around; /* the object that is checked now */
    struct table names;        /* of definitions; one table serves as long as one kind is defined */
    struct definition *definitions, **definitions_end;
    struct reading **readings; /* by the numbers of anchors */
    uint32_t readings_room;
    bool names_lost; /* the definitions could not be read: nothing can be said of names */
};

enum { CHECK_MAX_KEYS = 64 }; /* of a kind */

/* A mapping that is checked as an object. */
struct mapping {
    const struct node *node;                  /* NODE_MAPPING */
    const struct object_value *object;        /* what it becomes; its span is the alias's where there is one */
    const struct node *given[CHECK_MAX_KEYS]; /* the first node of each key of the kind; NULL: not there */
    bool meant[CHECK_MAX_KEYS];               /* an unknown key was probably this one */
};

/* ---- scalars.c: one value each. False when it was reported as wrong; *out is then untouched. ---- */

bool check_number(struct checker *ck, const struct grammar_key *key, const struct node *node, double *out);
bool check_integer(struct checker *ck, const struct grammar_key *key, const struct node *node, double *out);
bool check_boolean(struct checker *ck, const struct grammar_key *key, const struct node *node, int *out);
bool check_choice(struct checker *ck, const struct grammar_key *key, const struct node *node, int *out);
bool check_text(struct checker *ck, const struct grammar_key *key, const struct node *node, const char **out);

/* Whether the text is a number of the language: decimal, of any size. */
bool scalar_is_number(const char *text);

/* ---- rows.c ---- */

/* Three numbers in range; a direction is not null. */
bool check_vector(struct checker *ck, const struct grammar_key *key, const struct node *node, vec3 *out);
bool check_size(struct checker *ck, const struct grammar_key *key, const struct node *node, vec3 *out);
bool check_matrix(struct checker *ck, const struct grammar_key *key, const struct node *node, const affine **out);

/* ---- colors.c ---- */

bool check_color(struct checker *ck, const struct grammar_key *key, const struct node *node, vec3 *out);

/* Whether the text is a colour: "#rrggbb", "#rgb" or a CSS name. */
bool color_parse(const char *text, vec3 *out);

/* The light of an sRGB part, both 0 to 1 (IEC 61966-2-1). */
double linear_from_srgb(double c);

/* ---- mistakes.c: what is wrong with keys and mappings, and the smallest fix ---- */

/* Whether there is room for the count of mistakes alone: then it is counted, and its text need not be made. */
bool only_counted(struct checker *ck, struct span span);

/* "a list of 3", "`abc`": what was found, for messages; "" when nobody will read it. */
const char *found_text(struct checker *ck, const struct node *node);

/* The text, or its beginning and `...`: for messages. */
const char *short_text(struct checker *ck, const char *text);

/* The index of the key that was probably meant, or -1. Marks a key under which it belongs as meant. */
int report_unknown_key(struct checker *ck, const struct grammar_kind *kind, struct mapping *mapping, const struct node *key);
void report_no_value(struct checker *ck, const struct grammar_key *key, const struct node *name);
void report_no_mapping(struct checker *ck, const struct grammar_kind *kind, const struct node *node);
void report_no_list(struct checker *ck, const struct grammar_key *key, const struct node *node);
void report_no_map(struct checker *ck, const struct grammar_key *key, const struct node *node);
void report_no_name(struct checker *ck, const struct grammar_key *key, const struct node *node);
void report_no_alternative(struct checker *ck, const struct object_value *object);

#endif
