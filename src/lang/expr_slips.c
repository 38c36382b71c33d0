#include <ctype.h>
#include <string.h>

#include "lang/expr_parts.h"
#include "lang/grammar.h"

bool slip(struct parser *p, size_t offset, size_t length, const char *code, const char *message,
          const char *help) {
    *p->error = (struct expr_error){offset, length, code, message, help};
    return false;
}

static bool bad(struct parser *p, struct token at, const char *message, const char *help) {
    return slip(p, at.offset, at.length, "bad-expression", message, help);
}

static bool is_symbol(struct token token, int symbol) {
    return token.kind == TOKEN_SYMBOL && token.symbol == symbol;
}

static bool begins_value(struct token token) {
    return token.kind == TOKEN_NUMBER || token.kind == TOKEN_NAME || token.kind == TOKEN_COLOR ||
           is_symbol(token, '(');
}

static char *text_of(const struct parser *p, struct token token) {
    return arena_text(p->arena, p->text + token.offset, token.length);
}

const char *text_shown(struct arena *arena, const char *text, uint32_t begin, uint32_t end) {
    enum { MOST = 40 };
    if (end - begin <= MOST) return arena_format(arena, "`%.*s`", (int)(end - begin), text + begin);
    end = begin + MOST;
    while (end > begin && ((unsigned char)text[end] & 0xc0) == 0x80) end--; /* no half of a character */
    return arena_format(arena, "`%.*s...`", (int)(end - begin), text + begin);
}

static const char *token_text(const struct parser *p, struct token token) {
    return text_shown(p->arena, p->text, token.offset, token.offset + token.length);
}

static bool is_word(const struct parser *p, struct token token, const char *word) {
    return token.kind == TOKEN_NAME && token.length == strlen(word) &&
           memcmp(p->text + token.offset, word, token.length) == 0;
}

/* ---- Words of other languages ---- */

static const struct {
    const char *word, *instead;
} words[] = {
    {"and", "write `&&`"},
    {"or", "write `||`"},
    {"not", "write `!`"},
    {"xor", "write `!=`"},
    {"is", "write `==`"},
    {"mod", "write `%`"},
    {"div", "write `/`"},
    {"if", "write `condition ? this : that`"},
    {"range", "a range is written {from: 0, to: 3}"},
    {"then", "write `condition ? this : that`"},
    {"else", "write `condition ? this : that`"},
    {"fract", "write `x % 1`"},
    {"frac", "write `x % 1`"},
    {"saturate", "write `clamp(x, 0, 1)`"},
    {"square", "write `x ^ 2`"},
    {"sqr", "write `x ^ 2`"},
    {"cbrt", "write `x ^ (1/3)`"},
    {"radians", "angles are in degrees: leave it out"},
    {"degrees", "angles are in degrees: leave it out"},
    {"deg2rad", "angles are in degrees: leave it out"},
    {"rad2deg", "angles are in degrees: leave it out"},
    {"vec2", "write `[x, y]`"},
    {"vec3", "write `[x, y, z]`"},
    {"vec4", "write `[x, y, z, w]`"},
};

const char *word_instead(struct arena *arena, const char *word) {
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (spelling_distance(word, words[i].word) == 0) return words[i].instead;
    for (int i = 0; i < grammar_function_count; i++)
        for (const char *const *other = grammar_functions[i].instead; other && *other; other++)
            if (spelling_distance(word, *other) == 0)
                return arena_format(arena, "did you mean `%s`?", grammar_functions[i].call);
    return NULL;
}

int function_find(const char *name, size_t length) {
    for (int i = 0; i < grammar_function_count; i++)
        if (strlen(grammar_functions[i].name) == length &&
            memcmp(grammar_functions[i].name, name, length) == 0)
            return i;
    return -1;
}

bool slip_unknown_function(struct parser *p, struct token name) {
    const char *word = text_of(p, name), *help = word_instead(p->arena, word);
    struct spelling s = spelling_begin(word);
    for (int i = 0; i < grammar_function_count; i++) spelling_offer(&s, grammar_functions[i].name);
    if (!help && s.best) help = arena_format(p->arena, "did you mean `%s`?", s.best);
    if (!help) help = arena_format(p->arena, "to multiply, write `%s * (`", word);
    return slip(p, name.offset, name.length, "unknown-function",
                arena_format(p->arena, "there is no function %s", token_text(p, name)), help);
}

/* ---- Where a value ends ---- */

/* `2x`, `2(x + 1)`, `45deg`. */
static const char *help_after_number(struct parser *p) {
    static const char *const units[] = {"deg", "degrees", "px", "m", "cm", "mm", "s", "rad"};
    const char *number = text_of(p, p->last);
    if (p->token.kind == TOKEN_NUMBER) return NULL;
    for (size_t i = 0; i < sizeof units / sizeof *units; i++)
        if (is_word(p, p->token, units[i]))
            return arena_format(p->arena, "numbers have no unit here: write %s", number);
    return arena_format(p->arena, "to multiply, write `%s * %s`", number, text_of(p, p->token));
}

static const char *help_after_name(struct parser *p) {
    const char *name = text_of(p, p->last), *instead = word_instead(p->arena, name);
    if (function_find(name, strlen(name)) >= 0)
        return arena_format(p->arena, "write `%s(%s)`", name, text_of(p, p->token));
    return instead;
}

/* `0,5`. */
static const char *help_comma(struct parser *p) {
    const char *next = p->text + p->token.offset + 1;
    const bool joined = p->last.kind == TOKEN_NUMBER && p->last.offset + p->last.length == p->token.offset;
    if (joined && isdigit((unsigned char)*next) && !memchr(p->text + p->last.offset, '.', p->last.length))
        return arena_format(p->arena, "the decimal point is a point: write %s.%.*s", text_of(p, p->last),
                            (int)strspn(next, "0123456789"), next);
    return "a vector is written [x, y, z]";
}

static const char *help_after_value(struct parser *p) {
    const struct token t = p->token, last = p->last;
    const char *instead = t.kind == TOKEN_NAME ? word_instead(p->arena, text_of(p, t)) : NULL;
    if (instead) return instead;
    if (is_symbol(t, ',')) return help_comma(p);
    if (is_symbol(t, '<') || is_symbol(t, '>') || is_symbol(t, SYMBOL('<', '=')) ||
        is_symbol(t, SYMBOL('>', '=')) || is_symbol(t, SYMBOL('=', '=')) || is_symbol(t, SYMBOL('!', '=')))
        return "comparisons do not chain: write `a < b && b < c`";
    if (!begins_value(t)) return NULL;
    if (last.kind == TOKEN_NAME) return help_after_name(p);
    if (last.kind == TOKEN_NUMBER) return help_after_number(p);
    return is_symbol(last, ')') || is_symbol(last, ']') ? "to multiply, write `*` between" : NULL;
}

static const char *closer_of(const struct parser *p, struct token opener) {
    return p->text[opener.offset] == '(' ? ")" : "]";
}

bool slip_after_value(struct parser *p, struct token opener) {
    if (p->token.kind == TOKEN_END ||
        (opener.length && (is_symbol(p->token, ')') || is_symbol(p->token, ']'))))
        return bad(p, opener, arena_format(p->arena, "this %s is not closed", token_text(p, opener)),
                   arena_format(p->arena, "add `%s`%s%s", closer_of(p, opener),
                                p->token.length ? " before " : "",
                                p->token.length ? token_text(p, p->token) : ""));
    if (is_symbol(p->token, ')') || is_symbol(p->token, ']'))
        return bad(p, p->token,
                   arena_format(p->arena, "nothing is open that %s could close", token_text(p, p->token)),
                   "leave it out");
    if (is_symbol(p->token, ':'))
        return bad(p, p->token, "`:` without `?`", "write `condition ? this : that`");
    const char *expected =
        opener.length ? arena_format(p->arena, "an operator or `%s`", closer_of(p, opener)) : "an operator";
    return bad(p, p->token,
               arena_format(p->arena, "expected %s, found %s", expected, token_text(p, p->token)),
               help_after_value(p));
}

/* ---- Where a value is missing ---- */

bool slip_no_value(struct parser *p) {
    const struct token t = p->token, last = p->last;
    const char *after = last.length ? arena_format(p->arena, " after %s", token_text(p, last)) : "";
    const char *found = t.length ? arena_format(p->arena, ", found %s", token_text(p, t)) : "";
    const bool dangling = last.kind == TOKEN_SYMBOL && !strchr("([,", p->text[last.offset]);
    if (t.kind == TOKEN_END && last.length == 0) return bad(p, t, "there is no expression", NULL);
    if (t.kind == TOKEN_END || is_symbol(t, ')') || is_symbol(t, ']') || is_symbol(t, ','))
        return bad(p, t, arena_format(p->arena, "expected a value%s%s", after, found),
                   is_symbol(last, '%') ? "there is no percent: 50 % is 0.5"
                   : dangling ? arena_format(p->arena, "leave out the %s, or write a value after it",
                                             token_text(p, last))
                   : is_symbol(last, ',') ? "leave out the `,`"
                                          : NULL);
    return bad(p, t, arena_format(p->arena, "expected a value%s%s", after, found), NULL);
}

bool slip_no_colon(struct parser *p, struct token question) {
    if (p->token.kind == TOKEN_NAME || begins_value(p->token)) return slip_after_value(p, (struct token){0});
    return bad(p, question, "this `?` has no `:`", "write `condition ? this : that`");
}

/* `Math.sin`, `np.pi`: the name alone is there. */
static bool slip_module(struct parser *p, const struct term *of) {
    char *name = text_of(p, p->token);
    bool known = function_find(name, p->token.length) >= 0;
    for (int i = 0; i < grammar_constant_count; i++)
        known |= spelling_distance(name, grammar_constants[i].name) == 0;
    if (!known || of->kind != TERM_NAME) return true;
    for (char *c = name; *c; c++) *c = (char)tolower((unsigned char)*c);
    return slip(p, of->begin, p->token.offset + p->token.length - of->begin, "bad-expression",
                arena_format(p->arena, "functions and constants stand alone: there is no `%s.`", of->name),
                arena_format(p->arena, "write `%s`", name));
}

bool slip_part(struct parser *p, const struct term *of, struct token point) {
    if (p->token.kind == TOKEN_NAME && !slip_module(p, of)) return false;
    if (p->token.kind != TOKEN_NAME)
        return bad(p, point, "expected a part after `.`", "parts are .x .y .z, .r .g .b and [i]");
    return bad(p, p->token, arena_format(p->arena, "there is no part %s", token_text(p, p->token)),
               "parts are .x .y .z, .r .g .b and [i]");
}
