/* The functions of grammar/functions.yaml. They are pure: the same arguments give the same bits. */
#ifndef MONGE_LANG_FUNCTIONS_H
#define MONGE_LANG_FUNCTIONS_H

#include <stdint.h>

#include "lang/expr.h"

enum function_result {
    FUNCTION_DONE,
    FUNCTION_OUTSIDE,   /* has no value there */
    FUNCTION_DIFFERENT, /* arguments of different counts */
    FUNCTION_COUNTS,    /* takes vectors of other counts */
};

enum { FUNCTION_ARGUMENTS = 32 }; /* of one call, at most */

/* `count` arguments, as many as the function takes. *out may be infinite: too large for a number. */
enum function_result function_call(int function, const struct quantity *args, unsigned count,
                                   struct quantity *out);

/* How many parts `a` and `b` have together, part by part; 0: their counts do not fit. */
static inline unsigned quantity_join(const struct quantity *a, const struct quantity *b) {
    return a->count == b->count || b->count == 1 ? a->count : a->count == 1 ? b->count : 0;
}

/* The part i of a vector, of a number itself. */
static inline double quantity_part(const struct quantity *q, unsigned i) {
    return q->v[q->count == 1 ? 0 : i];
}

/* The rest of a / b with the sign of b, nearer to 0 than b. NaN for b = 0. */
double function_modulo(double a, double b);

/* NaN where there is none: a negative x and a broken y, or 0 to a negative power. */
double function_power(double x, double y);

/* Gradient noise at 1 to 3 coordinates: -1 to 1, with continuous second derivatives (Perlin 2002). */
double noise_at(const double *at, unsigned dimensions);

/* 64 well-mixed bits of the numbers; -0 counts as 0. */
uint64_t random_bits_of(uint64_t start, const double *v, unsigned count);

#endif
