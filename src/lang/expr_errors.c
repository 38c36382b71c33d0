#include "lang/expr_errors.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lang/grammar.h"

static enum expr_result wrong(const struct evaluation *e, const struct term *term, const char *code,
                              const char *message, const char *help) {
    *e->error = (struct expr_error){term->offset, term->length, code, message, help};
    return EXPR_WRONG;
}

/* "-1", "[0.5, 2]" */
static const char *value_text(const struct evaluation *e, const struct quantity *q) {
    if (q->count == 1) return arena_format(e->arena, "%.6g", q->v[0] + 0.0);
    const char *text = "[";
    for (unsigned i = 0; i < q->count; i++)
        text = arena_format(e->arena, "%s%.6g%s", text, q->v[i] + 0.0, i + 1 < q->count ? ", " : "]");
    return text;
}

/* As it is written. */
static const char *term_text(const struct evaluation *e, const struct term *term) {
    return text_shown(e->arena, e->text, term->begin, term->end);
}

static const char *count_text(const struct evaluation *e, const struct quantity *q) {
    return q->count == 1 ? "a number" : arena_format(e->arena, "a vector of %u", q->count);
}

/* ---- Names ---- */

enum { NAMES_MAX = 64, NAMES_SHOWN = 12 };

struct names {
    struct spelling spelling;
    const char *all[NAMES_MAX];
    size_t count;
};

static void collect(void *to, const char *name) {
    struct names *names = to;
    spelling_offer(&names->spelling, name);
    if (names->count < NAMES_MAX) names->all[names->count++] = name;
}

static int compare_names(const void *a, const void *b) {
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

static const char *names_in_scope(const struct evaluation *e, struct names *names) {
    if (names->count == 0) return "no names are in scope here";
    qsort(names->all, names->count, sizeof *names->all, compare_names);
    const char *text = "in scope: ";
    size_t shown = 0;
    for (size_t i = 0; i < names->count && shown < NAMES_SHOWN; i++) {
        if (i > 0 && strcmp(names->all[i], names->all[i - 1]) == 0) continue;
        text = arena_format(e->arena, "%s%s%s", text, shown++ ? ", " : "", names->all[i]);
    }
    return names->count > NAMES_SHOWN ? arena_format(e->arena, "%s, ...", text) : text;
}

static const char *help_name(const struct evaluation *e, const char *name) {
    struct names names = {.spelling = spelling_begin(name)};
    const char *call = NULL, *instead = word_instead(e->arena, name);
    e->scope->names(e->scope->context, collect, &names);
    for (int i = 0; i < grammar_constant_count; i++)
        spelling_offer(&names.spelling, grammar_constants[i].name);
    for (int i = 0; i < grammar_function_count; i++) {
        const char *before = names.spelling.best;
        spelling_offer(&names.spelling, grammar_functions[i].name);
        if (names.spelling.best != before) call = grammar_functions[i].call;
    }
    const unsigned distance = names.spelling.distance;
    if (call && distance == 0) return arena_format(e->arena, "it is a function: write `%s`", call);
    if (instead && (!names.spelling.best || distance > 0)) return instead;
    if (names.spelling.best)
        return arena_format(e->arena, "did you mean `%s`?", call ? call : names.spelling.best);
    for (int i = 0; i < grammar_color_count; i++) spelling_offer(&names.spelling, grammar_colors[i].name);
    if (names.spelling.best)
        return arena_format(e->arena, "did you mean the colour `%s`?", names.spelling.best);
    return names_in_scope(e, &names);
}

enum expr_result wrong_name(const struct evaluation *e, const struct term *term) {
    return wrong(e, term, "unknown-variable",
                 arena_format(e->arena, "nothing here is named %s", term_text(e, term)),
                 help_name(e, term->name));
}

enum expr_result wrong_kind(const struct evaluation *e, const struct term *term) {
    return wrong(e, term, "not-a-quantity",
                 arena_format(e->arena, "%s is no number, vector or colour", term_text(e, term)), NULL);
}

/* ---- Values ---- */

enum expr_result wrong_count(const struct evaluation *e, const struct term *term,
                             const struct quantity *value) {
    struct term whole = *term;
    whole.offset = term->begin;
    whole.length = term->end - term->begin;
    return wrong(
        e, &whole, "not-a-number",
        arena_format(e->arena, "expected a number, found %s: %s", count_text(e, value), value_text(e, value)),
        value->count == 3 ? "take a part of it: .x, .y, .z, .r, .g or .b, or its length(v)"
                          : "take a part of it: [0], or its length(v)");
}

enum expr_result wrong_pair(const struct evaluation *e, const struct term *term, const struct quantity *a,
                            const struct quantity *b) {
    return wrong(e, term, "different-counts",
                 arena_format(e->arena, "a vector of %u meets a vector of %u: %s and %s", a->count, b->count,
                              value_text(e, a), value_text(e, b)),
                 NULL);
}

/* "`n - 3` is 0"; of a number that is written there nothing need be said. */
static const char *which_is(const struct evaluation *e, const struct term *term,
                            const struct quantity *value) {
    return term->kind == TERM_VALUE
               ? ""
               : arena_format(e->arena, ": %s is %s", term_text(e, term), value_text(e, value));
}

enum expr_result wrong_arithmetic(const struct evaluation *e, const struct term *term,
                                  const struct quantity *a, const struct quantity *b, bool none) {
    if (none && term->symbol != '^')
        return wrong(e, term, "division-by-zero",
                     arena_format(e->arena, "division by zero%s", which_is(e, term->parts[1], b)), NULL);
    const char *calculation =
        arena_format(e->arena, "%s %c %s", value_text(e, a), term->symbol, value_text(e, b));
    if (!none)
        return wrong(e, term, "not-finite",
                     arena_format(e->arena, "%s is too large: numbers end at 1.8e308", calculation), NULL);
    for (unsigned i = 0; i < 4; i++)
        if (i < (a->count > b->count ? a->count : b->count) && quantity_part(a, i) == 0.0 &&
            quantity_part(b, i) < 0.0)
            return wrong(e, term, "division-by-zero",
                         arena_format(e->arena, "division by zero: %s", calculation), NULL);
    return wrong(e, term, "outside-domain",
                 arena_format(e->arena, "%s: a negative number has only whole powers", calculation), NULL);
}

enum expr_result wrong_part(const struct evaluation *e, const struct term *term, const struct quantity *whole,
                            double index) {
    if (whole->count == 1)
        return wrong(e, term, "not-a-vector",
                     arena_format(e->arena, "%s is a number and has no parts", term_text(e, term->parts[0])),
                     NULL);
    const char *has = whole->count == 2 ? "0 and 1" : whole->count == 3 ? "0, 1 and 2" : "0 to 3";
    if (index != floor(index))
        return wrong(e, term, "outside-domain", arena_format(e->arena, "the part %.6g of a vector", index),
                     "write floor(i) for a whole number");
    return wrong(e, term, "outside-domain",
                 arena_format(e->arena, "a vector of %u has no part %.6g%s", whole->count, index,
                              which_is(e, term->parts[1], &(struct quantity){1, {index}})),
                 arena_format(e->arena, "its parts are %s", has));
}

static const char *arguments_text(const struct evaluation *e, const struct quantity *args, unsigned count,
                                  bool counts) {
    const char *text = "";
    for (unsigned i = 0; i < count; i++)
        text = arena_format(e->arena, "%s%s%s", text,
                            i == 0          ? ""
                            : i + 1 < count ? ", "
                                            : " and ",
                            counts ? count_text(e, &args[i]) : value_text(e, &args[i]));
    return text;
}

enum expr_result wrong_call(const struct evaluation *e, const struct term *term, const struct quantity *args,
                            enum function_result why) {
    const struct grammar_function *f = &grammar_functions[term->symbol];
    const char *of =
        arguments_text(e, args, term->count, why == FUNCTION_DIFFERENT || why == FUNCTION_COUNTS);
    const char *what = arena_format(e->arena, "%s of %s", f->name, of);
    const char *doc = arena_format(e->arena, "%s: %s", f->call, f->doc);
    if (why == FUNCTION_DIFFERENT) return wrong(e, term, "different-counts", what, doc);
    if (why == FUNCTION_COUNTS) return wrong(e, term, "wrong-arguments", what, doc);
    if (why == FUNCTION_OUTSIDE && f->domain)
        return wrong(e, term, "outside-domain", what,
                     arena_format(e->arena, "%s takes %s", f->name, f->domain));
    return wrong(e, term, "not-finite",
                 arena_format(e->arena, "%s is too large: numbers end at 1.8e308", what), NULL);
}
