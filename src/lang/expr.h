/* Expressions: what may stand wherever a number is expected.
 *
 *     expression = choice                       i < 6 ? 90 : 35.26
 *     choice     = or ["?" choice ":" choice]
 *     or = and {"||" and}    and = equal {"&&" equal}    equal = order [("==" | "!=") order]
 *     order = sum [("<" | "<=" | ">" | ">=") sum]
 *     sum = product {("+" | "-") product}        product = unary {("*" | "/" | "%") unary}
 *     unary = ("-" | "+" | "!") unary | power    power = postfix ["^" unary]
 *     postfix = primary {"." ("x" | "y" | "z" | "r" | "g" | "b") | "[" choice "]"}
 *     primary = number | color | name | name "(" [choice {"," choice}] ")" | "[" choice {"," choice} "]" | "(" choice ")"
 *
 * grammar/functions.yaml has the functions and constants. Angles are in degrees. The results are the same
 * bits on every machine. A text has 4096 bytes at most and nests 100 levels deep. */
#ifndef MONGE_LANG_EXPR_H
#define MONGE_LANG_EXPR_H

#include "base/arena.h"
#include "lang/spelling.h"

/* A number (count 1), or a vector or colour of 2 to 4 of them. True is 1, false 0. */
struct quantity {
    unsigned count;
    double v[4];
};

struct expr; /* parsed; belongs to the arena */

/* What is wrong with an expression, and where in its text. */
struct expr_error {
    size_t offset, length; /* bytes of the text; length 0: it ends too early */
    const char *code;      /* of the diagnostic; static */
    const char *message;   /* in the arena or static */
    const char *help;      /* the smallest fix; NULL: none */
};

enum expr_found {
    EXPR_FOUND,   /* *out is its value, all of it finite */
    EXPR_MISSING, /* there is no such name here */
    EXPR_OTHER,   /* a name of something that is no number: a material, a text, a list */
    EXPR_LATER,   /* its value is not known yet: the evaluation ends */
};

/* What an expression may refer to besides constants, functions and colours. It is asked first: a name of
 * its own hides the constant or colour. Functions are called, so that a name may be that of one. */
struct expr_scope {
    void *context;
    enum expr_found (*find)(void *context, const char *name, struct quantity *out);
    void (*names)(void *context, void (*each)(void *to, const char *name),
                  void *to); /* all of them, for suggestions */
};

enum expr_result { EXPR_OK, EXPR_WRONG, EXPR_WAIT }; /* WAIT: `find` said EXPR_LATER */

/* NULL: *error says why. The text need not end with a zero, and may go when this returns. */
struct expr *expr_parse(struct arena *arena, const char *text, size_t size, struct expr_error *error);

/* The name that is all of the expression, or NULL. It may be that of a constant or colour. */
const char *expr_name(const struct expr *expr);

/* The value. Every part of it is finite. EXPR_WRONG: *error says why, with texts in `arena`. */
enum expr_result expr_evaluate(const struct expr *expr, const struct expr_scope *scope, struct arena *arena,
                               struct quantity *out, struct expr_error *error);

/* Whether the scope has all names of it, without their values: what can be said of a template that
 * nobody uses. EXPR_OK or EXPR_WRONG: what is known later counts as there. */
enum expr_result expr_check(const struct expr *expr, const struct expr_scope *scope, struct arena *arena,
                            struct expr_error *error);

#endif
