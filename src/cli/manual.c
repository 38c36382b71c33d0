#include "cli/manual.h"

#include <string.h>

#include "cli/help.h"
#include "monge.h"

/* Text as roff shows it letter by letter. */
static void print_roff(FILE *out, const char *text) {
    if (*text == '.' || *text == '\'') fputs("\\&", out); /* else it would be a request */
    for (; *text; text++) {
        if (*text == '\\')
            fputs("\\e", out);
        else if (*text == '-')
            fputs("\\-", out);
        else if (*text == '\'')
            fputs("\\(aq", out);
        else if (*text == '`')
            fputs("\\(ga", out);
        else
            fputc(*text, out);
    }
}

static void print_line(FILE *out, const char *text) {
    print_roff(out, text);
    fputc('\n', out);
}

static void print_option(FILE *out, enum option_id option) {
    const struct option_row *row = &OPTION_TABLE[option];
    char doc[160];
    fputs(".TP\n\\fB", out);
    if (row->letter) fprintf(out, "\\-%c\\fR, \\fB", row->letter);
    fputs("\\-\\-", out);
    print_roff(out, row->name);
    if (row->value) {
        fputs("\\fR \\fI", out);
        print_roff(out, row->value);
    }
    fputs("\\fR\n", out);
    print_line(out, help_option_doc(option, doc, sizeof doc));
}

static void print_command(FILE *out, enum command_id command) {
    const struct command_row *row = &COMMAND_TABLE[command];
    fprintf(out, ".SS monge %s %s\n", row->name, row->operands);
    for (int i = 0; row->text[i]; i++) {
        fputs(i ? ".PP\n" : "", out);
        print_line(out, row->text[i]);
    }
    for (enum option_id o = 0; o < OPTIONS; o++)
        if (command_takes(command, o)) print_option(out, o);
}

static void print_scenes(FILE *out) {
    fputs(".SH SCENES\nA scene, to begin with:\n.PP\n.nf\n", out);
    for (const char *line = monge_example(); *line; line = strchr(line, '\n') + 1) {
        char text[120];
        snprintf(text, sizeof text, "%.*s", (int)strcspn(line, "\n"), line);
        fputs("    ", out);
        print_line(out, text);
    }
    fputs(".fi\n.PP\n", out);
    print_line(
        out,
        "The objects, materials, lights and all other mappings of a scene, and their keys, are told by "
        "`monge help WORD`; `monge help language` lists them. `monge check` finds the mistakes of a scene, "
        "and `monge schema` lets an editor find them as you type.");
}

static void print_examples(FILE *out) {
    fputs(".SH EXAMPLES\n", out);
    for (enum command_id c = COMMAND_NONE + 1; c < COMMANDS; c++) {
        for (const struct example *e = COMMAND_TABLE[c].examples; e->line; e++) {
            fputs(".TP\n.B ", out);
            print_line(out, e->line);
            print_line(out, e->doc);
        }
    }
}

/* Terms with what they mean, up to a NULL. */
static void print_terms(FILE *out, const char *section, const char *const terms[][2]) {
    fprintf(out, ".SH %s\n", section);
    for (; (*terms)[0]; terms++) {
        fputs(".TP\n.B ", out);
        print_line(out, (*terms)[0]);
        print_line(out, (*terms)[1]);
    }
}

static const char *const files[][2] = {
    {".NAME.png.partial", "beside NAME.png: the tiles of a picture that `monge render --resume` has not "
                          "completed yet; it goes with the last of them, and may be removed"},
    {"monge-test/",
     "the last run of `monge test`, unless --output names another folder: results.json, and the "
     "new pictures that `monge accept` takes"},
    {"DIR/golden.yaml, DIR/golden.lock",
     "rules for goldens, which are yours to write, and goldens that are a "
     "line of text"},
    {"PREFIX/share/doc/monge/", "README.md; manual.md and reference.md of the language; testing.md, about "
                                "golden pictures; errors.md"},
    {"PREFIX/share/monge/scene.schema.json, golden.schema.json", "what editors complete and check scenes and "
                                                                 "golden.yaml by"},
    {NULL, NULL}};

static const char *const environment[][2] = {
    {"NO_COLOR", "where it is set, `monge test` uses no colours on a terminal"},
    {"TERM", "where it is `dumb`, no bar is drawn that nobody has asked for"},
    {NULL, NULL}};

void manual_print(FILE *out) {
    fprintf(out, ".TH MONGE 1 \"\" \"Monge %s\" \"User Commands\"\n.SH NAME\nmonge \\- ", monge_version());
    print_line(out, COMMAND_TABLE[COMMAND_NONE].doc);
    fputs(".SH SYNOPSIS\n", out);
    for (enum command_id c = COMMAND_NONE + 1; c < COMMANDS; c++)
        fprintf(out, "%s.B monge %s\n.RI [ OPTION ...]\\&\n%s\n", c > 1 ? ".br\n" : "", COMMAND_TABLE[c].name,
                COMMAND_TABLE[c].operands);
    fputs(".SH DESCRIPTION\n", out);
    print_line(out, COMMAND_TABLE[COMMAND_NONE].text[0]);
    fputs(".SH COMMANDS\n", out);
    for (enum command_id c = COMMAND_NONE + 1; c < COMMANDS; c++) print_command(out, c);
    fputs(".SH OPTIONS\n", out);
    for (enum option_id o = 0; o < OPTIONS; o++)
        if (command_takes(COMMAND_NONE, o)) print_option(out, o);
    print_scenes(out);
    fputs(".SH EXIT STATUS\n", out);
    for (int s = 0; s <= STATUS_TROUBLE; s++) {
        fprintf(out, ".TP\n%d\n", s);
        print_line(out, STATUS_DOC[s]);
    }
    fputs(".PP\n", out);
    print_line(out, SIGNAL_DOC);
    print_terms(out, "ENVIRONMENT", environment);
    print_terms(out, "FILES", files);
    print_examples(out);
}
