#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "lang/expr_parts.h"

/* What stands for no operator of the language, longer ones first. */
static const struct {
    const char *found, *name, *meant;
} slips[] = {
    {"===", NULL, "=="},
    {"!==", NULL, "!="},
    {"**", NULL, "^"},
    {"<>", NULL, "!="},
    {"=<", NULL, "<="},
    {"=>", NULL, ">="},
    {":=", NULL, "=="},
    {"\xe2\x88\x92", "a typographic minus (U+2212)", "-"},
    {"\xe2\x80\x93", "a dash (U+2013)", "-"},
    {"\xe2\x80\x94", "a long dash (U+2014)", "-"},
    {"\xef\xbc\x8d", "a full-width minus (U+FF0D)", "-"},
    {"\xc3\x97", "a multiplication sign (U+00D7)", "*"},
    {"\xc2\xb7", "a middle dot (U+00B7)", "*"},
    {"\xe2\x8b\x85", "a middle dot (U+22C5)", "*"},
    {"\xc3\xb7", "a division sign (U+00F7)", "/"},
    {"\xe2\x89\xa4", "a sign (U+2264)", "<="},
    {"\xe2\x89\xa5", "a sign (U+2265)", ">="},
    {"\xe2\x89\xa0", "a sign (U+2260)", "!="},
    {"\xcf\x80", "a Greek letter", "pi"},
    {"\xcf\x84", "a Greek letter", "tau"},
    {"\xe2\x88\x9a", "a root (U+221A)", "sqrt(x)"},
    {"\xc2\xb2", "a raised 2", "^2"},
    {"\xc2\xb3", "a raised 3", "^3"},
};

static const struct {
    const char *found, *message, *help;
} strangers[] = {
    {"//", "`//` is no operator", "a quotient without its broken part is floor(a / b)"},
    {"=", "`=` is no operator", "did you mean `==`?"},
    {"&", "`&` is no operator", "did you mean `&&`?"},
    {"|", "`|` is no operator", "did you mean `||`?"},
    {"$", "`$` has no meaning here", "write the name alone"},
    {"@", "`@` has no meaning here", "write the name alone"},
    {"{", "`{` has no meaning here", "write the name alone; a vector is [x, y, z]"},
    {"}", "`}` has no meaning here", NULL},
    {"\"", "a quote has no meaning here", "numbers, names and colours stand without quotes"},
    {"'", "a quote has no meaning here", "numbers, names and colours stand without quotes"},
    {"\xc2\xb0", "a degree sign has no meaning here", "angles are in degrees anyway: leave it out"},
    {"\xc2\xa0", "a non-breaking space (U+00A0) is no space", "write a plain space"},
};

static bool starts(const char *text, const char *with) { return strncmp(text, with, strlen(with)) == 0; }

static bool is_stranger(const char *c) {
    for (size_t i = 0; i < sizeof slips / sizeof *slips; i++)
        if (starts(c, slips[i].found)) return true;
    for (size_t i = 0; i < sizeof strangers / sizeof *strangers; i++)
        if (starts(c, strangers[i].found)) return true;
    return false;
}

static bool begins_name(const char *c) {
    return isalpha((unsigned char)*c) || *c == '_' || ((unsigned char)*c >= 0x80 && !is_stranger(c));
}

static bool is_digit(char c) { return c >= '0' && c <= '9'; }

static bool take(struct parser *p, enum token_kind kind, int symbol, const char *end) {
    const uint32_t offset = p->token.offset;
    p->token = (struct token){kind, symbol, offset, (uint32_t)(end - p->text) - offset};
    return true;
}

/* 0x1F, 0o17, 0b11; 010, which is 8 to some readers and 10 to others; 1_000. */
static bool slip_number(struct parser *p, const char *start, const char *end) {
    const int base = start[0] != '0'                      ? 0
                     : start[1] == 'x' || start[1] == 'X' ? 16
                     : start[1] == 'o'                    ? 8
                     : start[1] == 'b'                    ? 2
                                                          : 0;
    if (base) {
        char *last;
        const unsigned long long value = strtoull(start + 2, &last, base);
        const char *help = last > start + 2 ? arena_format(p->arena, "write %llu", value) : NULL;
        return slip(p, p->token.offset, (size_t)(last - start), "bad-expression", "numbers are decimal",
                    help);
    }
    if (start[0] == '0' && is_digit(start[1])) {
        while (start + 1 < end && *start == '0' && is_digit(start[1])) start++;
        return slip(p, p->token.offset, (size_t)(end - p->text) - p->token.offset, "leading-zero",
                    "a number with a leading zero",
                    arena_format(p->arena, "write %.*s; some readers take a leading zero for base 8",
                                 (int)(end - start), start));
    }
    char *plain = arena_text(p->arena, start, strspn(start, "0123456789_")), *to = plain;
    const size_t length = strlen(plain);
    for (const char *from = plain; *from; from++)
        if (*from != '_') *to++ = *from;
    *to = '\0';
    return slip(p, p->token.offset, length, "bad-expression", "a number has no underscores",
                arena_format(p->arena, "write %s", plain));
}

/* number = digits ["." digits] ["e" ["+" | "-"] digits], with digits on one side of the point at least. */
static bool lex_number(struct parser *p, const char *start) {
    const char *c = start;
    while (is_digit(*c)) c++;
    const char *whole_end = c;
    if (*c == '.')
        for (c++; is_digit(*c);) c++;
    const char *exponent = c + 1 + (c[0] && (c[1] == '+' || c[1] == '-'));
    if ((*c == 'e' || *c == 'E') && is_digit(*exponent))
        for (c = exponent; is_digit(*c);) c++;
    const bool leading_zero =
        start[0] == '0' && (is_digit(start[1]) || (start[1] && strchr("xXob", start[1])));
    if (leading_zero || (*whole_end == '_' && is_digit(whole_end[1]))) return slip_number(p, start, c);
    return take(p, TOKEN_NUMBER, 0, c);
}

static bool lex_name(struct parser *p, const char *start) {
    const char *c = start;
    while (begins_name(c) || is_digit(*c)) c++;
    return take(p, TOKEN_NAME, 0, c);
}

static bool lex_color(struct parser *p, const char *start) {
    const char *c = start + 1;
    while (isalnum((unsigned char)*c)) c++;
    return take(p, TOKEN_COLOR, 0, c);
}

static bool lex_symbol(struct parser *p, const char *start) {
    static const char *const pairs[] = {"&&", "||", "==", "!=", "<=", ">="};
    for (size_t i = 0; i < sizeof slips / sizeof *slips; i++)
        if (starts(start, slips[i].found))
            return slip(p, p->token.offset, strlen(slips[i].found), "bad-expression",
                        arena_format(p->arena, "%s%s%s", slips[i].name ? slips[i].name : "`",
                                     slips[i].name ? "" : slips[i].found,
                                     slips[i].name ? " is no sign of the language" : "` is no operator"),
                        arena_format(p->arena, "write `%s`", slips[i].meant));
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++)
        if (starts(start, pairs[i])) return take(p, TOKEN_SYMBOL, SYMBOL(start[0], start[1]), start + 2);
    for (size_t i = 0; i < sizeof strangers / sizeof *strangers; i++)
        if (starts(start, strangers[i].found))
            return slip(p, p->token.offset, strlen(strangers[i].found), "bad-expression",
                        strangers[i].message, strangers[i].help);
    if (*start && strchr("+-*/%^!<>?:,.()[]", *start)) return take(p, TOKEN_SYMBOL, *start, start + 1);
    return slip(p, p->token.offset, 1, "bad-expression",
                arena_format(p->arena, "`%c` has no meaning here", *start), NULL);
}

bool lexer_next(struct parser *p) {
    p->last = p->token;
    const char *c = p->text + p->token.offset + p->token.length, *end = p->text + p->size;
    while (c < end && (*c == ' ' || *c == '\t' || *c == '\r' || *c == '\n')) c++;
    p->token = (struct token){TOKEN_END, 0, (uint32_t)(c - p->text), 0};
    if (c == end) {
        p->token.offset = p->size;
        return true;
    }
    if (is_digit(*c) || (*c == '.' && is_digit(c[1]))) return lex_number(p, c);
    if (begins_name(c)) return lex_name(p, c);
    if (*c == '#') return lex_color(p, c);
    return lex_symbol(p, c);
}
