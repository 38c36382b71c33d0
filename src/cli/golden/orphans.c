#include "cli/golden/orphans.h"

#include <stdlib.h>
#include <string.h>

#include "cli/aov.h"
#include "cli/golden/folder.h"
#include "cli/paths.h"
#include "cli/say.h"

static bool is_broken(const struct golden_scene *scene) {
    for (size_t i = 0; i < scene->count; i++)
        if (scene->cases[i].status == GOLDEN_BROKEN) return true;
    return false;
}

/* ---- What the run has, by name ---- */

struct known {
    const char *name;
    const struct golden_scene *scene;
};

struct search {
    const struct golden_run *run;
    struct golden_results *results;
    struct known *cases, *scenes; /* owned, sorted */
    size_t case_count;
};

static int compare_known(const void *a, const void *b) {
    return strcmp(((const struct known *)a)->name, ((const struct known *)b)->name);
}

static const struct known *find(const struct known *all, size_t count, const char *name) {
    const struct known key = {.name = name};
    return count ? bsearch(&key, all, count, sizeof *all, compare_known) : NULL;
}

static struct known *make_known(size_t count) {
    struct known *all = calloc(count + 1, sizeof *all);
    if (!all) say_no_memory();
    return all;
}

static void begin(struct search *search) {
    const struct golden_run *run = search->run;
    for (size_t i = 0; i < run->count; i++) search->case_count += run->scenes[i].count;
    search->scenes = make_known(run->count);
    search->cases = make_known(search->case_count);
    struct known *to = search->cases;
    for (size_t i = 0; i < run->count; i++) {
        const struct golden_scene *scene = &run->scenes[i];
        search->scenes[i] = (struct known){scene->name, scene};
        for (size_t k = 0; k < scene->count; k++) *to++ = (struct known){scene->cases[k].name, scene};
    }
    qsort(search->scenes, run->count, sizeof *search->scenes, compare_known);
    qsort(search->cases, search->case_count, sizeof *search->cases, compare_known);
}

/* ---- Orphans ---- */

/* Whether there is a scene of that name, which the run has not tested. */
static bool is_elsewhere(const struct search *search, const char *name) {
    const bool there = golden_places_have(&search->results->places, name, &search->run->loader.limits.load);
    search->results->elsewhere += there;
    return there;
}

/* Whether some scene that is still there may need it, though this run does not tell: it is called NAME, or NAME- and
 * what frames and parameters add. */
static bool may_be_needed(const struct search *search, const char *golden) {
    char *name = say_text("%s", golden);
    bool needed = false;
    for (char *end = name + strlen(name); end && !needed; end = strrchr(name, '-')) {
        *end = '\0';
        const struct known *known = find(search->scenes, search->run->count, name);
        needed = known ? is_broken(known->scene) : is_elsewhere(search, name);
    }
    free(name);
    return needed;
}

static void add_orphan(struct golden_results *results, const char *name, enum monge_golden_kind kind,
                       char *path) {
    results->cases = realloc(results->cases, (results->count + 1) * sizeof *results->cases);
    if (!results->cases) say_no_memory();
    results->cases[results->count++] =
        (struct golden_case){.name = say_text("%s", name),
                             .kind = kind,
                             .status = GOLDEN_ORPHAN,
                             .golden_path = path,
                             .prune_command = say_text("%s --prune", results->accept)};
}

static bool is_orphan(const struct search *search, const char *golden) {
    return !find(search->cases, search->case_count, golden) && !may_be_needed(search, golden);
}

static bool is_picture(const struct search *search, const char *golden) {
    return golden_settings_find(&search->run->settings, golden)->rule->kind != MONGE_GOLDEN_HASH;
}

static void add_lines(const struct search *search) {
    const struct golden_lock *lock = &search->run->lock;
    for (size_t i = 0; i < lock->count; i++) {
        const char *name = lock->lines[i].name;
        if (!is_orphan(search, name)) continue;
        char *path = path_below(search->run->folder, name, ".png");
        const bool there = is_picture(search, name) && path_is_file(path);
        add_orphan(search->results, name, there ? MONGE_GOLDEN_BOTH : MONGE_GOLDEN_HASH, there ? path : NULL);
        if (!there) free(path);
    }
}

/* Whether it is NAME.object or so, a pass of a picture of the run, whose golden has gone. */
static bool is_pass(const struct search *search, const char *name) {
    bool found = false;
    for (enum monge_layer layer = 0; layer < MONGE_LAYERS && !found; layer++) {
        char *file = aov_path(layer, "x.png"), *ending = file + 1, *dot = strrchr(file, '.');
        *dot = '\0';
        const size_t all = strlen(name), length = strlen(ending);
        char *picture = all > length ? say_text("%.*s", (int)(all - length), name) : NULL;
        found = picture && strcmp(name + all - length, ending) == 0 &&
                find(search->cases, search->case_count, picture);
        free(picture);
        free(file);
    }
    return found;
}

/* Where goldens are hashes, pictures in their folder are for something else. */
static void add_pictures(const struct search *search) {
    const struct golden_run *run = search->run;
    char **names = golden_names(run->folder);
    for (char **name = names; name && *name; name++)
        if (is_picture(search, *name) && !golden_lock_find(&run->lock, *name) && !is_pass(search, *name) &&
            is_orphan(search, *name))
            add_orphan(search->results, *name, MONGE_GOLDEN_PNG, path_below(run->folder, *name, ".png"));
    golden_names_free(names);
}

/* ---- Scenes of other names ---- */

static int compare_pixels(const void *a, const void *b) {
    const struct golden_case *p = *(const struct golden_case *const *)a,
                             *q = *(const struct golden_case *const *)b;
    return strcmp(p->now.pixels, q->now.pixels);
}

/* Those without a golden, by their pixels. To be freed. */
static struct golden_case **find_new(struct golden_results *results, size_t *count) {
    struct golden_case **all = calloc(results->count + 1, sizeof *all);
    if (!all) say_no_memory();
    *count = 0;
    for (size_t i = 0; i < results->count; i++)
        if (results->cases[i].status == GOLDEN_NEW && *results->cases[i].now.pixels)
            all[(*count)++] = &results->cases[i];
    qsort(all, *count, sizeof *all, compare_pixels);
    return all;
}

/* c->old.pixels: of its line, or of its picture; "" where that cannot be read. */
static void hash_orphan(const struct golden_run *run, struct golden_case *c) {
    const struct golden_line *line = golden_lock_find(&run->lock, c->name);
    const bool file = !line && path_is_file(c->golden_path); /* a link may lead to what has no end */
    struct monge_diagnostics *diag = file ? monge_diagnostics_new() : NULL;
    struct monge_picture *picture = diag ? monge_picture_read(c->golden_path, diag) : NULL;
    if (line)
        memcpy(c->old.pixels, line->stamp.pixels, sizeof c->old.pixels);
    else if (!picture || !monge_picture_hash(picture, diag, c->old.pixels))
        *c->old.pixels = '\0';
    monge_picture_free(picture);
    monge_diagnostics_free(diag);
}

/* A new scene that looks as the golden of an orphan does may be that one's, under another name. */
static void find_renamed(const struct golden_run *run, struct golden_results *results) {
    size_t count = 0;
    struct golden_case **all = find_new(results, &count);
    for (size_t i = 0; count > 0 && i < results->count; i++) {
        struct golden_case *orphan = &results->cases[i], looks = {0}, *key = &looks;
        if (orphan->status != GOLDEN_ORPHAN) continue;
        hash_orphan(run, orphan);
        memcpy(looks.now.pixels, orphan->old.pixels, sizeof looks.now.pixels);
        struct golden_case **found = bsearch(&key, all, count, sizeof *all, compare_pixels), *new;
        if (!found) continue;
        new = *found;
        golden_add_message(orphan, "its picture is that of %s, which is new: was the scene renamed?",
                           new->name);
        if (!new->message)
            golden_add_message(new, "its picture is that of the orphan %s: was the scene renamed?",
                               orphan->name);
    }
    free(all);
}

/* Without a root, scenes of which none has a golden may be called from another folder than the goldens are. */
static bool knows_goldens(const struct golden_run *run) {
    bool known = false;
    for (size_t i = 0; i < run->count && !known; i++)
        for (size_t k = 0; k < run->scenes[i].count && !known; k++)
            known = run->scenes[i].cases[k].status != GOLDEN_NEW &&
                    run->scenes[i].cases[k].status != GOLDEN_BROKEN;
    return known;
}

bool golden_looks_for_orphans(const struct golden_run *run, const struct golden_results *results) {
    return results->places.root || (results->places.count > 0 && knows_goldens(run));
}

void golden_find_orphans(const struct golden_run *run, struct golden_results *results) {
    struct search search = {.run = run, .results = results};
    begin(&search);
    add_lines(&search);
    add_pictures(&search);
    find_renamed(run, results);
    free(search.cases);
    free(search.scenes);
}
