#include "cli/check.h"

#include <stdio.h>
#include <stdlib.h>

#include "cli/load.h"
#include "cli/say.h"

static char *count_text(unsigned count, const char *what) {
    return say_text("%u %s%s", count, what, count == 1 ? "" : "s");
}

static void print_verdict(const char *scene, const struct load *load) {
    char *errors = count_text(load->errors, "error"), *warnings = count_text(load->warnings, "warning");
    const char *verdict = load->status == STATUS_YES ? "ok" : load->status == STATUS_NO ? errors : "not read";
    if (load->warnings > 0)
        say_line(stdout, "%s: %s, %s", scene, verdict, warnings);
    else
        say_line(stdout, "%s: %s", scene, verdict);
    free(errors);
    free(warnings);
    streams_flush();
}

static void check_limits(const struct loader *loader, const char *scene, struct load *load) {
    if (!load->scene) return;
    const struct monge_settings settings = monge_scene_settings(load->scene);
    if (load_allows(loader, scene, &settings)) return;
    load->errors++;
    load->status = STATUS_NO;
}

/* The scene with one combination of the sweep. */
static enum status check_scene(struct loader *loader, const char *scene, const struct monge_define *defines,
                               bool quiet) {
    struct load load = load_scene(loader, scene, defines, 0);
    check_limits(loader, scene, &load);
    load_examine(loader, &load);
    const bool wanted = load.status != STATUS_YES || !quiet;
    char *with = sweep_describe(&loader->sweep, defines),
         *title = say_text("%s%s%s", scene, *with ? " with " : "", with);
    if (wanted && loader->report.format == MONGE_FORMAT_TEXT) print_verdict(title, &load);
    free(title);
    free(with);
    load_close(loader, &load);
    return load.status;
}

static enum status check_scenes(struct loader *loader, bool quiet) {
    struct monge_define *defines = calloc(loader->sweep.count + 1, sizeof *defines);
    enum status worst = defines ? loader->scenes.status : STATUS_TROUBLE;
    if (!defines) say_error("out of memory");
    for (size_t i = 0; defines && i < loader->scenes.count * loader->sweep.total; i++) {
        sweep_combination(&loader->sweep, i % loader->sweep.total, defines);
        const enum status status =
            check_scene(loader, loader->scenes.all[i / loader->sweep.total].path, defines, quiet);
        if (status > worst) worst = status;
    }
    free(defines);
    return worst;
}

enum status check_command(const struct arguments *args) {
    struct loader loader;
    const bool good = loader_begin(&loader, args);
    loader.serial = true;
    const enum status status =
        good ? check_scenes(&loader, args->option[OPTION_QUIET].given) : STATUS_TROUBLE;
    loader_end(&loader, good ? stdout : NULL);
    return status;
}
