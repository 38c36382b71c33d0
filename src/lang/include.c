/* Files that a scene includes for their definitions. */
#include <dirent.h>
#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "lang/checker.h"
#include "lang/file.h"
#include "lang/problem.h"
#include "lang/spelling.h"

/* Bytes of a path up to its last slash, that included. */
static size_t folder_length(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash ? (size_t)(slash - path) + 1 : 0;
}

static const char *path_from(struct checker *ck, const struct unit *unit, const char *name) {
    struct arena *arena = &ck->memory->kept;
    if (*name == '/') return arena_text(arena, name, strlen(name));
    return arena_format(arena, "%.*s%s", (int)folder_length(unit->path), unit->path, name);
}

/* ---- What is wrong ---- */

static void report_missing(struct checker *ck, const struct node *node, const char *path) {
    const int reason = errno;
    const struct node *n = node_resolve(node);
    struct diagnostic *d = diag_error(ck->diag, node->span, "include-missing", "cannot read `%s`: %s",
                                      short_text(ck, n->text), strerror(reason));
    if (strcmp(path, n->text) != 0) diag_note(ck->diag, d, "looked for it at %s", path);
    if (reason == EINVAL) diag_help(ck->diag, d, "what is included is a regular file");
    if (reason == EISDIR || reason == EINVAL) return;
    const char *folder = arena_format(ck->arena, "%.*s", (int)folder_length(path), path);
    DIR *files = opendir(*folder ? folder : ".");
    if (!files) diag_help(ck->diag, d, "there is no folder %s", folder);
    struct spelling s = spelling_begin(path + folder_length(path));
    char best[sizeof((struct dirent *)0)->d_name] = ""; /* the arena might leave while the folder is open */
    for (struct dirent *file = files ? readdir(files) : NULL; file; file = readdir(files)) {
        spelling_offer(&s, file->d_name);
        if (s.best == file->d_name) s.best = strcpy(best, file->d_name);
    }
    if (files) closedir(files);
    if (*best) diag_help(ck->diag, d, "did you mean `%.*s%s`?", (int)folder_length(n->text), n->text, best);
}

static void report_no_definitions(struct checker *ck, const struct unit *unit) {
    struct diagnostic *d = diag_error(ck->diag, unit->root->span, "not-a-mapping",
                                      "expected definitions, found %s", found_text(ck, unit->root));
    diag_note(ck->diag, d, "an included file has `params`, `define`, `materials` or `include`");
    diag_related(ck->diag, d, unit->include, "it is included here");
}

/* Nothing can be said of names that are not found: they may be in the file that cannot be read. */
static void lose_names(struct checker *ck) { ck->names_lost = ck->variables_lost = true; }

static void report_cycle(struct checker *ck, const struct unit *unit, const struct unit *again,
                         const struct node *node) {
    struct diagnostic *d =
        diag_error(ck->diag, node->span, "include-cycle", "`%s` includes itself", again->source->name);
    for (const struct unit *u = unit; u != again; u = u->includer)
        diag_related(ck->diag, d, u->include, "`%s` is included here", u->source->name);
    diag_help(ck->diag, d, "remove one of these includes");
}

/* In an untrusted run nothing is read outside of the folder of the scene. */
static bool is_allowed(struct checker *ck, const struct node *node, const char *path) {
    if (!ck->input->untrusted) return true;
    char folder[PATH_MAX], real[PATH_MAX];
    const char *scene = ck->input->path;
    const char *around = arena_format(ck->arena, "%.*s", (int)folder_length(scene), scene);
    if (!realpath(*around ? around : ".", folder) || !realpath(path, real))
        return true; /* is missing: reported so */
    const size_t length = strlen(folder);
    if (strncmp(folder, real, length) == 0 && (real[length] == '/' || length == 1)) return true;
    struct diagnostic *d =
        diag_error(ck->diag, node->span, "include-outside", "`%s` is not in the folder of the scene",
                   short_text(ck, node_resolve(node)->text));
    diag_help(ck->diag, d, "without `--untrusted` it may be included");
    return false;
}

/* ---- Reading ---- */

/* A file that is included, as it was when it was first asked for. */
struct included {
    uint64_t device, inode;
    const struct source *source; /* NULL: not read yet */
};

/* NULL: reported. */
static struct included *find_file(struct checker *ck, const struct node *node, const char *path) {
    struct lang_files *files = ck->input->files;
    struct included *file = table_find(&files->included, path);
    struct stat status;
    if (file) return file;
    if (!is_allowed(ck, node, path)) return NULL;
    errno = 0;
    if (stat(path, &status) != 0 || !S_ISREG(status.st_mode)) { /* a pipe might never end, nor begin */
        if (!errno) errno = S_ISDIR(status.st_mode) ? EISDIR : EINVAL;
        report_missing(ck, node, path);
        return NULL;
    }
    file = arena_alloc(files->arena, sizeof *file);
    *file = (struct included){.device = (uint64_t)status.st_dev, .inode = (uint64_t)status.st_ino};
    table_put(files->arena, &files->included, arena_text(files->arena, path, strlen(path)), file);
    return file;
}

static struct unit *find_unit(const struct checker *ck, const struct included *file) {
    struct unit *u = ck->units;
    while (u && !(u->device == file->device && u->inode == file->inode && u->inode)) u = u->next;
    return u;
}

static bool is_around(const struct unit *unit, const struct unit *wanted) {
    while (unit && unit != wanted) unit = unit->includer;
    return unit != NULL;
}

static struct unit *read_unit(struct checker *ck, const struct unit *includer, const struct node *node,
                              const char *path, struct included *file) {
    struct arena *arena = &ck->memory->kept;
    if (!file->source)
        file->source = file_read(ck->input->files->arena, ck->diag, path, ck->input->limits.file_bytes);
    const struct source *source = file->source;
    if (!source) return NULL;
    struct unit *unit = arena_alloc(arena, sizeof *unit);
    *unit = (struct unit){.source = source,
                          .path = path,
                          .includer = includer,
                          .include = node->span,
                          .device = file->device,
                          .inode = file->inode,
                          .next = ck->units};
    ck->units = unit;
    const struct node_limits limits = {ck->input->limits.nesting, ck->input->limits.values};
    struct node_problem problem = {0};
    unit->root = node_parse(arena, ck->diag, source, &limits, NULL, &problem);
    if (problem.text) problem_report(ck->diag, &problem);
    return unit->root ? unit : NULL;
}

static void include_file(struct checker *ck, const struct unit *unit, const struct node *node) {
    const struct node *n = node_resolve(node);
    if (n->kind != NODE_SCALAR || n->count == 0) {
        diag_error(ck->diag, node->span, "not-a-text", "`include`: expected a path, found %s",
                   found_text(ck, node));
        return;
    }
    const char *path = path_from(ck, unit, n->text);
    struct included *file = find_file(ck, node, path);
    if (!file) {
        lose_names(ck);
        return;
    }
    const struct unit *known = find_unit(ck, file);
    if (known && is_around(unit, known)) report_cycle(ck, unit, known, node);
    if (known || !place_descend(ck, node->span)) return;
    struct unit *included = read_unit(ck, unit, node, path, file);
    if (included && included->root->kind == NODE_MAPPING)
        define_names(ck, included);
    else
        lose_names(ck);
    if (included && included->root->kind != NODE_MAPPING) report_no_definitions(ck, included);
    ck->depth--;
}

void include_files(struct checker *ck, const struct unit *unit, const struct node *value) {
    const struct node *n = node_resolve(value);
    if (n->kind != NODE_SEQUENCE) {
        include_file(ck, unit, value);
        return;
    }
    for (const struct node *item = n->first; item; item = item->next) include_file(ck, unit, item);
}
