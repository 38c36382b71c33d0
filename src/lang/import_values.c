#include <ctype.h>
#include <locale.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "lang/importer.h"
#include "lang/spelling.h"

enum { MAX_PARTS = 1000000, MAX_DEPTH = 40, MAX_SHOWN = 40 };

const char *const IMPORT_NO_WORDS[] = {NULL};

/* ---- Mappings ---- */

const struct node *mapping_find(const struct node *mapping, const char *key) {
    for (const struct node *name = mapping->first; name; name = name->next->next) {
        const struct node *n = node_resolve(name);
        if (n->kind == NODE_SCALAR && strcmp(n->text, key) == 0) return name->next;
    }
    return NULL;
}

struct place_in_book layer_find(const struct layer *layer, const char *key) {
    for (; layer; layer = layer->under) {
        const struct node *value = mapping_find(layer->mapping, key);
        if (value) return (struct place_in_book){value, layer->knows};
    }
    return (struct place_in_book){NULL, 0};
}

static bool is_known(const char *key, const char *const *known, struct spelling *nearest) {
    for (; *known; known++) {
        if (strcmp(key, *known) == 0) return true;
        spelling_offer(nearest, *known);
    }
    return false;
}

void import_check_keys(struct importer *im, const struct layer *layers, const char *what,
                       const char *const *known, const char *const *also) {
    for (; layers; layers = layers->under) {
        for (const struct node *name = layers->mapping->first; name; name = name->next->next) {
            const struct node *n = node_resolve(name);
            const char *key = n->kind == NODE_SCALAR ? n->text : "";
            struct spelling nearest = spelling_begin(key);
            if (is_known(key, known, &nearest) || is_known(key, also, &nearest)) continue;
            struct diagnostic *d = diag_warning(im->diag, name->span, "import-unknown-key",
                                                "%s has no key %s: left out", what, found_in_book(im, name));
            if (nearest.best) diag_help(im->diag, d, "did you mean `%s`?", nearest.best);
        }
    }
}

/* ---- Definitions ---- */

static const struct node *require(struct importer *im, const struct node *item, const char *key) {
    const struct node *value = mapping_find(item, key);
    if (!value) diag_error(im->diag, item->span, "import-missing", "a definition needs `%s`", key);
    return value;
}

void import_define(struct importer *im, const struct node *item) {
    static const char *const keys[] = {"define", "value", "extend", NULL};
    const struct layer layer = {item, 0, NULL};
    const struct node *name = mapping_find(item, "define"), *value = require(im, item, "value");
    import_check_keys(im, &layer, "a definition", keys, IMPORT_NO_WORDS);
    if (node_resolve(name)->kind != NODE_SCALAR) {
        diag_error(im->diag, name->span, "import-value", "`define`: expected a name, found %s",
                   found_in_book(im, name));
        return;
    }
    if (!value) return;
    struct book_definition *definition = arena_alloc(im->arena, sizeof *definition);
    *definition = (struct book_definition){.name = node_resolve(name)->text,
                                           .span = name->span,
                                           .value = value,
                                           .extend = mapping_find(item, "extend"),
                                           .number = ++im->defined};
    definition->before = table_find(&im->definitions, definition->name);
    table_put(im->arena, &im->definitions, definition->name, definition);
    *im->end = definition;
    im->end = &definition->next;
    if (!definition->before) return;
    struct diagnostic *d =
        diag_warning(im->diag, name->span, "import-defined-twice",
                     "%s is defined again: from here on it means this", found_in_book(im, name));
    diag_related(im->diag, d, definition->before->span, "the first is here");
}

struct book_definition *import_definition(struct importer *im, const char *name, uint32_t knows) {
    struct book_definition *definition = table_find(&im->definitions, name);
    while (definition && definition->number > knows) definition = definition->before;
    if (definition) definition->used = true;
    return definition;
}

void import_unknown_name(struct importer *im, const struct node *name, const char *what,
                         const char *const *also) {
    const char *word = node_resolve(name)->text;
    const struct book_definition *later = table_find(&im->definitions, word);
    struct diagnostic *d =
        diag_error(im->diag, name->span, "import-unknown-name", "%s: nothing called %s is defined before",
                   what, found_in_book(im, name));
    if (later) {
        diag_related(im->diag, d, later->span, "it is defined here: too late to be used there");
        return;
    }
    struct spelling nearest = spelling_begin(word);
    for (; *also; also++) spelling_offer(&nearest, *also);
    for (const struct book_definition *def = im->first; def; def = def->next)
        spelling_offer(&nearest, def->name);
    if (nearest.best) diag_help(im->diag, d, "did you mean `%s`?", nearest.best);
}

bool import_depth(struct importer *im, const struct node *node, int depth) {
    if (depth < MAX_DEPTH) return true;
    diag_error(im->diag, node->span, "import-limit", "more than %d groups or definitions within each other",
               MAX_DEPTH);
    return false;
}

bool import_enter(struct importer *im, const struct node *node) {
    if (im->parts < MAX_PARTS) return import_depth(im, node, im->depth) && (im->parts++, im->depth++, true);
    if (im->parts++ > MAX_PARTS) return false; /* reported */
    diag_error(im->diag, node->span, "import-limit",
               "more than %d objects and transforms, with definitions written out", MAX_PARTS);
    return false;
}

void import_leave(struct importer *im) { im->depth--; }

static struct book_definition *extended(struct importer *im, const struct node *extend, uint32_t knows) {
    const struct node *name = node_resolve(extend);
    if (name->kind != NODE_SCALAR) {
        diag_error(im->diag, extend->span, "import-value", "`extend`: expected a name, found %s",
                   found_in_book(im, name));
        return NULL;
    }
    struct book_definition *base = import_definition(im, name->text, knows);
    if (!base) import_unknown_name(im, extend, "`extend`", IMPORT_NO_WORDS);
    return base;
}

struct layer *import_layers(struct importer *im, struct place_in_book at, const struct node *extend) {
    struct layer *top = NULL, **end = &top;
    for (int depth = 0; import_depth(im, at.node, depth); depth++) {
        const struct node *mapping = node_resolve(at.node);
        if (mapping->kind != NODE_MAPPING) {
            diag_error(im->diag, at.node->span, "import-value",
                       "expected a mapping, of an object or a material, found %s",
                       found_in_book(im, mapping));
            return NULL;
        }
        struct layer *layer = arena_alloc(im->arena, sizeof *layer);
        *layer = (struct layer){mapping, at.knows, NULL};
        *end = layer;
        end = &layer->under;
        if (!extend) extend = mapping_find(mapping, "extend");
        const struct book_definition *base = extend ? extended(im, extend, at.knows) : NULL;
        if (!base) return top;
        at = (struct place_in_book){base->value, base->number - 1};
        extend = base->extend;
    }
    return NULL;
}

struct place_in_book import_named(struct importer *im, struct place_in_book at) {
    for (;;) {
        const struct node *n = node_resolve(at.node);
        struct book_definition *definition =
            n->kind == NODE_SCALAR ? import_definition(im, n->text, at.knows) : NULL;
        if (!definition) return at;
        at = (struct place_in_book){definition->value, definition->number - 1};
    }
}

/* ---- Single values ---- */

const char *found_in_book(struct importer *im, const struct node *node) {
    const struct node *n = node_resolve(node);
    if (diag_full(im->diag)) return "";
    if (node_is_null(n)) return "nothing";
    if (n->kind == NODE_MAPPING) return "a mapping";
    if (n->kind == NODE_SEQUENCE) return arena_format(im->arena, "a list of %u", n->count);
    if (n->count <= MAX_SHOWN) return arena_format(im->arena, "`%s`", n->text);
    size_t length = MAX_SHOWN;
    while (length > 0 && ((unsigned char)n->text[length] & 0xc0) == 0x80) length--;
    return arena_format(im->arena, "`%.*s...`", (int)length, n->text);
}

/* A decimal number as other YAML readers have them: strtod without its hexadecimal, inf and nan. */
static bool parse_decimal(struct importer *im, const char *text, double *out) {
    const char *point = localeconv()->decimal_point, *dot = strchr(text, '.');
    if (!*text || text[strspn(text, "0123456789.+-eE")]) return false;
    const char *local = dot && strcmp(point, ".") != 0
                            ? arena_format(im->arena, "%.*s%s%s", (int)(dot - text), text, point, dot + 1)
                            : text;
    char *end;
    const double value = strtod(local, &end);
    if (*end || !isfinite(value)) return false;
    *out = value;
    return true;
}

static bool wrong_value(struct importer *im, const char *what, const struct node *node, const char *wanted) {
    diag_error(im->diag, node->span, "import-value", "%s: expected %s, found %s", what, wanted,
               found_in_book(im, node));
    return false;
}

/* What scene/ can turn into transforms, and their products too. */
static const double least = 1e-30, most = 1e30;

bool import_number(struct importer *im, const char *what, struct place_in_book at, double *out) {
    const struct place_in_book value = import_named(im, at);
    const struct node *n = node_resolve(value.node);
    double number;
    if (n->kind != NODE_SCALAR || !parse_decimal(im, n->text, &number))
        return wrong_value(im, what, at.node, "a number");
    const double size = fabs(number);
    if (number != 0.0 && !(size >= least && size <= most))
        return wrong_value(im, what, at.node, "0, or a number of size 1e-30 to 1e30");
    *out = number;
    return true;
}

bool import_extent(struct importer *im, const char *what, struct place_in_book at, double *out) {
    const struct node *n = node_resolve(at.node);
    if (n->kind == NODE_SCALAR) {
        const char *word = n->text + strspn(n->text, "+-.");
        const double sign = n->text[0] == '-' ? -1.0 : 1.0;
        if (strcasecmp(word, "inf") == 0 || strcasecmp(word, "infinity") == 0)
            return *out = sign * INFINITY, true;
    }
    return import_number(im, what, at, out);
}

bool import_vec3(struct importer *im, const char *what, struct place_in_book at, vec3 *out) {
    const struct place_in_book value = import_named(im, at);
    const struct node *n = node_resolve(value.node);
    if (n->kind != NODE_SEQUENCE || n->count != 3) return wrong_value(im, what, at.node, "three numbers");
    double parts[3];
    const struct node *item = n->first;
    for (int i = 0; i < 3; i++, item = item->next)
        if (!import_number(im, what, (struct place_in_book){item, value.knows}, &parts[i])) return false;
    *out = (vec3){parts[0], parts[1], parts[2]};
    return true;
}

bool import_color(struct importer *im, const char *what, struct place_in_book at, vec3 *out) {
    vec3 color;
    if (!import_vec3(im, what, at, &color)) return false;
    if (color.x < 0.0 || color.y < 0.0 || color.z < 0.0)
        diag_warning(im->diag, at.node->span, "import-range",
                     "%s: a colour has no negative parts here: they become 0", what);
    *out = (vec3){fmax(color.x, 0.0), fmax(color.y, 0.0), fmax(color.z, 0.0)};
    return true;
}

bool import_boolean(struct importer *im, const char *what, struct place_in_book at, bool *out) {
    static const char *const words[] = {"false", "no", "off", "true", "yes", "on"};
    const struct node *n = node_resolve(import_named(im, at).node);
    for (int i = 0; i < 6 && n->kind == NODE_SCALAR; i++)
        if (strcasecmp(n->text, words[i]) == 0) return *out = i >= 3, true;
    return wrong_value(im, what, at.node, "true or false");
}
