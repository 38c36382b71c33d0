#include "cli/golden_orphans.h"

#include <stdlib.h>
#include <string.h>

#include "cli/golden_folder.h"
#include "cli/say.h"

static bool is_broken(const struct golden_scene *scene) {
    for (size_t i = 0; i < scene->count; i++)
        if (scene->cases[i].status == GOLDEN_BROKEN) return true;
    return false;
}

static bool is_case(const struct golden_run *run, const char *golden) {
    for (size_t i = 0; i < run->count; i++)
        for (size_t k = 0; k < run->scenes[i].count; k++)
            if (strcmp(run->scenes[i].cases[k].name, golden) == 0) return true;
    return false;
}

/* The scene of the run whose name is the first `length` bytes; NULL: none. */
static const struct golden_scene *scene_of(const struct golden_run *run, const char *name, size_t length) {
    for (size_t i = 0; i < run->count; i++)
        if (strncmp(run->scenes[i].name, name, length) == 0 && !run->scenes[i].name[length])
            return &run->scenes[i];
    return NULL;
}

/* Whether there is a scene of that name, which the run has not tested. */
static bool is_elsewhere(const struct golden_run *run, struct golden_results *results, const char *name,
                         size_t length) {
    char *scene = say_text("%.*s", (int)length, name);
    const bool there = golden_places_have(&results->places, scene, &run->loader.limits.load);
    results->elsewhere += there;
    free(scene);
    return there;
}

/* Whether some scene that is still there may need it, though this run does not tell: it is called NAME, or NAME- and
 * what frames and parameters add. */
static bool may_be_needed(const struct golden_run *run, struct golden_results *results, const char *golden) {
    for (size_t length = 1, all = strlen(golden); length <= all; length++) {
        if (golden[length] && golden[length] != '-') continue;
        const struct golden_scene *scene = scene_of(run, golden, length);
        if (scene ? is_broken(scene) : is_elsewhere(run, results, golden, length)) return true;
    }
    return false;
}

static void add_orphan(struct golden_results *results, const char *name, enum monge_golden_kind kind,
                       char *path) {
    results->cases = realloc(results->cases, (results->count + 1) * sizeof *results->cases);
    if (!results->cases) {
        say_error("out of memory");
        exit(STATUS_TROUBLE);
    }
    results->cases[results->count++] = (struct golden_case){
        .name = say_text("%s", name), .kind = kind, .status = GOLDEN_ORPHAN, .golden_path = path};
}

static bool is_orphan(const struct golden_run *run, struct golden_results *results, const char *golden) {
    return !is_case(run, golden) && !may_be_needed(run, results, golden);
}

static void add_lines(const struct golden_run *run, struct golden_results *results) {
    for (size_t i = 0; i < run->lock.count; i++) {
        const char *name = run->lock.lines[i].name;
        if (!is_orphan(run, results, name)) continue;
        const bool picture = golden_settings_find(&run->settings, name)->rule->kind != MONGE_GOLDEN_HASH;
        char *path = golden_path(run->folder, name, ".png");
        const bool there = picture && golden_is_file(path);
        add_orphan(results, name, there ? MONGE_GOLDEN_BOTH : MONGE_GOLDEN_HASH, there ? path : NULL);
        if (!there) free(path);
    }
}

/* Where goldens are hashes, pictures in their folder are for something else. */
static void add_pictures(const struct golden_run *run, struct golden_results *results) {
    char **names = golden_names(run->folder);
    for (char **name = names; name && *name; name++) {
        const bool picture = golden_settings_find(&run->settings, *name)->rule->kind != MONGE_GOLDEN_HASH;
        if (picture && !golden_lock_find(&run->lock, *name) && is_orphan(run, results, *name))
            add_orphan(results, *name, MONGE_GOLDEN_PNG, golden_path(run->folder, *name, ".png"));
    }
    golden_names_free(names);
}

void golden_find_orphans(const struct golden_run *run, struct golden_results *results) {
    if (!results->places.root && results->places.count == 0) return;
    add_lines(run, results);
    add_pictures(run, results);
}
