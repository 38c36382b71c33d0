#include "cli/golden/take.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/aov.h"
#include "cli/golden/folder.h"
#include "cli/paths.h"
#include "cli/say.h"

bool golden_can_take(const struct golden_case *c) {
    return c->new_path &&
           (c->status == GOLDEN_CHANGED || c->status == GOLDEN_NEW || c->status == GOLDEN_MISSING);
}

/* ---- What there is ---- */

static void hash_file(const char *path, char hash[MONGE_HASH_SIZE]) {
    struct monge_diagnostics *diag = monge_diagnostics_new();
    if (!diag || !path_is_file(path) || !monge_files_hash(path, "", NULL, diag, hash)) *hash = '\0';
    monge_diagnostics_free(diag);
}

static char *line_of(const struct golden_lock *lock, const char *name) {
    const struct golden_line *line = golden_lock_find(lock, name);
    return line ? golden_lock_text(name, &line->stamp) : NULL;
}

static bool same_line(const char *a, const char *b) { return a && b ? strcmp(a, b) == 0 : !a && !b; }

void golden_note(const char *folder, const struct golden_lock *lock, struct golden_case *c) {
    char *path = path_below(folder, c->name, ".png");
    if (c->kind != MONGE_GOLDEN_HASH) hash_file(path, c->golden_file);
    c->golden_line = line_of(lock, c->name);
    free(path);
}

bool golden_is_as_noted(const char *folder, const struct golden_lock *lock, const struct golden_case *c) {
    struct golden_case now = {.name = c->name, .kind = c->kind};
    golden_note(folder, lock, &now);
    const bool same =
        strcmp(now.golden_file, c->golden_file) == 0 && same_line(now.golden_line, c->golden_line);
    free(now.golden_line);
    return same;
}

static bool same_files(const char *a, const char *b) {
    char p[MONGE_HASH_SIZE], q[MONGE_HASH_SIZE];
    hash_file(a, p);
    hash_file(b, q);
    return strcmp(p, q) == 0;
}

static bool same_text(const struct monge_picture *a, const struct monge_picture *b, const char *key) {
    const char *p = monge_picture_text(a, key), *q = monge_picture_text(b, key);
    return p && q ? strcmp(p, q) == 0 : !p && !q;
}

/* All that a reader of passes goes by. */
static bool says_same(const struct monge_picture *a, const struct monge_picture *b) {
    static const char *const keys[] = {"monge:scene",  "monge:region",   "monge:table", "monge:camera",
                                       "monge:lights", "monge:settings", "monge:depth"};
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        if (!same_text(a, b, keys[i])) return false;
    return true;
}

/* Whether the files of a layer have the same to say: those of another program may be compressed in another way. */
static bool same_layers(const char *a, const char *b) {
    if (same_files(a, b)) return true;
    struct monge_diagnostics *diag = monge_diagnostics_new(); /* a file that cannot be read is not the same */
    struct monge_picture *p = diag ? monge_picture_read(a, diag) : NULL,
                         *q = p ? monge_picture_read(b, diag) : NULL;
    const struct monge_compare how = {.max_delta = 0.0};
    struct monge_difference difference;
    const bool same = q && says_same(p, q) && monge_compare(p, q, &how, &difference, diag) && difference.same;
    monge_picture_free(q);
    monge_picture_free(p);
    monge_diagnostics_free(diag);
    return same;
}

/* With its layers. */
static bool same_pictures(const char *a, const char *b) {
    bool same = same_files(a, b);
    for (enum monge_layer layer = 0; same && layer < MONGE_LAYERS; layer++) {
        char *p = aov_path(layer, a), *q = aov_path(layer, b);
        same = same_layers(p, q);
        free(q);
        free(p);
    }
    return same;
}

bool golden_is_taken(const char *folder, const struct golden_lock *lock, const struct golden_case *c) {
    char *path = path_below(folder, c->name, ".png"), *line = line_of(lock, c->name);
    char *wanted = c->kind == MONGE_GOLDEN_PNG ? NULL : golden_lock_text(c->name, &c->now);
    const bool taken =
        same_line(line, wanted) && (c->kind == MONGE_GOLDEN_HASH || same_pictures(path, c->new_path));
    free(wanted);
    free(line);
    free(path);
    return taken;
}

/* ---- Taking ---- */

bool golden_check_places(const char *folder, const struct golden_case *c) {
    char *picture = path_below(folder, c->name, ".png");
    bool good = c->kind == MONGE_GOLDEN_HASH || golden_check_inside(folder, picture);
    for (enum monge_layer layer = 0; good && layer < MONGE_LAYERS && c->kind != MONGE_GOLDEN_HASH; layer++) {
        char *path = aov_path(layer, picture);
        good = golden_check_inside(folder, path);
        free(path);
    }
    free(picture);
    return good;
}

/* The layers of the picture come along; those of the old one go, unless they are the same. */
static bool take_layers(const char *folder, const char *from, const char *to) {
    bool good = true;
    for (enum monge_layer layer = 0; good && layer < MONGE_LAYERS; layer++) {
        char *new = aov_path(layer, from), *old = aov_path(layer, to);
        good =
            same_layers(old, new) || (path_is_file(new) ? golden_copy(new, old) : golden_remove(folder, old));
        free(new);
        free(old);
    }
    return good;
}

/* The picture last: while it is the old one, the case still fails. */
static bool take_picture(const char *folder, const struct golden_case *c) {
    char *to = path_below(folder, c->name, ".png");
    const bool good = golden_check_places(folder, c) && path_make_folders(to) &&
                      take_layers(folder, c->new_path, to) && golden_copy(c->new_path, to);
    free(to);
    return good;
}

bool golden_keep(const char *output, struct golden_case *c) {
    char *folder = path_below(output, "old", ""), *to = path_below(folder, c->name, ".png");
    bool good = strcmp(to, c->golden_path) == 0 || (path_make_folders(to) && golden_copy(c->golden_path, to));
    for (enum monge_layer layer = 0; good && layer < MONGE_LAYERS; layer++) {
        char *from = aov_path(layer, c->golden_path), *copy = aov_path(layer, to);
        good = !path_is_file(from) || path_is_same(from, copy) || golden_copy(from, copy);
        free(copy);
        free(from);
    }
    free(folder);
    free(good ? c->golden_path : to);
    if (good) c->golden_path = to;
    return good;
}

bool golden_take(const char *folder, struct golden_lock *lock, const struct golden_case *c) {
    if (c->kind != MONGE_GOLDEN_HASH && !take_picture(folder, c)) return false;
    if (c->kind != MONGE_GOLDEN_PNG)
        golden_lock_put(lock, c->name, &c->now);
    else
        golden_lock_remove(lock, c->name);
    return true;
}

bool golden_forget(const char *folder, struct golden_lock *lock, const struct golden_case *c) {
    golden_lock_remove(lock, c->name);
    return !c->golden_path || golden_remove_picture(folder, c->golden_path);
}
