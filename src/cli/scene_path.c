#include "cli/scene_path.h"

#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "cli/matches.h"
#include "cli/say.h"

/* ---- Names ---- */

const char *scene_extension(const char *path) {
    const char *slash = strrchr(path, '/'), *base = slash ? slash + 1 : path, *dot = strrchr(base, '.');
    const bool yaml = dot && dot > base && (strcasecmp(dot, ".yaml") == 0 || strcasecmp(dot, ".yml") == 0);
    return yaml ? dot : NULL;
}

char *scene_name(const char *path) {
    const char *end = scene_extension(path);
    return say_text("%.*s", (int)(end ? (size_t)(end - path) : strlen(path)), path);
}

char *scene_place(const char *path) {
    char real[PATH_MAX];
    const char *slash = strrchr(path, '/'), *base = slash ? slash + 1 : path;
    char *folder = slash ? say_text("%.*s", (int)(base - path), path) : say_text(".");
    const bool found = realpath(folder, real);
    free(folder);
    if (!found) return NULL;
    return say_text("%s%s%s", real, strcmp(real, "/") == 0 ? "" : "/", base);
}

char *scene_name_below(const char *root, const char *path, const char *otherwise) {
    char *place = scene_place(path);
    if (!place) return say_text("%s", otherwise);
    const size_t length = strcmp(root, "/") == 0 ? 0 : strlen(root);
    const bool below = strncmp(place, root, length) == 0 && place[length] == '/';
    char *name = below ? scene_name(place + length + 1) : NULL;
    free(place);
    return name;
}

/* ---- What is there ---- */

enum monge_text_kind scene_kind(const char *path, const struct monge_limits *limits) {
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_text text = {NULL, 0};
    enum monge_text_kind kind = MONGE_TEXT_SCENE;
    if (diag && monge_text_read(path, limits, &text, diag)) kind = monge_text_kind(&text, limits);
    monge_text_free(&text);
    monge_diagnostics_free(diag);
    return kind;
}

static bool is_scene(const char *path, const struct monge_limits *limits) {
    struct stat status;
    if (stat(path, &status) != 0) return errno != ENOENT && errno != ENOTDIR;
    return S_ISREG(status.st_mode) && scene_kind(path, limits) == MONGE_TEXT_SCENE;
}

void scene_folder_free(struct scene_folder *folder) {
    folder_names_free(folder->names);
    free(folder->path);
    *folder = (struct scene_folder){0};
}

/* The folder is the first `length` bytes of the path. */
static void look_into(struct scene_folder *folder, const char *path, size_t length) {
    if (folder->path && strlen(folder->path) == length && strncmp(folder->path, path, length) == 0) return;
    scene_folder_free(folder);
    folder->path = say_text("%.*s", (int)length, path);
    folder->names = folder_names(folder->path);
    folder->unknown = !folder->names && errno != ENOENT && errno != ENOTDIR;
    while (folder->names && folder->names[folder->count]) folder->count++;
}

/* The first name that is not before `text`. */
static size_t find_from(const struct scene_folder *folder, const char *text) {
    size_t low = 0, high = folder->count;
    while (low < high) {
        const size_t mid = low + (high - low) / 2;
        if (strcmp(folder->names[mid], text) < 0)
            low = mid + 1;
        else
            high = mid;
    }
    return low;
}

bool scene_is_there(const char *path, struct scene_folder *last, const struct monge_limits *limits) {
    const char *slash = strrchr(path, '/'), *base = slash ? slash + 1 : path;
    look_into(last, path, (size_t)(base - path));
    bool there = last->unknown || *base == '.'; /* what is hidden has not been looked at */
    char *start = say_text("%s.", base);
    const size_t length = strlen(start);
    for (size_t i = find_from(last, start); !there && i < last->count; i++) {
        const char *name = last->names[i];
        if (strncmp(name, start, length) != 0) break;
        if (scene_extension(name) != name + length - 1) continue;
        char *file = say_text("%s%s", last->path, name);
        there = is_scene(file, limits);
        free(file);
    }
    free(start);
    return there;
}
