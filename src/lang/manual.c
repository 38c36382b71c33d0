#include "lang/manual.h"

#include <string.h>

#include "base/same.h"
#include "base/wrap.h"
#include "grammar_tables.h"
#include "lang/file.h"
#include "lang/grammar.h"
#include "lang/node.h"
#include "lang/spelling.h"

enum { KEY_COLUMN = 4, DOC_COLUMN = 8, NAME_COLUMN = 16, FUNCTION_COLUMN = 28 };

static void print_paragraph(FILE *out, const char *text, int indent) {
    fprintf(out, "%*s", indent, "");
    wrap_print(out, text, indent, indent);
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

/* ---- Expressions ---- */

static void print_function(FILE *out, const struct grammar_function *f) {
    fprintf(out, "In expressions, %s:\n\n", f->call);
    print_paragraph(out, f->doc, KEY_COLUMN);
    if (f->domain) fprintf(out, "%*sTakes %s.\n", KEY_COLUMN, "", f->domain);
    if (f->example) fprintf(out, "%*sAs in: %s, which is %s\n", KEY_COLUMN, "", f->example, f->gives);
}

static void print_constant(FILE *out, const struct grammar_constant *c) {
    fprintf(out, "In expressions, %s: %.15g\n\n", c->name, c->value);
    print_paragraph(out, c->doc, KEY_COLUMN);
}

/* The function or the constant of that name, `before` before it. False: there is none. */
static bool print_in_expressions(FILE *out, const char *word, const char *before) {
    int f = 0, c = 0;
    while (f < grammar_function_count && strcmp(grammar_functions[f].name, word) != 0) f++;
    while (c < grammar_constant_count && strcmp(grammar_constants[c].name, word) != 0) c++;
    if (f == grammar_function_count && c == grammar_constant_count) return false;
    fputs(before, out);
    if (f < grammar_function_count)
        print_function(out, &grammar_functions[f]);
    else
        print_constant(out, &grammar_constants[c]);
    return true;
}

static void print_row(FILE *out, const char *name, const char *doc) {
    const int length = (int)strlen(name), column = FUNCTION_COLUMN;
    fprintf(out, "  %s", name);
    if (length + 3 > column)
        fprintf(out, "\n%*s", column, "");
    else
        fprintf(out, "%*s", column - 2 - length, "");
    wrap_print(out, doc, column, column);
}

static bool print_functions(FILE *out) {
    fputs("What expressions may call; `monge help NAME` tells more of each:\n\n", out);
    for (int i = 0; i < grammar_function_count; i++)
        print_row(out, grammar_functions[i].call, grammar_functions[i].doc);
    fputs("\nAnd name, besides what the scene defines and the colours of CSS:\n\n", out);
    for (int i = 0; i < grammar_constant_count; i++)
        print_row(out, grammar_constants[i].name, grammar_constants[i].doc);
    return true;
}

/* ---- Presets ---- */

/* A scalar or a list as it is written. */
static const char *value_text(struct arena *arena, const struct node *value) {
    if (value->kind == NODE_SCALAR)
        return value->quoted ? arena_format(arena, "\"%s\"", value->text) : value->text;
    const char *text = "[";
    for (const struct node *item = value->first; item; item = item->next)
        text = arena_format(arena, "%s%s%s", text, value_text(arena, item), item->next ? ", " : "]");
    return text;
}

static void print_preset(FILE *out, struct arena *arena, const struct node *name) {
    const struct node *first = name->next->first;
    int column = fprintf(out, "  %-*s", NAME_COLUMN - 2, name->text);
    for (const struct node *key = first; key; key = key->next->next) {
        const char *text = arena_format(arena, "%s: %s%s", key->text, value_text(arena, key->next),
                                        key->next->next ? "," : "");
        const int length = (int)strlen(text), space = key == first ? 0 : 1;
        const bool fits = column + space + length <= WRAP_WIDTH;
        fprintf(out, "%s%*s%s", fits ? "" : "\n", fits ? space : NAME_COLUMN, "", text);
        column = (fits ? column + space : NAME_COLUMN) + length;
    }
    fputc('\n', out);
}

static void print_all_presets(FILE *out, struct arena *arena, struct diagnostics *diag) {
    const struct node_limits limits = {20, 100000};
    struct node_problem problem = {0};
    const struct source *source =
        file_from_memory(arena, "presets.yaml", grammar_presets, strlen(grammar_presets));
    const struct node *root = node_parse(arena, diag, source, &limits, NULL, &problem);
    fputs("The materials that come with the program: `material: {preset: glass}` takes one,\n"
          "keys beside it change it, as in {preset: glass, index: 1.52}.\n\n",
          out);
    for (const struct node *name = node_get(root, "materials")->first; name; name = name->next->next)
        print_preset(out, arena, name);
}

/* False: no memory for it. */
static bool print_presets(FILE *out) {
    struct arena arena = {0};
    struct diagnostics diag = {0};
    jmp_buf full;
    arena.on_full = diag.arena.on_full = &full;
    const bool enough = setjmp(full) == 0;
    if (enough) print_all_presets(out, &arena, &diag);
    arena_free(&arena);
    diag_free(&diag);
    return enough;
}

/* ---- The whole ---- */

/* Its first sentence. */
static void print_summary(FILE *out, const struct grammar_kind *kind) {
    char text[256];
    const char *end = strstr(kind->doc, ". ");
    snprintf(text, sizeof text, "%.*s", end ? (int)(end + 1 - kind->doc) : (int)sizeof text, kind->doc);
    fprintf(out, "  %-*s", NAME_COLUMN - 2, kind->name);
    wrap_print(out, text, NAME_COLUMN, NAME_COLUMN);
}

static bool print_language(FILE *out) {
    const struct grammar_kind *file = &grammar_kinds[KIND_FILE];
    fputs("A scene:\n\n", out);
    for (const char *line = lang_example(); *line; line = strchr(line, '\n') + 1)
        fprintf(out, "%*s%.*s\n", *line == '\n' ? 0 : KEY_COLUMN, "", (int)strcspn(line, "\n"), line);
    fputc('\n', out);
    print_paragraph(out, file->doc, 0);
    fputs("\nThe mappings of a scene; `monge help WORD` tells more of each, and of any key:\n\n", out);
    for (int i = 0; i < grammar_kind_count; i++) print_summary(out, &grammar_kinds[i]);
    fputs("\n`monge help functions` has what expressions may call, `monge help presets` the\nmaterials that "
          "come with the program.\n",
          out);
    return true;
}

const char *lang_example(void) { return grammar_kinds[KIND_FILE].example; }

const char *lang_kind_name(size_t index) {
    return index < (size_t)grammar_kind_count ? grammar_kinds[index].name : NULL;
}

/* What is asked for by a word that is none of scenes. */
static const struct topic {
    const char *word;
    bool (*print)(FILE *out);
} topics[] = {{"language", print_language}, {"functions", print_functions}, {"presets", print_presets}};

enum { TOPICS = sizeof topics / sizeof *topics };

bool lang_help(const char *word, FILE *out) {
    const struct grammar_kind *kind = find_kind(word);
    for (int i = 0; i < TOPICS; i++)
        if (strcmp(topics[i].word, word) == 0) return topics[i].print(out);
    if (kind) print_kind(out, kind);
    const bool known = print_uses(out, word) || kind;
    return print_in_expressions(out, word, known ? "\n" : "") || known;
}

const char *lang_help_nearest(const char *word) {
    struct spelling nearest = spelling_begin(word);
    for (int i = 0; i < TOPICS; i++) spelling_offer(&nearest, topics[i].word);
    for (int i = 0; i < grammar_kind_count; i++) {
        spelling_offer(&nearest, grammar_kinds[i].name);
        for (int k = 0; k < grammar_kinds[i].key_count; k++)
            spelling_offer(&nearest, grammar_kinds[i].keys[k].name);
    }
    for (int i = 0; i < grammar_function_count; i++) spelling_offer(&nearest, grammar_functions[i].name);
    for (int i = 0; i < grammar_constant_count; i++) spelling_offer(&nearest, grammar_constants[i].name);
    return nearest.best;
}
