#include "cli/render.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/asked.h"
#include "cli/batch.h"
#include "cli/checkpoint.h"
#include "cli/clock.h"
#include "cli/interrupt.h"
#include "cli/render_picture.h"
#include "cli/say.h"
#include "cli/stats.h"
#include "cli/unchanged.h"

/* ---- Pictures ---- */

static struct picture *add_picture(struct unit *unit, const char *path, unsigned frame) {
    struct picture *pictures = realloc(unit->pictures, (unit->count + 1) * sizeof *pictures);
    if (!pictures) say_no_memory();
    unit->pictures = pictures;
    pictures[unit->count] = (struct picture){.scene = unit->output->scene,
                                             .output = path ? say_text("%s", path) : NULL,
                                             .frame = frame,
                                             .defines = unit->output->defines,
                                             .define_count = unit->work->loader.sweep.count};
    return &pictures[unit->count++];
}

/* The last one is none yet. */
static void drop_picture(struct unit *unit) { picture_free(&unit->pictures[--unit->count]); }

/* The last picture of the unit is done. What a signal has cut short is no failure: it is as if it had not been begun. */
static enum status end_picture(struct unit *unit, enum status status) {
    struct work *work = unit->work;
    struct picture *picture = &unit->pictures[unit->count - 1];
    const bool failed = picture->outcome == PICTURE_FAILED, stopped = failed && interrupt_pending();
    if (failed && !stopped)
        picture->problem = unit->problem;
    else
        problem_free(&unit->problem);
    unit->problem = (struct problem){0};
    if (stopped) {
        drop_picture(unit);
        return status;
    }
    log_keep(&work->log, (size_t)(unit - work->units), picture);
    progress_done(&unit->progress, picture->outcome);
    return status;
}

/* The picture that there is no picture of; with --frames nobody knows yet where it would have gone. */
static enum status fail_output(struct unit *unit, enum status status) {
    add_picture(unit, unit->work->plan.frames ? NULL : unit->output->path, 0);
    return end_picture(unit, status);
}

/* NULL where it is asked for, and right, that the picture stays as it is; else why not, "" being that nobody asked. */
static const char *reason_to_render(const struct unit *unit, struct picture *picture) {
    const struct work *work = unit->work;
    const struct output *output = unit->output;
    if (!work_wants(work, OPTION_SKIP_UNCHANGED) && !work_wants(work, OPTION_RESUME)) return "";
    char *asked = asked_text(work->args.option, output->defines, work->loader.sweep.count, picture->frame);
    const char *reason = unchanged_reason(picture, asked, work->plan.passes, &work->loader.limits.load);
    free(asked);
    return reason;
}

static bool is_unchanged(const struct unit *unit, struct picture *picture) {
    const struct work *work = unit->work;
    if (reason_to_render(unit, picture)) return false;
    picture->outcome = PICTURE_UNCHANGED;
    checkpoint_forget(picture->output);
    if (!work_wants(work, OPTION_QUIET)) say_note("unchanged %s", picture->output);
    return true;
}

/* ---- What would be rendered ---- */

/* Of the last picture. */
static enum status foresee(struct unit *unit) {
    struct picture *picture = &unit->pictures[unit->count - 1];
    const char *scene = picture->scene;
    if (strcmp(scene, "-") != 0 && access(scene, R_OK) != 0) {
        report_failure(&unit->work->loader.report, "cannot-read", "cannot read %s: %s", scene,
                       strerror(errno));
        return STATUS_TROUBLE;
    }
    picture->reason = reason_to_render(unit, picture);
    picture->outcome = picture->reason ? PICTURE_RENDERED : PICTURE_UNCHANGED;
    return STATUS_YES;
}

static void tell_foreseen(const struct unit *unit) {
    for (size_t i = 0; i < unit->count; i++) {
        const struct picture *p = &unit->pictures[i];
        if (p->outcome == PICTURE_FAILED) continue;
        const char *output = strcmp(p->output, "-") == 0 ? "standard output" : p->output;
        say_line(stdout, "%s -> %s: %s%s%s", unit->output->title, output,
                 p->reason ? "would be rendered" : "unchanged", p->reason && *p->reason ? ": " : "",
                 p->reason ? p->reason : "");
    }
    streams_flush();
}

/* ---- The frames of a scene ---- */

/* Into the last picture; the scene stands at frame *at, which moves. */
static enum status render_frame(struct unit *unit, struct load *load, unsigned frame, unsigned *at,
                                double begun) {
    struct work *work = unit->work;
    struct picture *picture = &unit->pictures[unit->count - 1];
    if (work_wants(work, OPTION_DRY_RUN)) return foresee(unit);
    if (work->plan.frames && !plan_reach(&work->plan, picture->output)) return STATUS_TROUBLE;
    if (work->plan.frames && is_unchanged(unit, picture)) return STATUS_YES;
    const enum status status = frame == *at ? STATUS_YES : load_frame(&unit->work->loader, load, frame);
    if (status == STATUS_YES) {
        *at = frame;
        return render_picture(unit, load, begun);
    }
    if (!work_wants(work, OPTION_QUIET)) say_note("frame %u of %s is left out", frame, unit->output->title);
    return status;
}

static enum status render_frames(struct unit *unit, struct load *load, const unsigned *frames, char **paths,
                                 size_t count, double begun) {
    enum status worst = STATUS_YES;
    const bool numbered = unit->work->plan.frames && monge_scene_frames(load->scene) > 0;
    unsigned at = frames[0];
    progress_pictures(&unit->progress, count);
    for (size_t i = 0; i < count && !interrupt_pending(); i++) {
        add_picture(unit, paths[i], numbered ? frames[i] : 0);
        const enum status status =
            end_picture(unit, render_frame(unit, load, frames[i], &at, i == 0 ? begun : clock_seconds()));
        if (status > worst) worst = status;
        if (status != STATUS_YES && work_wants(unit->work, OPTION_FAIL_FAST)) break;
    }
    return worst;
}

static enum status render_load(struct unit *unit, struct load *load, double begun) {
    struct work *work = unit->work;
    size_t count = 0;
    const unsigned total = monge_scene_frames(load->scene);
    unsigned *frames = asked_frames(&work->args.option[OPTION_FRAMES], unit->output->scene, total,
                                    &work->loader.report, &count);
    char **paths = frames ? plan_frames(&work->plan, unit->output, frames, count, total) : NULL;
    const enum status status =
        paths ? render_frames(unit, load, frames, paths, count, begun) : fail_output(unit, STATUS_TROUBLE);
    paths_free(paths, count);
    free(frames);
    return status;
}

/* ---- Units ---- */

/* Without --frames, all that can be known before the scene is loaded: that its picture cannot be written, or need
 * not be. For a scene that is not there no folder is made. */
static bool is_settled(struct unit *unit, enum status *status) {
    const char *scene = unit->output->scene;
    if (unit->work->plan.frames || (strcmp(scene, "-") != 0 && access(scene, F_OK) != 0)) return false;
    struct picture *picture = add_picture(unit, unit->output->path, 0);
    if (work_wants(unit->work, OPTION_DRY_RUN)) {
        *status = end_picture(unit, foresee(unit));
        return true;
    }
    const bool reached = plan_reach(&unit->work->plan, picture->output);
    if (reached && !is_unchanged(unit, picture)) {
        drop_picture(unit);
        return false;
    }
    *status = end_picture(unit, reached ? STATUS_YES : STATUS_TROUBLE);
    return true;
}

static enum status render_output(struct unit *unit) {
    struct loader *loader = &unit->work->loader;
    const unsigned frame = unit->work->args.option[OPTION_FRAMES].number[0];
    const double begun = clock_seconds();
    enum status status;
    if (is_settled(unit, &status)) return status;
    struct load load = load_scene(loader, unit->output->scene, unit->output->defines, frame);
    if (!load.scene || interrupt_pending())
        status = fail_output(unit, load.status);
    else
        status = render_load(unit, &load, begun);
    load_close(loader, &load);
    return status;
}

static bool run_unit(void *context, size_t index) {
    struct work *work = context;
    struct unit *unit = &work->units[index];
    *unit = (struct unit){.work = work, .output = &work->plan.outputs[index]};
    progress_unit_begin(&unit->progress, &work->progress);
    report_watch(&unit->problem);
    report_apart(&work->loader.report);
    unit->status = render_output(unit);
    unit->apart = report_apart_end();
    report_watch(NULL);
    progress_unit_end(&unit->progress);
    return unit->status == STATUS_YES || !work_wants(work, OPTION_FAIL_FAST);
}

static void tell_repeated(struct work *work) {
    if (work->repeated > 0)
        say_note("%s: the same for %zu more combination%s", work->scene, work->repeated,
                 work->repeated == 1 ? "" : "s");
    work->repeated = 0;
}

/* What each combination of a broken scene says again is told once. */
static void tell(struct work *work, const struct unit *unit, const char *said) {
    const bool again = unit->status != STATUS_YES && *said && work->said &&
                       work->scene == unit->output->scene && strcmp(work->said, said) == 0;
    work->repeated += again;
    if (again) return;
    progress_pause(&work->progress);
    tell_repeated(work);
    fputs(said, stderr);
    progress_resume(&work->progress);
    free(work->said);
    work->said = say_text("%s", said);
    work->scene = unit->output->scene;
}

/* What each combination says again is kept once. A unit that a signal has stopped has no picture: it says nothing. */
static void document(struct work *work, struct unit *unit) {
    if (unit->count > 0)
        report_add(&work->loader.report, unit->apart, work->documented == unit->output->scene);
    else
        monge_diagnostics_free(unit->apart);
    unit->apart = NULL;
    work->documented = unit->output->scene;
}

static void end_unit(void *context, size_t index, const char *said) {
    struct work *work = context;
    struct unit *unit = &work->units[index];
    tell(work, unit, said);
    document(work, unit);
    if (work_wants(work, OPTION_DRY_RUN) && !work_wants(work, OPTION_QUIET)) tell_foreseen(unit);
    for (size_t i = 0; i < unit->count; i++) {
        work->outcomes[unit->pictures[i].outcome]++;
        log_picture(&work->log, &unit->pictures[i]);
    }
    if (unit->status > work->worst) work->worst = unit->status;
}

/* What goes to a pipe has an order. */
static unsigned choose_jobs(const struct work *work) {
    const struct option_value *option = &work->args.option[OPTION_JOBS];
    const unsigned jobs = option->given ? option->number[0] : monge_processors();
    if (plan_is_serial(&work->plan)) return 1;
    return jobs < work->plan.count ? jobs : work->plan.count > 0 ? (unsigned)work->plan.count : 1;
}

/* ---- What has become of all ---- */

enum { FEW = 10 }; /* pictures; of more, a failure may have left the screen by the end */

static void list_failures(const struct work *work) {
    for (size_t i = 0; i < work->loader.scenes.missing; i++)
        say_note("failed %s", work->loader.scenes.lost[i]);
    for (size_t i = 0; i < work->begun; i++)
        for (size_t k = 0; k < work->units[i].count; k++) {
            const struct picture *p = &work->units[i].pictures[k];
            if (p->outcome != PICTURE_FAILED) continue;
            if (p->output)
                say_note("failed %s  from %s", p->output, work->units[i].output->title);
            else
                say_note("failed %s", work->units[i].output->title);
        }
}

/* With what was asked for and is not there. */
static size_t count_lost(const struct work *work) {
    return work->outcomes[PICTURE_FAILED] + work->loader.scenes.missing;
}

static size_t count_pictures(const struct work *work) {
    const size_t *n = work->outcomes;
    return n[PICTURE_RENDERED] + n[PICTURE_UNCHANGED] + count_lost(work);
}

/* Of those that are not rendered: ", 3 unchanged, 1 failed". To be freed. */
static char *count_others(const struct work *work) {
    const size_t unchanged = work->outcomes[PICTURE_UNCHANGED], failed = count_lost(work);
    char *first = unchanged ? say_text(", %zu unchanged", unchanged) : say_text("%s", "");
    char *both = failed ? say_text("%s, %zu failed", first, failed) : say_text("%s", first);
    free(first);
    return both;
}

static void summarize(const struct work *work) {
    const size_t *n = work->outcomes, left = work->plan.count - work->begun, all = count_pictures(work);
    if (all + left < 2 || work_wants(work, OPTION_QUIET)) return;
    if (all > FEW) list_failures(work);
    char *others = count_others(work);
    char *rest = left ? say_text(", %zu not begun", left) : say_text("%s", "");
    say_note("%zu %srendered%s%s", n[PICTURE_RENDERED], work_wants(work, OPTION_DRY_RUN) ? "would be " : "",
             others, rest);
    free(rest);
    free(others);
}

/* How the rest is made of a batch that a signal has stopped; "" where it must begin anew. */
static const char *way_on(const struct work *work) {
    const size_t *n = work->outcomes;
    if (plan_is_serial(&work->plan)) return "";
    if (work_wants(work, OPTION_RESUME)) return "; the same command goes on";
    return n[PICTURE_RENDERED] + n[PICTURE_UNCHANGED] > 0 ? "; the same command with --resume goes on" : "";
}

static void tell_interrupted(const struct work *work) {
    if (work_wants(work, OPTION_QUIET)) return;
    if (count_pictures(work) > FEW) list_failures(work);
    char *others = count_others(work);
    say_note("interrupted: %zu of %zu rendered%s%s", work->outcomes[PICTURE_RENDERED],
             work->progress.pictures, others, way_on(work));
    free(others);
}

static bool write_stats(const struct work *work, const char *path) {
    size_t count = 0;
    for (size_t i = 0; i < work->begun; i++) count += work->units[i].count;
    struct picture *all = calloc(count + 1, sizeof *all), *to = all;
    for (size_t i = 0; all && i < work->begun; i++)
        for (size_t k = 0; k < work->units[i].count; k++) *to++ = work->units[i].pictures[k];
    if (!all) say_error("out of memory");
    const bool written = all && stats_write(path, all, count, &work->loader.report);
    free(all);
    return written;
}

/* ---- All of it ---- */

static enum status render_all(struct work *work) {
    const struct option_value *option = work->args.option;
    const unsigned jobs = choose_jobs(work);
    const bool held = jobs > 1 || work->loader.sweep.total > 1;
    const struct batch batch = {work->plan.count, jobs, held, work, run_unit, end_unit};
    work->worst = work->loader.scenes.status;
    const bool dry = option[OPTION_DRY_RUN].given;
    progress_begin(&work->progress, dry ? PROGRESS_NEVER : (enum progress_wish)option[OPTION_PROGRESS].choice,
                   option[OPTION_QUIET].given, work->plan.count, work->loader.scenes.missing);
    work->begun = batch_run(&batch);
    progress_end(&work->progress);
    tell_repeated(work);
    if (interrupt_pending() && count_pictures(work) < work->progress.pictures)
        tell_interrupted(work);
    else
        summarize(work);
    if (option[OPTION_STATS].text && !dry && !write_stats(work, option[OPTION_STATS].text))
        work->worst = STATUS_TROUBLE;
    return log_close(&work->log) ? work->worst : STATUS_TROUBLE;
}

static bool work_begin(struct work *work, const struct arguments *args) {
    *work = (struct work){.args = *args};
    if (!loader_begin(&work->loader, args) ||
        !plan_begin(&work->plan, args, &work->loader.scenes, &work->loader.sweep, &work->loader.report) ||
        !log_open(&work->log, args->option[OPTION_DRY_RUN].given ? NULL : args->option[OPTION_LOG].text,
                  &work->loader.report))
        return false;
    /* a document on stderr must be alone there: the notes are left out */
    if (work->loader.report.format != MONGE_FORMAT_TEXT ||
        args->option[OPTION_PROGRESS].choice == PROGRESS_JSON)
        work->args.option[OPTION_QUIET].given = true;
    work->units = calloc(work->plan.count + 1, sizeof *work->units);
    if (!work->units) say_error("out of memory");
    return work->units != NULL;
}

static void work_end(struct work *work, bool begun) {
    for (size_t i = 0; i < work->begun; i++) {
        for (size_t k = 0; k < work->units[i].count; k++) picture_free(&work->units[i].pictures[k]);
        free(work->units[i].pictures);
    }
    free(work->units);
    free(work->said);
    plan_free(&work->plan);
    loader_end(&work->loader, begun || report_has_failures(&work->loader.report) ? stderr : NULL);
}

static bool contradicts(const struct arguments *args, enum option_id a, enum option_id b) {
    if (!args->option[a].given || !args->option[b].given) return false;
    say_usage(COMMAND_RENDER, "--%s and --%s: give one of them", OPTION_TABLE[a].name, OPTION_TABLE[b].name);
    return true;
}

enum status render_command(const struct arguments *args) {
    struct work work;
    if (contradicts(args, OPTION_SHADOW, OPTION_NO_SHADOWS) ||
        contradicts(args, OPTION_KEEP_GOING, OPTION_FAIL_FAST))
        return STATUS_TROUBLE;
    const bool begun = work_begin(&work, args); /* here a signal may still end the program at once */
    interrupt_defer();
    const enum status status = begun ? render_all(&work) : STATUS_TROUBLE;
    work_end(&work, begun);
    streams_flush();
    interrupt_settle();
    return status;
}
