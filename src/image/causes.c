/* Why two pictures may differ, by what their files tell. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "monge.h"

static enum monge_sameness compare(const char *a, const char *b) {
    if (!a || !b) return MONGE_UNKNOWN;
    return strcmp(a, b) == 0 ? MONGE_SAME : MONGE_DIFFERENT;
}

struct monge_causes monge_causes(const struct monge_stamp *older, const struct monge_stamp *newer) {
    return (struct monge_causes){.program = compare(older->program, newer->program),
                                 .scene = compare(older->scene, newer->scene),
                                 .text = compare(older->text, newer->text),
                                 .options = compare(older->options, newer->options)};
}

enum { TEXT, OPTIONS, PROGRAM, SUBJECTS };

/* "the scene's text and the options are the same": those of the subjects that are `sameness`. Nothing of none. */
static void print_part(FILE *out, const char *const subjects[SUBJECTS],
                       const enum monge_sameness found[SUBJECTS], enum monge_sameness sameness,
                       const char *one, const char *many) {
    const char *name[SUBJECTS];
    int count = 0, last = 0;
    for (int i = 0; i < SUBJECTS; i++)
        if (found[i] == sameness) name[count++] = subjects[last = i];
    if (count == 0) return;
    if (ftell(out) > 0) fputs("; ", out);
    for (int i = 0; i < count; i++)
        fprintf(out, "%s%s", i == 0 ? "" : i + 1 < count ? ", " : " and ", name[i]);
    fprintf(out, " %s", count == 1 && last != OPTIONS ? one : many);
}

size_t monge_causes_text(const struct monge_causes *causes, char *text, size_t size) {
    const bool by_words = causes->text == MONGE_DIFFERENT && causes->scene == MONGE_SAME;
    const char *const subjects[SUBJECTS] = {[TEXT] = by_words ? "the scene's text, but not what it means,"
                                                              : "the scene's text",
                                            [OPTIONS] = "the options",
                                            [PROGRAM] = "the program"};
    const enum monge_sameness found[SUBJECTS] = {
        [TEXT] = causes->text, [OPTIONS] = causes->options, [PROGRAM] = causes->program};
    char *all = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&all, &length);
    if (!out) return (size_t)snprintf(text, size, "it is not known why");
    print_part(out, subjects, found, MONGE_DIFFERENT, "differs", "differ");
    print_part(out, subjects, found, MONGE_SAME, "is the same", "are the same");
    print_part(out, subjects, found, MONGE_UNKNOWN, "is not known", "are not known");
    snprintf(text, size, "%s", fclose(out) == 0 ? all : "");
    free(all);
    return length;
}
