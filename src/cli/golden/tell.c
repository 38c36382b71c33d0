#include "cli/golden/tell.h"

#include <stdlib.h>
#include <string.h>

#include "cli/say.h"

/* ---- What there is to say ---- */

const char GOLDEN_TAKEN[] = "taken: the new picture is its golden now";

static char *same_detail(const struct golden_case *c) {
    if (c->unchanged) return say_text("unchanged");
    if (!c->within) return NULL;
    char *difference = golden_difference_text(c);
    char *text = say_text("within its tolerance (%s): %s", c->tolerance.reason, difference);
    free(difference);
    return text;
}

char *golden_detail(const struct golden_case *c) {
    switch (c->status) {
    case GOLDEN_SAME: return same_detail(c);
    case GOLDEN_CHANGED:
        if (c->compared) return golden_difference_text(c);
        if (c->now.width != c->old.width || c->now.height != c->old.height || c->now.bits != c->old.bits)
            return say_text("%ux%u of %u bits, the golden %ux%u of %u", c->now.width, c->now.height,
                            c->now.bits, c->old.width, c->old.height, c->old.bits);
        return say_text("its pixels are not those of the hash");
    case GOLDEN_NEW: return say_text("there is no golden yet");
    case GOLDEN_ORPHAN: return say_text("no scene makes it any more: `%s` removes it", c->prune_command);
    default: return NULL;
    }
}

/* The line of an error among those of a message, which may begin with warnings; else its first one. */
static char *first_line(const char *message) {
    const char *error = strstr(message, ": error["), *line = message;
    for (const char *c = message; error && c < error; c++)
        if (*c == '\n') line = c + 1;
    return say_text("%.*s", (int)strcspn(line, "\n"), line);
}

char *golden_headline(const struct golden_case *c) {
    char *detail = golden_detail(c);
    return detail ? detail : first_line(c->message ? c->message : "");
}

/* A text of perhaps many lines; control characters, which may come from file names, made harmless. */
static void print_lines(FILE *out, const char *text, const char *before) {
    for (const char *line = text; *line;) {
        const size_t length = strcspn(line, "\n");
        say_line(out, "%s%.*s", before, (int)length, line);
        line += length + (line[length] == '\n');
    }
}

static void print_field(FILE *out, const char *key, const char *text, const char *before) {
    if (text) say_line(out, "%s%s%s", before, key, text);
}

/* With a control character in a name it would be printed as another command: results.json alone has it then. */
static void print_command(FILE *out, const char *key, const char *command, const char *before) {
    for (const char *c = command; c && *c; c++)
        if ((unsigned char)*c < 0x20 || *c == 0x7f) return;
    print_field(out, key, command, before);
}

/* All but golden_detail, each line with `before` ahead of it. */
static void print_details(FILE *out, const struct golden_case *c, const char *before) {
    if (c->message) print_lines(out, c->message, before);
    if (c->status == GOLDEN_SAME) return;
    for (size_t i = 0; i < c->change_count; i++) print_lines(out, c->changes[i], before);
    char *differs = c->status == GOLDEN_CHANGED ? golden_causes_text(c) : NULL;
    if (differs) print_lines(out, differs, before);
    free(differs);
    if (c->tolerance_text && c->status == GOLDEN_CHANGED)
        print_field(out, "allowed: ", c->tolerance_text, before);
    char *beyond = golden_beyond_text(c);
    print_field(out, "beyond: ", beyond, before);
    free(beyond);
    print_field(out, "new: ", c->new_path, before);
    print_command(out, "again: ", c->command, before);
    print_command(out, "old: ", c->old_command, before);
    if (c->taken) say_line(out, "%s%s", before, GOLDEN_TAKEN);
}

char *golden_details(const struct golden_case *c) {
    char *text = NULL;
    size_t size = 0;
    FILE *out = say_text_begin(&text, &size);
    print_details(out, c, "");
    say_text_end(out);
    return text;
}

/* ---- In a terminal ---- */

static void tell_line(const struct golden_teller *teller, const struct golden_case *c) {
    static const char *const colors[] = {"32", "31", "36", "33", "33", "31"};
    char *detail = golden_detail(c);
    if (teller->colors) fprintf(teller->out, "\033[%sm", colors[c->status]);
    fprintf(teller->out, "%-8s", GOLDEN_STATUS[c->status]);
    if (teller->colors) fputs("\033[0m", teller->out);
    say_line(teller->out, " %s%s%s", c->name, detail ? "  " : "", detail ? detail : "");
    print_details(teller->out, c, "         ");
    free(detail);
}

/* ---- As TAP ---- */

static void put_description(FILE *out, const char *name) {
    for (const char *c = name; *c; c++) {
        if (*c == '#' || *c == '\\') putc('\\', out);
        putc((unsigned char)*c < 0x20 || *c == 0x7f ? '?' : *c, out);
    }
}

static void put_block(FILE *to, const struct golden_case *c) {
    char *headline = golden_headline(c), *lines = golden_details(c);
    fprintf(to, "  ---\n  status: %s\n  detail: ", GOLDEN_STATUS[c->status]);
    monge_write_json_string(headline, to);
    fputs("\n  lines: ", to);
    monge_write_json_string(lines, to);
    fputs("\n  ...\n", to);
    free(lines);
    free(headline);
}

static void tell_tap(const struct golden_teller *teller, const struct golden_case *c) {
    const bool good = c->status == GOLDEN_SAME || c->taken;
    fprintf(teller->out, "%sok %zu - ", good ? "" : "not ", teller->told);
    put_description(teller->out, c->name);
    fprintf(teller->out, "%s\n", c->unchanged ? " # SKIP unchanged" : "");
    if (!good) put_block(teller->out, c);
    if (c->taken) fprintf(teller->out, "# %s, and %s\n", GOLDEN_STATUS[c->status], GOLDEN_TAKEN);
    char *detail = c->within ? golden_detail(c) : NULL;
    if (detail) say_line(teller->out, "# %s", detail);
    free(detail);
}

/* ---- Both ---- */

void golden_tell_begin(struct golden_teller *teller) {
    if (teller->tap) fprintf(teller->out, "TAP version 13\n");
}

void golden_tell(struct golden_teller *teller, const struct golden_case *c) {
    teller->told++;
    if (teller->tap)
        tell_tap(teller, c);
    else if (c->status != GOLDEN_SAME || !teller->quiet)
        tell_line(teller, c);
    streams_flush();
}

void golden_tell_end(struct golden_teller *teller, const struct golden_results *results) {
    char *summary = golden_summary(results), *interruption = golden_interruption(results);
    if (teller->tap && interruption)
        fprintf(teller->out, "Bail out! %s\n", interruption);
    else if (teller->tap)
        fprintf(teller->out, "1..%zu\n# %s\n", teller->told, summary);
    else if (!teller->quiet)
        fprintf(teller->out, "%s, in %.1f s\n", summary, results->seconds);
    free(interruption);
    free(summary);
}
