#include "cli/report.h"

#include <stdarg.h>
#include <stdlib.h>

#include "cli/say.h"

/* ---- What goes wrong first ---- */

static _Thread_local struct problem *watched;

void report_watch(struct problem *problem) { watched = problem; }

static void note(struct monge_diagnostics *diag) {
    struct monge_problem first;
    if (!monge_diagnostics_take(diag, &first) || !watched || watched->code) return;
    *watched = (struct problem){say_text("%s", first.code), say_text("%s", first.message),
                                first.file ? say_text("%s", first.file) : NULL, first.line, first.column};
}

void problem_free(struct problem *problem) {
    free(problem->code);
    free(problem->message);
    free(problem->file);
}

/* ---- Several at once ---- */

static _Thread_local struct monge_diagnostics *kept_apart; /* NULL: all goes into the document at once */

static struct monge_diagnostics *new_diagnostics(void);

void report_apart(const struct report *report) { kept_apart = report->all ? new_diagnostics() : NULL; }

struct monge_diagnostics *report_apart_end(void) {
    struct monge_diagnostics *apart = kept_apart;
    kept_apart = NULL;
    return apart;
}

void report_add(const struct report *report, struct monge_diagnostics *apart, bool again) {
    if (apart) monge_diagnostics_append(report->all, apart, again);
    monge_diagnostics_free(apart);
}

/* ---- The report ---- */

static struct monge_diagnostics *new_diagnostics(void) {
    struct monge_diagnostics *diag = monge_diagnostics_new();
    if (!diag) say_error("out of memory");
    return diag;
}

bool report_begin(struct report *report, const struct arguments *args) {
    *report = (struct report){.format = (enum monge_format)args->option[OPTION_FORMAT].choice};
    if (report->format == MONGE_FORMAT_TEXT) return true;
    report->all = new_diagnostics();
    return report->all != NULL;
}

struct monge_diagnostics *report_open(const struct report *report) {
    if (!report->all) return new_diagnostics();
    return kept_apart ? kept_apart : report->all;
}

void report_show(const struct report *report, struct monge_diagnostics *diag) {
    note(diag);
    if (!report->all) monge_diagnostics_print_new(diag, say_stream());
}

void report_close(const struct report *report, struct monge_diagnostics *diag, bool wanted) {
    if (wanted) report_show(report, diag);
    if (!report->all) monge_diagnostics_free(diag);
}

static void tell(const struct report *report,
                 void add(struct monge_diagnostics *, const char *, const char *), const char *code,
                 const char *format, va_list args) {
    struct monge_diagnostics *diag = report_open(report);
    char *message = say_text_list(format, args);
    if (diag) add(diag, code, message);
    if (diag) report_close(report, diag, true);
    free(message);
}

void report_failure(const struct report *report, const char *code, const char *format, ...) {
    va_list args;
    va_start(args, format);
    tell(report, monge_diagnostics_fail, code, format, args);
    va_end(args);
}

void report_warning(const struct report *report, const char *code, const char *format, ...) {
    va_list args;
    va_start(args, format);
    tell(report, monge_diagnostics_warn, code, format, args);
    va_end(args);
}

bool report_has_failures(const struct report *report) {
    return report->all && monge_diagnostics_failures(report->all) > 0;
}

void report_end(struct report *report, FILE *out) {
    if (report->all) monge_diagnostics_write(report->all, report->format, out);
    monge_diagnostics_free(report->all);
}
