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

static void write_plain_choice(struct json *j, const struct node *key) {
    json_open(j, '{');
    json_field(j, "if", "{\"type\": \"string\"}");
    json_key(j, "then");
    json_open(j, '{');
    write_enum(j, get(key, "choices"));
    json_close(j, '}');
    json_close(j, '}');
}

/* doNotSuggest: the other layer does. */
static void write_plain_key(struct json *j, const struct node *key) {
    const char *of = text_of(key, "of"), *plain = of ? reference_to(format("plain_%s", of)) : NULL;
    json_open(j, '{');
    json_field(j, "doNotSuggest", "true");
    json_key(j, "allOf");
    json_open(j, '[');
    if (type_is(key, "boolean"))
        json_raw(j, "{\"if\": {\"type\": \"string\"}, \"then\": {\"pattern\": \"^(true|false)$\", "
                    "\"patternErrorMessage\": \"not true or false, and there are no parameters\"}}");
    else if (type_is(key, "map"))
        json_raw(j, format("{\"additionalProperties\": %s}", no_text("object", plain)));
    else if (type_is(key, "object"))
        json_raw(j, is_true(key, "named") ? plain : no_text("object", plain));
    else if (type_is(key, "list"))
        json_raw(j, plain_list(key, plain));
    else
        write_plain_choice(j, key);
    json_close(j, ']');
    json_close(j, '}');
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

void write_plain(struct json *j, const char *name, const struct node *kind) {
    char *names = "";
    for (const struct node *k = keys_of(kind); k; k = k->next->next)
        if (brings_names(k->next))
            names = format("%s%s{\"required\": [\"%s\"]}", names, *names ? ", " : "", k->text);
    json_key(j, format("plain_%s", name));
    json_open(j, '{');
    if (*names) {
        json_field(j, "if", format("{\"anyOf\": [%s]}", names));
        json_key(j, "else");
        json_open(j, '{');
    }
    write_plain_keys(j, kind);
    if (*names) json_close(j, '}');
    json_close(j, '}');
}
