#include "cli/golden_places.h"

#include <stdlib.h>
#include <string.h>

#include "cli/say.h"
#include "cli/scene_path.h"

void golden_places_add(struct golden_places *places, const char *folder) {
    places->folders = realloc(places->folders, (places->count + 1) * sizeof *places->folders);
    if (!places->folders) {
        say_error("out of memory");
        exit(STATUS_TROUBLE);
    }
    places->folders[places->count++] = say_text("%s", folder);
}

void golden_places_free(struct golden_places *places) {
    for (size_t i = 0; i < places->count; i++) free(places->folders[i]);
    free(places->folders);
    free(places->root);
    matches_free(&places->others);
    *places = (struct golden_places){0};
}

/* In the folder, or, with `above`, in any above it. */
static bool is_in(const char *folder, bool above, const char *name, const struct monge_limits *limits) {
    char *real = realpath(folder, NULL);
    bool there = !real || scene_is_in(real, name, limits);
    for (char *slash; above && !there && (slash = strrchr(real, '/'));) {
        *slash = '\0';
        there = scene_is_in(real, name, limits);
    }
    free(real);
    return there;
}

/* ---- Elsewhere ---- */

static bool is_below_any(const struct golden_places *places, const char *path) {
    bool below = false;
    for (size_t i = 0; i < places->count && !below; i++) {
        char *real = realpath(places->folders[i], NULL);
        char *name = real ? scene_name_below(real, path, path) : NULL;
        below = name != NULL;
        free(name);
        free(real);
    }
    return below;
}

static void search(struct golden_places *places) {
    struct matches *others = &places->others;
    places->searched = true;
    *others = matches_find("**/*.[yY]*");
    size_t kept = 0;
    for (size_t i = 0; i < others->count; i++)
        if (scene_extension(others->paths[i]) && !is_below_any(places, others->paths[i]))
            others->paths[kept++] = others->paths[i];
        else
            free(others->paths[i]);
    others->count = kept;
}

/* Whether the path is that of a scene, and ends in the name. */
static bool is_called(const char *path, const char *name, const struct monge_limits *limits) {
    const size_t end = (size_t)(scene_extension(path) - path), length = strlen(name);
    if (end < length || strncmp(path + end - length, name, length) != 0) return false;
    return (end == length || path[end - length - 1] == '/') && scene_kind(path, limits) == MONGE_TEXT_SCENE;
}

static bool is_elsewhere(struct golden_places *places, const char *name, const struct monge_limits *limits) {
    if (!places->searched) search(places);
    for (size_t i = 0; i < places->others.count; i++)
        if (is_called(places->others.paths[i], name, limits)) return true;
    return false;
}

bool golden_places_have(struct golden_places *places, const char *name, const struct monge_limits *limits) {
    if (places->root) return is_in(places->root, false, name, limits);
    bool there = places->count == 0;
    for (size_t i = 0; i < places->count && !there; i++)
        there = is_in(places->folders[i], true, name, limits);
    return there || is_elsewhere(places, name, limits);
}
