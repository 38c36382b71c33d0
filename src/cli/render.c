#include "cli/render.h"

#include <stdlib.h>
#include <string.h>

#include "cli/aov.h"
#include "cli/clock.h"
#include "cli/interrupt.h"
#include "cli/load.h"
#include "cli/outputs.h"
#include "cli/progress.h"
#include "cli/say.h"
#include "cli/stats.h"

/* What there is to render, and what has become of it. */
struct work {
    struct arguments args;
    struct loader loader;
    struct plan plan;
    struct picture *pictures; /* those tried so far; a scene that cannot be loaded counts as one */
    size_t count;
};

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

static struct monge_film *render_film(const struct option_value *option, const char *title,
                                      struct monge_scene *scene, const struct monge_region *region,
                                      struct picture *picture) {
    const enum progress_wish wish = (enum progress_wish)option[OPTION_PROGRESS].choice;
    struct progress progress;
    struct monge_job job = {.threads = option[OPTION_THREADS].number[0], .cancel = interrupt_flag()};
    if (progress_wanted(wish, option[OPTION_QUIET].given)) {
        job.progress = progress_update;
        job.context = &progress;
    }
    progress_begin(&progress, title);
    struct monge_film *film = monge_render(scene, &picture->settings, region, &job, &picture->stats);
    progress_end(&progress);
    if (!film && !interrupt_pending())
        say_error("no memory for a picture of %ux%u", region->width, region->height);
    return film;
}

/* "king"; of many pictures "king  picture 2 of 5", of frames "king  frame 12 of 48". */
static char *progress_title(const struct work *work, const struct output *output, const struct load *load,
                            unsigned frame) {
    if (work->plan.frames) {
        char *values = sweep_describe(&work->loader.sweep, output->defines);
        char *title = say_text("%s%s%s  frame %u of %u", output->name, *values ? " " : "", values, frame,
                               monge_scene_frames(load->scene));
        free(values);
        return title;
    }
    const size_t number = (size_t)(output - work->plan.outputs) + 1;
    return work->plan.count > 1 ? say_text("%s  picture %zu of %zu", output->name, number, work->plan.count)
                                : say_text("%s", output->name);
}

static enum status choose_settings(const struct work *work, const char *scene, const struct load *load,
                                   struct picture *picture) {
    const struct option_value *option = work->args.option;
    picture->settings = monge_scene_settings(load->scene);
    override_settings(option, &picture->settings);
    const char *wrong = monge_settings_check(&picture->settings);
    if (wrong) say_error("%s: %s", scene, wrong);
    if (wrong || !choose_region(&option[OPTION_REGION], scene, &picture->settings, &picture->region))
        return STATUS_TROUBLE;
    if (load_allows(&work->loader, scene, &picture->settings)) return STATUS_YES;
    return option[OPTION_SIZE].given ? STATUS_TROUBLE : STATUS_NO;
}

/* The auxiliary passes, where there are to be any. */
static bool write_passes(struct work *work, struct monge_scene *scene, const struct picture *picture) {
    const struct option_value *option = work->args.option;
    const struct monge_job job = {.threads = option[OPTION_THREADS].number[0], .cancel = interrupt_flag()};
    return !option[OPTION_AOV].given ||
           aov_write(scene, &picture->settings, &picture->region, option[OPTION_AOV].set, &job,
                     picture->output, &work->loader.report);
}

/* Everything after loading. A signal in here ends the program once nothing is half done. */
static enum status render_scene(struct work *work, const struct output *output, const struct load *load,
                                struct picture *picture) {
    const enum status settings = choose_settings(work, output->scene, load, picture);
    if (settings != STATUS_YES) return settings;
    char *title = progress_title(work, output, load, picture->frame);
    interrupt_defer();
    struct monge_film *film = render_film(work->args.option, title, load->scene, &picture->region, picture);
    const double rendered = clock_seconds();
    picture->done = film && write_film(film, picture->output, &work->loader.report);
    monge_film_free(film);
    if (picture->done) picture->done = write_passes(work, load->scene, picture);
    picture->write_seconds = clock_seconds() - rendered;
    picture->peak_memory_bytes = stats_peak_memory();
    interrupt_settle();
    free(title);
    return picture->done ? STATUS_YES : STATUS_TROUBLE;
}

/* The scene as it is now, which began to be loaded at `begun`. */
static enum status render_picture(struct work *work, const struct output *output, struct load *load,
                                  double begun, struct picture *picture) {
    const double loaded = clock_seconds();
    const bool built = monge_scene_prepare(load->scene); /* here a signal may still end the program at once */
    const double prepared = clock_seconds();
    if (!built)
        say_error("%s: no memory for %zu primitives", output->scene, monge_scene_primitives(load->scene));
    if (built) load_examine(&work->loader, load);
    const enum status status = built ? render_scene(work, output, load, picture) : STATUS_TROUBLE;
    picture->primitives = monge_scene_primitives(load->scene);
    picture->load_seconds = loaded - begun;
    picture->stats.build_seconds += prepared - loaded;
    if (picture->done && !work->args.option[OPTION_QUIET].given)
        say_note("wrote %s  %ux%u  %.2f s",
                 strcmp(picture->output, "-") == 0 ? "standard output" : picture->output,
                 picture->region.width, picture->region.height, clock_seconds() - begun);
    return status;
}

/* ---- The frames of a scene ---- */

static struct picture *add_picture(struct work *work, const struct output *output, const char *path,
                                   unsigned frame) {
    struct picture *pictures = realloc(work->pictures, (work->count + 1) * sizeof *pictures);
    if (!pictures) {
        say_error("out of memory");
        exit(STATUS_TROUBLE);
    }
    work->pictures = pictures;
    pictures[work->count] = (struct picture){.scene = output->scene,
                                             .output = say_text("%s", path),
                                             .frame = frame,
                                             .defines = output->defines,
                                             .define_count = work->loader.sweep.count};
    return &pictures[work->count++];
}

/* The frames that --frames asks for, of an animation of `total`; without it the first alone. NULL, with the reason
 * on stderr, where they are not there. To be freed. */
static unsigned *choose_frames(const struct option_value *option, const char *scene, unsigned total,
                               size_t *count) {
    const unsigned first = option->given ? option->number[0] : 1,
                   step = option->given ? option->number[2] : 1;
    const unsigned last = !option->given ? 1 : option->number[1] ? option->number[1] : total;
    if (option->given && total == 0) {
        say_error("--frames %s: %s has no animation; `animation: {frames: 48}` makes one", option->text,
                  scene);
        return NULL;
    }
    if (option->given && (first > total || last > total)) {
        say_error("--frames %s: %s has %u frame%s", option->text, scene, total, total == 1 ? "" : "s");
        return NULL;
    }
    *count = (last - first) / step + 1;
    unsigned *frames = calloc(*count, sizeof *frames);
    for (size_t i = 0; frames && i < *count; i++) frames[i] = first + (unsigned)i * step;
    if (!frames) say_error("out of memory");
    return frames;
}

/* Frame number `index` of those to render; the scene stands at the first already. */
static enum status render_frame(struct work *work, const struct output *output, struct load *load,
                                const char *path, unsigned frame, size_t index, double begun) {
    struct picture *picture = add_picture(work, output, path, work->plan.frames ? frame : 0);
    const enum status status = index == 0 ? STATUS_YES : load_frame(&work->loader, load, frame);
    if (status == STATUS_YES) return render_picture(work, output, load, begun, picture);
    if (!work->args.option[OPTION_QUIET].given) say_note("frame %u of %s is left out", frame, output->title);
    return status;
}

static enum status render_frames(struct work *work, const struct output *output, struct load *load,
                                 double begun) {
    size_t count = 0;
    const unsigned total = monge_scene_frames(load->scene);
    unsigned *frames = choose_frames(&work->args.option[OPTION_FRAMES], output->scene, total, &count);
    char **paths = frames ? plan_frames(&work->plan, output, frames, count, total) : NULL;
    enum status worst = paths ? STATUS_YES : STATUS_TROUBLE;
    if (!paths) add_picture(work, output, output->path, 0);
    for (size_t i = 0; paths && i < count; i++) {
        const enum status status =
            render_frame(work, output, load, paths[i], frames[i], i, i == 0 ? begun : clock_seconds());
        if (status > worst) worst = status;
    }
    paths_free(paths, count);
    free(frames);
    return worst;
}

static enum status render_output(struct work *work, const struct output *output) {
    const double begun = clock_seconds();
    struct load load =
        load_scene(&work->loader, output->scene, output->defines, work->args.option[OPTION_FRAMES].number[0]);
    enum status status = load.status;
    if (load.scene)
        status = render_frames(work, output, &load, begun);
    else
        add_picture(work, output, output->path, 0);
    load_close(&work->loader, &load);
    return status;
}

/* ---- All pictures ---- */

static enum status render_outputs(struct work *work) {
    const struct option_value *option = work->args.option;
    enum status worst = STATUS_YES;
    size_t done = 0;
    for (size_t i = 0; i < work->plan.count; i++) {
        const enum status status = render_output(work, &work->plan.outputs[i]);
        if (status > worst) worst = status;
    }
    for (size_t i = 0; i < work->count; i++) done += work->pictures[i].done;
    if (done < work->count && work->count > 1 && !option[OPTION_QUIET].given)
        say_note("%zu rendered, %zu failed", done, work->count - done);
    if (!option[OPTION_STATS].text) return worst;
    interrupt_defer();
    if (!stats_write(option[OPTION_STATS].text, work->pictures, work->count)) worst = STATUS_TROUBLE;
    interrupt_settle();
    return worst;
}

static bool work_begin(struct work *work, const struct arguments *args) {
    *work = (struct work){.args = *args};
    if (!loader_begin(&work->loader, args) || !plan_begin(&work->plan, args, &work->loader.sweep))
        return false;
    /* a document on stderr must be alone there: the notes are left out */
    if (work->loader.report.format != MONGE_FORMAT_TEXT) work->args.option[OPTION_QUIET].given = true;
    return true;
}

static void work_end(struct work *work, bool begun) {
    for (size_t i = 0; i < work->count; i++) free(work->pictures[i].output);
    free(work->pictures);
    plan_free(&work->plan);
    loader_end(&work->loader, begun ? stderr : NULL);
}

enum status render_command(const struct arguments *args) {
    const struct option_value *option = args->option;
    struct work work;
    if (option[OPTION_SHADOW].given && option[OPTION_NO_SHADOWS].given) {
        say_usage(COMMAND_RENDER, "--shadow and --no-shadows: give one of them");
        return STATUS_TROUBLE;
    }
    const bool begun = work_begin(&work, args);
    const enum status status = begun ? render_outputs(&work) : STATUS_TROUBLE;
    work_end(&work, begun);
    return status;
}
