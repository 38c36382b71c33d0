#include <string.h>

#include "schema.h"

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
    return format("{\"if\": {\"type\": \"string\"}, \"then\": {\"type\": \"%s\", \"errorMessage\": \"not a "
                  "%s, and there are no "
                  "parameters\"}, \"else\": %s}",
                  type, strcmp(type, "array") == 0 ? "list" : "mapping", rest);
}

static const char *plain_list(const struct node *key, const char *plain) {
    const char *items = format("{\"items\": %s}", no_text("object", plain));
    return no_text("array", is_true(key, "single") ? format("{\"allOf\": [%s, %s]}", items, plain) : items);
}

static void write_plain_choice(struct emitter *j, const struct node *key) {
    emit_open(j, '{');
    emit_field(j, "if", "{\"type\": \"string\"}");
    emit_key(j, "then");
    emit_open(j, '{');
    write_enum(j, get(key, "choices"));
    emit_close(j, '}');
    emit_close(j, '}');
}

/* doNotSuggest: the other layer does. */
static void write_plain_key(struct emitter *j, const struct node *key) {
    const char *of = text_of(key, "of"), *plain = of ? reference_to(format("plain_%s", of)) : NULL;
    emit_open(j, '{');
    emit_field(j, "doNotSuggest", "true");
    emit_key(j, "allOf");
    emit_open(j, '[');
    if (type_is(key, "boolean"))
        emit_raw(j, "{\"if\": {\"type\": \"string\"}, \"then\": {\"pattern\": \"^(true|false)$\", "
                    "\"patternErrorMessage\": \"not true or false, and there are no parameters\"}}");
    else if (type_is(key, "map"))
        emit_raw(j, format("{\"additionalProperties\": %s}", no_text("object", plain)));
    else if (type_is(key, "object"))
        emit_raw(j, is_true(key, "named") ? plain : no_text("object", plain));
    else if (type_is(key, "list"))
        emit_raw(j, plain_list(key, plain));
    else
        write_plain_choice(j, key);
    emit_close(j, ']');
    emit_close(j, '}');
}

static void write_plain_keys(struct emitter *j, const struct node *kind) {
    emit_key(j, "properties");
    emit_open(j, '{');
    for (const struct node *k = keys_of(kind); k; k = k->next->next) {
        if (!is_plain_mapping(k->next) && !type_is(k->next, "boolean") && !type_is(k->next, "choice"))
            continue;
        emit_key(j, k->text);
        write_plain_key(j, k->next);
    }
    emit_close(j, '}');
}

void write_plain(struct emitter *j, const char *name, const struct node *kind) {
    char *names = "";
    for (const struct node *k = keys_of(kind); k; k = k->next->next)
        if (brings_names(k->next))
            names = format("%s%s{\"required\": [\"%s\"]}", names, *names ? ", " : "", k->text);
    emit_key(j, format("plain_%s", name));
    emit_open(j, '{');
    if (*names) {
        emit_field(j, "if", format("{\"anyOf\": [%s]}", names));
        emit_key(j, "else");
        emit_open(j, '{');
    }
    write_plain_keys(j, kind);
    if (*names) emit_close(j, '}');
    emit_close(j, '}');
}
