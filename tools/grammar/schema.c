/* The JSON Schema of scenes, draft-07, for editors.
 *
 * A schema cannot know what names stand for: wherever a value is a word, it may be the name of a parameter
 * or a loop variable. So there are two layers. The definitions allow a word in place of anything; those that
 * begin with `plain_` refuse it again for a scene, or an object in it, that brings in no names.
 *
 * What yaml-language-server completes, it finds in `properties` and `enum`; its diagnostics stand at the
 * right place where no two ways to read a value compete, so `if` is used rather than `anyOf`. errorMessage,
 * patternErrorMessage and doNotSuggest are its own. */
#include <stdlib.h>
#include <string.h>

#include "definition.h"
#include "json.h"

static void write_pair(struct json *j, const char *key, const char *text) {
    json_key(j, key);
    json_text(j, text);
}

static void write_raw(struct json *j, const char *key, const char *json) {
    json_key(j, key);
    json_raw(j, json);
}

static const char *reference_to(const char *definition) {
    return format("{\"$ref\": \"#/definitions/%s\"}", definition);
}

static void write_all_of(struct json *j, const char *definition) {
    write_raw(j, "allOf", format("[%s]", reference_to(definition)));
}

/* A word may stand for it. */
static void write_word(struct json *j, const char *what) {
    write_pair(j, "pattern", "^[A-Za-z_][A-Za-z0-9_]*$");
    write_pair(j, "patternErrorMessage", format("not %s, and not a name", what));
}

/* ---- Values by the type of their key ---- */

static void write_limits(struct json *j, const struct node *key) {
    const char *min = text_of(key, "min"), *max = text_of(key, "max");
    if (min) write_raw(j, is_true(key, "above") ? "exclusiveMinimum" : "minimum", min);
    if (max) write_raw(j, "maximum", max);
}

static bool only_digits(const struct node *words) {
    for (const struct node *c = words->first; c; c = c->next)
        if (c->text[strspn(c->text, "0123456789")]) return false;
    return true;
}

/* A choice like 8 may be written as a number or as a text. */
static void write_enum(struct json *j, const struct node *choices) {
    json_key(j, "enum");
    json_open(j, '[');
    if (only_digits(choices))
        for (const struct node *c = choices->first; c; c = c->next) json_raw(j, c->text);
    for (const struct node *c = choices->first; c; c = c->next) json_text(j, c->text);
    json_close(j, ']');
}

static void write_choice(struct json *j, const struct node *key) {
    json_key(j, "anyOf");
    json_open(j, '[');
    json_open(j, '{');
    write_enum(j, get(key, "choices"));
    json_close(j, '}');
    json_raw(j, reference_to("word"));
    json_close(j, ']');
}

static void write_number(struct json *j, const struct node *key) {
    const char *type = text_of(key, "type");
    write_raw(j, "type", format("[\"%s\", \"string\", \"object\"]", type));
    write_limits(j, key);
    write_all_of(j, type);
}

static void write_size(struct json *j, const struct node *key) {
    json_key(j, "items");
    json_open(j, '{');
    write_limits(j, key);
    json_close(j, '}');
    write_all_of(j, "size");
}

/* A mapping of another kind than keyframes may stand for some. Bytes are what people paste. */
static void write_color(struct json *j, const struct node *key) {
    if (get(key, "max"))
        write_raw(j, "not",
                  "{\"type\": \"array\", \"items\": {\"type\": \"integer\", \"maximum\": 255}, "
                  "\"contains\": {\"type\": \"integer\", \"minimum\": 3}}");
    if (!get(key, "of")) {
        write_all_of(j, "color");
        return;
    }
    write_raw(j, "if", "{\"type\": \"object\", \"not\": {\"required\": [\"keys\"]}}");
    write_raw(j, "then", reference_to(text_of(key, "of")));
    write_raw(j, "else", reference_to("color"));
}

static void write_object(struct json *j, const struct node *key) {
    const char *kind = text_of(key, "of");
    if (!is_true(key, "named")) {
        write_pair(j, "$ref", format("#/definitions/%s", kind));
        return;
    }
    write_raw(j, "if", "{\"type\": [\"string\", \"number\", \"boolean\"]}");
    write_raw(j, "then", reference_to("name"));
    write_raw(j, "else", reference_to(kind));
}

static void write_list(struct json *j, const struct node *key) {
    const bool single = is_true(key, "single");
    const char *item = reference_to(text_of(key, "of"));
    write_raw(j, "type", single ? "[\"array\", \"object\", \"string\"]" : "[\"array\", \"string\"]");
    write_word(j, "a list");
    write_raw(j, "items", item);
    if (!single) return;
    write_raw(j, "if", "{\"type\": \"object\"}");
    write_raw(j, "then", item);
}

static void write_map(struct json *j, const struct node *key) {
    write_raw(j, "type", "\"object\"");
    write_raw(j, "additionalProperties", reference_to(text_of(key, "of")));
}

/* A parameter's default alone, or a mapping that has it. */
static void write_values(struct json *j, const struct node *key) {
    if (get(key, "of"))
        write_raw(j, "additionalProperties",
                  format("{\"if\": {\"type\": \"object\", \"required\": [\"default\"]}, \"then\": %s}",
                         reference_to(text_of(key, "of"))));
    write_all_of(j, "values");
}

static void write_later(struct json *j, const char *name, const struct node *key) {
    write_raw(j, "type", "\"null\""); /* nothing is right, and errorMessage says why */
    write_raw(j, "not", "{\"type\": \"null\"}");
    write_pair(j, "errorMessage", format("`%s` is not there yet: %s", name, text_of(key, "doc")));
    write_raw(j, "doNotSuggest", "true");
}

static void write_type(struct json *j, const char *name, const struct node *key) {
    if (type_is(key, "number") || type_is(key, "integer"))
        write_number(j, key);
    else if (type_is(key, "choice"))
        write_choice(j, key);
    else if (type_is(key, "size"))
        write_size(j, key);
    else if (type_is(key, "color"))
        write_color(j, key);
    else if (type_is(key, "object"))
        write_object(j, key);
    else if (type_is(key, "list"))
        write_list(j, key);
    else if (type_is(key, "map"))
        write_map(j, key);
    else if (type_is(key, "values"))
        write_values(j, key);
    else if (type_is(key, "later"))
        write_later(j, name, key);
    else
        write_all_of(j, text_of(key, "type"));
}

/* ---- Keys ---- */

/* The example's value, where the example is `key: value`. */
static const struct node *example_value(const char *name, const struct node *key) {
    const struct node *example = get(key, "example") ? parse_text(text_of(key, "example")) : NULL;
    return example && example->kind == NODE_MAPPING ? get(example, name) : NULL;
}

static void write_docs(struct json *j, const char *name, const struct node *key) {
    const char *range = range_text(key), *otherwise = default_text(key);
    const struct node *example = example_value(name, key);
    write_pair(j, "description", text_of(key, "doc"));
    const char *facts = format("*%s*%s%s%s", type_text(key, false), *range ? ", " : "", range,
                               otherwise                  ? format("; default: %s", otherwise)
                               : is_true(key, "required") ? "; must be given"
                                                          : "");
    write_pair(j, "markdownDescription", format("%s\n\n%s", text_of(key, "doc"), facts));
    if (get(key, "default")) {
        json_key(j, "default");
        json_node(j, get(key, "default"));
    }
    if (!example) return;
    json_key(j, "examples");
    json_open(j, '[');
    json_node(j, example);
    json_close(j, ']');
}

static void write_key(struct json *j, const char *name, const struct node *key) {
    json_key(j, name);
    json_open(j, '{');
    write_docs(j, name, key);
    write_type(j, name, key);
    json_close(j, '}');
}

/* ---- Kinds ---- */

static void write_required(struct json *j, const struct node *kind) {
    char *names = "";
    for (const struct node *k = keys_of(kind); k; k = k->next->next)
        if (is_true(k->next, "required")) names = format("%s%s\"%s\"", names, *names ? ", " : "", k->text);
    if (*names) write_raw(j, "required", format("[%s]", names));
}

static bool is_alternative(const struct node *key) {
    return is_true(key, "alternative") && !type_is(key, "later");
}

/* The alternatives with `part` before and `after` behind each. */
static const char *alternatives(const struct node *kind, const char *before, const char *after,
                                const char *between) {
    char *all = "";
    for (const struct node *k = keys_of(kind); k; k = k->next->next)
        if (is_alternative(k->next))
            all = format("%s%s%s%s%s", all, *all ? between : "", before, k->text, after);
    return all;
}

/* At least one of them; that it is one at most, the dependencies say. */
static void write_alternatives(struct json *j, const struct node *kind) {
    const char *words = alternatives(kind, "", "", ", ");
    const char *message =
        format("\"], \"errorMessage\": \"%s needs one of %s\"}", text_of(kind, "title"), words);
    if (*words)
        write_raw(j, "anyOf", format("[%s]", alternatives(kind, "{\"required\": [\"", message, ", ")));
}

/* What must, or must not, stand beside the key. */
static const char *dependency(const struct node *kind, const char *name, const struct node *key) {
    const struct node *excludes = get(key, "excludes"), *needs = get(key, "needs");
    char *parts = "";
    if (is_alternative(key))
        parts = format("{\"patternProperties\": {\"^(?!%s$)(%s)$\": false}, \"errorMessage\": \"`%s` is "
                       "given: %s is one of them\"}",
                       name, alternatives(kind, "", "", "|"), name, text_of(kind, "title"));
    for (const struct node *other = excludes ? excludes->first : NULL; other; other = other->next)
        parts = format("%s%s{\"properties\": {\"%s\": false}, \"errorMessage\": \"contradicts `%s`\"}", parts,
                       *parts ? ", " : "", other->text, name);
    for (const struct node *other = needs ? needs->first : NULL; other; other = other->next)
        parts = format("%s%s{\"required\": [\"%s\"]}", parts, *parts ? ", " : "", other->text);
    return *parts ? format("{\"allOf\": [%s]}", parts) : NULL;
}

static void write_dependencies(struct json *j, const struct node *kind) {
    bool any = false;
    for (const struct node *k = keys_of(kind); k; k = k->next->next)
        any |= dependency(kind, k->text, k->next) != NULL;
    if (!any) return;
    json_key(j, "dependencies");
    json_open(j, '{');
    for (const struct node *k = keys_of(kind); k; k = k->next->next)
        if (dependency(kind, k->text, k->next)) write_raw(j, k->text, dependency(kind, k->text, k->next));
    json_close(j, '}');
}

static void write_kind(struct json *j, const struct node *kind) {
    write_pair(j, "description", text_of(kind, "doc"));
    write_required(j, kind);
    write_alternatives(j, kind);
    write_dependencies(j, kind);
    write_raw(j, "additionalProperties", "false");
    json_key(j, "properties");
    json_open(j, '{');
    for (const struct node *k = keys_of(kind); k; k = k->next->next) write_key(j, k->text, k->next);
    json_close(j, '}');
}

/* A kind but the file's: a word may stand for the mapping. */
static void write_definition(struct json *j, const char *name, const struct node *kind) {
    json_key(j, name);
    json_open(j, '{');
    write_pair(j, "title", text_of(kind, "title"));
    write_raw(j, "type", "[\"object\", \"string\"]");
    write_word(j, format("%s, which is a mapping", text_of(kind, "title")));
    write_kind(j, kind);
    json_close(j, '}');
}

/* ---- Where there are no names ---- */

static bool is_plain_mapping(const struct node *key) {
    return type_is(key, "object") || type_is(key, "list") || type_is(key, "map");
}

/* Whether the key brings names into its mapping. */
static bool brings_names(const struct node *key) {
    const char *of = text_of(key, "of");
    const bool named =
        of && (strcmp(of, "param") == 0 || strcmp(of, "template") == 0 || strcmp(of, "animation") == 0);
    return type_is(key, "files") || type_is(key, "ranges") || named;
}

/* Where a text stands, it should have been of that type; else the rest. */
static const char *no_text(const char *type, const char *rest) {
    return format("{\"if\": {\"type\": \"string\"}, \"then\": {\"type\": \"%s\"}, \"else\": %s}", type, rest);
}

static void write_plain_key(struct json *j, const struct node *key) {
    const char *of = text_of(key, "of"), *plain = of ? reference_to(format("plain_%s", of)) : NULL;
    if (type_is(key, "boolean"))
        json_raw(j, no_text("boolean", "true"));
    else if (type_is(key, "map"))
        json_raw(j, format("{\"additionalProperties\": %s}", no_text("object", plain)));
    else if (type_is(key, "object"))
        json_raw(j, is_true(key, "named") ? plain : no_text("object", plain));
    else if (type_is(key, "list")) {
        const char *items = format("{\"items\": %s}", no_text("object", plain));
        json_raw(j, no_text("array",
                            is_true(key, "single") ? format("{\"allOf\": [%s, %s]}", items, plain) : items));
    } else {
        json_open(j, '{');
        write_raw(j, "if", "{\"type\": \"string\"}");
        json_key(j, "then");
        json_open(j, '{');
        write_enum(j, get(key, "choices"));
        json_close(j, '}');
        json_close(j, '}');
    }
}

static void write_plain_keys(struct json *j, const struct node *kind) {
    json_key(j, "properties");
    json_open(j, '{');
    for (const struct node *k = keys_of(kind); k; k = k->next->next) {
        if (!is_plain_mapping(k->next) && !type_is(k->next, "boolean") && !type_is(k->next, "choice"))
            continue;
        json_key(j, k->text);
        write_plain_key(j, k->next);
    }
    json_close(j, '}');
}

static void write_plain(struct json *j, const char *name, const struct node *kind) {
    char *names = "";
    for (const struct node *k = keys_of(kind); k; k = k->next->next)
        if (brings_names(k->next))
            names = format("%s%s{\"required\": [\"%s\"]}", names, *names ? ", " : "", k->text);
    json_key(j, format("plain_%s", name));
    json_open(j, '{');
    if (*names) {
        write_raw(j, "if", format("{\"anyOf\": [%s]}", names));
        json_key(j, "else");
        json_open(j, '{');
    }
    write_plain_keys(j, kind);
    if (*names) json_close(j, '}');
    json_close(j, '}');
}

/* ---- The whole ---- */

void write_schema(FILE *out, const struct definition *language) {
    struct json j = {.out = out, .lines = 4};
    const struct node *file = language->kinds->first;
    json_open(&j, '{');
    write_pair(&j, "$schema", "http://json-schema.org/draft-07/schema#");
    write_pair(&j, "title", "a scene of Monge");
    write_pair(&j, "$comment", "Generated from grammar/language.yaml and grammar/types.yaml.");
    write_raw(&j, "type", "\"object\"");
    write_kind(&j, file->next);
    write_all_of(&j, "plain_file");
    json_key(&j, "definitions");
    json_open(&j, '{');
    for (const struct node *k = language->types->first; k; k = k->next->next) {
        json_key(&j, k->text);
        json_node(&j, k->next);
    }
    for (const struct node *k = file->next->next; k; k = k->next->next)
        write_definition(&j, k->text, k->next);
    for (const struct node *k = language->kinds->first; k; k = k->next->next)
        write_plain(&j, k->text, k->next);
    json_close(&j, '}');
    json_close(&j, '}');
    fputc('\n', out);
}

void write_schema_source(FILE *out, const struct definition *language) {
    char *text = NULL;
    size_t size = 0;
    FILE *memory = open_memstream(&text, &size);
    if (!memory) exit(2);
    write_schema(memory, language);
    if (fclose(memory) != 0) exit(2);
    fputs("/* Generated from grammar/language.yaml and grammar/types.yaml. */\n#include "
          "\"lang/manual.h\"\n\nconst char lang_schema[] =\n    \"",
          out);
    for (const char *c = text; *c; c++) {
        if (*c == '"' || *c == '\\') fputc('\\', out);
        if (*c != '\n')
            fputc(*c, out);
        else
            fputs(c[1] ? "\\n\"\n    \"" : "\\n", out);
    }
    fputs("\";\n", out);
    free(text);
}
