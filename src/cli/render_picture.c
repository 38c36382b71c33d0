#include "cli/render_picture.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "cli/aov.h"
#include "cli/asked.h"
#include "cli/checkpoint.h"
#include "cli/clock.h"
#include "cli/interrupt.h"
#include "cli/room.h"
#include "cli/say.h"
#include "cli/stats.h"

/* ---- What is rendered ---- */

static enum status choose_settings(const struct unit *unit, const struct load *load,
                                   struct picture *picture) {
    const struct option_value *option = unit->work->args.option;
    const char *scene = unit->output->scene;
    picture->settings = monge_scene_settings(load->scene);
    asked_settings(option, &picture->settings);
    const char *wrong = monge_settings_check(&picture->settings);
    if (wrong) say_error("%s: %s", scene, wrong);
    if (wrong || !asked_region(&option[OPTION_REGION], scene, &picture->settings, &unit->work->loader.report,
                               &picture->region))
        return STATUS_TROUBLE;
    if (load_allows(&unit->work->loader, scene, &picture->settings)) return STATUS_YES;
    return option[OPTION_SIZE].given ? STATUS_TROUBLE : STATUS_NO;
}

/* ---- The film ---- */

/* "king", of an animation "king  frame 12 of 48". */
static char *progress_title(const struct unit *unit, const struct load *load, unsigned frame) {
    return frame ? say_text("%s  frame %u of %u", unit->output->name, frame, monge_scene_frames(load->scene))
                 : say_text("%s", unit->output->name);
}

static bool is_file(const char *output) {
    struct stat there;
    return strcmp(output, "-") != 0 && (stat(output, &there) != 0 || S_ISREG(there.st_mode));
}

static struct checkpoint *open_checkpoint(const struct unit *unit, const struct load *load,
                                          const struct picture *picture) {
    const struct monge_settings *s = &picture->settings;
    const struct monge_region *r = &picture->region;
    char scene[MONGE_HASH_SIZE];
    const char *output = picture->output;
    if (!work_wants(unit->work, OPTION_RESUME) || !is_file(output)) return NULL;
    monge_scene_hash(load->scene, s, scene);
    char *what = say_text("program %s\nscene %s\nregion %u,%u,%u,%u of %ux%u", monge_program(), scene, r->x,
                          r->y, r->width, r->height, s->width, s->height);
    struct checkpoint *checkpoint = checkpoint_open(output, what);
    free(what);
    return checkpoint;
}

/* *status is set where there is none: of a signal, memory, or what is wrong with the scene. */
static struct monge_film *render_film(struct unit *unit, const struct load *load, struct picture *picture,
                                      const struct checkpoint *checkpoint, enum status *status) {
    const unsigned errors = monge_diagnostics_errors(load->diag);
    const struct option_value *option = unit->work->args.option;
    char *asked = asked_text(option, picture->defines, picture->define_count, picture->frame);
    char *title = progress_title(unit, load, picture->frame);
    const struct monge_job job = {.threads = option[OPTION_THREADS].number[0],
                                  .progress = progress_update,
                                  .context = &unit->progress,
                                  .cancel = interrupt_flag(),
                                  .diag = load->diag,
                                  .tiles = checkpoint ? checkpoint_tiles(checkpoint) : NULL,
                                  .options = asked};
    progress_picture(&unit->progress, title, picture, checkpoint ? checkpoint_pixels(checkpoint) : 0);
    struct monge_film *film =
        monge_render(load->scene, &picture->settings, &picture->region, &job, &picture->stats);
    progress_rendered(&unit->progress);
    progress_hide(&unit->work->progress);
    free(title);
    free(asked);
    if (film) return film;
    const bool wrong = monge_diagnostics_errors(load->diag) != errors;
    *status = wrong ? STATUS_NO : STATUS_TROUBLE;
    if (!wrong && !interrupt_pending())
        report_failure(&unit->work->loader.report, "out-of-memory", "%s: out of memory", picture->output);
    return NULL;
}

/* So that nothing is rendered that cannot be kept. Some room is enough, until a picture was too much for it: from then on
 * there must be about as much as a picture takes, a byte a pixel. */
static bool check_room(const struct unit *unit, const struct picture *picture) {
    const uint64_t pixels = (uint64_t)picture->region.width * picture->region.height;
    if (!is_file(picture->output) || room_for(picture->output, unit->work->tight ? pixels : 1)) return true;
    report_failure(&unit->work->loader.report, "cannot-write", "cannot write %s: %s; it is not rendered",
                   picture->output, strerror(errno));
    return false;
}

static bool write_film(const struct monge_film *film, const char *path, struct report *report) {
    struct monge_diagnostics *diag = report_open(report);
    const bool written = diag && monge_film_write_png(film, path, diag);
    if (diag) report_close(report, diag, !interrupt_pending());
    return written;
}

/* The auxiliary passes, where there are to be any: before the picture, which tells of their files. */
static bool write_passes(const struct unit *unit, const struct load *load, const struct picture *picture,
                         struct monge_film *film) {
    const unsigned passes = unit->work->plan.passes;
    const struct monge_job job = {.threads = unit->work->args.option[OPTION_THREADS].number[0],
                                  .cancel = interrupt_flag()};
    if (!passes) return true;
    const bool written = aov_write(load->scene, &picture->settings, &picture->region, passes, &job,
                                   picture->output, &unit->work->loader.report);
    if (written) aov_note(film, passes, picture->output);
    return written;
}

/* ---- The picture ---- */

static void tell_resumed(const struct unit *unit, const struct picture *picture,
                         const struct checkpoint *checkpoint) {
    const uint64_t known = checkpoint ? checkpoint_pixels(checkpoint) : 0;
    const double all = (double)picture->region.width * picture->region.height;
    if (known > 0 && !work_wants(unit->work, OPTION_QUIET))
        say_note("resumed %s  %.0f%% was done", picture->output, 100.0 * (double)known / all);
}

static void note_hashes(const struct unit *unit, const struct monge_film *film, struct picture *picture) {
    if (!unit->work->log.path && !work_wants(unit->work, OPTION_STATS)) return;
    monge_film_scene_hash(film, picture->scene_hash);
    if (!monge_film_hash(film, picture->pixel_hash)) *picture->pixel_hash = '\0';
}

/* Everything after loading. */
static enum status render_scene(struct unit *unit, const struct load *load, struct picture *picture) {
    enum status status = choose_settings(unit, load, picture);
    if (status != STATUS_YES) return status;
    if (!check_room(unit, picture)) return STATUS_TROUBLE;
    struct checkpoint *checkpoint = open_checkpoint(unit, load, picture);
    tell_resumed(unit, picture, checkpoint);
    struct monge_film *film = render_film(unit, load, picture, checkpoint, &status);
    report_show(&unit->work->loader.report, load->diag);
    const double rendered = clock_seconds();
    if (film && write_passes(unit, load, picture, film) &&
        write_film(film, picture->output, &unit->work->loader.report))
        picture->outcome = PICTURE_RENDERED;
    else if (film) {
        status = STATUS_TROUBLE;
        unit->work->tight = true;
    }
    picture->write_seconds = clock_seconds() - rendered;
    picture->peak_memory_bytes = stats_peak_memory();
    if (film) note_hashes(unit, film, picture);
    checkpoint_close(checkpoint, picture->outcome == PICTURE_RENDERED, &unit->work->loader.report);
    if (picture->outcome == PICTURE_RENDERED && is_file(picture->output)) checkpoint_forget(picture->output);
    monge_film_free(film);
    return status;
}

enum status render_picture(struct unit *unit, struct load *load, double begun) {
    struct picture *picture = &unit->pictures[unit->count - 1];
    const double loaded = clock_seconds();
    const bool built = monge_scene_prepare(load->scene);
    const double prepared = clock_seconds();
    if (!built)
        report_failure(&unit->work->loader.report, "out-of-memory", "%s: out of memory", unit->output->scene);
    if (built) load_examine(&unit->work->loader, load);
    const enum status status = built ? render_scene(unit, load, picture) : STATUS_TROUBLE;
    picture->primitives = monge_scene_primitives(load->scene);
    picture->load_seconds = loaded - begun;
    picture->stats.build_seconds += prepared - loaded;
    if (picture->outcome == PICTURE_RENDERED && !work_wants(unit->work, OPTION_QUIET))
        say_note("wrote %s  %ux%u  %.2f s",
                 strcmp(picture->output, "-") == 0 ? "standard output" : picture->output,
                 picture->region.width, picture->region.height, clock_seconds() - begun);
    return status;
}
