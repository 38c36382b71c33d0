/* Pictures against their goldens. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/aov.h"
#include "cli/golden/folder.h"
#include "cli/golden/run.h"
#include "cli/golden/take.h"
#include "cli/paths.h"
#include "cli/say.h"

/* ---- Goldens ---- */

static void copy_hash(const char *from, char to[MONGE_HASH_SIZE]) {
    if (from && strlen(from) == MONGE_HASH_SIZE - 1) memcpy(to, from, MONGE_HASH_SIZE);
}

static void copy_stamp(const struct golden_stamp *from, struct golden_stamp *to) {
    *to = *from;
    to->options = say_text("%s", from->options);
}

/* What the picture says that it was made from; where it is not as it was written, that says nothing of it. `pixels` is
 * the hash of those that it has, "" of another kind of picture. */
static void read_stamp(const struct monge_picture *picture, const char *pixels, struct golden_stamp *stamp) {
    const char *options = monge_picture_text(picture, "monge:options"),
               *said = monge_picture_text(picture, "monge:pixels");
    stamp->width = monge_picture_width(picture);
    stamp->height = monge_picture_height(picture);
    stamp->bits = monge_picture_bits(picture);
    copy_hash(pixels, stamp->pixels);
    if (!said || strcmp(said, pixels) != 0) return;
    copy_hash(monge_picture_text(picture, "monge:scene"), stamp->scene);
    copy_hash(monge_picture_text(picture, "monge:text"), stamp->text);
    copy_hash(monge_picture_text(picture, "monge:program"), stamp->program);
    stamp->options = say_text("%s", options ? options : "");
}

/* What the diagnostics have to say becomes part of the message. */
static void add_diagnostics(struct golden_case *c, const struct monge_diagnostics *diag) {
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (!out) return;
    monge_diagnostics_print(diag, out);
    if (fclose(out) == 0 && size > 0) golden_add_message(c, "%.*s", (int)strcspn(text, "\n"), text);
    free(text);
}

static struct monge_picture *read_picture(struct golden_case *c, const char *path) {
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_picture *picture = diag ? monge_picture_read(path, diag) : NULL;
    if (picture && !monge_picture_decode(picture, diag)) {
        monge_picture_free(picture);
        picture = NULL;
    }
    if (diag && !picture) add_diagnostics(c, diag);
    monge_diagnostics_free(diag);
    return picture;
}

static bool miss(struct golden_case *c) {
    c->status = GOLDEN_MISSING;
    return false;
}

/* The golden that is a picture: what it says, and that it can be read. */
static bool find_picture(struct golden_case *c, const char *path) {
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_picture *picture = diag ? read_picture(c, path) : NULL;
    char pixels[MONGE_HASH_SIZE] = "";
    const bool good = picture && *c->golden_file;
    if (good) {
        golden_stamp_free(&c->old);
        c->old = (struct golden_stamp){0};
        if (!monge_picture_hash(picture, diag, pixels)) *pixels = '\0';
        read_stamp(picture, pixels, &c->old);
        c->golden_path = say_text("%s", path);
    }
    monge_picture_free(picture);
    monge_diagnostics_free(diag);
    return good || miss(c);
}

/* Of goldens that are both, one may have gone; and a line where there ought to be a picture tells that there was one. */
static bool find_at(struct golden_case *c, const struct golden_line *line, const char *path,
                    const char *lock) {
    const bool file = path_is_file(path), png = c->kind != MONGE_GOLDEN_HASH,
               text = c->kind != MONGE_GOLDEN_PNG;
    if (png && !file && golden_is_there(path)) {
        golden_add_message(c, "%s is not a file: it is in the way of the golden", path);
        c->status = GOLDEN_BROKEN;
        return false;
    }
    if (line && text) copy_stamp(&line->stamp, &c->old);
    if (png && !file && line) {
        golden_add_message(c, "%s has a line for it, but %s is not there", lock, path);
        return miss(c);
    }
    if (c->kind == MONGE_GOLDEN_BOTH && file && !line) {
        golden_add_message(c, "%s is there, but %s has no line for it", path, lock);
        return miss(c);
    }
    if (png && file) return find_picture(c, path);
    if (line) return true;
    if (png && golden_has_passes(path)) {
        golden_add_message(c, "%s is not there, but its passes are", path);
        return miss(c);
    }
    c->status = GOLDEN_NEW;
    return false;
}

/* A golden that is both a line and a picture must be the same in both. */
static bool halves_agree(const struct golden_run *run, struct golden_case *c) {
    const struct golden_line *line = golden_lock_find(&run->lock, c->name);
    if (c->kind != MONGE_GOLDEN_BOTH || strcmp(line->stamp.pixels, c->old.pixels) == 0) return true;
    golden_add_message(c, "its line in %s is not that of the picture %s", run->lock.path, c->golden_path);
    return miss(c);
}

static bool has_pass(const char *picture, enum monge_layer layer) {
    char *path = aov_path(layer, picture);
    const bool there = path_is_file(path);
    free(path);
    return there;
}

/* As far as that is quickly told: a PNG by the sums of its chunks, depth by its hash. */
static bool is_whole(const char *picture, enum monge_layer layer, struct monge_diagnostics *diag) {
    const bool is_depth = layer == MONGE_LAYER_DEPTH;
    char *path = aov_path(layer, picture);
    struct monge_layers *depth = is_depth ? monge_layers_read(picture, 1u << layer, diag) : NULL;
    struct monge_picture *pass = is_depth ? NULL : monge_picture_read(path, diag);
    const bool whole = depth || pass;
    monge_picture_free(pass);
    monge_layers_free(depth);
    free(path);
    return whole;
}

static bool are_whole(struct golden_case *c) {
    struct monge_diagnostics *diag = monge_diagnostics_new();
    bool whole = diag;
    for (enum monge_layer layer = 0; layer < MONGE_LAYERS && whole; layer++)
        whole = is_whole(c->golden_path, layer, diag);
    if (diag && !whole) add_diagnostics(c, diag);
    monge_diagnostics_free(diag);
    return whole || miss(c);
}

/* A rule that asks for passes may be younger than the golden. */
static bool find_passes(struct golden_case *c) {
    bool all = c->golden_path || *c->old.layers[0];
    for (enum monge_layer layer = 0; layer < MONGE_LAYERS && c->golden_path; layer++)
        all &= has_pass(c->golden_path, layer);
    if (all) return !c->golden_path || are_whole(c);
    golden_add_message(c,
                       "the golden has not all the passes that `aov: true` asks for: to accept it adds them");
    return miss(c);
}

bool golden_find(const struct golden_run *run, struct golden_case *c) {
    char *path = path_below(run->folder, c->name, ".png");
    golden_note(run->folder, &run->lock, c);
    const bool found = find_at(c, golden_lock_find(&run->lock, c->name), path, run->lock.path);
    free(path);
    return found && halves_agree(run, c) && (!c->aov || find_passes(c));
}

/* ---- Without rendering ---- */

static bool same_text(const char *a, const char *b) { return a && b && strcmp(a, b) == 0; }
static bool same_hash(const char *a, const char *b) { return *a && strcmp(a, b) == 0; }

static bool same_inputs(const struct golden_stamp *a, const struct golden_stamp *b) {
    return same_hash(a->text, b->text) && same_hash(a->program, b->program) &&
           same_text(a->options, b->options);
}

bool golden_is_unchanged(const struct golden_run *run, const struct golden_case *c) {
    const struct golden_case *last = golden_results_find(&run->last, c->name);
    if (same_inputs(&c->now, &c->old)) return true;
    return last && last->status == GOLDEN_SAME && last->kind == c->kind && same_inputs(&c->now, &last->now) &&
           strcmp(last->old.pixels, c->old.pixels) == 0 && strcmp(last->golden_file, c->golden_file) == 0 &&
           (same_text(last->tolerance_text, c->tolerance_text) ||
            !(last->tolerance_text || c->tolerance_text));
}

/* ---- Comparing ---- */

static struct monge_compare how_to_compare(const struct golden_case *c, bool all) {
    const struct monge_tolerance *t = &c->tolerance;
    const bool bounded = c->tolerance_text && !isnan(t->max);
    return (struct monge_compare){.metrics = all ? 1u << MONGE_METRIC_SSIM | 1u << MONGE_METRIC_FLIP : 0,
                                  .max_delta = bounded ? t->max : 0.0};
}

/* False: one of them turns out to be damaged. */
static bool compare(struct golden_case *c, struct monge_picture *golden, struct monge_picture *new) {
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_compare quickly = how_to_compare(c, false), wholly = how_to_compare(c, true);
    c->compared = diag && monge_compare(golden, new, &quickly, &c->difference, diag);
    if (c->compared && !c->difference.same && !isnan(c->difference.max))
        c->compared = monge_compare(golden, new, &wholly, &c->difference, diag);
    if (diag && !c->compared) add_diagnostics(c, diag);
    monge_diagnostics_free(diag);
    return c->compared;
}

static void judge_difference(struct golden_case *c) {
    c->within = !c->difference.same && c->tolerance_text && golden_tolerates(&c->tolerance, &c->difference);
    c->status = c->difference.same || c->within ? GOLDEN_SAME : GOLDEN_CHANGED;
}

/* The two pictures, where they can be read. */
static bool compare_files(struct golden_case *c) {
    struct monge_picture *golden = read_picture(c, c->golden_path), *new = read_picture(c, c->new_path);
    const bool good = golden && new &&compare(c, golden, new);
    monge_picture_free(golden);
    monge_picture_free(new);
    return good;
}

static bool is_exact(const struct golden_case *c) { return strcmp(c->old.pixels, c->now.pixels) == 0; }

static void judge_picture(struct golden_case *c) {
    if (compare_files(c))
        judge_difference(c);
    else
        miss(c);
}

static void judge_hash(const struct golden_run *run, struct golden_case *c) {
    c->status = GOLDEN_CHANGED;
    if (!run->old_program || !golden_render_old(run, c) || !compare_files(c)) return;
    judge_difference(c);
}

/* ---- Judging ---- */

bool golden_knows_tolerance(const struct golden_run *run, enum monge_golden_kind kind) {
    return kind != MONGE_GOLDEN_HASH || run->old_program;
}

static bool write_new(const struct golden_run *run, struct golden_case *c, const struct monge_film *film) {
    struct monge_diagnostics *diag = monge_diagnostics_new();
    char *folder = path_below(run->output, "new", "");
    c->new_path = path_below(folder, c->name, ".png");
    free(folder);
    const bool good = diag && golden_remove_picture(NULL, c->new_path) && path_make_folders(c->new_path) &&
                      monge_film_write_png(film, c->new_path, diag);
    if (diag && !good) add_diagnostics(c, diag);
    monge_diagnostics_free(diag);
    if (good) return true;
    free(c->new_path);
    c->new_path = NULL;
    c->status = GOLDEN_BROKEN;
    c->trouble = true;
    return false;
}

static void drop_new(struct golden_case *c) {
    golden_remove(NULL, c->new_path);
    free(c->new_path);
    c->new_path = NULL;
}

void golden_judge(const struct golden_run *run, struct golden_case *c, const struct monge_film *film,
                  bool has_golden) {
    const bool hash = c->kind == MONGE_GOLDEN_HASH;
    if (has_golden && is_exact(c)) {
        c->status = GOLDEN_SAME;
        return;
    }
    if (!write_new(run, c, film) || !has_golden) return;
    if (hash)
        judge_hash(run, c);
    else
        judge_picture(c);
    if (c->status == GOLDEN_SAME)
        drop_new(c);
    else if (c->status == GOLDEN_CHANGED && hash && !c->golden_path)
        golden_set_old_command(run, c);
}
