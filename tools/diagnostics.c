/* Makes what is generated from grammar/diagnostics.yaml, where the codes of diagnostics are explained:
 *
 *     diagnostics tables    DIAGNOSTICS OUT    the table of lang/stories.h
 *     diagnostics reference DIAGNOSTICS OUT    the manual of errors, Markdown
 *     diagnostics examples  DIAGNOSTICS OUT    a line for each code, `CODE SEVERITY KIND`, and beside OUT the
 *                                              examples: OUT.CODE.wrong and OUT.CODE.right
 *
 * Exit 0, or 2 with a message and no OUT. */
#include <stdlib.h>
#include <string.h>

#include "lang/file.h"
#include "lang/node.h"

static struct arena arena;
static struct diagnostics diag;

/* ---- Reading ---- */

static _Noreturn void fail(void) {
    diag_print(&diag, stderr);
    exit(2);
}

static const struct node *read_file(const char *path) {
    const struct node_limits limits = {20, 100000};
    struct node_problem problem = {0};
    const struct source *source = file_read(&arena, &diag, path, 1 << 24);
    const struct node *root = source ? node_parse(&arena, &diag, source, &limits, NULL, &problem) : NULL;
    if (problem.text) diag_error(&diag, problem.at, "not-yaml", "%s", problem.text);
    if (!root) fail();
    return root;
}

/* What sort of example a code has; the word is the key that it stands under. */
static const char *const example_kinds[] = {
    "scene",    /* two scenes: the first gives the code and no other, the second nothing */
    "book",     /* the same of two scenes for `monge import` */
    "commands", /* the same of two shell commands, beside a scene king.yaml */
    "sketch",   /* what is too large to be tried */
};
enum { EXAMPLE_KINDS = sizeof example_kinds / sizeof *example_kinds };

struct story {
    const char *code, *severity, *summary, *text, *kind, *wrong, *right;
};

static const struct node *get(const struct node *mapping, const char *key) {
    for (const struct node *k = mapping->kind == NODE_MAPPING ? mapping->first : NULL; k; k = k->next->next)
        if (strcmp(k->text, key) == 0) return k->next;
    return NULL;
}

static const char *need_text(const struct node *mapping, const char *key) {
    const struct node *value = get(mapping, key);
    if (value && value->kind == NODE_SCALAR) return value->text;
    diag_error(&diag, mapping->span, "definition", "a text `%s` is missing", key);
    fail();
}

static struct story read_story(const struct node *code) {
    const struct node *body = code->next, *example = NULL;
    struct story story = {.code = code->text};
    for (int i = 0; i < EXAMPLE_KINDS && !example; i++) {
        example = get(body, example_kinds[i]);
        story.kind = example_kinds[i];
    }
    if (!example || body->count != 4) {
        diag_error(&diag, code->span, "definition",
                   "a code has severity, summary, story and one of scene, book, commands, sketch");
        fail();
    }
    story.severity = need_text(body, "severity");
    story.summary = need_text(body, "summary");
    story.text = need_text(body, "story");
    story.wrong = need_text(example, "wrong");
    story.right = need_text(example, "right");
    return story;
}

static int compare_codes(const void *a, const void *b) {
    return strcmp(((const struct story *)a)->code, ((const struct story *)b)->code);
}

static struct story *read_stories(const struct node *root) {
    struct story *all = arena_array(&arena, root->count, sizeof *all);
    size_t count = 0;
    for (const struct node *k = root->first; k; k = k->next->next) all[count++] = read_story(k);
    qsort(all, count, sizeof *all, compare_codes);
    for (size_t i = 1; i < count; i++) {
        if (compare_codes(&all[i - 1], &all[i]) != 0) continue;
        diag_error(&diag, root->span, "definition", "the code `%s` stands here twice", all[i].code);
        fail();
    }
    return all;
}

/* ---- The table ---- */

static void write_string(FILE *out, const char *text) {
    fputs("\n     \"", out);
    for (; *text; text++) {
        if (*text == '\n')
            fputs("\\n", out);
        else if (*text == '\t')
            fputs("\\t", out);
        else
            fprintf(out, strchr("\"\\?", *text) ? "\\%c" : "%c", *text); /* ?? would begin a trigraph */
    }
    fputc('"', out);
}

static void write_tables(FILE *out, const struct story *all, size_t count) {
    fputs("/* Generated from grammar/diagnostics.yaml. */\n#include \"lang/stories.h\"\n\n"
          "static const struct diag_story rows[] = {\n",
          out);
    for (const struct story *s = all; s < all + count; s++) {
        const char *texts[] = {s->code, s->severity, s->summary, s->text, s->wrong, s->right};
        for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
            fputs(i > 0 ? "," : "    {", out);
            write_string(out, texts[i]);
        }
        fputs("},\n", out);
    }
    fprintf(out, "};\n\nconst struct diag_stories stories = {rows, %zu};\n", count);
}

/* ---- The manual ---- */

/* As `yml`: what stands in a manual as `yaml` is tried as a scene by itself. */
static void reference_example(FILE *out, const char *title, const struct story *s, const char *text) {
    const bool ends = *text && text[strlen(text) - 1] == '\n';
    const bool is_yaml = strcmp(s->kind, "scene") == 0 || strcmp(s->kind, "book") == 0;
    fprintf(out, "\n%s:\n\n```%s\n%s%s```\n", title, is_yaml ? "yml" : "", text, ends ? "" : "\n");
}

static void write_reference(FILE *out, const struct story *all, size_t count) {
    fputs("# Errors and warnings\n\nGenerated from `diagnostics.yaml`; `monge explain CODE` prints the same. "
          "A code is stable: what it means "
          "stays, while the words of a message may change. An error is a mistake in a scene, a warning "
          "leaves the scene a meaning, "
          "a failure is of the system or a limit.\n\n| code | | |\n| --- | --- | --- |\n",
          out);
    for (const struct story *s = all; s < all + count; s++)
        fprintf(out, "| [%s](#%s) | %s | %s |\n", s->code, s->code, s->severity, s->summary);
    for (const struct story *s = all; s < all + count; s++) {
        fprintf(out, "\n## %s\n\n%s %s\n", s->code, s->summary, s->text);
        reference_example(out, "Wrong", s, s->wrong);
        reference_example(out, "Right", s, s->right);
    }
}

/* ---- The examples ---- */

static void write_example(const char *path, const char *code, const char *which, const char *text) {
    const char *name = arena_format(&arena, "%s.%s.%s", path, code, which);
    FILE *out = fopen(name, "w");
    const bool written = out && fputs(text, out) >= 0;
    if (out && fclose(out) == 0 && written) return;
    perror(name);
    exit(2);
}

static void write_examples(FILE *out, const char *path, const struct story *all, size_t count) {
    for (const struct story *s = all; s < all + count; s++) {
        fprintf(out, "%s\t%s\t%s\n", s->code, s->kind, s->severity);
        write_example(path, s->code, "wrong", s->wrong);
        write_example(path, s->code, "right", s->right);
    }
}

int main(int argc, char **argv) {
    if (argc != 4) {
        fprintf(stderr, "usage: diagnostics tables|reference|examples DIAGNOSTICS OUT\n");
        return 2;
    }
    const struct node *root = read_file(argv[2]);
    const struct story *all = read_stories(root);
    FILE *out = fopen(argv[3], "w");
    if (!out) {
        perror(argv[3]);
        return 2;
    }
    if (strcmp(argv[1], "tables") == 0)
        write_tables(out, all, root->count);
    else if (strcmp(argv[1], "reference") == 0)
        write_reference(out, all, root->count);
    else
        write_examples(out, argv[3], all, root->count);
    const bool written = fclose(out) == 0;
    if (!written) remove(argv[3]);
    arena_free(&arena);
    return written ? 0 : 2;
}
