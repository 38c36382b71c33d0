#include "cli/explain.h"

#include <stdio.h>

#include "cli/say.h"
#include "cli/suggest.h"
#include "monge.h"

static void print_codes(void) {
    for (size_t i = 0; monge_code(i); i++) printf("%-28s %s\n", monge_code(i), monge_code_summary(i));
}

static enum status unknown_code(const char *code) {
    struct suggestion nearest = {.word = code};
    for (size_t i = 0; monge_code(i); i++) suggestion_try(&nearest, monge_code(i));
    const char *best = suggestion_best(&nearest);
    if (best)
        say_usage(COMMAND_EXPLAIN, "no code `%s`; did you mean `%s`?", code, best);
    else
        say_usage(COMMAND_EXPLAIN, "no code `%s`; `monge explain` lists them", code);
    return STATUS_TROUBLE;
}

enum status explain_command(const struct arguments *args) {
    if (args->count == 0) print_codes();
    for (size_t i = 0; i < args->count; i++) {
        if (i > 0) putchar('\n');
        if (!monge_explain(args->operands[i], stdout)) return unknown_code(args->operands[i]);
    }
    return STATUS_YES;
}
