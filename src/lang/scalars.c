#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "lang/checker.h"
#include "lang/spelling.h"

/* ---- Numbers ---- */

/* number = [+-] digits [. digits] [e [+-] digits], with digits on one side of the point at least.
 * What strtod accepts besides (hexadecimal, inf, nan, spaces) is no number of the language. */
static bool is_number(const char *text) {
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

/* `010` is octal to some readers of YAML and ten to others. */
static bool has_leading_zero(const char *text) {
    const char *c = text + (*text == '-' || *text == '+');
    return c[0] == '0' && isdigit((unsigned char)c[1]);
}

static const struct {
    const char *bytes, *name, *plain;
} lookalikes[] = {
    {"\xe2\x88\x92", "a typographic minus (U+2212)", "-"}, {"\xe2\x80\x93", "a dash (U+2013)", "-"},
    {"\xe2\x80\x94", "a long dash (U+2014)", "-"},         {"\xc2\xa0", "a non-breaking space (U+00A0)", ""},
    {"\xef\xbc\x8d", "a full-width minus (U+FF0D)", "-"},  {",", "a comma", "."},
    {"O", "the letter O", "0"},                            {"o", "the letter o", "0"},
    {"l", "the letter l", "1"},                            {"_", "an underscore", ""},
    {"f", "an f", ""},                                     {"deg", "a unit", ""},
    {"\xc2\xb0", "a degree sign", ""},                     {"px", "a unit", ""},
    {" ", "a space", ""},
};

/* The text with every occurrence of one lookalike replaced, if that makes it a number. */
static const char *mend_number(struct checker *ck, const char *text, const char **what) {
    for (size_t i = 0; i < sizeof lookalikes / sizeof *lookalikes; i++) {
        const char *from = lookalikes[i].bytes, *hit = strstr(text, from), *rest = text;
        if (!hit) continue;
        char *mended = "";
        for (; hit; rest = hit + strlen(from), hit = strstr(rest, from))
            mended = arena_format(ck->arena, "%s%.*s%s", mended, (int)(hit - rest), rest, lookalikes[i].plain);
        mended = arena_format(ck->arena, "%s%s", mended, rest);
        *what = lookalikes[i].name;
        if (is_number(mended)) return mended;
    }
    return NULL;
}

static const char *wanted_number(const struct grammar_key *key) {
    return key->type == GRAMMAR_INTEGER || key->type == GRAMMAR_SIZE ? "a whole number" : "a number";
}

static void report_no_number(struct checker *ck, const struct grammar_key *key, const struct node *node) {
    struct diagnostic *d = diag_error(ck->diag, node->span, "`%s`: expected %s, found %s", key->name,
                                      wanted_number(key), check_found(ck, node));
    const struct node *n = node_resolve(node);
    if (n->kind == NODE_SEQUENCE && n->count == 3)
        diag_note(ck->diag, d, "one number serves all three axes here; stretch the object by `scale` in its `transform`");
    if (n->kind != NODE_SCALAR || n->count > 100) return;
    const char *what = NULL, *mended = mend_number(ck, n->text, &what);
    if (mended) diag_help(ck->diag, d, "it has %s in it: did you mean %s?", what, mended);
    else if (strspn(n->text, "+-*/() .0123456789") < n->count) return;
    else diag_help(ck->diag, d, "expressions are not there yet: write the number itself");
}

/* Any finite number. */
static bool parse_number(struct checker *ck, const struct grammar_key *key, const struct node *node, double *out) {
    const struct node *n = node_resolve(node);
    if (!check_count(ck, node)) return false;
    if (n->kind != NODE_SCALAR || !is_number(n->text)) {
        report_no_number(ck, key, node);
        return false;
    }
    const double value = strtod(n->text, NULL);
    if (has_leading_zero(n->text)) {
        struct diagnostic *d = diag_error(ck->diag, node->span, "`%s`: a number with a leading zero, `%s`", key->name, n->text);
        diag_help(ck->diag, d, "write %.17g", value);
        return false;
    }
    if (!isfinite(value)) {
        diag_error(ck->diag, node->span, "`%s`: %s is too large: a double ends at 1.8e308", key->name, n->text);
        return false;
    }
    *out = value;
    return true;
}

static const char *range_text(struct checker *ck, const struct grammar_key *key) {
    const char *unit = key->unit ? arena_format(ck->arena, " %s", key->unit) : "";
    if (key->has_max && key->above) return arena_format(ck->arena, "over %g, up to %g%s", key->min, key->max, unit);
    if (key->has_max) return arena_format(ck->arena, "%g to %g%s", key->min, key->max, unit);
    return arena_format(ck->arena, key->above ? "over %g" : "%g or more", key->min);
}

static bool in_range(struct checker *ck, const struct grammar_key *key, const struct node *node, double value) {
    const bool low = key->has_min && !(key->above ? value > key->min : value >= key->min);
    const bool high = key->has_max && !(value <= key->max);
    if (!low && !high) return true;
    diag_error(ck->diag, node->span, "`%s`: must be %s, found %s", key->name, range_text(ck, key),
               node_resolve(node)->text);
    return false;
}

bool check_number(struct checker *ck, const struct grammar_key *key, const struct node *node, double *out) {
    double value;
    if (!parse_number(ck, key, node, &value) || !in_range(ck, key, node, value)) return false;
    *out = value;
    return true;
}

bool check_integer(struct checker *ck, const struct grammar_key *key, const struct node *node, double *out) {
    double value;
    if (!parse_number(ck, key, node, &value)) return false;
    if (value != floor(value)) {
        diag_error(ck->diag, node->span, "`%s`: expected a whole number, found %s", key->name, node_resolve(node)->text);
        return false;
    }
    if (!in_range(ck, key, node, value)) return false;
    *out = value;
    return true;
}

/* ---- Words ---- */

bool check_boolean(struct checker *ck, const struct grammar_key *key, const struct node *node, int *out) {
    const struct node *n = node_resolve(node);
    if (!check_count(ck, node)) return false;
    if (n->kind == NODE_SCALAR && (strcmp(n->text, "true") == 0 || strcmp(n->text, "false") == 0)) {
        *out = n->text[0] == 't';
        return true;
    }
    struct diagnostic *d = diag_error(ck->diag, node->span, "`%s`: expected true or false, found %s", key->name, check_found(ck, node));
    static const char *const words[][2] = {{"yes", "true"}, {"on", "true"},   {"y", "true"},    {"1", "true"},
                                           {"no", "false"}, {"off", "false"}, {"n", "false"},   {"0", "false"},
                                           {"true", "true"}, {"false", "false"}};
    for (size_t i = 0; n->kind == NODE_SCALAR && i < sizeof words / sizeof *words; i++)
        if (spelling_distance(n->text, words[i][0]) == 0) diag_help(ck->diag, d, "write `%s`", words[i][1]);
    return false;
}

bool check_choice(struct checker *ck, const struct grammar_key *key, const struct node *node, int *out) {
    const struct node *n = node_resolve(node);
    if (!check_count(ck, node)) return false;
    struct spelling s = spelling_begin(n->kind == NODE_SCALAR ? n->text : "");
    const char *all = "";
    for (int i = 0; key->choices[i]; i++) {
        if (n->kind == NODE_SCALAR && strcmp(n->text, key->choices[i]) == 0) {
            *out = i;
            return true;
        }
        spelling_offer(&s, key->choices[i]);
        all = arena_format(ck->arena, "%s%s%s", all, i == 0 ? "" : key->choices[i + 1] ? ", " : " or ", key->choices[i]);
    }
    struct diagnostic *d = diag_error(ck->diag, node->span, "`%s`: expected %s, found %s", key->name, all, check_found(ck, node));
    if (s.best) diag_help(ck->diag, d, "did you mean `%s`?", s.best);
    return false;
}

bool check_text(struct checker *ck, const struct grammar_key *key, const struct node *node, const char **out) {
    const struct node *n = node_resolve(node);
    if (!check_count(ck, node)) return false;
    if (n->kind != NODE_SCALAR || n->count == 0) {
        diag_error(ck->diag, node->span, "`%s`: expected a text, found %s", key->name, check_found(ck, node));
        return false;
    }
    *out = n->text;
    return true;
}

/* ---- Rows of numbers ---- */

/* Exactly `count` numbers of a list, checked one by one with `check`. */
static bool check_row(struct checker *ck, const struct grammar_key *key, const struct node *node, const char *form, int count,
                      bool check(struct checker *, const struct grammar_key *, const struct node *, double *), double *out) {
    const struct node *n = node_resolve(node);
    if (!check_count(ck, node)) return false;
    if (n->kind != NODE_SEQUENCE) {
        diag_error(ck->diag, node->span, "`%s`: expected %s, found %s", key->name, form, check_found(ck, node));
        return false;
    }
    if ((int)n->count != count) {
        struct diagnostic *d = diag_error(ck->diag, node->span, "`%s`: expected %s, found %u number%s", key->name, form,
                                          (unsigned)n->count, n->count == 1 ? "" : "s");
        if (count == 3 && n->count == 2) diag_help(ck->diag, d, "the third number, z, is missing");
        if (count == 3 && n->count == 1) diag_help(ck->diag, d, "the second and third numbers, y and z, are missing");
        return false;
    }
    bool ok = true;
    int i = 0;
    for (const struct node *item = n->first; item; item = item->next, i++) ok &= check(ck, key, item, &out[i]);
    return ok;
}

bool check_vector(struct checker *ck, const struct grammar_key *key, const struct node *node, vec3 *out) {
    double v[3];
    const struct node *n = node_resolve(node);
    if (key->type == GRAMMAR_FACTORS && n->kind == NODE_SCALAR) {
        if (!check_number(ck, key, node, &v[0])) return false;
        *out = vec3_all(v[0]);
        return true;
    }
    const char *form = key->type == GRAMMAR_FACTORS ? "a number or [x, y, z]" : "[x, y, z]";
    if (!check_row(ck, key, node, form, 3, check_number, v)) return false;
    if (key->type == GRAMMAR_DIRECTION && v[0] == 0.0 && v[1] == 0.0 && v[2] == 0.0) {
        diag_help(ck->diag, diag_error(ck->diag, node->span, "`%s`: [0, 0, 0] is no direction", key->name),
                  "any other vector will do, of any length");
        return false;
    }
    *out = (vec3){v[0], v[1], v[2]};
    return true;
}

bool check_size(struct checker *ck, const struct grammar_key *key, const struct node *node, vec3 *out) {
    double v[2];
    if (!check_row(ck, key, node, "[width, height]", 2, check_integer, v)) return false;
    *out = (vec3){v[0], v[1], 0};
    return true;
}

bool check_matrix(struct checker *ck, const struct grammar_key *key, const struct node *node, const affine **out) {
    const struct node *n = node_resolve(node);
    double rows[4][4] = {{0}, {0}, {0}, {0, 0, 0, 1}};
    if (!check_count(ck, node)) return false;
    if (n->kind != NODE_SEQUENCE || (n->count != 3 && n->count != 4)) {
        struct diagnostic *d = diag_error(ck->diag, node->span, "`%s`: expected three rows of four numbers, found %s",
                                          key->name, check_found(ck, node));
        diag_help(ck->diag, d, "as in [[1, 0, 0, 5], [0, 1, 0, 0], [0, 0, 1, 0]]");
        return false;
    }
    bool ok = true;
    int i = 0;
    for (const struct node *row = n->first; row; row = row->next)
        ok &= check_row(ck, key, row, "four numbers in a row", 4, check_number, rows[i++]);
    if (!ok) return false;
    if (rows[3][0] != 0 || rows[3][1] != 0 || rows[3][2] != 0 || rows[3][3] != 1) {
        diag_error(ck->diag, node->span, "`%s`: the fourth row of an affine map is [0, 0, 0, 1]", key->name);
        return false;
    }
    affine *map = arena_alloc(ck->arena, sizeof *map);
    memcpy(map->m, rows, sizeof map->m);
    *out = map;
    return true;
}
