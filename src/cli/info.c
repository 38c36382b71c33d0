#include "cli/info.h"

#include <stdio.h>

#include "cli/report.h"
#include "cli/say.h"

static struct monge_scene *load_outlined(const char *path, struct report *report, enum status *status) {
    const struct monge_load_options options = {.outline = true};
    struct monge_diagnostics *diag = report_open(report);
    *status = STATUS_TROUBLE;
    if (!diag) return NULL;
    struct monge_scene *scene = monge_load_file(path, &options, diag);
    if (scene) *status = STATUS_YES;
    else if (monge_diagnostics_failures(diag) == 0) *status = STATUS_NO;
    report_close(report, diag, true);
    return scene;
}

static enum status tell(const char *path, struct report *report, enum monge_format format, const char *title) {
    enum status status;
    struct monge_scene *scene = load_outlined(path, report, &status);
    if (!scene) return status;
    if (title) printf("%s\n", title);
    if (!monge_scene_info(scene, format, stdout)) {
        say_error("%s: no memory for %zu primitives", path, monge_scene_primitives(scene));
        status = STATUS_TROUBLE;
    }
    streams_flush();
    monge_scene_free(scene);
    return status;
}

enum status info_command(const struct arguments *args) {
    const bool json = args->option[OPTION_JSON].given;
    const enum monge_format format = json ? MONGE_FORMAT_JSON : MONGE_FORMAT_TEXT;
    struct report report;
    enum status worst = STATUS_YES;
    if (!report_begin(&report, args)) return STATUS_TROUBLE;
    for (size_t i = 0; i < args->count; i++) {
        if (i > 0 && !json) printf("\n");
        const enum status status = tell(args->operands[i], &report, format, args->count > 1 && !json ? args->operands[i] : NULL);
        if (status > worst) worst = status;
    }
    report_end(&report, stdout);
    return worst;
}
