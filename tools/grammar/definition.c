#include "definition.h"

#include <ctype.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

static struct arena arena;
static struct diagnostics diag;

/* ---- Reading ---- */

static struct source *read_source(const char *folder, const char *file) {
    char *path = format("%s/%s", folder, file);
    FILE *in = fopen(path, "rb");
    if (!in || fseek(in, 0, SEEK_END) != 0) {
        perror(path);
        exit(2);
    }
    const size_t size = (size_t)ftell(in);
    rewind(in);
    char *text = arena_alloc(&arena, size + 1);
    if (fread(text, 1, size, in) != size) {
        perror(path);
        exit(2);
    }
    fclose(in);
    struct source *source = arena_alloc(&arena, sizeof *source);
    *source = (struct source){path, text, size};
    return source;
}

static const struct node *parse(const struct source *source) {
    const struct node_limits limits = {20, 100000};
    struct node_problem problem = {0};
    const struct node *root = node_parse(&arena, &diag, source, &limits, NULL, &problem);
    if (!root) {
        if (problem.text) diag_error(&diag, problem.at, "not-yaml", "%s", problem.text);
        diag_print(&diag, stderr);
        exit(2);
    }
    return root;
}

static const struct node *read_file(const char *folder, const char *file) {
    return parse(read_source(folder, file));
}

const struct node *parse_text(const char *text) {
    struct source *source = arena_alloc(&arena, sizeof *source);
    *source = (struct source){"an example", text, strlen(text)};
    return parse(source);
}

static _Noreturn void fail(const struct node *node, const char *message) {
    diag_error(&diag, node->span, "definition", "%s", message);
    diag_print(&diag, stderr);
    exit(2);
}

/* A slip in the definition would be a key without its default, or worse. */
static void check_fields(const struct node *key) {
    static const char *const known[] = {"type",     "of",          "default",  "defaults_to", "min",
                                        "max",      "above",       "choices",  "unit",        "doc",
                                        "example",  "alternative", "required", "named",       "single",
                                        "excludes", "needs",       "instead",  "near"};
    if (key->kind != NODE_MAPPING || !text_of(key, "type") || !text_of(key, "doc"))
        fail(key, "a key needs a type and a doc");
    for (const struct node *field = key->first; field; field = field->next->next) {
        bool found = false;
        for (size_t i = 0; i < sizeof known / sizeof *known; i++) found |= strcmp(field->text, known[i]) == 0;
        if (!found) fail(field, "a key has no such field");
    }
}

/* The words of a list must be keys of the same kind. */
static void check_keys_exist(const struct node *keys, const struct node *words) {
    for (const struct node *word = words ? words->first : NULL; word; word = word->next)
        if (!get(keys, word->text)) fail(word, "no such key");
}

static void check_default(const struct node *key) {
    const struct node *choices = get(key, "choices");
    bool found = !choices || !get(key, "default");
    for (const struct node *c = choices ? choices->first : NULL; c && !found; c = c->next)
        found = strcmp(c->text, text_of(key, "default")) == 0;
    if (!found) fail(key, "the default is no choice");
}

static void check_kind(const struct node *kinds, const struct node *kind) {
    for (const struct node *k = keys_of(kind); k; k = k->next->next) {
        check_fields(k->next);
        check_default(k->next);
        check_keys_exist(get(kind, "keys"), get(k->next, "excludes"));
        check_keys_exist(get(kind, "keys"), get(k->next, "needs"));
        if (get(k->next, "of") && !get(kinds, text_of(k->next, "of")))
            fail(get(k->next, "of"), "no such kind");
    }
}

static void check_function(const struct node *function) {
    static const char *const known[] = {"call", "arguments", "doc", "domain", "example", "gives", "instead"};
    const struct node *arguments = get(function, "arguments");
    if (!text_of(function, "call") || !text_of(function, "doc"))
        fail(function, "a function needs a call and a doc");
    if (!arguments || arguments->kind != NODE_SEQUENCE || arguments->count != 2)
        fail(function, "a function needs arguments: [least, most]");
    if (!get(function, "example") != !get(function, "gives"))
        fail(function, "an example needs what it gives");
    for (const struct node *field = function->first; field; field = field->next->next) {
        bool found = false;
        for (size_t i = 0; i < sizeof known / sizeof *known; i++) found |= strcmp(field->text, known[i]) == 0;
        if (!found) fail(field, "a function has no such field");
    }
}

static void check_constant(const struct node *constant) {
    if (!text_of(constant, "value") || !text_of(constant, "doc"))
        fail(constant, "a constant needs a value and a doc");
}

struct definition definition_read(const char *folder) {
    const struct node *expressions = read_file(folder, "functions.yaml");
    const struct definition language = {
        .kinds = get(read_file(folder, "language.yaml"), "kinds"),
        .functions = get(expressions, "functions"),
        .constants = get(expressions, "constants"),
        .colors = read_file(folder, "colors.yaml"),
        .types = read_file(folder, "types.yaml"),
        .presets = read_source(folder, "../scenes/presets.yaml"),
    };
    for (const struct node *k = language.kinds->first; k; k = k->next->next)
        check_kind(language.kinds, k->next);
    for (const struct node *k = language.functions->first; k; k = k->next->next) check_function(k->next);
    for (const struct node *k = language.constants->first; k; k = k->next->next) check_constant(k->next);
    return language;
}

void definition_free(void) { arena_free(&arena); }

/* ---- Fields ---- */

const struct node *get(const struct node *mapping, const char *field) {
    for (const struct node *k = mapping->first; k; k = k->next->next)
        if (strcmp(k->text, field) == 0) return k->next;
    return NULL;
}

const char *text_of(const struct node *mapping, const char *field) {
    const struct node *value = get(mapping, field);
    return value ? value->text : NULL;
}

bool is_true(const struct node *mapping, const char *field) {
    const char *text = text_of(mapping, field);
    return text && strcmp(text, "true") == 0;
}

bool type_is(const struct node *key, const char *type) { return strcmp(text_of(key, "type"), type) == 0; }

const struct node *keys_of(const struct node *kind) { return get(kind, "keys")->first; }

/* ---- For people ---- */

char *format(const char *text, ...) {
    char *out = NULL;
    va_list args;
    va_start(args, text);
    const int length = vasprintf(&out, text, args);
    va_end(args);
    if (length < 0) exit(2);
    char *kept = arena_text(&arena, out, (size_t)length);
    free(out);
    return kept;
}

const char *upper(const char *text) {
    char *copy = arena_text(&arena, text, strlen(text));
    for (char *c = copy; *c; c++) *c = (char)(isalnum((unsigned char)*c) ? toupper((unsigned char)*c) : '_');
    return copy;
}

const char *row_text(const struct node *row) {
    char *text = "[";
    for (const struct node *item = row->first; item; item = item->next)
        text = format("%s%s%s", text, item->text, item->next ? ", " : "]");
    return text;
}

const char *default_text(const struct node *key) {
    const struct node *value = get(key, "default");
    if (!value) return text_of(key, "defaults_to");
    return value->kind == NODE_SCALAR ? value->text : row_text(value);
}

static const char *choices_text(const struct node *key) {
    char *words = "";
    for (const struct node *c = get(key, "choices")->first; c; c = c->next)
        words = format("%s`%s`%s", words, c->text, c->next ? ", " : "");
    return words;
}

const char *type_text(const struct node *key, bool links) {
    const char *of = text_of(key, "of");
    const char *link = !of ? "" : links ? format("[%s](#%s)", of, of) : of;
    if (type_is(key, "object")) return is_true(key, "named") ? format("%s, or a name", link) : link;
    if (type_is(key, "list"))
        return is_true(key, "single") ? format("%s, or list of them", link) : format("list of %s", link);
    if (type_is(key, "map")) return format("names, each with a %s", link);
    if (type_is(key, "point") || type_is(key, "direction"))
        return format("%s `[x, y, z]`", text_of(key, "type"));
    if (type_is(key, "factors")) return "number or `[x, y, z]`";
    if (type_is(key, "amount")) return "number or color";
    if (type_is(key, "size")) return "`[width, height]`";
    if (type_is(key, "matrix")) return "rows of four numbers";
    if (type_is(key, "any")) return "any value";
    if (type_is(key, "values"))
        return of ? format("names, each with a value or a %s", link) : "names, each with a value";
    if (type_is(key, "ranges")) return format("variables, each with a count, a list or a %s", link);
    if (type_is(key, "condition")) return "expression, true or false";
    if (type_is(key, "name")) return format("name of a %s", link);
    if (type_is(key, "files")) return "path, or list of paths";
    if (type_is(key, "color") && of) return format("color or %s", link);
    return type_is(key, "choice") ? choices_text(key) : text_of(key, "type");
}

const char *range_text(const struct node *key) {
    const char *min = text_of(key, "min"), *max = text_of(key, "max"), *unit = text_of(key, "unit");
    const bool above = is_true(key, "above");
    const char *range = min && max ? format("%s %s to %s", above ? "over" : "from", min, max)
                        : min      ? format(above ? "over %s" : "%s or more", min)
                                   : "";
    return unit ? format("%s%s%s", range, *range ? ", " : "", unit) : range;
}
