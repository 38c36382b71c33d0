#include "lang/expr.h"

#include <ctype.h>
#include <locale.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lang/checker.h"
#include "lang/expr_parts.h"
#include "lang/functions.h"

enum { EXPR_SIZE_MAX = 4096, EXPR_DEPTH_MAX = 100 };

typedef const struct term *(*parse_function)(struct parser *p);

static const struct term *parse_choice(struct parser *p);
static const struct term *parse_unary(struct parser *p);

static bool at_symbol(const struct parser *p, int symbol) {
    return p->token.kind == TOKEN_SYMBOL && p->token.symbol == symbol;
}

static struct term *make(struct parser *p, enum term_kind kind, uint32_t begin, struct token at) {
    struct term *term = arena_alloc(p->arena, sizeof *term);
    *term = (struct term){.kind = kind,
                          .symbol = at.symbol,
                          .begin = begin,
                          .end = p->last.offset + p->last.length,
                          .offset = at.offset,
                          .length = at.length};
    return term;
}

static const struct term *with_parts(struct parser *p, struct term *term, unsigned count,
                                     const struct term *const *parts) {
    term->count = count;
    term->parts = arena_array(p->arena, count, sizeof *parts);
    memcpy(term->parts, parts, count * sizeof *parts);
    return term;
}

static const struct term *make_value(struct parser *p, struct token at, struct quantity value) {
    struct term *term = make(p, TERM_VALUE, at.offset, at);
    term->value = value;
    return term;
}

/* Parses what is one level deeper. */
static const struct term *parse_deeper(struct parser *p, parse_function parse) {
    if (p->depth == EXPR_DEPTH_MAX) {
        slip(p, p->token.offset, p->token.length, "expression-too-deep",
             "an expression may nest 100 levels deep", "give a part of it a name of its own");
        return NULL;
    }
    p->depth++;
    const struct term *term = parse(p);
    p->depth--;
    return term;
}

/* Goes on behind the closing bracket of `opener`. */
static bool close(struct parser *p, struct token opener, int closer) {
    if (!at_symbol(p, closer)) return slip_after_value(p, opener);
    return lexer_next(p);
}

/* ---- Primaries ---- */

/* strtod takes the decimal point of the program's locale, the language a point. */
static double number_value(struct parser *p, struct token token) {
    const char *point = localeconv()->decimal_point,
               *text = arena_text(p->arena, p->text + token.offset, token.length);
    const char *at = strchr(text, '.');
    if (at) text = arena_format(p->arena, "%.*s%s%s", (int)(at - text), text, point, at + 1);
    return strtod(text, NULL);
}

static const struct term *parse_number(struct parser *p) {
    const struct token token = p->token;
    const double value = number_value(p, token);
    if (!isfinite(value)) {
        slip(p, token.offset, token.length, "too-large", "too large: numbers end at 1.8e308", NULL);
        return NULL;
    }
    return lexer_next(p) ? make_value(p, token, (struct quantity){1, {value}}) : NULL;
}

static const struct term *parse_color(struct parser *p) {
    const struct token token = p->token;
    vec3 color;
    if (!color_parse(arena_text(p->arena, p->text + token.offset, token.length), &color)) {
        slip(p, token.offset, token.length, "bad-expression",
             "a colour in hexadecimal has 3 or 6 digits 0-9 a-f", NULL);
        return NULL;
    }
    return lexer_next(p) ? make_value(p, token, (struct quantity){3, {color.x, color.y, color.z}}) : NULL;
}

/* choice {"," choice}, and the closing bracket. False: told. */
static bool parse_list(struct parser *p, struct token opener, int closer, const struct term **parts,
                       unsigned *count) {
    *count = 0;
    while (*count < FUNCTION_ARGUMENTS) {
        if (!(parts[(*count)++] = parse_deeper(p, parse_choice))) return false;
        if (!at_symbol(p, ',')) return close(p, opener, closer);
        if (!lexer_next(p)) return false;
    }
    return slip(p, p->token.offset, p->token.length, "wrong-arguments", "32 values are the most", NULL);
}

static bool wrong_arguments(struct parser *p, struct token name, const struct grammar_function *f,
                            unsigned count) {
    const char *many = f->least == f->most ? "" : count < f->least ? "at least " : "at most ";
    const unsigned wanted = count < f->least ? f->least : f->most;
    return slip(p, name.offset, name.length, "wrong-arguments",
                arena_format(p->arena, "`%s` takes %s%u argument%s, found %u", f->name, many, wanted,
                             wanted == 1 ? "" : "s", count),
                arena_format(p->arena, "%s: %s", f->call, f->doc));
}

/* name "(" [choice {"," choice}] ")" */
static const struct term *parse_call(struct parser *p, struct token name) {
    const struct token opener = p->token;
    const struct term *parts[FUNCTION_ARGUMENTS];
    unsigned count = 0;
    const int function = function_find(p->text + name.offset, name.length);
    if (function < 0) slip_unknown_function(p, name);
    if (function < 0 || !lexer_next(p)) return NULL;
    if (at_symbol(p, ')') ? !lexer_next(p) : !parse_list(p, opener, ')', parts, &count)) return NULL;
    const struct grammar_function *f = &grammar_functions[function];
    if (count < f->least || count > f->most) {
        wrong_arguments(p, name, f, count);
        return NULL;
    }
    struct term *term = make(p, TERM_CALL, name.offset, name);
    term->symbol = function;
    return with_parts(p, term, count, parts);
}

/* The constant or colour of that name; count 0: there is none. */
static struct quantity named_value(const char *name) {
    for (int i = 0; i < grammar_constant_count; i++)
        if (strcmp(name, grammar_constants[i].name) == 0)
            return (struct quantity){1, {grammar_constants[i].value}};
    vec3 color;
    return color_parse(name, &color) ? (struct quantity){3, {color.x, color.y, color.z}}
                                     : (struct quantity){0};
}

/* name | name "(" [choice {"," choice}] ")" */
static const struct term *parse_name(struct parser *p) {
    const struct token name = p->token;
    if (!lexer_next(p)) return NULL;
    if (at_symbol(p, '(')) return parse_call(p, name);
    struct term *term = make(p, TERM_NAME, name.offset, name);
    term->name = arena_text(p->arena, p->text + name.offset, name.length);
    term->value = named_value(term->name);
    return term;
}

/* "[" choice {"," choice} "]" */
static const struct term *parse_vector(struct parser *p) {
    const struct token opener = p->token;
    const struct term *parts[FUNCTION_ARGUMENTS];
    unsigned count;
    if (!lexer_next(p) || !parse_list(p, opener, ']', parts, &count)) return NULL;
    if (count < 2 || count > 4) {
        slip(p, opener.offset, p->last.offset + 1 - opener.offset, "bad-expression",
             arena_format(p->arena, "a vector has 2 to 4 numbers, found %u", count),
             count == 1 ? "remove the brackets" : NULL);
        return NULL;
    }
    return with_parts(p, make(p, TERM_VECTOR, opener.offset, opener), count, parts);
}

/* "(" choice ")" */
static const struct term *parse_parentheses(struct parser *p) {
    const struct token opener = p->token;
    if (!lexer_next(p)) return NULL;
    const struct term *inner = parse_deeper(p, parse_choice);
    return inner && close(p, opener, ')') ? inner : NULL;
}

/* primary = number | color | name | name "(" ... ")" | "[" ... "]" | "(" choice ")" */
static const struct term *parse_primary(struct parser *p) {
    if (p->token.kind == TOKEN_NUMBER) return parse_number(p);
    if (p->token.kind == TOKEN_COLOR) return parse_color(p);
    if (p->token.kind == TOKEN_NAME) return parse_name(p);
    if (at_symbol(p, '[')) return parse_vector(p);
    if (at_symbol(p, '(')) return parse_parentheses(p);
    slip_no_value(p);
    return NULL;
}

/* ---- Operators ---- */

/* "." ("x" | "y" | "z" | "r" | "g" | "b"), at the point. NULL: told. */
static const struct term *parse_letter(struct parser *p, const struct term *of) {
    const struct token point = p->token;
    if (!lexer_next(p)) return NULL;
    static const char letters[] = "xyzrgb";
    const char c = p->text[p->token.offset], *letter = c ? strchr(letters, c) : NULL;
    if (p->token.kind != TOKEN_NAME || p->token.length != 1 || !letter) {
        slip_part(p, of, point);
        return NULL;
    }
    const struct token name = p->token;
    return lexer_next(p) ? make_value(p, name, (struct quantity){1, {(double)((letter - letters) % 3)}})
                         : NULL;
}

/* "[" choice "]" */
static const struct term *parse_index(struct parser *p) {
    const struct token opener = p->token;
    if (!lexer_next(p)) return NULL;
    const struct term *index = parse_deeper(p, parse_choice);
    return index && close(p, opener, ']') ? index : NULL;
}

/* postfix = primary {"." ("x" | "y" | "z" | "r" | "g" | "b") | "[" choice "]"} */
static const struct term *parse_postfix(struct parser *p) {
    const uint32_t begin = p->token.offset;
    const struct term *term = parse_primary(p);
    while (term && (at_symbol(p, '.') || at_symbol(p, '['))) {
        const struct token at = p->token;
        const struct term *parts[] = {term, at.symbol == '.' ? parse_letter(p, term) : parse_index(p)};
        if (!parts[1]) return NULL;
        struct token all = at;
        all.length = p->last.offset + p->last.length - at.offset;
        term = with_parts(p, make(p, TERM_PART, begin, all), 2, parts);
    }
    return term;
}

/* Goes on behind an operator, whose right side `parse` parses. */
static const struct term *parse_right(struct parser *p, uint32_t begin, const struct term *left,
                                      parse_function parse) {
    const struct token at = p->token;
    const struct term *parts[] = {left, NULL};
    if (!lexer_next(p) || !(parts[1] = parse(p))) return NULL;
    return with_parts(p, make(p, TERM_BINARY, begin, at), 2, parts);
}

static const struct term *parse_deeper_unary(struct parser *p) { return parse_deeper(p, parse_unary); }

/* power = postfix ["^" unary] */
static const struct term *parse_power(struct parser *p) {
    const uint32_t begin = p->token.offset;
    const struct term *left = parse_postfix(p);
    return left && at_symbol(p, '^') ? parse_right(p, begin, left, parse_deeper_unary) : left;
}

/* unary = ("-" | "+" | "!") unary | power */
static const struct term *parse_unary(struct parser *p) {
    if (!at_symbol(p, '-') && !at_symbol(p, '+') && !at_symbol(p, '!')) return parse_power(p);
    const struct token at = p->token;
    if (!lexer_next(p)) return NULL;
    const struct term *operand = parse_deeper(p, parse_unary);
    return operand ? with_parts(p, make(p, TERM_UNARY, at.offset, at), 1, &operand) : NULL;
}

/* lower {operator lower}, or lower [operator lower] if not `many`. The operators end with 0. */
static const struct term *parse_row(struct parser *p, parse_function lower, const int *operators, bool many) {
    const uint32_t begin = p->token.offset;
    const struct term *term = lower(p);
    for (bool again = true; term && again;) {
        const int *o = operators;
        while (*o && !at_symbol(p, *o)) o++;
        if (!*o) break;
        term = parse_right(p, begin, term, lower);
        again = many;
    }
    return term;
}

/* product = unary {("*" | "/" | "%") unary} */
static const struct term *parse_product(struct parser *p) {
    return parse_row(p, parse_unary, (const int[]){'*', '/', '%', 0}, true);
}

/* sum = product {("+" | "-") product} */
static const struct term *parse_sum(struct parser *p) {
    return parse_row(p, parse_product, (const int[]){'+', '-', 0}, true);
}

/* order = sum [("<" | "<=" | ">" | ">=") sum] */
static const struct term *parse_order(struct parser *p) {
    return parse_row(p, parse_sum, (const int[]){'<', SYMBOL('<', '='), '>', SYMBOL('>', '='), 0}, false);
}

/* equal = order [("==" | "!=") order] */
static const struct term *parse_equal(struct parser *p) {
    return parse_row(p, parse_order, (const int[]){SYMBOL('=', '='), SYMBOL('!', '='), 0}, false);
}

/* and = equal {"&&" equal} */
static const struct term *parse_and(struct parser *p) {
    return parse_row(p, parse_equal, (const int[]){SYMBOL('&', '&'), 0}, true);
}

/* or = and {"||" and} */
static const struct term *parse_or(struct parser *p) {
    return parse_row(p, parse_and, (const int[]){SYMBOL('|', '|'), 0}, true);
}

/* choice = or ["?" choice ":" choice] */
static const struct term *parse_choice(struct parser *p) {
    const uint32_t begin = p->token.offset;
    const struct term *parts[3] = {parse_or(p)};
    if (!parts[0] || !at_symbol(p, '?')) return parts[0];
    const struct token at = p->token;
    if (!lexer_next(p) || !(parts[1] = parse_deeper(p, parse_choice))) return NULL;
    if (!at_symbol(p, ':')) {
        slip_no_colon(p, at);
        return NULL;
    }
    if (!lexer_next(p) || !(parts[2] = parse_deeper(p, parse_choice))) return NULL;
    return with_parts(p, make(p, TERM_CHOICE, begin, at), 3, parts);
}

/* ---- Expressions ---- */

struct expr *expr_parse(struct arena *arena, const char *text, size_t size, struct expr_error *error) {
    if (size > EXPR_SIZE_MAX) {
        *error = (struct expr_error){0, size, "expression-too-long", "an expression may have 4096 bytes",
                                     "give a part of it a name of its own"};
        return NULL;
    }
    struct parser p = {
        .arena = arena, .text = arena_text(arena, text, size), .size = (uint32_t)size, .error = error};
    const struct term *root = lexer_next(&p) ? parse_choice(&p) : NULL;
    if (!root || (p.token.kind != TOKEN_END && !slip_after_value(&p, (struct token){0}))) return NULL;
    struct expr *expr = arena_alloc(arena, sizeof *expr);
    *expr = (struct expr){p.text, root};
    return expr;
}

const char *expr_name(const struct expr *expr) {
    return expr->root->kind == TERM_NAME ? expr->root->name : NULL;
}
