#include "cli/load.h"

struct load load_scene(const char *path, struct report *report) {
    struct load load = {.status = STATUS_TROUBLE};
    struct monge_diagnostics *diag = report_open(report);
    if (!diag) return load;
    const unsigned errors = monge_diagnostics_errors(diag), warnings = monge_diagnostics_warnings(diag);
    const unsigned failures = monge_diagnostics_failures(diag);
    load.scene = monge_load_file(path, NULL, diag);
    load.errors = monge_diagnostics_errors(diag) - errors;
    load.warnings = monge_diagnostics_warnings(diag) - warnings;
    if (load.scene)
        load.status = STATUS_YES;
    else if (monge_diagnostics_failures(diag) == failures)
        load.status = STATUS_NO;
    report_close(report, diag, true);
    return load;
}
