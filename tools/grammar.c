/* Makes what is generated from the definition of the language:
 *
 *     grammar tables-header FOLDER OUT    enums of kinds, keys, choices and functions
 *     grammar tables        FOLDER OUT    the loader's tables
 *     grammar reference     FOLDER OUT    the reference manual, Markdown
 *
 * FOLDER holds language.yaml, functions.yaml and colors.yaml. Exit 0, or 2 with a message and no OUT. */
#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "lang/node.h"

static struct arena arena;
static struct diagnostics diag;

/* ---- Reading the definition ---- */

static struct source *read_source(const char *folder, const char *file) {
    char *path = arena_format(&arena, "%s/%s", folder, file);
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

static const struct node *read_file(const char *folder, const char *file) {
    const struct node_limits limits = {20, 100000};
    struct node_problem problem = {0};
    const struct node *root = node_parse(&arena, &diag, read_source(folder, file), &limits, NULL, &problem);
    if (!root) {
        if (problem.text) diag_error(&diag, problem.at, "not-yaml", "%s", problem.text);
        diag_print(&diag, stderr);
        exit(2);
    }
    return root;
}

static _Noreturn void fail(const struct node *node, const char *message) {
    diag_error(&diag, node->span, "definition", "%s", message);
    diag_print(&diag, stderr);
    exit(2);
}

static const struct node *get(const struct node *mapping, const char *key) {
    for (const struct node *k = mapping->first; k; k = k->next->next)
        if (strcmp(k->text, key) == 0) return k->next;
    return NULL;
}

static const char *text_of(const struct node *mapping, const char *key) {
    const struct node *value = get(mapping, key);
    return value ? value->text : NULL;
}

static bool is_true(const struct node *mapping, const char *key) {
    const char *text = text_of(mapping, key);
    return text && strcmp(text, "true") == 0;
}

static const char *upper(const char *text) {
    char *copy = arena_text(&arena, text, strlen(text));
    for (char *c = copy; *c; c++) *c = (char)(isalnum((unsigned char)*c) ? toupper((unsigned char)*c) : '_');
    return copy;
}

/* A default as people write it: `[0, 0, 1]`, `8`, `srgb`. NULL: none. */
static const char *default_text(const struct node *key) {
    const struct node *value = get(key, "default");
    if (!value) return text_of(key, "defaults_to");
    if (value->kind == NODE_SCALAR) return value->text;
    char *text = "[";
    for (const struct node *item = value->first; item; item = item->next)
        text = arena_format(&arena, "%s%s%s", text, item->text, item->next ? ", " : "]");
    return text;
}

static int choice_index(const struct node *key, const char *word) {
    const struct node *choices = get(key, "choices");
    int index = 0;
    for (const struct node *c = choices ? choices->first : NULL; c; c = c->next, index++)
        if (strcmp(c->text, word) == 0) return index;
    fail(key, "the default is no choice");
}

/* Calls `each` on every kind. */
static void for_kinds(const struct node *root, FILE *out, void (*each)(FILE *, const char *name, const struct node *kind)) {
    for (const struct node *k = get(root, "kinds")->first; k; k = k->next->next) each(out, k->text, k->next);
}

/* ---- The header ---- */

static void header_kind(FILE *out, const char *name, const struct node *kind) {
    const char *kind_name = upper(name);
    fprintf(out, "enum {\n");
    for (const struct node *k = get(kind, "keys")->first; k; k = k->next->next)
        fprintf(out, "    KEY_%s_%s,\n", kind_name, upper(k->text));
    fprintf(out, "    KEYS_%s\n};\n", kind_name);
    for (const struct node *k = get(kind, "keys")->first; k; k = k->next->next) {
        const struct node *choices = get(k->next, "choices");
        if (!choices) continue;
        fprintf(out, "enum {\n");
        for (const struct node *c = choices->first; c; c = c->next)
            fprintf(out, "    CHOICE_%s_%s_%s,\n", kind_name, upper(k->text), upper(c->text));
        fprintf(out, "};\n");
    }
}

static void header_kind_name(FILE *out, const char *name, const struct node *kind) {
    (void)kind;
    fprintf(out, "    KIND_%s,\n", upper(name));
}

static void write_header(FILE *out, const struct node *root, const struct node *expressions) {
    fprintf(out, "/* Generated from grammar/language.yaml and grammar/functions.yaml. */\n#ifndef GRAMMAR_TABLES_H\n#define GRAMMAR_TABLES_H\n\nenum {\n");
    for_kinds(root, out, header_kind_name);
    fprintf(out, "    KINDS\n};\n\n");
    for_kinds(root, out, header_kind);
    fprintf(out, "\nenum {\n");
    for (const struct node *k = get(expressions, "functions")->first; k; k = k->next->next) fprintf(out, "    FUNCTION_%s,\n", upper(k->text));
    fprintf(out, "    FUNCTIONS\n};\n\n#endif\n");
}

/* ---- The tables ---- */

static void write_string(FILE *out, const char *text) {
    if (!text) {
        fputs("NULL", out);
        return;
    }
    fputc('"', out);
    for (; *text; text++) {
        if (*text == '"' || *text == '\\') fputc('\\', out);
        fputc(*text, out);
    }
    fputc('"', out);
}

static void write_words(FILE *out, const char *field, const struct node *list) {
    if (!list) return;
    fprintf(out, ", .%s = (const char *const[]){", field);
    for (const struct node *item = list->first; item; item = item->next) {
        write_string(out, item->text);
        fputs(", ", out);
    }
    fputs("NULL}", out);
}

static void write_default(FILE *out, const struct node *key) {
    const struct node *value = get(key, "default");
    if (!value) return;
    fprintf(out, ", .has_default = true, .value = {");
    if (strcmp(text_of(key, "type"), "choice") == 0) fprintf(out, "%d", choice_index(key, value->text));
    else if (strcmp(text_of(key, "type"), "boolean") == 0) fputs(is_true(key, "default") ? "1" : "0", out);
    else if (value->kind == NODE_SEQUENCE)
        for (const struct node *item = value->first; item; item = item->next)
            fprintf(out, "%s%s", item->text, item->next ? ", " : "");
    else fprintf(out, "%s, %s, %s", value->text, value->text, value->text);
    fputc('}', out);
}

static void write_flag(FILE *out, const char *field, const struct node *key) {
    if (is_true(key, field)) fprintf(out, ", .%s = true", field);
}

static void write_limit(FILE *out, const char *field, const struct node *key) {
    const char *text = text_of(key, field);
    if (text) fprintf(out, ", .has_%s = true, .%s = %s", field, field, text);
}

static void write_text(FILE *out, const char *field, const char *text) {
    if (!text) return;
    fprintf(out, ",\n     .%s = ", field);
    write_string(out, text);
}

/* A slip in the definition would be a key without its default, or worse. */
static void check_fields(const struct node *key) {
    static const char *const known[] = {"type", "of", "default", "defaults_to", "min", "max", "above", "choices", "unit", "doc", "example",
                                        "alternative", "required", "named", "single", "excludes", "needs", "instead", "near"};
    if (key->kind != NODE_MAPPING || !text_of(key, "type") || !text_of(key, "doc")) fail(key, "a key needs a type and a doc");
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

static void write_key(FILE *out, const struct node *keys, const char *name, const struct node *key) {
    check_fields(key);
    check_keys_exist(keys, get(key, "excludes"));
    check_keys_exist(keys, get(key, "needs"));
    fprintf(out, "    {.name = \"%s\", .type = GRAMMAR_%s", name, upper(text_of(key, "type")));
    if (get(key, "of")) fprintf(out, ", .of = &grammar_kinds[KIND_%s]", upper(text_of(key, "of")));
    const char *flags[] = {"required", "alternative", "named", "single", "above"};
    for (size_t i = 0; i < sizeof flags / sizeof *flags; i++) write_flag(out, flags[i], key);
    const char *words[] = {"choices", "instead", "near", "excludes", "needs"};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) write_words(out, words[i], get(key, words[i]));
    write_default(out, key);
    write_limit(out, "min", key);
    write_limit(out, "max", key);
    write_text(out, "default_text", default_text(key));
    const char *texts[] = {"unit", "doc", "example"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) write_text(out, texts[i], text_of(key, texts[i]));
    fputs("},\n", out);
}

static void write_keys(FILE *out, const char *name, const struct node *kind) {
    fprintf(out, "static const struct grammar_key keys_%s[] = {\n", name);
    for (const struct node *k = get(kind, "keys")->first; k; k = k->next->next) write_key(out, get(kind, "keys"), k->text, k->next);
    fputs("};\n", out);
}

/* Bit i: key i has the field, and it is not false. */
static unsigned long long keys_with(const struct node *kind, const char *field) {
    unsigned long long mask = 0, bit = 1;
    for (const struct node *k = get(kind, "keys")->first; k; k = k->next->next, bit <<= 1) {
        const struct node *value = get(k->next, field);
        if (value && (value->kind != NODE_SCALAR || is_true(k->next, field))) mask |= bit;
    }
    return mask;
}

static void write_kind(FILE *out, const char *name, const struct node *kind) {
    fprintf(out, "    {\"%s\", ", name);
    write_string(out, text_of(kind, "title"));
    fputs(", ", out);
    write_string(out, text_of(kind, "doc"));
    fprintf(out, ", keys_%s, KEYS_%s, 0x%llx, 0x%llx, 0x%llx},\n", name, upper(name), keys_with(kind, "required"), keys_with(kind, "alternative"),
            keys_with(kind, "excludes") | keys_with(kind, "needs"));
}

static void write_colors(FILE *out, const struct node *colors) {
    fputs("const struct grammar_color grammar_colors[] = {\n", out);
    for (const struct node *k = colors->first; k; k = k->next->next) {
        const unsigned long rgb = strtoul(k->next->text + 1, NULL, 16);
        fprintf(out, "    {\"%s\", {%lu, %lu, %lu}},\n", k->text, rgb >> 16, rgb >> 8 & 255, rgb & 255);
    }
    fprintf(out, "};\nconst int grammar_color_count = %u;\n", (unsigned)colors->count);
}

static void check_function(const struct node *function) {
    static const char *const known[] = {"call", "arguments", "doc", "domain", "example", "gives", "instead"};
    const struct node *arguments = get(function, "arguments");
    if (!text_of(function, "call") || !text_of(function, "doc")) fail(function, "a function needs a call and a doc");
    if (!arguments || arguments->kind != NODE_SEQUENCE || arguments->count != 2) fail(function, "a function needs arguments: [least, most]");
    if (!get(function, "example") != !get(function, "gives")) fail(function, "an example needs what it gives");
    for (const struct node *field = function->first; field; field = field->next->next) {
        bool found = false;
        for (size_t i = 0; i < sizeof known / sizeof *known; i++) found |= strcmp(field->text, known[i]) == 0;
        if (!found) fail(field, "a function has no such field");
    }
}

static void write_function(FILE *out, const char *name, const struct node *function) {
    check_function(function);
    const struct node *least = get(function, "arguments")->first;
    fprintf(out, "    {.name = \"%s\", .least = %s, .most = %s", name, least->text, least->next->text);
    write_words(out, "instead", get(function, "instead"));
    const char *texts[] = {"call", "doc", "domain", "example", "gives"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) write_text(out, texts[i], text_of(function, texts[i]));
    fputs("},\n", out);
}

static void write_constant(FILE *out, const char *name, const struct node *constant) {
    if (!text_of(constant, "value") || !text_of(constant, "doc")) fail(constant, "a constant needs a value and a doc");
    fprintf(out, "    {\"%s\", %s, ", name, text_of(constant, "value"));
    write_string(out, text_of(constant, "doc"));
    fputs("},\n", out);
}

static void write_expressions(FILE *out, const struct node *expressions) {
    fputs("const struct grammar_function grammar_functions[] = {\n", out);
    for (const struct node *k = get(expressions, "functions")->first; k; k = k->next->next) write_function(out, k->text, k->next);
    fputs("};\nconst int grammar_function_count = FUNCTIONS;\nconst struct grammar_constant grammar_constants[] = {\n", out);
    for (const struct node *k = get(expressions, "constants")->first; k; k = k->next->next) write_constant(out, k->text, k->next);
    fprintf(out, "};\nconst int grammar_constant_count = %u;\n", (unsigned)get(expressions, "constants")->count);
}

/* A text file of the project as a string. */
static void write_file(FILE *out, const char *name, const struct source *source) {
    fprintf(out, "const char %s[] =", name);
    for (size_t i = 0; i < source->size;) {
        const char *line = source->text + i, *end = memchr(line, '\n', source->size - i);
        const size_t length = end ? (size_t)(end - line) : source->size - i;
        fputs("\n    ", out);
        write_string(out, arena_text(&arena, line, length));
        fputs(" \"\\n\"", out);
        i += length + 1;
    }
    fputs(";\n", out);
}

static void write_tables(FILE *out, const struct node *root, const struct node *expressions, const struct node *colors, const struct source *presets) {
    fputs("/* Generated from the files of grammar/ and from scenes/presets.yaml. */\n#include \"grammar_tables.h\"\n\n"
          "#include <stddef.h>\n\n#include \"lang/grammar.h\"\n\n", out);
    for_kinds(root, out, write_keys);
    fputs("const struct grammar_kind grammar_kinds[] = {\n", out);
    for_kinds(root, out, write_kind);
    fputs("};\nconst int grammar_kind_count = KINDS;\n", out);
    write_expressions(out, expressions);
    write_colors(out, colors);
    write_file(out, "grammar_presets", presets);
}

/* ---- The manual ---- */

static const char *type_text(const struct node *key) {
    const char *type = text_of(key, "type"), *of = text_of(key, "of");
    const char *link = of ? arena_format(&arena, "[%s](#%s)", of, of) : "";
    if (strcmp(type, "object") == 0) return is_true(key, "named") ? arena_format(&arena, "%s, or a name", link) : link;
    if (strcmp(type, "list") == 0) return arena_format(&arena, "list of %s", link);
    if (strcmp(type, "map") == 0) return arena_format(&arena, "names, each with a %s", link);
    if (strcmp(type, "point") == 0 || strcmp(type, "direction") == 0) return arena_format(&arena, "%s `[x, y, z]`", type);
    if (strcmp(type, "factors") == 0) return "number or `[x, y, z]`";
    if (strcmp(type, "amount") == 0) return "number or color";
    if (strcmp(type, "size") == 0) return "`[width, height]`";
    if (strcmp(type, "matrix") == 0) return "rows of four numbers";
    if (strcmp(type, "any") == 0) return "any value";
    if (strcmp(type, "values") == 0) return of ? arena_format(&arena, "names, each with a value or a %s", link) : "names, each with a value";
    if (strcmp(type, "ranges") == 0) return arena_format(&arena, "variables, each with a count, a list or a %s", link);
    if (strcmp(type, "condition") == 0) return "expression, true or false";
    if (strcmp(type, "name") == 0) return arena_format(&arena, "name of a %s", link);
    if (strcmp(type, "files") == 0) return "path, or list of paths";
    if (strcmp(type, "color") == 0 && of) return arena_format(&arena, "color or %s", link);
    if (strcmp(type, "choice") != 0) return type;
    char *words = "";
    for (const struct node *c = get(key, "choices")->first; c; c = c->next)
        words = arena_format(&arena, "%s`%s`%s", words, c->text, c->next ? ", " : "");
    return words;
}

static const char *range_text(const struct node *key) {
    const char *min = text_of(key, "min"), *max = text_of(key, "max"), *unit = text_of(key, "unit");
    const char *range = min && max              ? arena_format(&arena, "%s %s to %s", is_true(key, "above") ? "over" : "from", min, max)
                        : min && is_true(key, "above") ? arena_format(&arena, "over %s", min)
                        : min                          ? arena_format(&arena, "%s or more", min)
                                                       : "";
    return unit ? arena_format(&arena, "%s%s%s", range, *range ? ", " : "", unit) : range;
}

static bool is_later(const struct node *key) { return strcmp(text_of(key, "type"), "later") == 0; }

static void reference_kind(FILE *out, const char *name, const struct node *kind) {
    fprintf(out, "\n## %s\n\n%s\n", name, text_of(kind, "doc"));
    bool alternatives = false;
    for (const struct node *k = get(kind, "keys")->first; k; k = k->next->next) alternatives |= is_true(k->next, "alternative");
    if (alternatives) fprintf(out, "Exactly one of the keys marked with a dot (•) must be given.\n");
    fprintf(out, "\n| key | value | range | default | |\n| --- | --- | --- | --- | --- |\n");
    for (const struct node *k = get(kind, "keys")->first; k; k = k->next->next) {
        if (is_later(k->next)) continue;
        const char *otherwise = default_text(k->next);
        const char *example = text_of(k->next, "example");
        fprintf(out, "| `%s`%s | %s | %s | %s | %s%s |\n", k->text, is_true(k->next, "alternative") ? " •" : "",
                type_text(k->next), range_text(k->next),
                is_true(k->next, "required") ? "must be given" : otherwise ? otherwise : "-", text_of(k->next, "doc"),
                example ? arena_format(&arena, " `%s`", example) : "");
    }
}

static void reference_later(FILE *out, const char *name, const struct node *kind) {
    for (const struct node *k = get(kind, "keys")->first; k; k = k->next->next)
        if (is_later(k->next)) fprintf(out, "| `%s` | %s | %s |\n", k->text, name, text_of(k->next, "doc"));
}

static void reference_expressions(FILE *out, const struct node *expressions) {
    fputs("\n## Expressions\n\nWherever a number is expected, an expression may stand: numbers, colours, names, `[x, y, z]`, and, "
          "from what binds most to what binds least,\n\n"
          "| | |\n| --- | --- |\n"
          "| `v.x` `v.y` `v.z` `c.r` `c.g` `c.b` `v[i]` | parts of a vector or colour; i counts from 0 |\n"
          "| `a ^ b` | power, from right to left: `2 ^ 3 ^ 2` is `2 ^ 9`, `-2 ^ 2` is -4 |\n"
          "| `-a` `+a` `!a` | negative, itself, not |\n"
          "| `a * b` `a / b` `a % b` | product, quotient, the rest of it with the sign of b |\n"
          "| `a + b` `a - b` | sum, difference |\n"
          "| `a < b` `a <= b` `a > b` `a >= b` | comparisons; they give 1 or 0, and do not chain |\n"
          "| `a == b` `a != b` | equal, not equal |\n"
          "| `a && b` | and; b is not looked at where a is 0 |\n"
          "| `a \\|\\| b` | or; b is not looked at where a is not 0 |\n"
          "| `a ? b : c` | b where a is not 0, else c |\n\n"
          "Vectors go through arithmetic and through the functions of numbers part by part; a number meets a vector by being repeated. "
          "Angles are in degrees. Every result must be a finite number. `#rgb`, `#rrggbb` and the names of CSS are linear colours; a name "
          "of the scene comes before a constant or colour of the same name.\n\n"
          "| function | | example | gives |\n| --- | --- | --- | --- |\n", out);
    for (const struct node *k = get(expressions, "functions")->first; k; k = k->next->next) {
        check_function(k->next);
        const char *call = text_of(k->next, "call"), *doc = text_of(k->next, "doc");
        const char *domain = text_of(k->next, "domain"), *example = text_of(k->next, "example");
        fprintf(out, "| `%s` | %s%s |", call, doc,
                domain ? arena_format(&arena, " Takes %s.", domain) : "");
        if (example) fprintf(out, " `%s` | `%s` |\n", example, text_of(k->next, "gives"));
        else fputs(" | |\n", out);
    }
    fputs("\n| constant | | value |\n| --- | --- | --- |\n", out);
    for (const struct node *k = get(expressions, "constants")->first; k; k = k->next->next)
        fprintf(out, "| `%s` | %s | %s |\n", k->text, text_of(k->next, "doc"), text_of(k->next, "value"));
}

static void write_reference(FILE *out, const struct node *root, const struct node *expressions) {
    fputs("# Reference of the scene language\n\nGenerated from `language.yaml` and `functions.yaml`. A *color* is linear `[r, g, b]`, each 0 to 1, or sRGB: a string "
          "like `\"#ffd700\"` or a CSS name like `gold`. Angles are in degrees. A *point* is in the space of the object that has the key.\n", out);
    for_kinds(root, out, reference_kind);
    reference_expressions(out, expressions);
    fputs("\n## Words that are reserved\n\nThis version knows these words and says that they are not there yet.\n\n"
          "| word | in | for |\n| --- | --- | --- |\n", out);
    for_kinds(root, out, reference_later);
}

int main(int argc, char **argv) {
    if (argc != 4) {
        fprintf(stderr, "usage: grammar tables-header|tables|reference FOLDER OUT\n");
        return 2;
    }
    const struct node *root = read_file(argv[2], "language.yaml"), *colors = read_file(argv[2], "colors.yaml");
    const struct node *expressions = read_file(argv[2], "functions.yaml");
    FILE *out = fopen(argv[3], "w");
    if (!out) {
        perror(argv[3]);
        return 2;
    }
    if (strcmp(argv[1], "tables-header") == 0) write_header(out, root, expressions);
    else if (strcmp(argv[1], "tables") == 0) write_tables(out, root, expressions, colors, read_source(argv[2], "../scenes/presets.yaml"));
    else write_reference(out, root, expressions);
    const bool written = fclose(out) == 0;
    if (!written) remove(argv[3]);
    arena_free(&arena);
    return written ? 0 : 2;
}
