#include <stdlib.h>
#include <string.h>

#include "definition.h"

/* The position among the choices. */
static int choice_index(const struct node *key, const char *word) {
    int index = 0;
    for (const struct node *c = get(key, "choices")->first; strcmp(c->text, word) != 0; c = c->next) index++;
    return index;
}

/* Calls `each` on every kind. */
static void for_kinds(const struct definition *language, FILE *out,
                      void (*each)(FILE *, const char *name, const struct node *kind)) {
    for (const struct node *k = language->kinds->first; k; k = k->next->next) each(out, k->text, k->next);
}

/* ---- The header ---- */

static void header_kind(FILE *out, const char *name, const struct node *kind) {
    const char *kind_name = upper(name);
    fprintf(out, "enum {\n");
    for (const struct node *k = keys_of(kind); k; k = k->next->next)
        fprintf(out, "    KEY_%s_%s,\n", kind_name, upper(k->text));
    fprintf(out, "    KEYS_%s\n};\n", kind_name);
    for (const struct node *k = keys_of(kind); k; k = k->next->next) {
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

void write_header(FILE *out, const struct definition *language) {
    fprintf(out, "/* Generated from grammar/language.yaml and grammar/functions.yaml. */\n#ifndef "
                 "GRAMMAR_TABLES_H\n#define "
                 "GRAMMAR_TABLES_H\n\nenum {\n");
    for_kinds(language, out, header_kind_name);
    fprintf(out, "    KINDS\n};\n\n");
    for_kinds(language, out, header_kind);
    fprintf(out, "\nenum {\n");
    for (const struct node *k = language->functions->first; k; k = k->next->next)
        fprintf(out, "    FUNCTION_%s,\n", upper(k->text));
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
        if (*text == '\n')
            fputs("\\n", out);
        else
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
    if (type_is(key, "choice"))
        fprintf(out, "%d", choice_index(key, value->text));
    else if (type_is(key, "boolean"))
        fputs(is_true(key, "default") ? "1" : "0", out);
    else if (value->kind == NODE_SEQUENCE)
        for (const struct node *item = value->first; item; item = item->next)
            fprintf(out, "%s%s", item->text, item->next ? ", " : "");
    else
        fprintf(out, "%s, %s, %s", value->text, value->text, value->text);
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

static void write_key(FILE *out, const char *name, const struct node *key) {
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
    write_text(out, "type_text", type_text(key, false));
    write_text(out, "range_text", range_text(key));
    const char *texts[] = {"unit", "doc", "example"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        write_text(out, texts[i], text_of(key, texts[i]));
    fputs("},\n", out);
}

static void write_keys(FILE *out, const char *name, const struct node *kind) {
    fprintf(out, "static const struct grammar_key keys_%s[] = {\n", name);
    for (const struct node *k = keys_of(kind); k; k = k->next->next) write_key(out, k->text, k->next);
    fputs("};\n", out);
}

/* Bit i: key i has the field, and it is not false. */
static unsigned long long keys_with(const struct node *kind, const char *field) {
    unsigned long long mask = 0, bit = 1;
    for (const struct node *k = keys_of(kind); k; k = k->next->next, bit <<= 1) {
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
    fputs(", ", out);
    write_string(out, text_of(kind, "example"));
    fprintf(out, ", keys_%s, KEYS_%s, 0x%llx, 0x%llx, 0x%llx},\n", name, upper(name),
            keys_with(kind, "required"), keys_with(kind, "alternative"),
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

static void write_function(FILE *out, const char *name, const struct node *function) {
    const struct node *least = get(function, "arguments")->first;
    fprintf(out, "    {.name = \"%s\", .least = %s, .most = %s", name, least->text, least->next->text);
    write_words(out, "instead", get(function, "instead"));
    const char *texts[] = {"call", "doc", "domain", "example", "gives"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        write_text(out, texts[i], text_of(function, texts[i]));
    fputs("},\n", out);
}

static void write_constant(FILE *out, const char *name, const struct node *constant) {
    fprintf(out, "    {\"%s\", %s, ", name, text_of(constant, "value"));
    write_string(out, text_of(constant, "doc"));
    fputs("},\n", out);
}

static void write_expressions(FILE *out, const struct definition *language) {
    fputs("const struct grammar_function grammar_functions[] = {\n", out);
    for (const struct node *k = language->functions->first; k; k = k->next->next)
        write_function(out, k->text, k->next);
    fputs("};\nconst int grammar_function_count = FUNCTIONS;\nconst struct grammar_constant "
          "grammar_constants[] = {\n",
          out);
    for (const struct node *k = language->constants->first; k; k = k->next->next)
        write_constant(out, k->text, k->next);
    fprintf(out, "};\nconst int grammar_constant_count = %u;\n", (unsigned)language->constants->count);
}

/* A text file of the project as a string. */
static void write_file(FILE *out, const char *name, const struct source *source) {
    fprintf(out, "const char %s[] =", name);
    for (size_t i = 0; i < source->size;) {
        const char *line = source->text + i, *end = memchr(line, '\n', source->size - i);
        const size_t length = end ? (size_t)(end - line) + 1 : source->size - i;
        fputs("\n    ", out);
        write_string(out, format("%.*s", (int)length, line));
        i += length;
    }
    fputs(";\n", out);
}

void write_tables(FILE *out, const struct definition *language) {
    fputs("/* Generated from the files of grammar/ and from scenes/presets.yaml. */\n#include "
          "\"grammar_tables.h\"\n\n"
          "#include <stddef.h>\n\n#include \"lang/grammar.h\"\n\n",
          out);
    for_kinds(language, out, write_keys);
    fputs("const struct grammar_kind grammar_kinds[] = {\n", out);
    for_kinds(language, out, write_kind);
    fputs("};\nconst int grammar_kind_count = KINDS;\n", out);
    write_expressions(out, language);
    write_colors(out, language->colors);
    write_file(out, "grammar_presets", language->presets);
}
