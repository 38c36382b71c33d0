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
#include "schema.h"

static const struct node *types; /* of the definition */

const char *reference_to(const char *definition) {
    return format("{\"$ref\": \"#/definitions/%s\"}", definition);
}

/* The values of types.yaml. Editors look at the key's own `type` for what to insert. */
static void write_shared(struct emitter *j, const char *type) {
    const struct node *allowed = get(get(types, type), "type");
    if (allowed) {
        emit_key(j, "type");
        emit_node(j, allowed);
    }
    emit_field(j, "allOf", format("[%s]", reference_to(type)));
}

/* A word may stand for it. */
static void write_word(struct emitter *j, const char *what) {
    emit_pair(j, "pattern", text_of(get(types, "word"), "pattern"));
    emit_pair(j, "patternErrorMessage", format("not %s, and not a name", what));
}

/* ---- What people read ---- */

static bool has_mapping(const struct node *node) {
    bool found = node->kind == NODE_MAPPING;
    for (const struct node *item = node->kind == NODE_SEQUENCE ? node->first : NULL; item; item = item->next)
        found |= has_mapping(item);
    return found;
}

/* The example's value, where the example is `key: value`. NULL: none, or one that is no help where editors
 * make a template of it. */
static const struct node *example_value(const char *name, const struct node *key) {
    const struct node *example = get(key, "example") ? parse_text(text_of(key, "example")) : NULL;
    const struct node *value = example && example->kind == NODE_MAPPING ? get(example, name) : NULL;
    return value && !has_mapping(value) ? value : NULL;
}

/* A row is better written in one line than as editors would. */
static void write_snippet(struct emitter *j, const struct node *row) {
    if (!row || row->kind != NODE_SEQUENCE) return;
    char *text = "";
    int stop = 0;
    for (const struct node *item = row->first; item; item = item->next) {
        if (item->kind != NODE_SCALAR) return;
        text = format("%s%s${%d:%s}", text, stop ? ", " : "", stop + 1, item->text);
        stop++;
    }
    emit_key(j, "defaultSnippets");
    emit_open(j, '[');
    emit_open(j, '{');
    emit_pair(j, "label", row_text(row));
    emit_pair(j, "body", format("[%s]", text));
    emit_close(j, '}');
    emit_close(j, ']');
}

static void write_docs(struct emitter *j, const char *name, const struct node *key) {
    const char *range = range_text(key), *otherwise = default_text(key);
    const struct node *example = example_value(name, key);
    emit_pair(j, "description", text_of(key, "doc"));
    const char *facts = format("*%s*%s%s%s", type_text(key, false), *range ? ", " : "", range,
                               otherwise                  ? format("; default: %s", otherwise)
                               : is_true(key, "required") ? "; must be given"
                                                          : "");
    const char *shown =
        get(key, "example") && !example ? format("\n\nExample: `%s`", text_of(key, "example")) : "";
    emit_pair(j, "markdownDescription", format("%s\n\n%s%s", text_of(key, "doc"), facts, shown));
    if (get(key, "default")) {
        emit_key(j, "default");
        emit_node(j, get(key, "default"));
    }
    write_snippet(j, get(key, "default") ? get(key, "default") : example);
    if (!example) return;
    emit_key(j, "examples");
    emit_open(j, '[');
    emit_node(j, example);
    emit_close(j, ']');
}

/* ---- Values by the type of their key ---- */

static void write_limits(struct emitter *j, const struct node *key) {
    const char *min = text_of(key, "min"), *max = text_of(key, "max");
    if (min) emit_field(j, is_true(key, "above") ? "exclusiveMinimum" : "minimum", min);
    if (max) emit_field(j, "maximum", max);
}

static bool only_digits(const struct node *words) {
    for (const struct node *c = words->first; c; c = c->next)
        if (c->text[strspn(c->text, "0123456789")]) return false;
    return true;
}

/* A choice like 8 may be written as a number or as a text. */
void write_enum(struct emitter *j, const struct node *choices) {
    emit_key(j, "enum");
    emit_open(j, '[');
    if (only_digits(choices))
        for (const struct node *c = choices->first; c; c = c->next) emit_raw(j, c->text);
    for (const struct node *c = choices->first; c; c = c->next) emit_text(j, c->text);
    emit_close(j, ']');
}

static void write_choice(struct emitter *j, const struct node *key) {
    emit_key(j, "anyOf");
    emit_open(j, '[');
    emit_open(j, '{');
    write_enum(j, get(key, "choices"));
    emit_close(j, '}');
    emit_raw(j, reference_to("word"));
    emit_close(j, ']');
}

static void write_number(struct emitter *j, const struct node *key) {
    write_limits(j, key);
    write_shared(j, text_of(key, "type"));
}

static void write_size(struct emitter *j, const struct node *key) {
    emit_key(j, "items");
    emit_open(j, '{');
    write_limits(j, key);
    emit_close(j, '}');
    write_shared(j, "size");
}

/* A mapping of another kind than keyframes may stand for some. */
static void write_color(struct emitter *j, const struct node *key) {
    const char *color = reference_to("color");
    if (get(key, "max")) color = format("%s, %s", reference_to("no_bytes"), color);
    if (get(key, "of")) {
        color = format("{\"if\": {\"type\": \"object\", \"not\": {\"required\": [\"keys\"]}}, \"then\": %s, "
                       "\"else\": {\"allOf\": [%s]}}",
                       reference_to(text_of(key, "of")), color);
        emit_field(j, "anyOf",
                   format("[%s, {}]", reference_to("color_name"))); /* editors offer nothing of an `else` */
    }
    emit_field(j, "type", "[\"array\", \"string\", \"object\"]");
    emit_field(j, "allOf", format("[%s]", color));
}

static void write_object(struct emitter *j, const char *name, const struct node *key) {
    const char *kind = text_of(key, "of");
    if (!is_true(key, "named")) {
        emit_pair(j, "$ref", format("#/definitions/%s", kind));
        return;
    }
    emit_field(j, "type", "[\"object\", \"string\", \"number\", \"boolean\"]");
    emit_field(j, "if", "{\"type\": \"object\"}");
    emit_key(j, "then");
    emit_open(j, '{');
    write_docs(j, name, key); /* else the kind's are shown */
    emit_pair(j, "$ref", format("#/definitions/%s", kind));
    emit_close(j, '}');
    emit_field(j, "else", reference_to("name"));
}

static void write_list(struct emitter *j, const struct node *key) {
    const bool single = is_true(key, "single");
    const char *item = reference_to(text_of(key, "of"));
    emit_field(j, "type", single ? "[\"array\", \"object\", \"string\"]" : "[\"array\", \"string\"]");
    write_word(j, "a list");
    emit_field(j, "items", item);
    if (!single) return;
    emit_field(j, "if", "{\"type\": \"object\"}");
    emit_field(j, "then", item);
}

static void write_map(struct emitter *j, const struct node *key) {
    emit_field(j, "type", "\"object\"");
    emit_field(j, "additionalProperties", reference_to(text_of(key, "of")));
}

/* A parameter's default alone, or a mapping that has it. */
static void write_values(struct emitter *j, const struct node *key) {
    if (get(key, "of")) {
        emit_field(j, "propertyNames", reference_to("word"));
        emit_field(j, "additionalProperties",
                   format("{\"if\": {\"type\": \"object\", \"required\": [\"default\"]}, \"then\": %s}",
                          reference_to(text_of(key, "of"))));
    }
    write_shared(j, "values");
}

static void write_later(struct emitter *j, const char *name, const struct node *key) {
    emit_field(j, "type", "\"null\""); /* nothing is right, and errorMessage says why */
    emit_field(j, "not", "{\"type\": \"null\"}");
    emit_pair(j, "errorMessage", format("`%s` is not there yet: %s", name, text_of(key, "doc")));
    emit_field(j, "doNotSuggest", "true");
}

static void write_type(struct emitter *j, const char *name, const struct node *key) {
    if (type_is(key, "number") || type_is(key, "integer"))
        write_number(j, key);
    else if (type_is(key, "choice"))
        write_choice(j, key);
    else if (type_is(key, "size"))
        write_size(j, key);
    else if (type_is(key, "color"))
        write_color(j, key);
    else if (type_is(key, "object"))
        write_object(j, name, key);
    else if (type_is(key, "list"))
        write_list(j, key);
    else if (type_is(key, "map"))
        write_map(j, key);
    else if (type_is(key, "values"))
        write_values(j, key);
    else if (type_is(key, "later"))
        write_later(j, name, key);
    else
        write_shared(j, text_of(key, "type"));
}

static void write_key(struct emitter *j, const char *name, const struct node *key) {
    emit_key(j, name);
    emit_open(j, '{');
    write_docs(j, name, key);
    write_type(j, name, key);
    emit_close(j, '}');
}

/* ---- Kinds ---- */

static void write_required(struct emitter *j, const struct node *kind) {
    char *names = "";
    for (const struct node *k = keys_of(kind); k; k = k->next->next)
        if (is_true(k->next, "required")) names = format("%s%s\"%s\"", names, *names ? ", " : "", k->text);
    if (*names) emit_field(j, "required", format("[%s]", names));
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
static void write_alternatives(struct emitter *j, const struct node *kind) {
    const char *words = alternatives(kind, "", "", ", ");
    const char *message =
        format("\"], \"errorMessage\": \"%s needs one of %s\"}", text_of(kind, "title"), words);
    if (*words)
        emit_field(j, "anyOf", format("[%s]", alternatives(kind, "{\"required\": [\"", message, ", ")));
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

static void write_dependencies(struct emitter *j, const struct node *kind) {
    bool any = false;
    for (const struct node *k = keys_of(kind); k; k = k->next->next)
        any |= dependency(kind, k->text, k->next) != NULL;
    if (!any) return;
    emit_key(j, "dependencies");
    emit_open(j, '{');
    for (const struct node *k = keys_of(kind); k; k = k->next->next)
        if (dependency(kind, k->text, k->next)) emit_field(j, k->text, dependency(kind, k->text, k->next));
    emit_close(j, '}');
}

static void write_kind(struct emitter *j, const struct node *kind) {
    emit_pair(j, "description", text_of(kind, "doc"));
    write_required(j, kind);
    write_alternatives(j, kind);
    write_dependencies(j, kind);
    emit_field(j, "additionalProperties", "false");
    emit_key(j, "properties");
    emit_open(j, '{');
    for (const struct node *k = keys_of(kind); k; k = k->next->next) write_key(j, k->text, k->next);
    emit_close(j, '}');
}

/* A kind but the file's: a word may stand for the mapping. */
static void write_definition(struct emitter *j, const char *name, const struct node *kind) {
    emit_key(j, name);
    emit_open(j, '{');
    emit_pair(j, "title", text_of(kind, "title"));
    emit_field(j, "type", "[\"object\", \"string\"]");
    write_word(j, format("%s, which is a mapping", text_of(kind, "title")));
    write_kind(j, kind);
    emit_close(j, '}');
}

/* ---- The whole ---- */

static void write_color_names(struct emitter *j, const struct node *colors) {
    emit_key(j, "color_name");
    emit_open(j, '{');
    emit_key(j, "enum");
    emit_open(j, '[');
    for (const struct node *k = colors->first; k; k = k->next->next) emit_text(j, k->text);
    emit_close(j, ']');
    emit_close(j, '}');
}

void write_schema(FILE *out, const struct definition *language) {
    struct emitter j = {.out = out, .lines = 4};
    const struct node *file = language->kinds->first;
    types = language->types;
    emit_open(&j, '{');
    emit_pair(&j, "$schema", "http://json-schema.org/draft-07/schema#");
    emit_pair(&j, "title", "a scene of Monge");
    emit_pair(&j, "$comment", "Generated from grammar/language.yaml and grammar/types.yaml.");
    emit_field(&j, "type", "\"object\"");
    write_kind(&j, file->next);
    emit_field(&j, "allOf", format("[%s]", reference_to("plain_file")));
    emit_key(&j, "definitions");
    emit_open(&j, '{');
    write_color_names(&j, language->colors);
    for (const struct node *k = language->types->first; k; k = k->next->next) {
        emit_key(&j, k->text);
        emit_node(&j, k->next);
    }
    for (const struct node *k = file->next->next; k; k = k->next->next)
        write_definition(&j, k->text, k->next);
    for (const struct node *k = language->kinds->first; k; k = k->next->next)
        write_plain(&j, k->text, k->next);
    emit_close(&j, '}');
    emit_close(&j, '}');
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
