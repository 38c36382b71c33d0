#include "cli/report.h"

#include "cli/say.h"

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

struct monge_diagnostics *report_open(struct report *report) {
    return report->all ? report->all : new_diagnostics();
}

void report_show(const struct report *report, struct monge_diagnostics *diag) {
    if (diag != report->all) monge_diagnostics_print_new(diag, say_stream());
}

void report_close(struct report *report, struct monge_diagnostics *diag, bool wanted) {
    if (diag == report->all) return;
    if (wanted) report_show(report, diag);
    monge_diagnostics_free(diag);
}

void report_end(struct report *report, FILE *out) {
    if (report->all) monge_diagnostics_write(report->all, report->format, out);
    monge_diagnostics_free(report->all);
}
