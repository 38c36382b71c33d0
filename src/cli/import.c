#include "cli/import.h"

#include <string.h>

#include "cli/options.h"
#include "cli/paths.h"
#include "cli/say.h"
#include "monge.h"

enum status import_command(const struct arguments *args) {
    const char *path = args->operands[0];
    const char *out =
        args->option[OPTION_IMPORT_OUTPUT].given ? args->option[OPTION_IMPORT_OUTPUT].text : "-";
    if (args->count > 1) {
        say_usage(COMMAND_IMPORT, "import: expected one file, found `%s` as well", args->operands[1]);
        return STATUS_TROUBLE;
    }
    if (strcmp(path, "-") != 0 && path_is_file(path) && path_is_same(path, out)) {
        say_usage(COMMAND_IMPORT, "%s would be written over by its own import", path);
        return STATUS_TROUBLE;
    }
    struct monge_diagnostics *diag = monge_diagnostics_new();
    if (!diag) {
        say_error("out of memory");
        return STATUS_TROUBLE;
    }
    const bool done = monge_import(path, out, NULL, diag);
    const bool failed = monge_diagnostics_failures(diag) > 0;
    monge_diagnostics_print(diag, stderr);
    monge_diagnostics_free(diag);
    return done ? STATUS_YES : failed ? STATUS_TROUBLE : STATUS_NO;
}
