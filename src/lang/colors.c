#include <ctype.h>
#include <string.h>
#include <strings.h>

#include "base/elementary.h"
#include "lang/checker.h"
#include "lang/spelling.h"

double linear_from_srgb(double c) {
    return c <= 0.04045 ? c / 12.92 : elementary_pow((c + 0.055) / 1.055, 2.4);
}

static vec3 linear_from_bytes(const unsigned char rgb[3]) {
    return (vec3){linear_from_srgb(rgb[0] / 255.0), linear_from_srgb(rgb[1] / 255.0),
                  linear_from_srgb(rgb[2] / 255.0)};
}

static int hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

/* #rgb or #rrggbb, without regard to letter case. */
static bool parse_hex(const char *text, unsigned char rgb[3]) {
    const size_t digits = strlen(text) - 1;
    if (digits != 3 && digits != 6) return false;
    for (size_t i = 0; i < digits; i++)
        if (hex_digit(text[i + 1]) < 0) return false;
    for (size_t i = 0; i < 3; i++) {
        const char *c = text + 1 + i * digits / 3;
        rgb[i] = (unsigned char)(digits == 3 ? 17 * hex_digit(c[0]) : 16 * hex_digit(c[0]) + hex_digit(c[1]));
    }
    return true;
}

bool color_parse(const char *text, vec3 *out) {
    unsigned char rgb[3];
    if (text[0] == '#') {
        if (!parse_hex(text, rgb)) return false;
        *out = linear_from_bytes(rgb);
        return true;
    }
    const char first = (char)(text[0] | 0x20); /* the names are in small letters */
    for (int i = 0; i < grammar_color_count; i++)
        if (first == grammar_colors[i].name[0] && strcasecmp(text, grammar_colors[i].name) == 0) {
            *out = linear_from_bytes(grammar_colors[i].rgb);
            return true;
        }
    return false;
}

static void report_no_color(struct checker *ck, const struct grammar_key *key, const struct node *node) {
    if (only_counted(ck, node->span)) return;
    struct diagnostic *d =
        diag_error(ck->diag, node->span, "not-a-color", "`%s`: expected %s, found %s", key->name,
                   key->type == GRAMMAR_AMOUNT ? "a number or a colour" : "a colour", found_text(ck, node));
    const struct node *n = node_resolve(node);
    const char *text = n->kind == NODE_SCALAR && n->count <= 40 ? n->text : "",
               *hash = arena_format(ck->arena, "#%s", text);
    unsigned char rgb[3];
    if (scalar_is_number(text))
        diag_help(ck->diag, d, "for a grey write [%s, %s, %s], or `%s * white`", text, text, text, text);
    else if (*text != '#' && parse_hex(hash, rgb))
        diag_help(ck->diag, d, "did you mean \"%s\"?", hash);
    else if (n->kind == NODE_MAPPING)
        diag_help(ck->diag, d,
                  "a colour is [r, g, b], \"#rrggbb\" or a CSS name; textures are not there yet");
    else
        diag_help(ck->diag, d, "a colour is [r, g, b], \"#rrggbb\" or a CSS name");
}

static void report_no_color_name(struct checker *ck, const struct grammar_key *key, const struct node *node) {
    if (only_counted(ck, node->span)) return;
    const char *text = node_resolve(node)->text;
    struct spelling s = spelling_begin(text);
    for (int i = 0; i < grammar_color_count; i++) spelling_offer(&s, grammar_colors[i].name);
    if (text[0] == '#') {
        struct diagnostic *d = diag_error(ck->diag, node->span, "not-a-color",
                                          "`%s`: a colour in hexadecimal has 3 or 6 digits 0-9 a-f, found %s",
                                          key->name, found_text(ck, node));
        unsigned char rgb[3];
        const char *start = arena_text(ck->arena, text, strlen(text) > 7 ? 7 : 0);
        if (strlen(text) == 9 && parse_hex(start, rgb))
            diag_help(ck->diag, d, "without the last two, which say how opaque it is: \"%s\"", start);
    } else if (s.best) {
        struct diagnostic *d = diag_error(ck->diag, node->span, "unknown-color",
                                          "`%s`: no colour is named %s", key->name, found_text(ck, node));
        diag_help(ck->diag, d, "did you mean `%s`?", s.best);
    } else {
        report_no_color(ck, key, node);
    }
}

/* Bytes are what people paste: [255, 128, 0]. */
static bool looks_like_bytes(const double v[3]) {
    const double most = v[0] > v[1] ? (v[0] > v[2] ? v[0] : v[2]) : (v[1] > v[2] ? v[1] : v[2]);
    bool whole = most > 2.0 && most <= 255.0;
    for (int i = 0; i < 3; i++) whole &= v[i] >= 0.0 && v[i] == floor(v[i]);
    return whole;
}

static bool check_color_range(struct checker *ck, const struct grammar_key *key, const struct node *node,
                              const double v[3]) {
    const bool over = key->has_max && !(v[0] <= key->max && v[1] <= key->max && v[2] <= key->max);
    if (over && looks_like_bytes(v)) {
        struct diagnostic *d = diag_error(ck->diag, node->span, "color-of-bytes",
                                          "`%s`: [r, g, b] is linear, each 0 to 1", key->name);
        diag_help(ck->diag, d, "did you mean \"#%02x%02x%02x\"?", (unsigned)v[0], (unsigned)v[1],
                  (unsigned)v[2]);
        return false;
    }
    if (!(v[0] >= 0.0 && v[1] >= 0.0 && v[2] >= 0.0)) {
        diag_error(ck->diag, node->span, "out-of-range", "`%s`: a colour has no negative parts", key->name);
        return false;
    }
    if (over && key->type == GRAMMAR_AMOUNT) {
        diag_error(ck->diag, node->span, "out-of-range", "`%s`: each part must be 0 to 1", key->name);
        return false;
    }
    const bool surface = ck->around.kind == &grammar_kinds[KIND_MATERIAL];
    if (over)
        diag_warning(ck->diag, node->span, "too-much-light",
                     surface ? "`%s`: gives back more light than it gets: a part is over 1"
                             : "`%s`: a part is over 1, where the picture ends",
                     key->name);
    return true;
}

static bool check_color_list(struct checker *ck, const struct grammar_key *key, const struct node *node,
                             vec3 *out) {
    const struct node *n = node_resolve(node);
    struct grammar_key component = *key;
    component.type = GRAMMAR_NUMBER;
    component.has_min = component.has_max = false;
    double v[3];
    if (report_cut_in(ck, key->name, n)) return false;
    if (n->count != 3) {
        diag_error(ck->diag, node->span, "not-a-color", "`%s`: expected [r, g, b], found %s", key->name,
                   found_text(ck, node));
        return false;
    }
    bool ok = true;
    int i = 0;
    for (const struct node *item = n->first; item; item = item->next)
        ok &= check_number(ck, &component, item, &v[i++]);
    if (!ok || !check_color_range(ck, key, node, v)) return false;
    *out = (vec3){v[0], v[1], v[2]};
    return true;
}

/* A grey, where an amount is wanted. */
static bool check_grey(struct checker *ck, const struct grammar_key *key, const struct node *node,
                       vec3 *out) {
    double all;
    if (!check_number(ck, key, node, &all)) return false;
    *out = vec3_all(all);
    return true;
}

/* What is neither a colour as such nor a list: an expression or keyframes. */
static enum quantity_result read_color(struct checker *ck, const struct grammar_key *key,
                                       const struct node *node, vec3 *out) {
    struct quantity q;
    const enum quantity_result result = scope_quantity(ck, key->name, node, &q);
    if (result == QUANTITY_UNKNOWN) *out = (vec3){key->value[0], key->value[1], key->value[2]};
    if (result != QUANTITY_OK) return result;
    if (q.count == 1 && key->type == GRAMMAR_AMOUNT)
        return check_grey(ck, key, node, out) ? QUANTITY_OK : QUANTITY_WRONG;
    if (q.count != 3) {
        struct diagnostic *d =
            diag_error(ck->diag, node->span, "not-a-color", "`%s`: expected a colour, found %s", key->name,
                       found_quantity(ck, node, &q));
        scope_tell_given(ck, d, node);
        const struct node *n = node_resolve(node);
        if (q.count == 1 && n->kind == NODE_SCALAR)
            diag_help(ck->diag, d,
                      scope_is_name(n->text) ? "for a grey write `%s * white`"
                                             : "for a grey write `(%s) * white`",
                      short_text(ck, n->text));
        return QUANTITY_WRONG;
    }
    if (!check_color_range(ck, key, node, q.v)) return QUANTITY_WRONG;
    *out = (vec3){q.v[0], q.v[1], q.v[2]};
    return QUANTITY_OK;
}

static bool starts_like_number(const char *text) { return isdigit((unsigned char)text[strspn(text, "+-.")]); }

bool check_color(struct checker *ck, const struct grammar_key *key, const struct node *node, vec3 *out) {
    const struct node *n = node_resolve(node);
    if (n->kind == NODE_SEQUENCE) return check_color_list(ck, key, node, out);
    if (n->kind == NODE_SCALAR && color_parse(n->text, out)) return true;
    const bool number = n->kind == NODE_SCALAR && starts_like_number(n->text);
    if (number && key->type == GRAMMAR_AMOUNT) return check_grey(ck, key, node, out);
    const bool written =
        n->kind == NODE_SCALAR && (n->count == 0 || n->text[0] == '#' || scalar_is_number(n->text));
    const enum quantity_result result = written ? QUANTITY_NONE : read_color(ck, key, node, out);
    if (result != QUANTITY_NONE)
        return result == QUANTITY_OK || (result == QUANTITY_UNKNOWN && ck->rehearsing);
    if (n->kind == NODE_SCALAR && n->count > 0 && !number)
        report_no_color_name(ck, key, node);
    else
        report_no_color(ck, key, node);
    return false;
}
