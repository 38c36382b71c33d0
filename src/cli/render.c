#include "cli/render.h"

#include <stdlib.h>
#include <string.h>

#include "cli/clock.h"
#include "cli/interrupt.h"
#include "cli/load.h"
#include "cli/outputs.h"
#include "cli/progress.h"
#include "cli/say.h"
#include "cli/stats.h"

/* ---- What the options change ---- */

static void override_settings(const struct option_value *option, struct monge_settings *settings) {
    if (option[OPTION_SIZE].given) {
        settings->width = option[OPTION_SIZE].number[0];
        settings->height = option[OPTION_SIZE].number[1];
    }
    if (option[OPTION_SAMPLES].given) settings->samples = option[OPTION_SAMPLES].number[0];
    if (option[OPTION_DEPTH].given) settings->depth = option[OPTION_DEPTH].number[0];
    if (option[OPTION_BITS].given) settings->bits = option[OPTION_BITS].choice == 0 ? 8 : 16;
    if (option[OPTION_SHADOW].given) settings->shadow = option[OPTION_SHADOW].fraction;
    if (option[OPTION_NO_SHADOWS].given) settings->shadow = 1.0;
    if (option[OPTION_SHADING].given) settings->shading = (enum monge_shading)option[OPTION_SHADING].choice;
    if (option[OPTION_ENCODING].given)
        settings->encoding = (enum monge_encoding)option[OPTION_ENCODING].choice;
}

/* The region that is asked for, or the whole picture. False, with the reason on stderr, when it is not inside. */
static bool choose_region(const struct option_value *option, const char *scene,
                          const struct monge_settings *settings, struct monge_region *region) {
    *region = (struct monge_region){0, 0, settings->width, settings->height};
    if (!option->given) return true;
    const uint32_t *n = option->number;
    *region = (struct monge_region){n[0], n[1], n[2], n[3]};
    if ((uint64_t)n[0] + n[2] <= settings->width && (uint64_t)n[1] + n[3] <= settings->height) return true;
    say_error("--region %s does not lie within the picture of %s, which is %ux%u", option->text, scene,
              settings->width, settings->height);
    return false;
}

/* ---- One picture ---- */

static bool write_film(const struct monge_film *film, const char *path, struct report *report) {
    struct monge_diagnostics *diag = report_open(report);
    const bool written = diag && monge_film_write_png(film, path, diag);
    if (diag) report_close(report, diag, !interrupt_pending());
    return written;
}

static struct monge_film *render_film(const struct option_value *option, const char *name,
                                      struct monge_scene *scene, const struct monge_region *region,
                                      struct picture *picture) {
    const enum progress_wish wish = (enum progress_wish)option[OPTION_PROGRESS].choice;
    struct progress progress;
    struct monge_job job = {.threads = option[OPTION_THREADS].number[0], .cancel = interrupt_flag()};
    if (progress_wanted(wish, option[OPTION_QUIET].given)) {
        job.progress = progress_update;
        job.context = &progress;
    }
    progress_begin(&progress, name);
    struct monge_film *film = monge_render(scene, &picture->settings, region, &job, &picture->stats);
    progress_end(&progress);
    if (!film && !interrupt_pending())
        say_error("no memory for a picture of %ux%u", region->width, region->height);
    return film;
}

/* Everything after loading. A signal in here ends the program once nothing is half done. */
static enum status render_scene(const struct option_value *option, const struct output *output,
                                struct monge_scene *scene, struct report *report, struct picture *picture) {
    picture->settings = monge_scene_settings(scene);
    override_settings(option, &picture->settings);
    const char *wrong = monge_settings_check(&picture->settings);
    if (wrong) say_error("%s: %s", output->scene, wrong);
    if (wrong || !choose_region(&option[OPTION_REGION], output->scene, &picture->settings, &picture->region))
        return STATUS_TROUBLE;

    interrupt_defer();
    struct monge_film *film = render_film(option, output->name, scene, &picture->region, picture);
    const double rendered = clock_seconds();
    picture->done = film && write_film(film, output->path, report);
    picture->write_seconds = clock_seconds() - rendered;
    picture->peak_memory_bytes = stats_peak_memory();
    monge_film_free(film);
    interrupt_settle();
    return picture->done ? STATUS_YES : STATUS_TROUBLE;
}

static enum status render_output(const struct option_value *option, const struct output *output,
                                 struct report *report, struct picture *picture) {
    const double begun = clock_seconds();
    *picture = (struct picture){.scene = output->scene, .output = output->path};
    struct load load = load_scene(output->scene, report);
    const double loaded = clock_seconds();
    if (!load.scene) return load.status;
    const bool built = monge_scene_prepare(load.scene); /* here a signal may still end the program at once */
    const double prepared = clock_seconds();
    if (!built)
        say_error("%s: no memory for %zu primitives", output->scene, monge_scene_primitives(load.scene));
    const enum status status = built ? render_scene(option, output, load.scene, report, picture) : STATUS_TROUBLE;
    picture->primitives = monge_scene_primitives(load.scene);
    picture->load_seconds = loaded - begun;
    picture->stats.build_seconds += prepared - loaded;
    monge_scene_free(load.scene);
    if (picture->done && !option[OPTION_QUIET].given)
        say_note("wrote %s  %ux%u  %.2f s", strcmp(output->path, "-") == 0 ? "standard output" : output->path,
                 picture->region.width, picture->region.height, clock_seconds() - begun);
    return status;
}

/* ---- All pictures ---- */

static enum status render_outputs(const struct arguments *args, const struct output *outputs,
                                  struct report *report, struct picture *pictures) {
    const struct option_value *option = args->option;
    enum status worst = STATUS_YES;
    size_t done = 0;
    for (size_t i = 0; i < args->count; i++) {
        const enum status status = render_output(option, &outputs[i], report, &pictures[i]);
        if (status > worst) worst = status;
        done += pictures[i].done;
    }
    if (done < args->count && args->count > 1 && !option[OPTION_QUIET].given)
        say_note("%zu rendered, %zu failed", done, args->count - done);
    const char *stats = option[OPTION_STATS].text;
    if (!stats) return worst;
    interrupt_defer();
    if (!stats_write(stats, pictures, args->count)) worst = STATUS_TROUBLE;
    interrupt_settle();
    return worst;
}

/* A document on stderr must be alone there: the notes are left out. */
static enum status render_reported(struct arguments args, const struct output *outputs, struct picture *pictures) {
    struct report report;
    if (!report_begin(&report, &args)) return STATUS_TROUBLE;
    if (report.format != MONGE_FORMAT_TEXT) args.option[OPTION_QUIET].given = true;
    const enum status status = render_outputs(&args, outputs, &report, pictures);
    report_end(&report, stderr);
    return status;
}

enum status render_command(const struct arguments *args) {
    const struct option_value *option = args->option;
    if (option[OPTION_SHADOW].given && option[OPTION_NO_SHADOWS].given) {
        say_usage(COMMAND_RENDER, "--shadow and --no-shadows: give one of them");
        return STATUS_TROUBLE;
    }
    struct output *outputs = calloc(args->count, sizeof *outputs);
    struct picture *pictures = calloc(args->count, sizeof *pictures);
    enum status status = STATUS_TROUBLE;
    if (!outputs || !pictures)
        say_error("out of memory");
    else if (outputs_plan(option[OPTION_OUTPUT].text, option[OPTION_STATS].text, args->operands, args->count,
                          outputs))
        status = render_reported(*args, outputs, pictures);
    if (outputs) outputs_free(outputs, args->count);
    free(outputs);
    free(pictures);
    return status;
}
