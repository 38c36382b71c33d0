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
    fprintf(out, "/* Generated from grammar/language.yaml. */\n#ifndef GRAMMAR_TABLES_H\n#define "
                 "GRAMMAR_TABLES_H\n\nenum {\n");
    for_kinds(language, out, header_kind_name);
    fprintf(out, "    KINDS\n};\n\n");
    for_kinds(language, out, header_kind);
    fprintf(out, "\n#endif\n");
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

static void write_kind(FILE *out, const char *name, const struct node *kind) {
    fprintf(out, "    {\"%s\", ", name);
    write_string(out, text_of(kind, "title"));
    fputs(", ", out);
    write_string(out, text_of(kind, "doc"));
    fputs(", ", out);
    write_string(out, text_of(kind, "example"));
    fprintf(out, ", keys_%s, KEYS_%s},\n", name, upper(name));
}

static void write_colors(FILE *out, const struct node *colors) {
    fputs("const struct grammar_color grammar_colors[] = {\n", out);
    for (const struct node *k = colors->first; k; k = k->next->next) {
        const unsigned long rgb = strtoul(k->next->text + 1, NULL, 16);
        fprintf(out, "    {\"%s\", {%lu, %lu, %lu}},\n", k->text, rgb >> 16, rgb >> 8 & 255, rgb & 255);
    }
    fprintf(out, "};\nconst int grammar_color_count = %u;\n", (unsigned)colors->count);
}

void write_tables(FILE *out, const struct definition *language) {
    fputs("/* Generated from grammar/language.yaml and grammar/colors.yaml. */\n#include "
          "\"grammar_tables.h\"\n\n"
          "#include <stddef.h>\n\n#include \"lang/grammar.h\"\n\n",
          out);
    for_kinds(language, out, write_keys);
    fputs("const struct grammar_kind grammar_kinds[] = {\n", out);
    for_kinds(language, out, write_kind);
    fputs("};\nconst int grammar_kind_count = KINDS;\n", out);
    write_colors(out, language->colors);
}
