/* What the files of the checker share; for lang/ alone. */
#ifndef MONGE_LANG_CHECKER_H
#define MONGE_LANG_CHECKER_H

#include "base/table.h"
#include "lang/description.h"
#include "lang/lang.h"
#include "lang/node.h"
#include "lang/scope.h"

enum reading_state { READING_UNREAD, READING_UNDER_WAY, READING_DONE };

/* A material or a template with a name, read when it is first needed. */
struct definition {
    const struct grammar_kind *kind;
    const char *name;
    struct span span; /* of the name */
    const struct node *node;
    enum reading_state state;
    struct object_value *object; /* DONE: failed where something of it was reported */
    uint32_t number;             /* among its kind, from 0 */
    bool used;
    struct definition *next; /* in the order of the files */
};

struct definitions {
    struct table names;
    struct definition *first, **end;
    uint32_t count;
};

/* A parameter of the file: read when it is first needed. */
struct parameter {
    const char *name;
    struct span span;         /* of the name */
    const struct node *node;  /* its value, or a mapping of kind param */
    const struct node *given; /* the value from outside; NULL: none */
    enum reading_state state;
    struct binding binding; /* DONE */
    bool used;
    const struct parameter *needed_by; /* UNDER_WAY: whose value it is read for; NULL: none */
    struct parameter *next;
};

/* A file that is read: the scene or what it includes. */
struct unit {
    const struct source *source;
    const char *path; /* to find what it includes */
    const struct unit *includer;
    struct span include;    /* where it was asked for */
    uint64_t device, inode; /* the same file is read once */
    struct node *root;
    const struct node *declared; /* the last pair of the root whose names are known; NULL: none yet */
    struct unit *next;
};

/* Where an object stands: the value of `key` in a mapping of `kind`. Both NULL: the file itself. */
struct surrounding {
    const struct grammar_kind *kind;
    const struct grammar_key *key;
};

struct checker {
    struct arena *arena; /* of what is being read: the scratch of an object, or kept */
    struct lang_memory *memory;
    struct diagnostics *diag;
    const struct lang_input *input;
    struct surrounding around; /* the object that is checked now */
    const struct scope *scope; /* NULL: the file's alone */
    struct definitions materials, templates, presets;
    struct table parameters;
    struct parameter *first_parameter, **parameters_end;
    const struct parameter *parameter; /* that is read now; NULL: none */
    struct unit *units;
    const struct object_value *animation; /* NULL: none, or not read yet */
    bool names_lost;                      /* definitions could not be read: nothing can be said of names */
    bool variables_lost;                  /* the same of parameters */
    bool provisional;                     /* more names may come: what is not there yet is waited for */
    bool waiting;                         /* a name was looked for in vain while provisional */
    bool included;          /* the file that is checked is there for its definitions: it needs no scene */
    bool rehearsing;        /* names and forms are checked; values are not known, nothing is placed */
    bool in_template;       /* of what is rehearsed */
    bool stopped;           /* a limit was passed: evaluation is over */
    bool moved;             /* the animation's variables were read */
    unsigned depth;         /* of templates in use */
    unsigned groups, loops; /* groups and variables of loops that are open, through all templates */
    unsigned waiters;       /* parameters that are being read, each for the one before */
    size_t steps, objects;  /* against the limits */
};

enum { CHECK_MAX_KEYS = 64 }; /* of a kind */

/* A mapping that is checked as an object. */
struct mapping {
    const struct node *node;           /* NODE_MAPPING */
    const struct object_value *object; /* what it becomes; its span is the alias's where there is one */
    const struct node *given[CHECK_MAX_KEYS]; /* the first node of each key of the kind; NULL: not there */
    signed char index[CHECK_MAX_KEYS]; /* which keys the first pairs have, in their order; -1: unknown */
    uint64_t meant;                    /* bit i: an unknown key was probably this one */
};

/* ---- scalars.c: one value each. False when it was reported as wrong; *out is then untouched. ---- */

/* A number, also by an expression. */
bool check_number(struct checker *ck, const struct grammar_key *key, const struct node *node, double *out);
bool check_integer(struct checker *ck, const struct grammar_key *key, const struct node *node, double *out);
/* Whether the number that the node gives is in the key's range. Reported if not. */
bool check_in_range(struct checker *ck, const struct grammar_key *key, const struct node *node, double value);
/* Also the value of an expression: 0 is false. */
bool check_boolean(struct checker *ck, const struct grammar_key *key, const struct node *node, int *out);
bool check_choice(struct checker *ck, const struct grammar_key *key, const struct node *node, int *out);
bool check_text(struct checker *ck, const struct grammar_key *key, const struct node *node, const char **out);

/* Adds the variable that a word was meant to be, or those that there are. */
void scalar_help_variable(struct checker *ck, struct diagnostic *d, const char *word);

/* Adds `true` or `false` for a word like `yes`. Whether it is one. */
bool scalar_help_truth(struct checker *ck, struct diagnostic *d, const char *word);

/* Adds what to write for an expression as of another language: `a and b`. Whether it looks like one. */
bool scalar_help_expression(struct checker *ck, struct diagnostic *d, const char *text);

/* Whether the text is a number of the language: decimal, of any size. */
bool scalar_is_number(const char *text);

/* The same, and its value; false also of a leading zero, and of what is too large. */
bool scalar_number(struct checker *ck, const char *text, double *out);

/* ---- rows.c ---- */

/* Three numbers in range; a direction is not null. */
bool check_vector(struct checker *ck, const struct grammar_key *key, const struct node *node, vec3 *out);
bool check_size(struct checker *ck, const struct grammar_key *key, const struct node *node, vec3 *out);
bool check_matrix(struct checker *ck, const struct grammar_key *key, const struct node *node,
                  const affine **out);

/* ---- colors.c ---- */

/* Also an expression. */
bool check_color(struct checker *ck, const struct grammar_key *key, const struct node *node, vec3 *out);

/* Whether the text is a colour: "#rrggbb", "#rgb" or a CSS name. */
bool color_parse(const char *text, vec3 *out);

/* The light of an sRGB part, both 0 to 1 (IEC 61966-2-1). */
double linear_from_srgb(double c);
/* ---- check.c ---- */

/* A mapping of the kind; what is wrong in it is reported and left out. NULL: it is no mapping. Lists of
 * objects in it stay nodes, see place.c. */
struct object_value *check_object(struct checker *ck, const struct grammar_kind *kind,
                                  const struct node *node);

/* ---- define.c: names of the files ---- */

/* Whether the node can name a variable: a word that nothing else has. Reported if not; `what` is "a parameter". */
bool define_name_allowed(struct checker *ck, const char *what, const struct node *name);

/* Why no variable can have this name, or NULL. */
const char *define_name_taken(const char *name);

/* Makes the names known that the unit has so far, and reads what can be read of them. */
void define_names(struct checker *ck, struct unit *unit);

/* Whether the value, read in the scope of now, is in the range that a parameter's declaration states. Reported if not. */
bool define_in_range(struct checker *ck, const char *name, const struct node *declared,
                     const struct node *value);

/* The definition's object, read now if it was not; NULL: reported, or not known yet. */
struct object_value *define_read(struct checker *ck, struct definition *def);

/* The parameter's value; NULL as above. */
const struct binding *define_parameter(struct checker *ck, struct parameter *parameter);

/* The presets, read at the first call. */
struct definitions *define_presets(struct checker *ck);

/* Reports values from outside for parameters that are not there. */
void define_check_given(struct checker *ck);

/* Warns of names that nothing uses. */
void define_warn_unused(struct checker *ck);

/* ---- include.c ---- */

/* Reads the files that a value of `include` names, with their names. */
void include_files(struct checker *ck, const struct unit *unit, const struct node *value);

/* ---- loop.c ---- */

/* Calls `turn` for every turn of the loop (the value of `for`), its variables in scope. */
void loop_run(struct checker *ck, const struct node *loop, void (*turn)(struct checker *ck, void *context),
              void *context);

/* "-1", "[0.5, 2]" */
const char *quantity_text(struct arena *arena, const struct quantity *q);

/* "i = 3, tint = gold". */
const char *loop_bindings_text(struct arena *arena, const struct scope *scope);

/* Whether the `when` of a mapping holds. QUANTITY_OK: *out says. */
enum quantity_result loop_condition(struct checker *ck, const struct node *node, bool *out);

/* ---- place.c ---- */

/* Reads an item of a list of objects and gives what it means to the sink. */
void place_item(struct checker *ck, const struct node *node);
void place_list(struct checker *ck, const struct node *list);

/* The same of the value of a key, both by their numbers, so that messages know where it stands. */
void place_members(struct checker *ck, int kind, int key, const struct node *list);

/* One more object looked at, or turn of a loop: false, and reported, past the limit. */
bool place_count_step(struct checker *ck, const struct node *node);

/* What a parameter is where nobody sets it, of the value that it is declared with. */
const struct node *place_default(const struct node *declared);

/* One level further into what names stand for, ck->depth counts them: false, and reported, past the limit. */
bool place_descend(struct checker *ck, struct span span);

/* The same of what the stack alone bounds: `depth` is counted, and may be `most`, of `what`. */
bool place_nest(struct checker *ck, struct span span, unsigned *depth, unsigned most, const char *what);

/* ---- keyframes.c ---- */

bool keyframes_is(const struct node *node);
enum quantity_result keyframes_read(struct checker *ck, const struct node *node, struct quantity *out);

/* ---- mistakes.c: what is wrong with keys and mappings, and the smallest fix ---- */

/* `all` with one more name behind it; a long list ends in an ellipsis. */
const char *append_name(struct checker *ck, const char *all, const char *name);

/* Whether there is room for the count of mistakes alone: then it is counted, and its text need not be made. */
bool only_counted(struct checker *ck, struct span span);

/* "a list of 3", "`abc`": what was found, for messages; "" when nobody will read it. */
const char *found_text(struct checker *ck, const struct node *node);

/* The same of a node that has this value: "`r`, which is -1". */
const char *found_quantity(struct checker *ck, const struct node *node, const struct quantity *value);

/* The text, or its beginning and `...`: for messages. */
const char *short_text(struct checker *ck, const char *text);

/* The index of the key that a word was probably meant to be, or -1. */
int meant_key(const struct grammar_kind *kind, const char *word);

/* The index of the key that was probably meant, or -1. Marks a key under which it belongs as meant. */
int report_unknown_key(struct checker *ck, const struct grammar_kind *kind, struct mapping *mapping,
                       const struct node *key);
/* `max(1, 2)` within { } or [ ], where YAML ends the value at the comma. Whether it is so, and reported: once,
 * however often it is asked. `what` the value is of; in a list; in the value of a mapping before a key without one. */
bool report_cut(struct checker *ck, const char *what, const struct node *value);
bool report_cut_in(struct checker *ck, const char *what, const struct node *list);
bool report_cut_before(struct checker *ck, const struct node *mapping, const struct node *key);

/* Whether a number stands where [x, y, z] belongs, as in `offset: 1` of a plane: that the key is another one then tells
 * enough. */
bool is_number_for_row(const struct grammar_key *key, const struct node *value);

/* Adds what a decimal comma in a mapping was meant to be: in `{radius: 1,5}` the 5 is a key without a value. */
bool report_help_comma(struct checker *ck, struct diagnostic *d, const struct node *mapping,
                       const struct node *key);

/* Adds that in `diffuse: #ff0000` the colour is a comment. */
bool report_help_hash(struct checker *ck, struct diagnostic *d, const struct node *name);

/* Adds that `h:1` lacks a space, where any name may stand. */
bool report_help_glued(struct checker *ck, struct diagnostic *d, const char *word);

void report_no_value(struct checker *ck, const struct grammar_key *key, const struct node *name);
void report_no_mapping(struct checker *ck, const struct grammar_kind *kind, const struct node *node);
void report_no_list(struct checker *ck, const struct grammar_key *key, const struct node *node);
void report_no_map(struct checker *ck, const struct grammar_key *key, const struct node *node);
void report_no_name(struct checker *ck, const struct grammar_key *key, const struct definitions *among,
                    const struct node *node);
void report_no_alternative(struct checker *ck, const struct object_value *object);

#endif
