/* What can be wrong with the evaluation of an expression; for expr*.c alone. Each tells the error and
 * gives EXPR_WRONG. */
#ifndef MONGE_LANG_EXPR_ERRORS_H
#define MONGE_LANG_EXPR_ERRORS_H

#include "lang/expr_parts.h"
#include "lang/functions.h"

struct evaluation {
    const char *text;
    const struct expr_scope *scope;
    struct arena *arena; /* for the texts of errors */
    struct expr_error *error;
};

/* A name that nobody knows; one of something that is no number. */
enum expr_result wrong_name(const struct evaluation *e, const struct term *term);
enum expr_result wrong_kind(const struct evaluation *e, const struct term *term);

/* A vector where a number is expected. */
enum expr_result wrong_count(const struct evaluation *e, const struct term *term,
                             const struct quantity *value);

/* An operator between vectors of different counts; one whose result is none, or (not `none`) too large. */
enum expr_result wrong_pair(const struct evaluation *e, const struct term *term, const struct quantity *a,
                            const struct quantity *b);
enum expr_result wrong_arithmetic(const struct evaluation *e, const struct term *term,
                                  const struct quantity *a, const struct quantity *b, bool none);

/* A part of what has none, or that it has not. */
enum expr_result wrong_part(const struct evaluation *e, const struct term *term, const struct quantity *whole,
                            double index);

/* FUNCTION_DONE: the result is too large. */
enum expr_result wrong_call(const struct evaluation *e, const struct term *term, const struct quantity *args,
                            enum function_result why);

#endif
