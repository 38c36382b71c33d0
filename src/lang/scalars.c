#include <ctype.h>
#include <locale.h>
#include <stdlib.h>
#include <string.h>

#include "lang/checker.h"
#include "lang/spelling.h"

/* ---- Numbers ---- */

/* number = [+-] digits [. digits] [e [+-] digits], with digits on one side of the point at least.
 * What strtod accepts besides (hexadecimal, inf, nan, spaces) is no number of the language. */
bool scalar_is_number(const char *text) {
    const char *c = text + (*text == '-' || *text == '+');
    const bool whole = isdigit((unsigned char)*c);
    while (isdigit((unsigned char)*c)) c++;
    bool part = false;
    if (*c == '.')
        for (c++; isdigit((unsigned char)*c); c++) part = true;
    if (!whole && !part) return false;
    if (*c == 'e' || *c == 'E') {
        c += c[1] == '-' || c[1] == '+' ? 2 : 1;
        if (!isdigit((unsigned char)*c)) return false;
        while (isdigit((unsigned char)*c)) c++;
    }
    return *c == '\0';
}

static const struct {
    const char *bytes, *name, *plain;
} lookalikes[] = {
    {"\xe2\x88\x92", "a typographic minus (U+2212)", "-"},
    {"\xe2\x80\x93", "a dash (U+2013)", "-"},
    {"\xe2\x80\x94", "a long dash (U+2014)", "-"},
    {"\xc2\xa0", "a non-breaking space (U+00A0)", ""},
    {"\xef\xbc\x8d", "a full-width minus (U+FF0D)", "-"},
    {",", "a comma", "."},
    {"O", "the letter O", "0"},
    {"o", "the letter o", "0"},
    {"l", "the letter l", "1"},
    {"_", "an underscore", ""},
    {"f", "an f", ""},
    {"\xc2\xb0", "a degree sign", ""},
    {" ", "a space", ""},
};

/* `010` is octal to some readers of YAML and ten to others. */
static bool has_leading_zero(const char *text) {
    const char *c = text + (*text == '-' || *text == '+');
    return c[0] == '0' && isdigit((unsigned char)c[1]);
}

/* The text with every occurrence of one lookalike replaced, if that makes it a number. */
static const char *mend_lookalike(struct checker *ck, const char *text, const char **what) {
    for (size_t i = 0; i < sizeof lookalikes / sizeof *lookalikes; i++) {
        const char *from = lookalikes[i].bytes, *hit = strstr(text, from), *rest = text;
        if (!hit) continue;
        char *mended = "";
        for (; hit; rest = hit + strlen(from), hit = strstr(rest, from))
            mended =
                arena_format(ck->arena, "%s%.*s%s", mended, (int)(hit - rest), rest, lookalikes[i].plain);
        mended = arena_format(ck->arena, "%s%s", mended, rest);
        *what = lookalikes[i].name;
        if (scalar_is_number(mended) && !has_leading_zero(mended)) return mended;
    }
    return NULL;
}

/* 0x1F, 0o17, 0b11. */
static bool help_base(struct checker *ck, struct diagnostic *d, const char *text) {
    const int base = text[0] != '0'                     ? 0
                     : text[1] == 'x' || text[1] == 'X' ? 16
                     : text[1] == 'o'                   ? 8
                     : text[1] == 'b'                   ? 2
                                                        : 0;
    char *end;
    const unsigned long value = base ? strtoul(text + 2, &end, base) : 0;
    if (!base || *end || end == text + 2) return false;
    diag_help(ck->diag, d, "numbers are decimal: write %lu", value);
    return true;
}

/* What is no number even without it: `a − 1`. */
static bool help_lookalike(struct checker *ck, struct diagnostic *d, const char *text) {
    for (size_t i = 0; i < sizeof lookalikes / sizeof *lookalikes; i++) {
        if ((unsigned char)lookalikes[i].bytes[0] < 0x80 || !strstr(text, lookalikes[i].bytes)) continue;
        diag_help(ck->diag, d, "it has %s in it: write `%s`", lookalikes[i].name,
                  *lookalikes[i].plain ? lookalikes[i].plain : " ");
        return true;
    }
    return false;
}

/* 45deg, 10px, 5%; `2r` of a variable r. */
static bool help_unit(struct checker *ck, struct diagnostic *d, const char *text) {
    const size_t digits = strspn(text, "+-.0123456789");
    const char *number = arena_text(ck->arena, text, digits), *unit = text + digits;
    if (*unit == ' ') unit++;
    if (!scalar_is_number(number) || !*unit) return false;
    if (strcmp(unit, "%") == 0) {
        diag_help(ck->diag, d, "did you mean %g?", strtod(number, NULL) / 100.0);
        return true;
    }
    for (const char *c = unit; *c; c++)
        if (!isalpha((unsigned char)*c)) return false;
    if (scope_find(ck, unit))
        diag_help(ck->diag, d, "to multiply, write `%s * %s`", number, unit);
    else
        diag_help(ck->diag, d, "numbers have no unit here: did you mean %s?", number);
    return true;
}

static const char *wanted_number(const struct grammar_key *key) {
    return key->type == GRAMMAR_INTEGER || key->type == GRAMMAR_SIZE ? "a whole number" : "a number";
}

struct variables {
    struct arena *arena;
    struct spelling spelling;
    const char *all;
};

static void offer_name(void *to, const char *name) {
    struct variables *v = to;
    spelling_offer(&v->spelling, name);
    if (strlen(v->all) < 80) v->all = arena_format(v->arena, "%s%s%s", v->all, *v->all ? ", " : "", name);
}

void scalar_help_variable(struct checker *ck, struct diagnostic *d, const char *text) {
    struct variables v = {ck->arena, spelling_begin(text), ""};
    const struct expr_scope scope = scope_names(ck);
    scope.names(scope.context, offer_name, &v);
    if (scope_needs_animation(ck, text))
        diag_help(ck->diag, d, "for `frame`, `t` and `time` add `animation: {frames: 24}`");
    else if (v.spelling.best)
        diag_help(ck->diag, d, "did you mean `%s`?", v.spelling.best);
    else if (ck->rehearsing && ck->in_template)
        diag_help(ck->diag, d,
                  "a template sees its own parameters and the file's alone: add `params: {%s: 0}`", text);
    else if (*v.all)
        diag_note(ck->diag, d, "the variables here: %s", v.all);
}

bool scalar_help_expression(struct checker *ck, struct diagnostic *d, const char *text) {
    struct expr_error error = {0};
    if (!strchr(text, ' ') || expr_parse(ck->arena, text, strlen(text), &error) || !error.help) return false;
    diag_help(ck->diag, d, "%s", error.help);
    return true;
}

static void help_scalar(struct checker *ck, struct diagnostic *d, const char *text) {
    const char *what = NULL, *mended = mend_lookalike(ck, text, &what);
    if (mended)
        diag_help(ck->diag, d, "it has %s in it: did you mean %s?", what, mended);
    else if (help_base(ck, d, text) || help_unit(ck, d, text) || help_lookalike(ck, d, text))
        return;
    else if (spelling_distance(text, ".inf") <= 1 || spelling_distance(text, ".nan") <= 1 ||
             spelling_distance(text, "-.inf") <= 1)
        diag_help(ck->diag, d, "a number is finite");
    else if (scope_is_name(text))
        scalar_help_variable(ck, d, text);
    else
        scalar_help_expression(ck, d, text);
}

/* The text that the variable stands for, which is no number; NULL: it is no such variable. */
static const struct node *text_of_variable(struct checker *ck, const struct node *n) {
    const struct binding *b =
        n->kind == NODE_SCALAR && scope_is_name(n->text) ? scope_find(ck, n->text) : NULL;
    const struct node *value = b && b->kind == BINDING_NODE ? node_resolve(b->node) : NULL;
    return value && value->kind == NODE_SCALAR && value->count <= 100 ? value : NULL;
}

static void report_no_number_in(struct checker *ck, const struct grammar_key *key, const struct node *node,
                                const struct node *text) {
    struct diagnostic *d =
        diag_error(ck->diag, node->span, "not-a-number", "`%s`: expected %s, found %s, which is %s",
                   key->name, wanted_number(key), found_text(ck, node), found_text(ck, text));
    help_scalar(ck, d, text->text);
    diag_related(ck->diag, d, text->span, "its value is here");
}

/* `value`: what the node is instead; NULL: it has none. */
static void report_no_number(struct checker *ck, const struct grammar_key *key, const struct node *node,
                             const struct quantity *value) {
    if (only_counted(ck, node->span)) return;
    const struct node *n = node_resolve(node), *text = value ? NULL : text_of_variable(ck, n);
    if (text) {
        report_no_number_in(ck, key, node, text);
        return;
    }
    struct diagnostic *d =
        diag_error(ck->diag, node->span, "not-a-number", "`%s`: expected %s, found %s", key->name,
                   wanted_number(key), value ? found_quantity(ck, node, value) : found_text(ck, node));
    scope_tell_given(ck, d, node);
    if (n->kind == NODE_SEQUENCE && n->count == 3)
        diag_note(ck->diag, d,
                  "one number serves all three axes here; stretch the object by `scale` in its `transform`");
    if (n->kind == NODE_SEQUENCE && n->count == 1) diag_help(ck->diag, d, "remove the brackets");
    if (n->kind == NODE_SCALAR && n->count <= 100 && !value) help_scalar(ck, d, n->text);
    if (n->kind == NODE_MAPPING && !value && ck->animation)
        diag_help(ck->diag, d, "values over time are written {keys: {1: 0, 24: 1}}");
    if (value && value->count == 3 && n->kind == NODE_SCALAR)
        diag_help(ck->diag, d, "take a part of it: .x, .y, .z, .r, .g or .b, or its length(v)");
}

/* A plain decimal: exact where the digits are few enough that their product with a power of ten rounds once
 * (Clinger, "How to read floating point numbers accurately", 1990). False: it is none, or too long. */
static bool short_number(const char *text, double *out) {
    static const double powers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                    1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    uint64_t digits = 0;
    const char *c = text + (*text == '-' || *text == '+'), *begin = c;
    for (; (unsigned)(*c - '0') < 10; c++) digits = 10 * digits + (uint64_t)(*c - '0');
    const ptrdiff_t whole = c - begin;
    if (whole > 1 && *begin == '0') return false;
    if (*c == '.')
        for (c++; (unsigned)(*c - '0') < 10; c++) digits = 10 * digits + (uint64_t)(*c - '0');
    const ptrdiff_t places = c - begin - whole - (c > begin + whole), count = whole + places;
    if (*c || count < 1 || count > 18 || digits >> 53) return false;
    const double value = places ? (double)digits / powers[places] : (double)digits;
    *out = *text == '-' ? -value : value;
    return true;
}

/* strtod takes the decimal point of the program's locale, the language a point. */
static double to_double(struct checker *ck, const char *number) {
    const char *point = localeconv()->decimal_point, *at = strchr(number, '.');
    if (!at || strcmp(point, ".") == 0) return strtod(number, NULL);
    return strtod(arena_format(ck->arena, "%.*s%s%s", (int)(at - number), number, point, at + 1), NULL);
}

bool scalar_number(struct checker *ck, const char *text, double *out) {
    if (short_number(text, out)) return true;
    if (!scalar_is_number(text) || has_leading_zero(text)) return false;
    const double value = to_double(ck, text);
    if (!isfinite(value)) return false;
    *out = value;
    return true;
}

static enum quantity_result report_bad_number(struct checker *ck, const struct grammar_key *key,
                                              const struct node *node) {
    const struct node *n = node_resolve(node);
    if (has_leading_zero(n->text)) {
        struct diagnostic *d =
            diag_error(ck->diag, node->span, "leading-zero", "`%s`: a number with a leading zero, found %s",
                       key->name, found_text(ck, node));
        diag_help(ck->diag, d, "write %.17g; some readers of YAML take a leading zero for base 8",
                  to_double(ck, n->text));
    } else {
        diag_error(ck->diag, node->span, "too-large", "`%s`: too large, numbers end at 1.8e308, found %s",
                   key->name, found_text(ck, node));
    }
    return QUANTITY_WRONG;
}

/* Any finite number. */
static enum quantity_result read_number(struct checker *ck, const struct grammar_key *key,
                                        const struct node *node, double *out) {
    const struct node *n = node_resolve(node);
    struct quantity q;
    if (n->kind == NODE_SCALAR && scalar_number(ck, n->text, out)) return QUANTITY_OK;
    if (n->kind == NODE_SCALAR && scalar_is_number(n->text)) return report_bad_number(ck, key, node);
    const bool truth =
        n->kind == NODE_SCALAR && (strcmp(n->text, "true") == 0 || strcmp(n->text, "false") == 0);
    enum quantity_result result =
        n->kind == NODE_SEQUENCE || truth ? QUANTITY_NONE : scope_quantity(ck, key->name, node, &q);
    if (result == QUANTITY_OK && q.count == 1)
        *out = q.v[0];
    else if (result == QUANTITY_OK || result == QUANTITY_NONE) {
        report_no_number(ck, key, node, result == QUANTITY_OK ? &q : NULL);
        result = QUANTITY_WRONG;
    }
    return result;
}

/* A value that is not known: in a rehearsal anything will do. */
static bool take_default(const struct checker *ck, const struct grammar_key *key, double *out) {
    if (ck->rehearsing) *out = key->value[0];
    return ck->rehearsing;
}

static const char *range_text(struct checker *ck, const struct grammar_key *key) {
    const char *unit = key->unit ? arena_format(ck->arena, " %s", key->unit) : "";
    if (key->has_max && key->max == key->min) return arena_format(ck->arena, "%.15g%s", key->min, unit);
    if (key->has_max && !key->has_min) return arena_format(ck->arena, "%.15g%s or less", key->max, unit);
    if (key->has_max && key->above)
        return arena_format(ck->arena, "over %.15g, up to %.15g%s", key->min, key->max, unit);
    if (key->has_max) return arena_format(ck->arena, "%.15g to %.15g%s", key->min, key->max, unit);
    return arena_format(ck->arena, key->above ? "over %.15g" : "%.15g or more", key->min);
}

static bool report_out_of_range(struct checker *ck, const struct grammar_key *key, const struct node *node,
                                double value, bool high) {
    if (only_counted(ck, node->span)) return false;
    const struct node *n = node_resolve(node);
    const bool written = n->kind == NODE_SCALAR && scalar_is_number(n->text);
    const char *found = written ? found_text(ck, node)
                                : arena_format(ck->arena, "%s, which is %.15g", found_text(ck, node), value);
    struct diagnostic *d = diag_error(ck->diag, node->span, "out-of-range", "`%s`: must be %s, found %s",
                                      key->name, range_text(ck, key), found);
    scope_tell_given(ck, d, node);
    if (high && key->type == GRAMMAR_SIZE)
        diag_help(ck->diag, d, "a square of that side would take %.3g GiB of memory",
                  12.0 * value * value / (1 << 30));
    return false;
}

bool check_in_range(struct checker *ck, const struct grammar_key *key, const struct node *node,
                    double value) {
    const bool low = key->has_min && !(key->above ? value > key->min : value >= key->min);
    const bool high = key->has_max && !(value <= key->max);
    return (!low && !high) || report_out_of_range(ck, key, node, value, high);
}

bool check_number(struct checker *ck, const struct grammar_key *key, const struct node *node, double *out) {
    double value;
    const enum quantity_result result = read_number(ck, key, node, &value);
    if (result == QUANTITY_UNKNOWN) return take_default(ck, key, out);
    if (result != QUANTITY_OK || !check_in_range(ck, key, node, value)) return false;
    *out = value;
    return true;
}

bool check_integer(struct checker *ck, const struct grammar_key *key, const struct node *node, double *out) {
    double value;
    const enum quantity_result result = read_number(ck, key, node, &value);
    if (result == QUANTITY_UNKNOWN) return take_default(ck, key, out);
    if (result != QUANTITY_OK) return false;
    if (value != floor(value)) {
        struct diagnostic *d =
            diag_error(ck->diag, node->span, "not-whole", "`%s`: expected a whole number, found %s",
                       key->name, found_text(ck, node));
        scope_tell_given(ck, d, node);
        return false;
    }
    if (!check_in_range(ck, key, node, value)) return false;
    *out = value;
    return true;
}

/* ---- Words ---- */

bool scalar_help_truth(struct checker *ck, struct diagnostic *d, const char *word) {
    static const char *const words[][2] = {
        {"yes", "true"},  {"on", "true"}, {"y", "true"},  {"1", "true"},    {"no", "false"},
        {"off", "false"}, {"n", "false"}, {"0", "false"}, {"true", "true"}, {"false", "false"}};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        if (spelling_distance(word, words[i][0]) != 0) continue;
        diag_help(ck->diag, d, "write `%s`", words[i][1]);
        return true;
    }
    return false;
}

/* 0 and 1 are no booleans as they stand: they were meant to be words. */
static bool is_written_number(const struct node *n) {
    return n->kind == NODE_SCALAR && scalar_is_number(n->text);
}

bool check_boolean(struct checker *ck, const struct grammar_key *key, const struct node *node, int *out) {
    const struct node *n = node_resolve(node);
    if (n->kind == NODE_SCALAR && (strcmp(n->text, "true") == 0 || strcmp(n->text, "false") == 0)) {
        *out = n->text[0] == 't';
        return true;
    }
    struct quantity q;
    const enum quantity_result result =
        is_written_number(n) ? QUANTITY_NONE : scope_quantity(ck, key->name, node, &q);
    if (result == QUANTITY_UNKNOWN) *out = 0;
    if (result == QUANTITY_UNKNOWN || result == QUANTITY_WRONG)
        return result == QUANTITY_UNKNOWN && ck->rehearsing;
    if (result == QUANTITY_OK && q.count == 1) {
        *out = q.v[0] != 0.0;
        return true;
    }
    struct diagnostic *d =
        diag_error(ck->diag, node->span, "not-a-boolean", "`%s`: expected true or false, found %s", key->name,
                   found_text(ck, node));
    if (n->kind == NODE_SCALAR) scalar_help_truth(ck, d, n->text);
    return false;
}

static int find_choice(const struct grammar_key *key, const char *word) {
    for (int i = 0; key->choices[i]; i++)
        if (strcmp(word, key->choices[i]) == 0) return i;
    return -1;
}

static void report_no_choice(struct checker *ck, const struct grammar_key *key, const struct node *node) {
    if (only_counted(ck, node->span)) return;
    const struct node *n = node_resolve(node);
    struct spelling s = spelling_begin(n->kind == NODE_SCALAR ? n->text : "");
    const char *all = "";
    for (int i = 0; key->choices[i]; i++) {
        spelling_offer(&s, key->choices[i]);
        all = arena_format(ck->arena, "%s%s%s", all,
                           i == 0                ? ""
                           : key->choices[i + 1] ? ", "
                                                 : " or ",
                           key->choices[i]);
    }
    struct diagnostic *d = diag_error(ck->diag, node->span, "not-a-choice", "`%s`: expected %s, found %s",
                                      key->name, all, found_text(ck, node));
    if (s.best) diag_help(ck->diag, d, "did you mean `%s`?", s.best);
}

bool check_choice(struct checker *ck, const struct grammar_key *key, const struct node *node, int *out) {
    const struct node *n = node_resolve(node);
    const int index = n->kind == NODE_SCALAR ? find_choice(key, n->text) : -1;
    if (index >= 0)
        *out = index;
    else
        report_no_choice(ck, key, node);
    return index >= 0;
}

bool check_text(struct checker *ck, const struct grammar_key *key, const struct node *node,
                const char **out) {
    const struct node *n = node_resolve(node);
    if (n->kind != NODE_SCALAR || n->count == 0) {
        diag_error(ck->diag, node->span, "not-a-text", "`%s`: expected a text, found %s", key->name,
                   found_text(ck, node));
        return false;
    }
    *out = n->text;
    return true;
}
