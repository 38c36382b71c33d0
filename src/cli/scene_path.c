#include "cli/scene_path.h"

#include <ctype.h>
#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

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

/* The extension with those letters as capitals that `capitals` has a bit for. */
static bool is_there_as(char *path, size_t length, unsigned capitals, const struct monge_limits *limits) {
    for (unsigned i = 0; path[length + i]; i++) {
        const int c = path[length + i];
        path[length + i] = (char)(capitals >> i & 1 ? toupper(c) : tolower(c));
    }
    return is_scene(path, limits);
}

bool scene_is_in(const char *folder, const char *name, const struct monge_limits *limits) {
    static const char *const extensions[] = {"yaml", "yml"};
    bool there = false;
    for (int i = 0; i < 2 && !there; i++) {
        char *path = say_text("%s/%s.%s", folder, name, extensions[i]);
        const size_t letters = strlen(extensions[i]), length = strlen(path) - letters;
        for (unsigned capitals = 0; capitals < 1u << letters && !there; capitals++)
            there = is_there_as(path, length, capitals, limits);
        free(path);
    }
    return there;
}
