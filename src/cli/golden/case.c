/* From a scene to its cases: a picture for each combination of -D and each frame of its rule. */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/asked.h"
#include "cli/clock.h"
#include "cli/golden/folder.h"
#include "cli/golden/run.h"
#include "cli/interrupt.h"
#include "cli/paths.h"
#include "cli/pattern.h"
#include "cli/say.h"
#include "cli/words.h"

void golden_add_message(struct golden_case *c, const char *format, ...) {
    va_list args;
    va_start(args, format);
    char *line = say_text_list(format, args);
    va_end(args);
    char *before = c->message;
    c->message = before ? say_text("%s\n%s", before, line) : say_text("%s", line);
    free(before);
    free(line);
}

/* ---- What is said on the way ---- */

/* Takes up what is said by say_error and the like, and what diagnostics print. */
struct listener {
    FILE *before, *stream;
    char *text;
    size_t size;
};

static void listen_begin(struct listener *listener) {
    *listener = (struct listener){.before = say_stream()};
    listener->stream = open_memstream(&listener->text, &listener->size);
    say_divert(listener->stream);
}

/* It becomes part of the message. */
static void listen_end(struct listener *listener, struct golden_case *c) {
    say_divert(listener->before);
    if (listener->stream) fclose(listener->stream);
    size_t size = listener->text ? strlen(listener->text) : 0;
    while (size > 0 && listener->text[size - 1] == '\n') size--;
    if (size > 0 && (c->status == GOLDEN_BROKEN || c->trouble))
        golden_add_message(c, "%.*s", (int)size, listener->text);
    free(listener->text);
}

/* ---- Commands ---- */

/* `frames`: all that --frames asks for, of a scene without a picture; NULL: it is the one of this frame. */
static void set_command(struct golden_case *c, const struct golden_rule *rule,
                        const struct monge_define *defines, unsigned frame, const char *frames) {
    const char *slash = strrchr(c->name, '/');
    char *options = asked_text(rule->args.option, defines, rule->loader.sweep.count, frame),
         *scene = word_quoted(c->scene);
    c->has_frames = frames || frame > 1;
    char *name = pattern_of(slash ? slash + 1 : c->name, c->has_frames),
         *picture = say_text("%s%s.png", name, frames ? "-{frame}" : ""), *output = word_quoted(picture);
    c->arguments = say_text("%s%s%s%s%s", scene, *options ? " " : "", options, frames ? " --frames " : "",
                            frames ? frames : "");
    c->command = say_text("monge render %s -o %s", c->arguments, output);
    free(output);
    free(picture);
    free(name);
    free(scene);
    free(options);
}

/* ---- Cases ---- */

/* The picture of a case, where its frame is known: the scene stands at it. */
struct subject {
    const struct golden_run *run;
    struct golden_scene *scene;
    const struct monge_define *defines;
    struct load *load;
    unsigned frame; /* 0: --frames is not given, or */
    bool lost;      /* what frames there are is not known */
    int digits;     /* of the last frame */
};

static struct golden_case *add_case(const struct subject *s) {
    struct golden_scene *scene = s->scene;
    const struct sweep *sweep = &scene->rule->loader.sweep;
    const bool frames = scene->rule->args.option[OPTION_FRAMES].given && s->frame;
    const struct pattern_values values = {scene->name, s->defines, sweep->count, frames, s->frame, s->digits};
    scene->cases = realloc(scene->cases, (scene->count + 1) * sizeof *scene->cases);
    if (!scene->cases) say_no_memory();
    struct golden_case *c = &scene->cases[scene->count++];
    *c = (struct golden_case){.name = pattern_usual(sweep, &values),
                              .scene = say_text("%s", scene->path),
                              .scene_name = say_text("%s", scene->name),
                              .rule_options = say_text("%s", scene->rule->rule->options),
                              .kind = scene->rule->rule->kind,
                              .aov = scene->rule->rule->aov,
                              .status = GOLDEN_BROKEN};
    c->now.options = asked_text(scene->rule->args.option, s->defines, sweep->count, s->frame);
    set_command(c, scene->rule, s->defines, frames ? s->frame : 0,
                s->lost ? scene->rule->args.option[OPTION_FRAMES].text : NULL);
    return c;
}

/* What became of the last case while a signal came is not known. */
static void drop_case(const struct subject *s) {
    struct golden_case *c = &s->scene->cases[--s->scene->count];
    golden_clear(s->run->output, c->name);
    golden_case_free(c);
}

/* One that cannot hold is none: that of a rule is told when that is read, that of a scene here. */
static void set_tolerance(const struct subject *s, struct golden_case *c) {
    const struct monge_tolerance *own = monge_scene_tolerance(s->load->scene);
    const struct monge_tolerance *tolerance = s->scene->rule->rule->tolerance;
    if (!tolerance) tolerance = own;
    if (!tolerance) return;
    if (!golden_knows_tolerance(s->run, c->kind)) {
        if (tolerance == own)
            golden_add_message(c,
                               "its tolerance counts for nothing: a golden that is a hash has no pixels to "
                               "compare, which `kind: png` keeps");
        return;
    }
    c->tolerance = *tolerance;
    c->tolerance.reason = say_text("%s", tolerance->reason);
    c->tolerance_text = golden_tolerance_text(tolerance);
}

/* False: told. */
static bool set_inputs(const struct subject *s, struct golden_case *c, struct monge_settings *settings,
                       struct monge_region *region) {
    const struct option_value *option = s->scene->rule->args.option;
    *settings = monge_scene_settings(s->load->scene);
    asked_settings(option, settings);
    const char *wrong = monge_settings_check(settings);
    if (wrong) say_error("%s: %s", c->scene, wrong);
    if (wrong || !asked_region(&option[OPTION_REGION], c->scene, settings, &s->run->loader.report, region) ||
        !load_allows(&s->run->loader, c->scene, settings))
        return false;
    monge_scene_hash(s->load->scene, settings, c->now.scene);
    monge_scene_text_hash(s->load->scene, c->now.text);
    memcpy(c->now.program, monge_program(), strnlen(monge_program(), MONGE_HASH_SIZE - 1));
    c->now.width = region->width;
    c->now.height = region->height;
    c->now.bits = settings->bits;
    set_tolerance(s, c);
    return true;
}

static struct monge_film *render(const struct subject *s, struct golden_case *c,
                                 const struct monge_settings *settings, const struct monge_region *region) {
    const struct picture shown = {
        .scene = c->scene, .output = c->name, .frame = s->frame, .settings = *settings, .region = *region};
    const struct monge_job job = {.threads = s->run->threads,
                                  .progress = progress_update,
                                  .context = &s->scene->progress,
                                  .cancel = interrupt_flag(),
                                  .options = c->now.options};
    progress_picture(&s->scene->progress, c->name, &shown, 0);
    struct monge_film *film = monge_render(s->load->scene, settings, region, &job, NULL);
    progress_rendered(&s->scene->progress);
    const bool good = film && monge_film_hash(film, c->now.pixels);
    if (!good && !interrupt_pending()) {
        say_error("%s: no memory for a picture of %ux%u", c->scene, region->width, region->height);
        c->trouble = true;
    }
    if (good) return film;
    monge_film_free(film);
    return NULL;
}

/* Everything after loading. */
static enum outcome run_case(const struct subject *s, struct golden_case *c) {
    struct monge_settings settings;
    struct monge_region region;
    if (!set_inputs(s, c, &settings, &region)) return PICTURE_FAILED;
    const bool has_golden = golden_find(s->run, c);
    if (has_golden && s->run->changed_only && golden_is_unchanged(s->run, c)) {
        c->status = GOLDEN_SAME;
        c->unchanged = true;
        return PICTURE_UNCHANGED;
    }
    struct monge_film *film = render(s, c, &settings, &region);
    if (film) golden_judge(s->run, c, film, has_golden);
    if (film && c->new_path && s->scene->rule->rule->aov)
        golden_judge_layers(s->run, s->load->scene, &settings, &region, c);
    monge_film_free(film);
    return film ? PICTURE_RENDERED : PICTURE_FAILED;
}

/* ---- Frames, combinations ---- */

static void run_frames(struct subject *s) {
    size_t count = 0;
    const struct option_value *option = &s->scene->rule->args.option[OPTION_FRAMES];
    const unsigned total = monge_scene_frames(s->load->scene);
    struct listener listener;
    listen_begin(&listener);
    unsigned *frames = asked_frames(option, s->scene->path, total, &s->run->loader.report, &count);
    if (!frames) {
        s->lost = true;
        struct golden_case *c = add_case(s);
        listen_end(&listener, c);
        progress_done(&s->scene->progress, PICTURE_FAILED);
        return;
    }
    say_divert(listener.before);
    if (listener.stream) fclose(listener.stream);
    free(listener.text);
    s->digits = pattern_digits(total);
    progress_pictures(&s->scene->progress, s->scene->progress.pictures + count - 1);
    for (size_t i = 0; i < count && !interrupt_pending(); i++) {
        const double begun = clock_seconds();
        s->frame = option->given && total > 0 ? frames[i] : 0;
        struct golden_case *c = add_case(s);
        listen_begin(&listener);
        const enum status status =
            i == 0 ? STATUS_YES : load_frame(&s->scene->rule->loader, s->load, frames[i]);
        c->trouble = status == STATUS_TROUBLE;
        const enum outcome outcome = status == STATUS_YES ? run_case(s, c) : PICTURE_FAILED;
        listen_end(&listener, c);
        c->seconds = clock_seconds() - begun;
        if (interrupt_pending())
            drop_case(s);
        else
            progress_done(&s->scene->progress, outcome);
    }
    free(frames);
}

char *golden_find_meant(const struct golden_run *run, const char *name) {
    const struct golden_case *last = golden_results_find(&run->last, name);
    char *root = golden_settings_root(&run->settings);
    char *scene = root                  ? path_below(root, name, ".yaml")
                  : last && last->scene ? say_text("%s", last->scene)
                                        : NULL;
    free(root);
    if (scene && path_is_file(scene)) return scene;
    free(scene);
    return NULL;
}

/* The scene cannot be loaded: perhaps since it is called as its golden. */
static void add_meant(const struct golden_run *run, struct golden_case *c) {
    char *meant = golden_is_there(c->scene) ? NULL : golden_find_meant(run, c->scene);
    if (meant) golden_add_message(c, "did you mean `%s`?", meant);
    free(meant);
}

static void run_combination(struct subject *s) {
    const double begun = clock_seconds();
    struct golden_rule *rule = s->scene->rule;
    struct listener listener;
    listen_begin(&listener);
    struct load load =
        load_scene(&rule->loader, s->scene->path, s->defines, rule->args.option[OPTION_FRAMES].number[0]);
    s->load = &load;
    s->frame = 0;
    s->lost = !load.scene;
    struct golden_case none = {.status = GOLDEN_SAME};
    struct golden_case *c = load.scene ? &none : add_case(s);
    c->trouble = load.status == STATUS_TROUBLE;
    listen_end(&listener, c);
    if (!load.scene) add_meant(s->run, c);
    c->seconds = clock_seconds() - begun;
    if (!load.scene && interrupt_pending()) drop_case(s);
    const size_t first = s->scene->count;
    if (load.scene)
        run_frames(s);
    else
        progress_done(&s->scene->progress, PICTURE_FAILED);
    if (first < s->scene->count) s->scene->cases[first].seconds += c->seconds;
    load_close(&rule->loader, &load);
}

void golden_scene_run(struct golden_run *run, struct golden_scene *scene) {
    const struct sweep *sweep = &scene->rule->loader.sweep;
    struct monge_define *defines = calloc(sweep->count + 1, sizeof *defines);
    if (!defines) say_no_memory();
    progress_unit_begin(&scene->progress, &run->progress);
    progress_pictures(&scene->progress, sweep->total);
    for (size_t i = 0; i < sweep->total && !interrupt_pending(); i++) {
        struct subject s = {.run = run, .scene = scene, .defines = defines};
        sweep_combination(sweep, i, defines);
        run_combination(&s);
    }
    progress_unit_end(&scene->progress);
    free(defines);
    scene->done = !interrupt_pending();
}
