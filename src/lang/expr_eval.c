#include <math.h>

#include "lang/expr_errors.h"
#include "lang/functions.h"

/* Each of these gives EXPR_OK and *out, which is finite, or the error told, or EXPR_WAIT. */
static enum expr_result evaluate(const struct evaluation *e, const struct term *term, struct quantity *out);

static const struct quantity truths[] = {{1, {0}}, {1, {1}}};

/* A part that must be a number. */
static enum expr_result evaluate_number(const struct evaluation *e, const struct term *term, double *out) {
    struct quantity value;
    const enum expr_result result = evaluate(e, term, &value);
    if (result == EXPR_OK && value.count != 1) return wrong_count(e, term, &value);
    if (result == EXPR_OK) *out = value.v[0];
    return result;
}

static enum expr_result evaluate_name(const struct evaluation *e, const struct term *term,
                                      struct quantity *out) {
    switch (e->scope->find(e->scope->context, term->name, out)) {
    case EXPR_FOUND: return EXPR_OK;
    case EXPR_LATER: return EXPR_WAIT;
    case EXPR_OTHER: return wrong_kind(e, term);
    case EXPR_MISSING: break;
    }
    if (term->value.count == 0) return wrong_name(e, term);
    *out = term->value;
    return EXPR_OK;
}

static enum expr_result evaluate_unary(const struct evaluation *e, const struct term *term,
                                       struct quantity *out) {
    double condition = 0.0;
    const enum expr_result result = term->symbol == '!' ? evaluate_number(e, term->parts[0], &condition)
                                                        : evaluate(e, term->parts[0], out);
    if (result != EXPR_OK) return result;
    if (term->symbol == '!') *out = truths[condition == 0.0];
    if (term->symbol == '-')
        for (unsigned i = 0; i < out->count; i++) out->v[i] = -out->v[i];
    return EXPR_OK;
}

static enum expr_result evaluate_logic(const struct evaluation *e, const struct term *term,
                                       struct quantity *out) {
    double a = 0.0, b = 0.0;
    enum expr_result result = evaluate_number(e, term->parts[0], &a);
    if (result != EXPR_OK) return result;
    const bool enough = term->symbol == SYMBOL('|', '|') ? a != 0.0 : a == 0.0;
    if (!enough) result = evaluate_number(e, term->parts[1], &b);
    if (result == EXPR_OK) *out = truths[(enough ? a : b) != 0.0];
    return result;
}

static bool compare(int symbol, double a, double b) {
    switch (symbol) {
    case '<': return a < b;
    case '>': return a > b;
    case SYMBOL('<', '='): return a <= b;
    case SYMBOL('>', '='): return a >= b;
    case SYMBOL('=', '='): return a == b;
    default: return a != b;
    }
}

static enum expr_result evaluate_comparison(const struct evaluation *e, const struct term *term,
                                            struct quantity *out) {
    double a = 0.0, b = 0.0;
    enum expr_result result = evaluate_number(e, term->parts[0], &a);
    if (result == EXPR_OK) result = evaluate_number(e, term->parts[1], &b);
    if (result == EXPR_OK) *out = truths[compare(term->symbol, a, b)];
    return result;
}

/* NaN: there is no value. */
static double calculate(int symbol, double a, double b) {
    switch (symbol) {
    case '+': return a + b;
    case '-': return a - b;
    case '*': return a * b;
    case '/': return b == 0.0 ? NAN : a / b;
    case '%': return function_modulo(a, b);
    default: return function_power(a, b);
    }
}

static enum expr_result evaluate_arithmetic(const struct evaluation *e, const struct term *term,
                                            struct quantity *out) {
    struct quantity a, b;
    enum expr_result result = evaluate(e, term->parts[0], &a);
    if (result == EXPR_OK) result = evaluate(e, term->parts[1], &b);
    if (result != EXPR_OK) return result;
    const unsigned count = quantity_join(&a, &b);
    if (count == 0) return wrong_pair(e, term, &a, &b);
    for (unsigned i = 0; i < count; i++) {
        out->v[i] = calculate(term->symbol, quantity_part(&a, i), quantity_part(&b, i));
        if (!isfinite(out->v[i])) return wrong_arithmetic(e, term, &a, &b, isnan(out->v[i]));
    }
    out->count = count;
    return EXPR_OK;
}

static enum expr_result evaluate_binary(const struct evaluation *e, const struct term *term,
                                        struct quantity *out) {
    switch (term->symbol) {
    case '+':
    case '-':
    case '*':
    case '/':
    case '%':
    case '^': return evaluate_arithmetic(e, term, out);
    case SYMBOL('&', '&'):
    case SYMBOL('|', '|'): return evaluate_logic(e, term, out);
    default: return evaluate_comparison(e, term, out);
    }
}

static enum expr_result evaluate_choice(const struct evaluation *e, const struct term *term,
                                        struct quantity *out) {
    double condition = 0.0;
    const enum expr_result result = evaluate_number(e, term->parts[0], &condition);
    return result == EXPR_OK ? evaluate(e, term->parts[condition != 0.0 ? 1 : 2], out) : result;
}

static enum expr_result evaluate_part(const struct evaluation *e, const struct term *term,
                                      struct quantity *out) {
    struct quantity whole;
    double index = 0.0;
    enum expr_result result = evaluate(e, term->parts[0], &whole);
    if (result == EXPR_OK) result = evaluate_number(e, term->parts[1], &index);
    if (result != EXPR_OK) return result;
    if (whole.count == 1 || !(index >= 0.0 && index < whole.count) || index != floor(index))
        return wrong_part(e, term, &whole, index);
    *out = (struct quantity){1, {whole.v[(unsigned)index]}};
    return EXPR_OK;
}

static enum expr_result evaluate_vector(const struct evaluation *e, const struct term *term,
                                        struct quantity *out) {
    enum expr_result result = EXPR_OK;
    for (unsigned i = 0; i < term->count && result == EXPR_OK; i++)
        result = evaluate_number(e, term->parts[i], &out->v[i]);
    out->count = term->count;
    return result;
}

static enum expr_result evaluate_call(const struct evaluation *e, const struct term *term,
                                      struct quantity *out) {
    struct quantity args[FUNCTION_ARGUMENTS];
    for (unsigned i = 0; i < term->count; i++) {
        const enum expr_result result = evaluate(e, term->parts[i], &args[i]);
        if (result != EXPR_OK) return result;
    }
    const enum function_result called = function_call(term->symbol, args, term->count, out);
    if (called != FUNCTION_DONE) return wrong_call(e, term, args, called);
    for (unsigned i = 0; i < out->count; i++)
        if (!isfinite(out->v[i])) return wrong_call(e, term, args, FUNCTION_DONE);
    return EXPR_OK;
}

static enum expr_result evaluate(const struct evaluation *e, const struct term *term, struct quantity *out) {
    switch (term->kind) {
    case TERM_VALUE: *out = term->value; return EXPR_OK;
    case TERM_NAME: return evaluate_name(e, term, out);
    case TERM_UNARY: return evaluate_unary(e, term, out);
    case TERM_BINARY: return evaluate_binary(e, term, out);
    case TERM_CHOICE: return evaluate_choice(e, term, out);
    case TERM_PART: return evaluate_part(e, term, out);
    case TERM_VECTOR: return evaluate_vector(e, term, out);
    default: return evaluate_call(e, term, out);
    }
}

enum expr_result expr_evaluate(const struct expr *expr, const struct expr_scope *scope, struct arena *arena,
                               struct quantity *out, struct expr_error *error) {
    const struct evaluation e = {expr->text, scope, arena, error};
    struct quantity value;
    const enum expr_result result = evaluate(&e, expr->root, &value);
    if (result == EXPR_OK) *out = value;
    return result;
}

static enum expr_result check(const struct evaluation *e, const struct term *term) {
    struct quantity ignored;
    if (term->kind == TERM_NAME && evaluate_name(e, term, &ignored) == EXPR_WRONG) return EXPR_WRONG;
    for (unsigned i = 0; i < term->count; i++)
        if (check(e, term->parts[i]) == EXPR_WRONG) return EXPR_WRONG;
    return EXPR_OK;
}

enum expr_result expr_check(const struct expr *expr, const struct expr_scope *scope, struct arena *arena,
                            struct expr_error *error) {
    const struct evaluation e = {expr->text, scope, arena, error};
    return check(&e, expr->root);
}
