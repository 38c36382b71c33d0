#include <string.h>

#include "base/diag_write.h"

enum { LINE_WIDTH = 80 };

const struct diag_story *diag_find_story(struct diag_stories stories, const char *code) {
    for (size_t i = 0; i < stories.count; i++)
        if (strcmp(stories.first[i].code, code) == 0) return &stories.first[i];
    return NULL;
}

static void print_wrapped(const char *text, FILE *out) {
    for (size_t column = 0; *text;) {
        const size_t length = strcspn(text, " ");
        if (column > 0 && column + 1 + length > LINE_WIDTH) {
            fputc('\n', out);
            column = 0;
        }
        column += (size_t)fprintf(out, "%s%.*s", column > 0 ? " " : "", (int)length, text);
        text += length;
        text += strspn(text, " ");
    }
    fputc('\n', out);
}

static void print_example(const char *title, const char *text, FILE *out) {
    fprintf(out, "\n%s:\n\n", title);
    while (*text) {
        const size_t length = strcspn(text, "\n");
        fprintf(out, "%s%.*s\n", length > 0 ? "    " : "", (int)length, text);
        text += length + (text[length] == '\n');
    }
}

void diag_explain(const struct diag_story *story, FILE *out) {
    fprintf(out, "%s (%s)\n\n", story->code, story->severity);
    print_wrapped(story->summary, out);
    fputc('\n', out);
    print_wrapped(story->text, out);
    print_example("wrong", story->wrong, out);
    print_example("right", story->right, out);
}
