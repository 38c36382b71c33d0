#include "cli/load.h"

#include <string.h>

#include "cli/interrupt.h"
#include "cli/say.h"

bool loader_begin(struct loader *loader, const struct arguments *args) {
    *loader = (struct loader){.untrusted = args->option[OPTION_UNTRUSTED].given};
    if (!sweep_read(args, &loader->sweep) || !limits_read(args, &loader->limits) ||
        !report_begin(&loader->report, args))
        return false;
    sweep_warn(args, "", &loader->report);
    return scenes_find(&loader->scenes, args, SCENES_ALONE, &loader->limits.load, &loader->report);
}

static void close_last(struct loader *loader) {
    if (loader->diag) report_close(&loader->report, loader->diag, false);
    loader->diag = NULL;
    loader->path = NULL;
}

void loader_end(struct loader *loader, FILE *out) {
    close_last(loader);
    if (out)
        report_end(&loader->report, out);
    else
        monge_diagnostics_free(loader->report.all);
    scenes_free(&loader->scenes);
    sweep_free(&loader->sweep);
}

static struct monge_scene *load_path(const struct loader *loader, const char *path,
                                     const struct monge_load_options *options,
                                     struct monge_diagnostics *diag) {
    const struct monge_text *input = &loader->scenes.input;
    if (strcmp(path, "-") != 0) return monge_load_file(path, options, diag);
    return monge_load_memory("<stdin>", input->bytes, input->size, options, diag);
}

/* Of another combination of the same scene, those of the one before. NULL: no memory. */
static struct monge_diagnostics *open_diagnostics(struct loader *loader, const char *path) {
    if (!loader->serial) return report_open(&loader->report);
    if (loader->path == path) return loader->diag;
    close_last(loader);
    loader->diag = report_open(&loader->report);
    loader->path = loader->diag ? path : NULL;
    return loader->diag;
}

struct load load_scene(struct loader *loader, const char *path, const struct monge_define *defines,
                       unsigned frame) {
    const bool again = loader->serial && loader->path == path;
    struct load load = {.status = STATUS_TROUBLE, .diag = open_diagnostics(loader, path)};
    struct monge_diagnostics *diag = load.diag;
    if (!diag) return load;
    const struct monge_load_options options = {.limits = loader->limits.load,
                                               .defines = defines,
                                               .define_count = loader->sweep.count,
                                               .frame = frame,
                                               .untrusted = loader->untrusted,
                                               .outline = loader->outline,
                                               .again = again};
    const unsigned errors = monge_diagnostics_errors(diag), warnings = monge_diagnostics_warnings(diag);
    const unsigned failures = monge_diagnostics_failures(diag);
    load.scene = load_path(loader, path, &options, diag);
    load.errors = monge_diagnostics_errors(diag) - errors;
    load.warnings = monge_diagnostics_warnings(diag) - warnings;
    if (load.scene)
        load.status = STATUS_YES;
    else if (monge_diagnostics_failures(diag) == failures)
        load.status = STATUS_NO;
    if (load.scene || !interrupt_pending())
        report_show(&loader->report, diag); /* a read that a signal ends */
    return load;
}

enum status load_frame(struct loader *loader, struct load *load, unsigned frame) {
    const unsigned failures = monge_diagnostics_failures(load->diag);
    const bool good = monge_scene_set_frame(load->scene, frame, load->diag);
    report_show(&loader->report, load->diag);
    if (good) return STATUS_YES;
    return monge_diagnostics_failures(load->diag) == failures ? STATUS_NO : STATUS_TROUBLE;
}

void load_examine(struct loader *loader, struct load *load) {
    if (!load->scene) return;
    const unsigned warnings = monge_diagnostics_warnings(load->diag);
    monge_scene_examine(load->scene, load->diag);
    load->warnings += monge_diagnostics_warnings(load->diag) - warnings;
    report_show(&loader->report, load->diag);
}

void load_close(struct loader *loader, struct load *load) {
    monge_scene_free(load->scene);
    if (load->diag && !loader->serial) report_close(&loader->report, load->diag, false);
}

bool load_allows(const struct loader *loader, const char *path, const struct monge_settings *settings) {
    if ((uint64_t)settings->width * settings->height <= loader->limits.pixels) return true;
    report_failure(&loader->report, "limit-pixels",
                   "%s: a picture of %ux%u has more than %zu pixels (the limit `pixels`)", path,
                   settings->width, settings->height, loader->limits.pixels);
    return false;
}
