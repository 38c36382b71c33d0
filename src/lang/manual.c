#include "lang/manual.h"

#include <string.h>

#include "grammar_tables.h"
#include "lang/grammar.h"
#include "lang/spelling.h"

enum { LINE_WIDTH = 80, KEY_COLUMN = 4, DOC_COLUMN = 8, NAME_COLUMN = 16 };

/* Words from `column` on, where the cursor is, with new lines that begin at `indent`. */
static void print_wrapped(FILE *out, const char *text, int column, int indent) {
    for (bool first = true; *text; first = false) {
        const int length = (int)strcspn(text, " \n");
        if (!first && column + 1 + length > LINE_WIDTH) {
            fprintf(out, "\n%*s", indent, "");
            column = indent;
        } else if (!first) {
            fputc(' ', out);
            column++;
        }
        fprintf(out, "%.*s", length, text);
        column += length;
        text += length;
        text += strspn(text, " \n");
    }
    fputc('\n', out);
}

static void print_paragraph(FILE *out, const char *text, int indent) {
    fprintf(out, "%*s", indent, "");
    print_wrapped(out, text, indent, indent);
}

/* ---- Keys ---- */

/* "radius: number, over 0, scene units; default: 1", and what it is. */
static void print_key(FILE *out, const struct grammar_key *key) {
    const char *mark = key->alternative ? " *" : "",
               *value = key->type == GRAMMAR_LATER ? "not there yet" : key->type_text;
    const char *otherwise = key->required ? "; must be given" : key->default_text ? "; default: " : "";
    char text[1024];
    snprintf(text, sizeof text, "%s%s: %s%s%s%s%s", key->name, mark, value, *key->range_text ? ", " : "",
             key->range_text, otherwise, key->required || !key->default_text ? "" : key->default_text);
    fputc('\n', out);
    print_paragraph(out, text, KEY_COLUMN);
    print_paragraph(out, key->doc, DOC_COLUMN);
    if (key->example) fprintf(out, "%*sAs in: %s\n", DOC_COLUMN, "", key->example);
}

static bool has_alternatives(const struct grammar_kind *kind) {
    for (int i = 0; i < kind->key_count; i++)
        if (kind->keys[i].alternative) return true;
    return false;
}

static bool same_text(const char *a, const char *b) { return a == b || (a && b && strcmp(a, b) == 0); }

/* Whether all that print_key says of them is the same. */
static bool same_key(const struct grammar_key *a, const struct grammar_key *b) {
    return a->type == b->type && a->alternative == b->alternative && a->required == b->required &&
           same_text(a->type_text, b->type_text) && same_text(a->range_text, b->range_text) &&
           same_text(a->default_text, b->default_text) && same_text(a->doc, b->doc) &&
           same_text(a->example, b->example);
}

/* The key of that name in the kind of that number; NULL: it has none. */
static const struct grammar_key *key_of(int kind, const char *word) {
    const int key = grammar_find_key(&grammar_kinds[kind], word);
    return key < 0 ? NULL : &grammar_kinds[kind].keys[key];
}

static bool was_printed(int before, const struct grammar_key *key) {
    for (int i = 0; i < before; i++) {
        const struct grammar_key *other = key_of(i, key->name);
        if (other && same_key(other, key)) return true;
    }
    return false;
}

/* The key in each kind that has it, once for those where it is the same. False: none has. */
static bool print_uses(FILE *out, const char *word) {
    bool any = false;
    for (int i = 0; i < grammar_kind_count; i++) {
        const struct grammar_key *key = key_of(i, word);
        if (!key || was_printed(i, key)) continue;
        fprintf(out, "%sThe key `%s` of %s", any ? "\n" : "", word, grammar_kinds[i].name);
        for (int k = i + 1; k < grammar_kind_count; k++)
            if (key_of(k, word) && same_key(key_of(k, word), key))
                fprintf(out, ", %s", grammar_kinds[k].name);
        fputs(":\n", out);
        print_key(out, key);
        any = true;
    }
    return any;
}

/* ---- Kinds ---- */

static const struct grammar_kind *find_kind(const char *word) {
    for (int i = 0; i < grammar_kind_count; i++)
        if (strcmp(grammar_kinds[i].name, word) == 0) return &grammar_kinds[i];
    return NULL;
}

static void print_kind(FILE *out, const struct grammar_kind *kind) {
    fprintf(out, "%s: %s\n\n", kind->name, kind->title);
    print_paragraph(out, kind->doc, 0);
    fputs(has_alternatives(kind) ? "\nIts keys; exactly one of those with a * must be given:\n"
                                 : "\nIts keys:\n",
          out);
    for (int i = 0; i < kind->key_count; i++) print_key(out, &kind->keys[i]);
    fputc('\n', out);
}

/* ---- The whole ---- */

/* Its first sentence. */
static void print_summary(FILE *out, const struct grammar_kind *kind) {
    char text[256];
    const char *end = strstr(kind->doc, ". ");
    snprintf(text, sizeof text, "%.*s", end ? (int)(end + 1 - kind->doc) : (int)sizeof text, kind->doc);
    fprintf(out, "  %-*s", NAME_COLUMN - 2, kind->name);
    print_wrapped(out, text, NAME_COLUMN, NAME_COLUMN);
}

static void print_language(FILE *out) {
    const struct grammar_kind *file = &grammar_kinds[KIND_FILE];
    fputs("A scene:\n\n", out);
    for (const char *line = lang_example(); *line; line = strchr(line, '\n') + 1)
        fprintf(out, "%*s%.*s\n", *line == '\n' ? 0 : KEY_COLUMN, "", (int)strcspn(line, "\n"), line);
    fputc('\n', out);
    print_paragraph(out, file->doc, 0);
    fputs("\nThe mappings of a scene; `monge help WORD` tells more of each, and of any key:\n\n", out);
    for (int i = 0; i < grammar_kind_count; i++) print_summary(out, &grammar_kinds[i]);
}

const char *lang_example(void) { return grammar_kinds[KIND_FILE].example; }

const char *lang_kind_name(size_t index) {
    return index < (size_t)grammar_kind_count ? grammar_kinds[index].name : NULL;
}

bool lang_help(const char *word, FILE *out) {
    const struct grammar_kind *kind = find_kind(word);
    if (strcmp(word, "language") == 0) {
        print_language(out);
        return true;
    }
    if (kind) print_kind(out, kind);
    return print_uses(out, word) || kind;
}

const char *lang_help_nearest(const char *word) {
    struct spelling nearest = spelling_begin(word);
    spelling_offer(&nearest, "language");
    for (int i = 0; i < grammar_kind_count; i++) {
        spelling_offer(&nearest, grammar_kinds[i].name);
        for (int k = 0; k < grammar_kinds[i].key_count; k++)
            spelling_offer(&nearest, grammar_kinds[i].keys[k].name);
    }
    return nearest.best;
}
