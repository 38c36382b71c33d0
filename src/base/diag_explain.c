#include <string.h>

#include "base/diag_write.h"
#include "base/wrap.h"

const struct diag_story *diag_find_story(struct diag_stories stories, const char *code) {
    for (size_t i = 0; i < stories.count; i++)
        if (strcmp(stories.first[i].code, code) == 0) return &stories.first[i];
    return NULL;
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
    wrap_print(out, story->summary, 0, 0);
    fputc('\n', out);
    wrap_print(out, story->text, 0, 0);
    print_example("wrong", story->wrong, out);
    print_example("right", story->right, out);
}
