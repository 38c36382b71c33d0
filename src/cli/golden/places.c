#include "cli/golden/places.h"

#include <stdlib.h>
#include <string.h>

#include "cli/say.h"
#include "cli/scene_path.h"

struct golden_place {
    char *folder; /* owned; "" is the root of the machine */
    struct scene_folder last;
};

void golden_places_add(struct golden_places *places, const char *folder) {
    places->folders = realloc(places->folders, (places->count + 1) * sizeof *places->folders);
    if (!places->folders) say_no_memory();
    places->folders[places->count++] = say_text("%s", folder);
}

void golden_places_free(struct golden_places *places) {
    for (size_t i = 0; i < places->count; i++) free(places->folders[i]);
    for (size_t i = 0; i < places->all_count; i++) {
        free(places->all[i].folder);
        scene_folder_free(&places->all[i].last);
    }
    free(places->all);
    free(places->folders);
    free(places->root);
    matches_free(&places->others);
    *places = (struct golden_places){0};
}

/* ---- The places ---- */

static void add_place(struct golden_places *places, const char *folder) {
    places->all = realloc(places->all, (places->all_count + 1) * sizeof *places->all);
    if (!places->all) say_no_memory();
    places->all[places->all_count++] = (struct golden_place){.folder = say_text("%s", folder)};
}

/* The folder, and, with `above`, all above it. */
static void add_folder(struct golden_places *places, const char *folder, bool above) {
    char *real = realpath(folder, NULL);
    places->unknown |= !real;
    if (real) add_place(places, strcmp(real, "/") == 0 ? "" : real);
    for (char *slash; real && above && (slash = strrchr(real, '/'));) {
        *slash = '\0';
        add_place(places, real);
    }
    free(real);
}

static void find_all(struct golden_places *places) {
    if (places->all_count > 0 || places->unknown) return;
    if (places->root) add_folder(places, places->root, false);
    for (size_t i = 0; i < places->count && !places->root; i++) add_folder(places, places->folders[i], true);
}

static bool is_in(struct golden_place *place, const char *name, const struct monge_limits *limits) {
    char *path = say_text("%s/%s", place->folder, name);
    const bool there = scene_is_there(path, &place->last, limits);
    free(path);
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
    find_all(places);
    bool there = places->unknown || places->all_count == 0;
    for (size_t i = 0; i < places->all_count && !there; i++) there = is_in(&places->all[i], name, limits);
    return there || (!places->root && is_elsewhere(places, name, limits));
}
