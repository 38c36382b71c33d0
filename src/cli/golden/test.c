#include "cli/golden/test.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/batch.h"
#include "cli/clock.h"
#include "cli/golden/claims.h"
#include "cli/golden/files.h"
#include "cli/golden/folder.h"
#include "cli/golden/orphans.h"
#include "cli/golden/rules.h"
#include "cli/golden/run.h"
#include "cli/golden/take.h"
#include "cli/golden/targets.h"
#include "cli/golden/tell.h"
#include "cli/interrupt.h"
#include "cli/paths.h"
#include "cli/pattern.h"
#include "cli/say.h"
#include "cli/scene_path.h"

/* A run, what has become of it, and how it is told. */
struct test {
    struct arguments args;
    struct golden_run run;
    struct golden_teller teller;
    struct golden_results results;
    bool holds_new; /* what is new is told at the end, when it is known whether it is that of an orphan */
    double begun;
};

static bool wants(const struct test *test, enum option_id option) { return test->args.option[option].given; }

/* ---- Scenes ---- */

/* Without operands, all that is below the root. */
static bool find_scenes(struct test *test) {
    struct golden_run *run = &test->run;
    const bool nowhere = test->args.count == 0 && !run->settings.root;
    if (nowhere && !golden_is_there(run->folder)) {
        say_error("--golden %s: there is no such folder", run->folder);
        return false;
    }
    if (nowhere) {
        say_usage(COMMAND_TEST, "test: no scene given; --root, or `root` in %s, would tell where they are",
                  run->settings.path);
        return false;
    }
    if (test->args.count == 0) {
        struct arguments args = test->args;
        char *root = golden_settings_root(&run->settings);
        args.operands = &root;
        args.count = 1;
        scenes_find(&run->loader.scenes, &args, SCENES_ALONE, &run->loader.limits.load, &run->loader.report);
        free(root);
    }
    for (size_t i = 0; i < run->loader.scenes.count; i++) {
        if (strcmp(run->loader.scenes.all[i].path, "-") != 0) continue;
        say_usage(COMMAND_TEST, "test: a scene on standard input has no name for a golden");
        return false;
    }
    return true;
}

static int compare_scenes(const void *a, const void *b) {
    const struct golden_scene *p = *(const struct golden_scene *const *)a,
                              *q = *(const struct golden_scene *const *)b;
    const int order = strcmp(p->name, q->name);
    return order ? order : p < q ? -1 : p > q;
}

/* Only an extension tells a.yaml from a.yml, and no root has that in the name. */
static void say_same_name(const struct golden_scene *a, const struct golden_scene *b) {
    char *place = scene_place(a->path), *other = scene_place(b->path);
    char *name = scene_name(place ? place : a->path), *other_name = scene_name(other ? other : b->path);
    say_error("%s and %s would have the same golden, %s: %s", a->path, b->path, a->name,
              strcmp(name, other_name) == 0 ? "rename one of them" : "give --root, or golden.yaml a `root`");
    free(other_name);
    free(name);
    free(other);
    free(place);
}

/* A scene that is named twice counts once; two scenes of one name are wrong. */
static bool check_scenes(struct golden_run *run) {
    struct golden_scene **sorted = calloc(run->count + 1, sizeof *sorted);
    bool good = sorted != NULL;
    if (!good) say_error("out of memory");
    for (size_t i = 0; good && i < run->count; i++) sorted[i] = &run->scenes[i];
    if (good && run->count > 1) qsort(sorted, run->count, sizeof *sorted, compare_scenes);
    for (size_t i = 1; good && i < run->count; i++) {
        if (strcmp(sorted[i - 1]->name, sorted[i]->name) != 0) continue;
        good = strcmp(sorted[i - 1]->path, sorted[i]->path) == 0 ||
               path_is_same(sorted[i - 1]->path, sorted[i]->path);
        if (!good) say_same_name(sorted[i - 1], sorted[i]);
        sorted[i]->path = sorted[i - 1]->path;
        sorted[i - 1]->path = NULL;
    }
    free(sorted);
    if (!good) return false;
    size_t kept = 0;
    for (size_t i = 0; i < run->count; i++)
        if (run->scenes[i].path)
            run->scenes[kept++] = run->scenes[i];
        else
            free(run->scenes[i].name);
    run->count = kept;
    return true;
}

/* Before frames are known, of which there may be none. */
static void claim_scene(struct golden_claims *claims, const struct golden_scene *scene) {
    const struct sweep *sweep = &scene->rule->loader.sweep;
    struct monge_define *defines = calloc(sweep->count + 1, sizeof *defines);
    if (!defines) say_no_memory();
    for (size_t i = 0; i < sweep->total; i++) {
        sweep_combination(sweep, i, defines);
        const struct pattern_values values = {
            .name = scene->name, .defines = defines, .define_count = sweep->count};
        char *name = pattern_usual(sweep, &values);
        golden_claims_add(claims, name, scene->rule->rule->aov, scene->path);
        free(name);
    }
    free(defines);
}

static bool check_files(const struct golden_run *run) {
    struct golden_claims claims;
    golden_claims_begin(&claims);
    for (size_t i = 0; i < run->count; i++)
        if (!run->scenes[i].rule->args.option[OPTION_FRAMES].given) claim_scene(&claims, &run->scenes[i]);
    const bool good = golden_claims_check(&claims);
    golden_claims_free(&claims);
    return good;
}

static void say_unread(const struct golden_run *run, const char *path) {
    const char *why = strerror(errno);
    char *meant = golden_find_meant(run, path);
    say_error("cannot read %s: %s%s%s%s", path, why, meant ? "; did you mean `" : "", meant ? meant : "",
              meant ? "`?" : "");
    free(meant);
}

static bool name_scenes(struct golden_run *run) {
    const struct scenes *found = &run->loader.scenes;
    run->scenes = calloc(found->count + 1, sizeof *run->scenes);
    if (!run->scenes) say_error("out of memory");
    for (size_t i = 0; run->scenes && i < found->count; i++) {
        char *name = golden_settings_name(&run->settings, &found->all[i]);
        if (name) {
            run->scenes[run->count++] = (struct golden_scene){
                .path = found->all[i].path, .name = name, .rule = golden_settings_find(&run->settings, name)};
            continue;
        }
        if (access(found->all[i].path, F_OK) != 0)
            say_unread(run, found->all[i].path);
        else
            say_error("%s: it is not below `root`, %s", found->all[i].path, run->settings.root);
        run->loader.scenes.status = STATUS_TROUBLE;
    }
    return run->scenes && check_scenes(run) && check_files(run);
}

/* Whether the operands may tell all scenes: each is a folder, and was read. */
static bool names_all(const struct test *test) {
    const struct golden_settings *settings = &test->run.settings;
    bool has_root = !settings->root || test->args.count == 0;
    for (size_t i = 0; i < test->args.count; i++) {
        struct stat status;
        if (stat(test->args.operands[i], &status) != 0 || !S_ISDIR(status.st_mode)) return false;
        char *real = realpath(test->args.operands[i], NULL);
        has_root |= real && settings->root && strcmp(real, settings->root) == 0;
        free(real);
    }
    return has_root && !settings->other_root && test->run.loader.scenes.status == STATUS_YES;
}

/* Where a golden's scene must be gone from, so that it is an orphan. */
static void find_places(struct test *test) {
    struct golden_places *places = &test->results.places;
    const char *root = test->run.settings.root;
    if (!names_all(test)) return;
    if (root) places->root = golden_settings_root(&test->run.settings);
    for (size_t i = 0; i < test->args.count && !root; i++) golden_places_add(places, test->args.operands[i]);
}

/* ---- The folder of the run ---- */

/* What the run before has left. */
static bool clear_folder(const struct golden_run *run) {
    bool good = true;
    for (size_t i = 0; i < run->last.count; i++) good &= golden_clear(run->output, run->last.cases[i].name);
    return good;
}

/* A folder that is made here keeps itself out of repositories. */
static bool make_folder(const char *path) {
    struct monge_text ignore = {"*\n", 2};
    char *file = path_below(path, ".gitignore", "");
    struct stat status;
    const bool there = stat(path, &status) == 0;
    const bool good = there || (path_make_folders(file) && golden_write(file, &ignore));
    free(file);
    return good;
}

static bool prepare_folder(struct golden_run *run) {
    char *results = path_below(run->output, "results.json", "");
    const enum golden_reading reading = golden_results_read(&run->last, results);
    if (reading == GOLDEN_DAMAGED)
        say_error("warning: %s is damaged: this run goes as if there had been none before, and replaces it",
                  results);
    const bool good = reading != GOLDEN_UNREAD && make_folder(run->output) && clear_folder(run) &&
                      golden_remove(run->output, results);
    free(results);
    return good && make_folder(run->output); /* the last file that goes may take the folder with it */
}

/* ---- The run ---- */

static bool run_scene(void *context, size_t index) {
    struct test *test = context;
    golden_scene_run(&test->run, &test->run.scenes[index]);
    return true;
}

/* Whether it is told at the end alone: what is new, or when it is known whether it is taken. */
static bool is_held(const struct test *test, const struct golden_case *c) {
    return (test->holds_new && c->status == GOLDEN_NEW) ||
           (wants(test, OPTION_UPDATE_ONLY_FAILED) && golden_can_take(c));
}

static void end_scene(void *context, size_t index, const char *said) {
    struct test *test = context;
    const struct golden_scene *scene = &test->run.scenes[index];
    progress_pause(&test->run.progress);
    fputs(said, stderr);
    for (size_t i = 0; i < scene->count; i++)
        if (!is_held(test, &scene->cases[i])) golden_tell(&test->teller, &scene->cases[i]);
    progress_resume(&test->run.progress);
}

/* Whether there are goldens of which the run may find out that they are orphans. */
static bool may_find_orphans(const struct test *test) {
    if (!names_all(test)) return false;
    char **names = golden_names(test->run.folder);
    const bool any = test->run.lock.count > 0 || (names && *names);
    golden_names_free(names);
    return any;
}

/* What the run has not told: what is held, and orphans. */
static void tell_rest(struct test *test, size_t first_orphan) {
    const struct golden_results *results = &test->results;
    for (size_t i = 0; i < results->count; i++)
        if (i >= first_orphan || is_held(test, &results->cases[i]))
            golden_tell(&test->teller, &results->cases[i]);
}

/* Of all scenes, in their order; they are the results' from now on. */
static bool gather(struct test *test) {
    struct golden_run *run = &test->run;
    size_t count = 0;
    for (size_t i = 0; i < run->count; i++) count += run->scenes[i].count;
    struct golden_case *cases = calloc(count + 1, sizeof *cases), *to = cases;
    if (!cases) say_error("out of memory");
    for (size_t i = 0; cases && i < run->count; i++)
        for (size_t k = 0; k < run->scenes[i].count; k++) *to++ = run->scenes[i].cases[k];
    test->results.cases = cases;
    test->results.count = cases ? count : 0;
    return cases;
}

/* With frames, of which the scenes alone know how many there are. */
static bool check_names(const struct golden_case *cases, size_t count) {
    struct golden_claims claims;
    golden_claims_begin(&claims);
    for (size_t i = 0; i < count; i++)
        golden_claims_add(&claims, cases[i].name, cases[i].aov && cases[i].status != GOLDEN_BROKEN,
                          cases[i].scene);
    const bool good = golden_claims_check(&claims);
    golden_claims_free(&claims);
    return good;
}

/* For the report, which is to show both. */
static bool keep_old(const struct test *test, struct golden_case *c) {
    return !wants(test, OPTION_REPORT) || !c->golden_path || golden_keep(test->run.output, c);
}

static bool take_new(struct test *test) {
    struct golden_run *run = &test->run;
    golden_hold(run->folder); /* others may have written the lock during the run */
    golden_lock_free(&run->lock);
    if (!golden_lock_read(&run->lock, run->folder)) return false;
    size_t taken = 0;
    bool good = true;
    for (size_t i = 0; i < test->results.count; i++) {
        struct golden_case *c = &test->results.cases[i];
        if (!golden_can_take(c)) continue;
        if (golden_is_as_noted(run->folder, &run->lock, c))
            good &= c->taken = keep_old(test, c) && golden_take(run->folder, &run->lock, c);
        else
            say_error("%s is left as it is: its golden has changed during the run", c->name);
        taken += c->taken;
    }
    if (taken == 0 || golden_lock_write(&run->lock)) return good;
    for (size_t i = 0; i < test->results.count; i++)
        test->results.cases[i].taken &= test->results.cases[i].kind == MONGE_GOLDEN_PNG;
    return false;
}

static void mention_taken(const struct test *test) {
    size_t taken = 0, wanted = 0;
    for (size_t i = 0; i < test->results.count; i++) {
        wanted += golden_can_take(&test->results.cases[i]);
        taken += test->results.cases[i].taken;
    }
    if (wanted > 0) fprintf(test->teller.out, "%zu of %zu new pictures are goldens now\n", taken, wanted);
}

/* ---- What it comes to ---- */

static enum status judge(const struct test *test) {
    enum status worst = test->run.loader.scenes.status;
    for (size_t i = 0; i < test->results.count; i++) {
        const struct golden_case *c = &test->results.cases[i];
        const enum status status = c->trouble                             ? STATUS_TROUBLE
                                   : c->status == GOLDEN_SAME || c->taken ? STATUS_YES
                                                                          : STATUS_NO;
        if (status > worst) worst = status;
    }
    return worst;
}

/* Files of goldens that do not count any more are no orphans: they may be there for something else. First pictures of those
 * that have become hashes. */
static void mention_pictures(const struct test *test) {
    char *first = NULL;
    size_t count = 0;
    for (size_t i = 0; i < test->results.count; i++) {
        const struct golden_case *c = &test->results.cases[i];
        char *path = path_below(test->run.folder, c->name, ".png");
        const bool useless = c->kind == MONGE_GOLDEN_HASH && c->scene && path_is_file(path);
        if (useless && count++ == 0)
            first = path;
        else
            free(path);
    }
    if (count == 1) say_line(test->teller.out, "%s is not compared: its golden is a hash", first);
    if (count > 1)
        say_line(test->teller.out, "%s and %zu more pictures are not compared: their goldens are hashes",
                 first, count - 1);
    free(first);
}

static void mention_passes(const struct test *test) {
    const char *first = NULL;
    size_t count = 0;
    for (size_t i = 0; i < test->results.count; i++) {
        const struct golden_case *c = &test->results.cases[i];
        char *path = path_below(test->run.folder, c->name, ".png");
        if (c->kind != MONGE_GOLDEN_HASH && !c->aov && c->scene && golden_has_passes(path) && count++ == 0)
            first = c->name;
        free(path);
    }
    if (count == 1)
        say_line(test->teller.out, "the passes of %s are not compared: its rule has no `aov: true`", first);
    if (count > 1)
        say_line(test->teller.out,
                 "the passes of %s and %zu more goldens are not compared: their rules have no `aov: true`",
                 first, count - 1);
}

static void mention_elsewhere(const struct test *test) {
    const size_t count = test->results.elsewhere;
    if (count > 0)
        say_line(test->teller.out, "%zu golden%s of scenes that are not in this run", count,
                 count == 1 ? " is" : "s are");
}

static void hint(const struct test *test) {
    bool can = false, orphans = false;
    for (size_t i = 0; i < test->results.count; i++) {
        can |= golden_can_take(&test->results.cases[i]) && !test->results.cases[i].taken;
        orphans |= test->results.cases[i].status == GOLDEN_ORPHAN;
    }
    if (!(can || orphans)) return;
    fprintf(test->teller.out, "`%s%s` %s\n", test->results.accept, orphans ? " --prune" : "",
            !orphans ? "takes the new pictures"
            : can    ? "takes the new pictures and removes the orphans"
                     : "removes the orphans");
}

/* ---- All of it ---- */

/* Scenes that a signal has kept from being judged. */
static size_t count_undone(const struct golden_run *run) {
    size_t undone = 0;
    for (size_t i = 0; i < run->count; i++) undone += !run->scenes[i].done;
    return undone;
}

static void tell_interrupted(const struct test *test) {
    if (test->results.interrupted && !test->teller.quiet)
        say_note("interrupted: %zu of %zu scenes not judged", test->results.interrupted, test->run.count);
}

static enum status run_test(struct test *test) {
    struct golden_run *run = &test->run;
    const struct batch batch = {run->count, run->jobs, run->jobs > 1, test, run_scene, end_scene};
    test->holds_new = may_find_orphans(test);
    golden_tell_begin(&test->teller);
    progress_begin(&run->progress, (enum progress_wish)test->args.option[OPTION_PROGRESS].choice,
                   test->teller.quiet, run->count, run->loader.scenes.missing);
    if (run->count > 0) batch_run(&batch);
    progress_end(&run->progress);
    if (!gather(test)) return STATUS_TROUBLE;
    test->results.interrupted = count_undone(run);
    const bool all = test->results.interrupted == 0;
    const size_t first_orphan = test->results.count;
    if (all) find_places(test);
    const bool whole = all && golden_looks_for_orphans(run, &test->results);
    if (whole) golden_find_orphans(run, &test->results);
    const bool named = check_names(test->results.cases, first_orphan),
               takes = named && all && wants(test, OPTION_UPDATE_ONLY_FAILED);
    bool good = !takes || take_new(test);
    tell_rest(test, first_orphan);
    test->results.seconds = clock_seconds() - test->begun;
    golden_tell_end(&test->teller, &test->results);
    if (whole && test->results.elsewhere == 0) golden_warn_of_unused(run);
    if (!named) return STATUS_TROUBLE;
    good &= golden_files_write(&test->results, run->output, test->args.option);
    if (!test->teller.tap && !test->teller.quiet) {
        if (takes) mention_taken(test);
        mention_pictures(test);
        mention_passes(test);
        mention_elsewhere(test);
        hint(test);
    }
    tell_interrupted(test);
    return good ? judge(test) : STATUS_TROUBLE;
}

static void mention_folder(const struct test *test) {
    if (golden_is_there(test->run.folder) || test->teller.quiet) return;
    if (wants(test, OPTION_UPDATE_ONLY_FAILED))
        say_note("there is no folder %s yet: this run makes it", test->run.folder);
    else
        say_note("there is no folder %s yet: `%s` makes it", test->run.folder, test->results.accept);
}

static bool is_standard(const struct option_value *option) {
    return option->given && strcmp(option->text, "-") == 0;
}

static bool begin(struct test *test, const struct arguments *args) {
    const struct option_value *option = args->option;
    struct golden_run *run = &test->run;
    if (!option[OPTION_GOLDEN].given) {
        say_usage(COMMAND_TEST, "test: --golden DIR is missing, the folder of the goldens");
        return false;
    }
    if (is_standard(&option[OPTION_TEST_JSON]) && is_standard(&option[OPTION_JUNIT])) {
        say_usage(COMMAND_TEST, "--json - and --junit -: standard output can take only one of them");
        return false;
    }
    run->folder = option[OPTION_GOLDEN].text;
    run->output = option[OPTION_TEST_OUTPUT].given ? option[OPTION_TEST_OUTPUT].text : "monge-test";
    run->old_program = option[OPTION_OLD].text;
    run->changed_only = option[OPTION_CHANGED].given;
    run->threads = option[OPTION_THREADS].number[0];
    run->jobs = option[OPTION_JOBS].given ? option[OPTION_JOBS].number[0] : monge_processors();
    /* a document must be alone on standard output */
    FILE *out =
        is_standard(&option[OPTION_TEST_JSON]) || is_standard(&option[OPTION_JUNIT]) ? stderr : stdout;
    const bool for_programs = option[OPTION_PROGRESS].choice == PROGRESS_JSON; /* alone on stderr */
    test->teller =
        (struct golden_teller){.out = out,
                               .tap = option[OPTION_TAP].given,
                               .quiet = option[OPTION_QUIET].given || (out == stderr && for_programs),
                               .colors = isatty(fileno(out)) && !getenv("NO_COLOR")};
    test->results.folder = say_text("%s", run->folder);
    test->results.from = getcwd(NULL, 0);
    test->results.accept = golden_accept_words(run->folder, option[OPTION_TEST_OUTPUT].text);
    const enum monge_golden_kind kind = (enum monge_golden_kind)option[OPTION_GOLDEN_KIND].choice;
    if (!golden_check_folder(run->folder) || (run->old_program && !golden_check_old(run->old_program)) ||
        !loader_begin(&run->loader, args) ||
        !golden_settings_read(&run->settings, run->folder, option[OPTION_GOLDEN_KIND].given ? &kind : NULL,
                              &option[OPTION_ROOT], &run->loader))
        return false;
    golden_warn_of_tolerances(run);
    if (!find_scenes(test) || !name_scenes(run) || !golden_check_targets(run, option) ||
        !golden_lock_read(&run->lock, run->folder) || !prepare_folder(run))
        return false;
    mention_folder(test);
    return true;
}

static void end(struct test *test) {
    struct golden_run *run = &test->run;
    for (size_t i = 0; i < run->count; i++) {
        free(run->scenes[i].name);
        free(run->scenes[i].cases);
    }
    free(run->scenes);
    golden_results_free(&test->results);
    golden_results_free(&run->last);
    golden_lock_free(&run->lock);
    golden_settings_free(&run->settings);
    loader_end(&run->loader, NULL);
}

enum status test_command(const struct arguments *args) {
    struct test test = {.args = *args, .begun = clock_seconds()};
    streams_outlive_readers();
    const bool begun = begin(&test, args); /* here a signal may still end the program at once */
    interrupt_defer();
    const enum status status = begun ? run_test(&test) : STATUS_TROUBLE;
    end(&test);
    streams_flush();
    interrupt_settle();
    return status;
}
