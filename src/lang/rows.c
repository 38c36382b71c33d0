/* Rows of numbers: points, directions, sizes, matrices. */
#include <string.h>

#include "lang/checker.h"

static bool all_scalars(const struct node *n) {
    for (const struct node *item = n->first; item; item = item->next)
        if (node_resolve(item)->kind != NODE_SCALAR) return false;
    return true;
}

static void help_missing(struct checker *ck, struct diagnostic *d, uint32_t found, int wanted,
                         const char *const names[3]) {
    if (found == 0 || found >= (uint32_t)wanted) return;
    if (wanted - (int)found == 1)
        diag_help(ck->diag, d, "the %s number, %s, is missing", wanted == 3 ? "third" : "second",
                  names[wanted - 1]);
    else
        diag_help(ck->diag, d, "the second and third numbers, %s and %s, are missing", names[1], names[2]);
}

/* A mapping {x: 1, y: 2, z: 3}, or a text like `1, 2, 3` or `640x480`. */
static void help_other_form(struct checker *ck, struct diagnostic *d, const struct node *n, int count,
                            const char *const names[3]) {
    if (n->kind == NODE_MAPPING && n->first && node_resolve(n->first)->kind == NODE_SCALAR &&
        strcmp(node_resolve(n->first)->text, names[0]) == 0)
        diag_help(ck->diag, d, "without the names: [%s, %s%s%s]", names[0], names[1], count == 3 ? ", " : "",
                  count == 3 ? names[2] : "");
    if (n->kind != NODE_SCALAR || n->count > 40) return;
    const char *const between = " ,;x*()[]";
    const char *all = "", *c = n->text + strspn(n->text, between);
    int found = 0;
    for (; *c; found++) {
        const size_t length = strcspn(c, between);
        const char *item = arena_text(ck->arena, c, length);
        if (!scalar_is_number(item)) return;
        all = arena_format(ck->arena, "%s%s%s", all, found ? ", " : "", item);
        c += length;
        c += strspn(c, between);
    }
    if (found == count)
        diag_help(ck->diag, d, "write [%s]", all);
    else if (n->text[0] == '(')
        diag_help(ck->diag, d, "a list stands in [ ]");
}

/* In `[0,5, 1, 2]` the comma that was meant as a decimal point has no space behind it. */
static void help_decimal_comma(struct checker *ck, struct diagnostic *d, const struct node *n) {
    for (const struct node *item = n->first, *next = item ? item->next : NULL; next;
         item = next, next = next->next) {
        const size_t at = next->span.source ? source_offset(next->span) : 0;
        if (at == 0 || item->kind != NODE_SCALAR || next->kind != NODE_SCALAR ||
            next->span.source->text[at - 1] != ',')
            continue;
        if (!scalar_is_number(item->text) || strchr(item->text, '.') ||
            strspn(next->text, "0123456789") != next->count)
            continue;
        diag_help(ck->diag, d, "a decimal point is a point: did you mean %s.%s?", short_text(ck, item->text),
                  short_text(ck, next->text));
        return;
    }
}

/* Most rows are as many plain numbers as there should be. Whether this one is; if not, *out means nothing. */
static bool read_plain(struct checker *ck, const struct grammar_key *key, const struct node *n, int count,
                       double *out) {
    if (n->kind != NODE_SEQUENCE || n->count != (uint32_t)count || key->type == GRAMMAR_SIZE) return false;
    for (const struct node *item = n->first; item; item = item->next)
        if (item->kind != NODE_SCALAR || !scalar_number(ck, item->text, out++)) return false;
    return true;
}

static bool all_in_range(struct checker *ck, const struct grammar_key *key, const struct node *n,
                         const double *value) {
    bool ok = true;
    for (const struct node *item = n->first; item; item = item->next)
        ok &= check_in_range(ck, key, item, *value++);
    return ok;
}

/* Exactly `count` numbers of a list, of a size whole ones. */
static bool check_row(struct checker *ck, const struct grammar_key *key, const struct node *node,
                      const char *form, int count, const char *const names[3], double *out) {
    const struct node *n = node_resolve(node);
    if (read_plain(ck, key, n, count, out)) return all_in_range(ck, key, n, out);
    if (n->kind != NODE_SEQUENCE) {
        struct diagnostic *d = diag_error(ck->diag, node->span, "not-a-row", "`%s`: expected %s, found %s",
                                          key->name, form, found_text(ck, node));
        if (names && !diag_full(ck->diag)) help_other_form(ck, d, n, count, names);
        return false;
    }
    if (report_cut_in(ck, key->name, n)) return false;
    if (n->count != (uint32_t)count) {
        const bool numbers = n->count > 0 && all_scalars(n);
        struct diagnostic *d =
            numbers ? diag_error(ck->diag, node->span, "wrong-count", "`%s`: expected %s, found %u number%s",
                                 key->name, form, (unsigned)n->count, n->count == 1 ? "" : "s")
                    : diag_error(ck->diag, node->span, "not-a-row", "`%s`: expected %s, found %s", key->name,
                                 form, found_text(ck, node));
        if (numbers && n->count > (uint32_t)count)
            help_decimal_comma(ck, d, n);
        else if (numbers && names)
            help_missing(ck, d, n->count, count, names);
        else if (!numbers && n->count == 1)
            diag_help(ck->diag, d, "one pair of brackets is enough");
        return false;
    }
    bool ok = true;
    int i = 0;
    for (const struct node *item = n->first; item; item = item->next, i++)
        ok &= key->type == GRAMMAR_SIZE ? check_integer(ck, key, item, &out[i])
                                        : check_number(ck, key, item, &out[i]);
    return ok;
}

/* A scalar or keyframes for the whole vector: an expression. A number serves all three axes where
 * factors are wanted. QUANTITY_NONE: it is neither. */
static enum quantity_result read_vector(struct checker *ck, const struct grammar_key *key,
                                        const struct node *node, double v[3]) {
    const struct node *n = node_resolve(node);
    struct quantity q;
    if (n->kind == NODE_SEQUENCE) return QUANTITY_NONE;
    const enum quantity_result result = scope_quantity(ck, key->name, node, &q);
    if (result == QUANTITY_UNKNOWN) memcpy(v, key->value, sizeof key->value);
    if (result != QUANTITY_OK) return result;
    if (q.count != 3 && (q.count != 1 || key->type != GRAMMAR_FACTORS)) {
        if (n->kind == NODE_SCALAR && scalar_is_number(n->text)) return QUANTITY_NONE;
        struct diagnostic *d =
            diag_error(ck->diag, node->span, "not-a-row", "`%s`: expected [x, y, z], found %s", key->name,
                       found_quantity(ck, node, &q));
        scope_tell_given(ck, d, node);
        return QUANTITY_WRONG;
    }
    for (unsigned i = 0; i < 3; i++) v[i] = q.v[q.count == 3 ? i : 0];
    return QUANTITY_OK;
}

bool check_vector(struct checker *ck, const struct grammar_key *key, const struct node *node, vec3 *out) {
    static const char *const names[3] = {"x", "y", "z"};
    double v[3];
    const struct node *n = node_resolve(node);
    const bool all = key->type == GRAMMAR_FACTORS && n->kind == NODE_SCALAR && scalar_is_number(n->text);
    const enum quantity_result whole = all ? QUANTITY_NONE : read_vector(ck, key, node, v);
    if (whole == QUANTITY_WRONG || (whole == QUANTITY_UNKNOWN && !ck->rehearsing)) return false;
    if (all) {
        if (!check_number(ck, key, node, &v[0])) return false;
        v[1] = v[2] = v[0];
    } else if (whole == QUANTITY_NONE) {
        const char *form = key->type == GRAMMAR_FACTORS ? "a number or [x, y, z]" : "[x, y, z]";
        if (!check_row(ck, key, node, form, 3, names, v)) return false;
    }
    if (key->type == GRAMMAR_DIRECTION && !ck->rehearsing && v[0] == 0.0 && v[1] == 0.0 && v[2] == 0.0) {
        diag_help(
            ck->diag,
            diag_error(ck->diag, node->span, "null-direction", "`%s`: [0, 0, 0] is no direction", key->name),
            "any other vector will do, of any length");
        return false;
    }
    *out = (vec3){v[0], v[1], v[2]};
    return true;
}

/* `size: 2 * small`. QUANTITY_NONE: it is no such expression. */
static enum quantity_result read_size(struct checker *ck, const struct grammar_key *key,
                                      const struct node *node, double v[2]) {
    struct quantity q;
    const enum quantity_result result =
        node_resolve(node)->kind == NODE_SCALAR ? scope_quantity(ck, key->name, node, &q) : QUANTITY_NONE;
    if (result == QUANTITY_UNKNOWN) memcpy(v, key->value, 2 * sizeof *v);
    if (result != QUANTITY_OK) return result;
    if (q.count != 2) return QUANTITY_NONE;
    for (int i = 0; i < 2; i++) {
        const char *text = arena_format(ck->arena, "%.17g", q.v[i]);
        const struct node part = {
            .span = node->span, .kind = NODE_SCALAR, .text = text, .count = (uint32_t)strlen(text)};
        if (!check_integer(ck, key, &part, &v[i])) return QUANTITY_WRONG;
    }
    return QUANTITY_OK;
}

bool check_size(struct checker *ck, const struct grammar_key *key, const struct node *node, vec3 *out) {
    static const char *const names[3] = {"width", "height"};
    double v[2];
    const enum quantity_result whole = read_size(ck, key, node, v);
    if (whole == QUANTITY_WRONG || (whole == QUANTITY_UNKNOWN && !ck->rehearsing)) return false;
    if (whole == QUANTITY_NONE && !check_row(ck, key, node, "[width, height]", 2, names, v)) return false;
    *out = (vec3){v[0], v[1], 0};
    return true;
}

bool check_matrix(struct checker *ck, const struct grammar_key *key, const struct node *node,
                  const affine **out) {
    const struct node *n = node_resolve(node);
    double rows[4][4] = {{0}, {0}, {0}, {0, 0, 0, 1}};
    if (n->kind != NODE_SEQUENCE || (n->count != 3 && n->count != 4) || all_scalars(n)) {
        struct diagnostic *d = diag_error(ck->diag, node->span, "not-a-matrix",
                                          "`%s`: expected three rows of four numbers, found %s", key->name,
                                          found_text(ck, node));
        diag_help(ck->diag, d, "as in [[1, 0, 0, 5], [0, 1, 0, 0], [0, 0, 1, 0]]");
        return false;
    }
    bool ok = true;
    int i = 0;
    for (const struct node *row = n->first; row; row = row->next)
        ok &= check_row(ck, key, row, "four numbers in a row", 4, NULL, rows[i++]);
    if (!ok) return false;
    if (rows[3][0] != 0 || rows[3][1] != 0 || rows[3][2] != 0 || rows[3][3] != 1) {
        const bool columns = rows[0][3] == 0 && rows[1][3] == 0 && rows[2][3] == 0 && rows[3][3] == 1;
        struct diagnostic *d = diag_error(ck->diag, node->span, "not-affine",
                                          "`%s`: the fourth row of an affine map is [0, 0, 0, 1]", key->name);
        if (columns)
            diag_help(ck->diag, d, "the translation is the last column here: turn rows into columns");
        return false;
    }
    affine *map = arena_alloc(ck->arena, sizeof *map);
    memcpy(map->m, rows, sizeof map->m);
    *out = map;
    return true;
}
