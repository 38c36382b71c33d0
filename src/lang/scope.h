/* Variables: parameters, arguments of templates, loop variables, and what an animation provides. */
#ifndef MONGE_LANG_SCOPE_H
#define MONGE_LANG_SCOPE_H

#include "lang/expr.h"
#include "lang/node.h"

struct checker;
struct scope;

enum binding_kind {
    BINDING_QUANTITY, /* a number, vector or colour */
    BINDING_NODE,     /* whatever the node means where the variable stands, its names those of `scope` */
    BINDING_UNKNOWN,  /* in a rehearsal: there is such a variable */
};

struct binding {
    const char *name;
    enum binding_kind kind;
    struct quantity quantity;
    const struct node *node; /* what was written; NULL: a loop's count or range */
    const struct scope *scope;
};

/* The innermost variables; those of the file and of the animation are behind the last. */
struct scope {
    const struct scope *outer;
    const struct binding *bindings;
    unsigned count;
};

/* The variable of that name, the innermost; NULL: none, or (ck->waiting is then set) not known yet. */
const struct binding *scope_find(struct checker *ck, const char *name);

/* Whether it is a variable that only an animation has, and there is none. */
bool scope_needs_animation(const struct checker *ck, const char *name);

/* What is told of something wrong in what the node, a variable, stands for. */
struct diag_frame scope_frame(struct checker *ck, const struct node *node);

/* Tells of an expression that something is wrong with where its values from outside are given. */
void scope_tell_given(struct checker *ck, struct diagnostic *d, const struct node *node);

/* What a scalar that is a variable's name alone stands for, if that is a node or unknown: NULL else. */
const struct binding *scope_stands_for(struct checker *ck, const struct node *node);

/* Whether the text can be the name of a variable: a letter or _, then letters, digits and _. */
bool scope_is_name(const char *text);

/* Gives the variable the value that the node has here and now. False: reported, or not known yet;
 * out->kind is then BINDING_UNKNOWN. */
bool scope_bind(struct checker *ck, const char *name, const struct node *node, struct binding *out);

enum quantity_result {
    QUANTITY_OK,
    QUANTITY_UNKNOWN, /* its names are right, its value is not known: in a rehearsal, or not yet */
    QUANTITY_WRONG,   /* reported */
    QUANTITY_NONE,    /* not reported: the node does not look like a quantity */
};

/* The number, vector or colour that a node is: a number, an expression, a list of 2 to 4 of them, or
 * keyframes. `what` names it in messages. */
enum quantity_result scope_quantity(struct checker *ck, const char *what, const struct node *node,
                                    struct quantity *out);

/* The variables that there are, for messages and suggestions. */
struct expr_scope scope_names(struct checker *ck);

#endif
