#include "cli/help.h"

#include <string.h>

#include "cli/completion.h"
#include "cli/manual.h"
#include "cli/say.h"
#include "cli/suggest.h"
#include "monge.h"

enum { DOC_COLUMN = 34 };

/* "  left    doc", the doc on a line of its own where `left` is long. */
static void print_row(FILE *out, const char *left, const char *doc) {
    const int width = (int)strlen(left);
    const int gap = DOC_COLUMN - width;
    if (gap >= 2)
        fprintf(out, "%s%*s", left, gap, "");
    else
        fprintf(out, "%s\n%*s", left, DOC_COLUMN, "");
    monge_write_wrapped(doc, DOC_COLUMN, DOC_COLUMN, out);
}

char *help_option_doc(enum option_id option, char *text, size_t size) {
    const struct option_row *row = &OPTION_TABLE[option];
    if (row->kind == VALUE_WHOLE || row->kind == VALUE_FRACTION)
        snprintf(text, size, "%s (%u to %u)", row->doc, row->low, row->high);
    else
        snprintf(text, size, "%s", row->doc);
    return text;
}

static void print_options(FILE *out, enum command_id command) {
    fputs("\noptions:\n", out);
    for (enum option_id o = 0; o < OPTIONS; o++) {
        if (!command_takes(command, o)) continue;
        const struct option_row *row = &OPTION_TABLE[o];
        char left[96], doc[160];
        const char letter[] = {'-', row->letter, ',', '\0'};
        snprintf(left, sizeof left, "  %3s --%s%s%s", row->letter ? letter : "", row->name,
                 row->value ? " " : "", row->value ? row->value : "");
        print_row(out, left, help_option_doc(o, doc, sizeof doc));
    }
}

static void print_overview(FILE *out) {
    fprintf(out, "Monge %s %s.\n\nusage: monge COMMAND [ARGUMENT...]\n\n", monge_version(),
            COMMAND_TABLE[COMMAND_NONE].doc);
    monge_write_wrapped(COMMAND_TABLE[COMMAND_NONE].text[0], 0, 0, out);
    fputs("\ncommands:\n", out);
    for (enum command_id c = COMMAND_NONE + 1; c < COMMANDS; c++) {
        char left[64];
        snprintf(left, sizeof left, "  %s %s", COMMAND_TABLE[c].name, COMMAND_TABLE[c].operands);
        print_row(out, left, COMMAND_TABLE[c].doc);
    }
    print_options(out, COMMAND_NONE);
    fputs("\n`monge help COMMAND` tells more, `monge help language` how to write scenes;\n"
          "`monge help --man` is the manual page.\nExit status:\n",
          out);
    for (int s = 0; s <= STATUS_TROUBLE; s++) {
        fprintf(out, "  %d  ", s);
        monge_write_wrapped(STATUS_DOC[s], 5, 5, out);
    }
    monge_write_wrapped(SIGNAL_DOC, 0, 0, out);
}

static bool is_kind(const char *word) {
    for (size_t i = 0; monge_kind(i); i++)
        if (strcmp(monge_kind(i), word) == 0) return true;
    return false;
}

static void print_command(FILE *out, enum command_id command) {
    const struct command_row *row = &COMMAND_TABLE[command];
    fprintf(out, "usage: monge %s%s%s [OPTION...]\n", row->name, *row->operands ? " " : "", row->operands);
    for (int i = 0; row->text[i]; i++) {
        fputc('\n', out);
        monge_write_wrapped(row->text[i], 0, 0, out);
    }
    print_options(out, command);
    fputs("\nexamples:\n", out);
    for (int i = 0; row->examples[i].line; i++)
        fprintf(out, "  %s\n      %s\n", row->examples[i].line, row->examples[i].doc);
    if (is_kind(row->name))
        fprintf(out, "\n`%s` is also a word of scenes: `monge help language %s`.\n", row->name, row->name);
}

void help_print(FILE *out, enum command_id command) {
    if (command == COMMAND_NONE)
        print_overview(out);
    else
        print_command(out, command);
}

/* Help for a word that is neither a command nor of a scene. */
static enum status unknown_word(const char *word) {
    struct suggestion nearest = {.word = word};
    for (enum command_id c = COMMAND_NONE + 1; c < COMMANDS; c++)
        suggestion_try(&nearest, COMMAND_TABLE[c].name);
    const char *best = suggestion_best(&nearest);
    if (!best) best = monge_help_nearest(word);
    if (best)
        say_usage(COMMAND_NONE, "help: no command and no word of scenes `%s`; did you mean `%s`?", word,
                  best);
    else
        say_usage(COMMAND_NONE, "help: no command and no word of scenes `%s`", word);
    return STATUS_TROUBLE;
}

enum status help_command(const struct arguments *args) {
    const struct option_value *completion = &args->option[OPTION_COMPLETION];
    const bool of_scenes = args->count > 1 && strcmp(args->operands[0], "language") == 0;
    if (args->count > 1 + (size_t)of_scenes) {
        say_usage(COMMAND_HELP, "help: expected one word, found `%s` as well", args->operands[1 + of_scenes]);
        return STATUS_TROUBLE;
    }
    if (args->option[OPTION_MAN].given) {
        manual_print(stdout);
        return STATUS_YES;
    }
    if (completion->given) {
        completion_print(stdout, (enum completion_shell)completion->choice);
        return STATUS_YES;
    }
    const char *word = args->count > 0 ? args->operands[args->count - 1] : NULL;
    if (word && (of_scenes || command_find(word) == COMMAND_NONE))
        return monge_help(word, stdout) ? STATUS_YES : unknown_word(word);
    help_print(stdout, word ? command_find(word) : COMMAND_NONE);
    return STATUS_YES;
}
