#include "cli/check.h"

#include <stdio.h>

#include "cli/load.h"
#include "cli/say.h"

static void print_count(const char *before, unsigned count, const char *what) {
    printf("%s%u %s%s", before, count, what, count == 1 ? "" : "s");
}

static void print_verdict(const char *scene, const struct load *load) {
    printf("%s:", scene);
    if (load->status == STATUS_YES) printf(" ok%s", load->warnings > 0 ? "," : "");
    if (load->status == STATUS_TROUBLE) printf(" not read");
    if (load->status == STATUS_NO) print_count(" ", load->errors, "error");
    if (load->status == STATUS_NO && load->warnings > 0) printf(",");
    if (load->warnings > 0) print_count(" ", load->warnings, "warning");
    printf("\n");
    streams_flush();
}

enum status check_command(const struct arguments *args) {
    struct report report;
    enum status worst = STATUS_YES;
    if (!report_begin(&report, args)) return STATUS_TROUBLE;
    for (size_t i = 0; i < args->count; i++) {
        struct load load = load_scene(args->operands[i], &report);
        monge_scene_free(load.scene);
        const bool wanted = load.status != STATUS_YES || !args->option[OPTION_QUIET].given;
        if (wanted && report.format == MONGE_FORMAT_TEXT) print_verdict(args->operands[i], &load);
        if (load.status > worst) worst = load.status;
    }
    report_end(&report, stdout);
    return worst;
}
