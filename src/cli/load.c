#include "cli/load.h"

#include "cli/say.h"

struct load load_scene(const char *path) {
    struct load load = {.status = STATUS_TROUBLE};
    struct monge_diagnostics *diag = monge_diagnostics_new();
    if (!diag) {
        say_error("out of memory");
        return load;
    }
    load.scene = monge_load_file(path, NULL, diag);
    load.errors = monge_diagnostics_errors(diag);
    load.warnings = monge_diagnostics_warnings(diag);
    if (load.scene)
        load.status = STATUS_YES;
    else if (monge_diagnostics_failures(diag) == 0)
        load.status = STATUS_NO;
    monge_diagnostics_print(diag, stderr);
    monge_diagnostics_free(diag);
    return load;
}
