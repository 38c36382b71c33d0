#include "cli/golden/accept.h"

#include <errno.h>
#include <fnmatch.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/golden/folder.h"
#include "cli/golden/results.h"
#include "cli/golden/settings.h"
#include "cli/golden/take.h"
#include "cli/golden/targets.h"
#include "cli/interrupt.h"
#include "cli/paths.h"
#include "cli/say.h"
#include "cli/scene_path.h"
#include "cli/words.h"

/* The last run, and what is taken of it. */
struct acceptance {
    const struct arguments *args;
    const char *folder, *output;
    struct loader loader;
    struct golden_settings settings;
    struct golden_lock lock;
    struct golden_results results;
    const char **scenes; /* owned: names of the scenes of the run, sorted */
    size_t scene_count;
    size_t taken, removed, refused, done; /* done: before, already */
    size_t orphans;                       /* that --prune would remove */
    char *
        far; /* owned: why scenes cannot be read, where the run was in another folder; NULL: it was in this one */
    char *sealed; /* owned: the folder of which was told last that nothing can be written there; NULL: none */
    bool trouble;
};

/* ---- What is wanted ---- */

static bool is_wanted(const struct acceptance *a, const char *name) {
    for (size_t i = 0; i < a->args->count; i++)
        if (fnmatch(a->args->operands[i], name, 0) == 0) return true;
    return a->args->count == 0;
}

/* The golden of a scene that is given by its path: called as that ends, without its extension. NULL: none. */
static const struct golden_case *find_meant(const struct acceptance *a, const char *path) {
    char *name = scene_name(path);
    const struct golden_case *found = golden_results_find(&a->results, name);
    for (char *slash = strchr(name, '/'); slash && !found; slash = strchr(slash + 1, '/'))
        found = golden_results_find(&a->results, slash + 1);
    free(name);
    return found;
}

/* Each glob must have something to say of the run. */
static bool check_globs(const struct acceptance *a) {
    for (size_t i = 0; i < a->args->count; i++) {
        size_t matches = 0;
        for (size_t k = 0; k < a->results.count; k++)
            matches += fnmatch(a->args->operands[i], a->results.cases[k].name, 0) == 0;
        if (matches > 0) continue;
        const struct golden_case *meant = find_meant(a, a->args->operands[i]);
        say_error("%s: no golden of the last run is called so%s%s%s", a->args->operands[i],
                  meant ? "; did you mean `" : "", meant ? meant->name : "", meant ? "`?" : "");
        return false;
    }
    return true;
}

/* ---- Inputs ---- */

static bool text_has_changed(const struct acceptance *a, const struct golden_case *c,
                             const struct monge_picture *picture, struct monge_diagnostics *diag) {
    char now[MONGE_HASH_SIZE];
    const char *files = monge_picture_text(picture, "monge:files");
    return !monge_files_hash(c->scene, files ? files : "", &a->loader.limits.load, diag, now) ||
           strcmp(now, c->now.text) != 0;
}

static bool options_have_changed(const struct acceptance *a, const struct golden_case *c) {
    return strcmp(golden_settings_find(&a->settings, c->scene_name)->rule->options, c->rule_options) != 0;
}

static bool says(const struct monge_picture *picture, const char *key, const char *text) {
    const char *said = monge_picture_text(picture, key);
    return strcmp(said ? said : "", text ? text : "") == 0;
}

/* Whether it is the picture that the run has written, with all that the run has noted of it: both are files that anybody
 * may have changed. */
static bool is_of_run(const struct golden_case *c, struct monge_picture *picture,
                      struct monge_diagnostics *diag) {
    const struct golden_stamp *s = &c->now;
    char pixels[MONGE_HASH_SIZE];
    return monge_picture_hash(picture, diag, pixels) && strcmp(pixels, s->pixels) == 0 &&
           monge_picture_width(picture) == s->width && monge_picture_height(picture) == s->height &&
           monge_picture_bits(picture) == s->bits && says(picture, "monge:scene", s->scene) &&
           says(picture, "monge:program", s->program) && says(picture, "monge:options", s->options);
}

/* Why the new picture cannot be taken; NULL: it can. */
static const char *find_obstacle(const struct acceptance *a, const struct golden_case *c,
                                 struct monge_diagnostics *diag) {
    struct monge_picture *picture = monge_picture_read(c->new_path, diag);
    const char *why = NULL;
    if (!picture)
        why = "its new picture cannot be read any more";
    else if (strcmp(monge_program(), c->now.program) != 0)
        why = "the program has changed since the run";
    else if (!is_of_run(c, picture, diag))
        why = "its new picture is not that of the run";
    else if (access(c->scene, R_OK) != 0)
        why = a->far ? a->far : "its scene cannot be read from here";
    else if (text_has_changed(a, c, picture, diag))
        why = "the scene has changed since the run";
    else if (options_have_changed(a, c))
        why = "its options in golden.yaml have changed since the run";
    monge_picture_free(picture);
    return why;
}

/* ---- Taking ---- */

static void refuse(struct acceptance *a, const struct golden_case *c, const char *why) {
    say_error("%s is left as it is: %s", c->name, why);
    a->refused++;
}

static void pass_by(struct acceptance *a, const struct golden_case *c, const char *what) {
    a->done++;
    if (!a->args->option[OPTION_QUIET].given) say_line(stdout, "%s is %s already", c->name, what);
}

static bool is_dry(const struct acceptance *a) { return a->args->option[OPTION_DRY_RUN].given; }

/* What has become of the golden, or of a dry run would. */
static void tell_case(const struct acceptance *a, const struct golden_case *c, const char *done,
                      const char *foreseen) {
    if (!a->args->option[OPTION_QUIET].given) say_line(stdout, "%s %s", is_dry(a) ? foreseen : done, c->name);
}

/* Once for all goldens of a folder. */
static bool is_sealed(struct acceptance *a, const char *folder) {
    if (access(folder, W_OK) == 0 || (errno != EACCES && errno != EROFS)) return false;
    if (!a->sealed || strcmp(a->sealed, folder) != 0) {
        say_error("cannot write into %s: %s", folder, strerror(errno));
        free(a->sealed);
        a->sealed = say_text("%s", folder);
    }
    return true;
}

/* Whether files of the golden may come and go: in its folder, or the nearest above it that is there, and in that of the
 * lock. */
static bool can_write(struct acceptance *a, const struct golden_case *c) {
    if (c->kind != MONGE_GOLDEN_PNG && is_sealed(a, a->folder)) return false;
    if (c->kind == MONGE_GOLDEN_HASH) return true;
    char *folder = path_below(a->folder, c->name, "");
    do *strrchr(folder, '/') = '\0';
    while (strlen(folder) > strlen(a->folder) && !golden_is_there(folder));
    const bool good = !is_sealed(a, folder);
    free(folder);
    return good;
}

static bool take(struct acceptance *a, const struct golden_case *c) {
    if (!can_write(a, c)) return false;
    return is_dry(a) ? golden_check_places(a->folder, c) : golden_take(a->folder, &a->lock, c);
}

static void take_case(struct acceptance *a, struct golden_case *c) {
    struct monge_diagnostics *diag = monge_diagnostics_new();
    const char *why = diag ? find_obstacle(a, c, diag) : "out of memory";
    monge_diagnostics_free(diag);
    if (why)
        refuse(a, c, why);
    else if (golden_is_taken(a->folder, &a->lock, c))
        pass_by(a, c, "taken");
    else if (!golden_is_as_noted(a->folder, &a->lock, c))
        refuse(a, c, "its golden has changed since the run: `monge test` compares it anew");
    else if (!take(a, c))
        a->trouble = true;
    else {
        a->taken++;
        tell_case(a, c, "took", "would take");
    }
}

static int compare_names(const void *a, const void *b) {
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

static bool name_scenes(struct acceptance *a) {
    a->scenes = calloc(a->results.count + 1, sizeof *a->scenes);
    if (!a->scenes) say_error("out of memory");
    for (size_t i = 0; a->scenes && i < a->results.count; i++)
        if (a->results.cases[i].scene_name) a->scenes[a->scene_count++] = a->results.cases[i].scene_name;
    if (a->scenes) qsort(a->scenes, a->scene_count, sizeof *a->scenes, compare_names);
    return a->scenes;
}

static bool was_in_run(const struct acceptance *a, const char *scene) {
    return bsearch(&scene, a->scenes, a->scene_count, sizeof scene, compare_names);
}

/* The golden is called as its scene, or that and what frames and parameters add behind a `-`. What a scene of the run had
 * no golden for is none of its. */
static bool scene_is_back(struct acceptance *a, const char *name) {
    char *scene = say_text("%s", name);
    bool back = false;
    for (char *end = scene + strlen(scene); end && !back; end = strrchr(scene, '-')) {
        *end = '\0';
        back = !was_in_run(a, scene) && golden_places_have(&a->results.places, scene, &a->loader.limits.load);
    }
    free(scene);
    return back;
}

static bool is_gone(const struct acceptance *a, const struct golden_case *c) {
    return !golden_lock_find(&a->lock, c->name) && !(c->golden_path && path_is_file(c->golden_path));
}

static void remove_orphan(struct acceptance *a, struct golden_case *c) {
    if (is_gone(a, c))
        pass_by(a, c, "removed");
    else if (scene_is_back(a, c->name))
        refuse(a, c, "its scene is there again");
    else if (!can_write(a, c) || (!is_dry(a) && !golden_forget(a->folder, &a->lock, c)))
        a->trouble = true;
    else {
        a->removed++;
        tell_case(a, c, "removed", "would remove");
    }
}

static void settle_orphan(struct acceptance *a, struct golden_case *c) {
    free(c->golden_path);
    c->golden_path = c->kind == MONGE_GOLDEN_HASH ? NULL : path_below(a->folder, c->name, ".png");
    if (a->args->option[OPTION_PRUNE].given)
        remove_orphan(a, c);
    else
        a->orphans += !is_gone(a, c) && !scene_is_back(a, c->name);
}

static void settle_case(struct acceptance *a, struct golden_case *c) {
    if (!is_wanted(a, c->name)) return;
    if (c->status == GOLDEN_ORPHAN) settle_orphan(a, c);
    if (c->status == GOLDEN_BROKEN) refuse(a, c, "it is broken");
    if (golden_can_take(c) && c->scene && c->scene_name && c->rule_options) take_case(a, c);
}

/* The paths are made anew from the names, which must be fit for it: the document is a file like any other. */
static bool prepare_cases(struct acceptance *a) {
    char *folder = path_below(a->output, "new", "");
    bool good = true;
    for (size_t i = 0; good && i < a->results.count; i++) {
        struct golden_case *c = &a->results.cases[i];
        good = golden_name_is_safe(c->name);
        if (!good) say_error("%s/results.json: `%s` is no name of a golden", a->output, c->name);
        if (!c->new_path) continue;
        free(c->new_path);
        c->new_path = path_below(folder, c->name, ".png");
    }
    free(folder);
    return good;
}

/* What the run says nothing of stays as it is. */
static void tell_interruption(const struct acceptance *a) {
    char *interruption = golden_interruption(&a->results);
    if (interruption && !a->args->option[OPTION_QUIET].given) say_note("the run was %s", interruption);
    free(interruption);
}

/* A shell's words with one more. */
static char *with_word(char *words, const char *more) {
    char *word = word_quoted(more), *longer = say_text("%s %s", words, word);
    free(word);
    free(words);
    return longer;
}

static void tell_counts(const struct acceptance *a) {
    printf("%zu %staken", a->taken, is_dry(a) ? "would be " : "");
    if (a->removed > 0) printf(", %zu removed", a->removed);
    if (a->done > 0) printf(", %zu done already", a->done);
    if (a->refused > 0) printf(", %zu left as they are", a->refused);
    printf("\n");
}

/* With the command that removes them, of the same globs. */
static void tell_orphans(const struct acceptance *a) {
    if (a->orphans == 0) return;
    char *words = golden_accept_words(a->folder, a->args->option[OPTION_TEST_OUTPUT].text);
    words = with_word(words, "--prune");
    if (a->args->count > 0 && *a->args->operands[0] == '-') words = with_word(words, "--");
    for (size_t i = 0; i < a->args->count; i++) words = with_word(words, a->args->operands[i]);
    say_line(stdout, "%zu orphan%s left: `%s` removes %s", a->orphans, a->orphans == 1 ? " is" : "s are",
             words, a->orphans == 1 ? "it" : "them");
    free(words);
}

static enum status settle(struct acceptance *a) {
    tell_interruption(a);
    interrupt_defer();
    for (size_t i = 0; i < a->results.count && !interrupt_pending(); i++)
        settle_case(a, &a->results.cases[i]);
    if (!is_dry(a) && a->taken + a->removed > 0 && !golden_lock_write(&a->lock)) a->trouble = true;
    interrupt_settle();
    if (!a->args->option[OPTION_QUIET].given) tell_counts(a);
    if (!a->args->option[OPTION_QUIET].given) tell_orphans(a);
    return a->trouble ? STATUS_TROUBLE : a->refused > 0 ? STATUS_NO : STATUS_YES;
}

/* ---- All of it ---- */

/* Paths of the run count from where it was. */
static void find_far(struct acceptance *a) {
    const char *from = a->results.from;
    if (!from || !path_is_folder(from) || path_is_same(from, ".")) return;
    a->far = say_text("its scene cannot be read from here: run it from %s, where the test ran", from);
}

/* Whether the run was with these goldens: from another folder only where its path to them was from the root. False: told. */
static bool check_goldens(const struct acceptance *a, const char *path) {
    const char *folder = a->results.folder;
    const bool other_place = a->far && *folder != '/';
    char *goldens = other_place ? path_below(a->results.from, folder, "") : say_text("%s", folder);
    const bool same = strcmp(goldens, a->folder) == 0 || path_is_same(goldens, a->folder);
    if (!same)
        say_error("%s: the last run was with the goldens of %s", path, goldens);
    else if (other_place)
        say_error("%s: run it from %s, where the test ran", path, a->results.from);
    free(goldens);
    return same && !other_place;
}

static bool read_run(struct acceptance *a) {
    char *path = path_below(a->output, "results.json", "");
    const enum golden_reading reading = golden_results_read(&a->results, path);
    bool good = reading == GOLDEN_READ;
    if (reading == GOLDEN_DAMAGED) say_error("%s is damaged: `monge test` makes it anew", path);
    if (good && !a->results.folder) {
        say_error("%s is not there: `monge test` makes it, with --output %s", path, a->output);
        good = false;
    } else if (good) {
        find_far(a);
        good = check_goldens(a, path);
    }
    free(path);
    return good && prepare_cases(a);
}

static bool begin(struct acceptance *a) {
    const struct option_value *option = a->args->option;
    if (!option[OPTION_GOLDEN].given) {
        say_usage(COMMAND_ACCEPT, "accept: --golden DIR is missing, the folder of the goldens");
        return false;
    }
    a->folder = option[OPTION_GOLDEN].text;
    a->output = option[OPTION_TEST_OUTPUT].given ? option[OPTION_TEST_OUTPUT].text : "monge-test";
    golden_hold(a->folder);
    return golden_check_folder(a->folder) && golden_check_output("output", a->output) &&
           limits_read(a->args, &a->loader.limits) &&
           golden_settings_read(&a->settings, a->folder, NULL, NULL, &a->loader) &&
           golden_lock_read(&a->lock, a->folder) && read_run(a) && name_scenes(a) && check_globs(a);
}

enum status accept_command(const struct arguments *args) {
    struct acceptance a = {.args = args};
    streams_outlive_readers();
    const enum status status = begin(&a) ? settle(&a) : STATUS_TROUBLE;
    free(a.scenes);
    free(a.sealed);
    free(a.far);
    golden_results_free(&a.results);
    golden_lock_free(&a.lock);
    golden_settings_free(&a.settings);
    return status;
}
