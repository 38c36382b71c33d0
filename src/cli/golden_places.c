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
    *places = (struct golden_places){0};
}

/* In the folder, or in any above it. */
static bool is_in_or_above(const char *folder, const char *name, const struct monge_limits *limits) {
    char *real = realpath(folder, NULL);
    bool there = !real || scene_is_in(real, name, limits);
    for (char *slash; !there && (slash = strrchr(real, '/'));) {
        *slash = '\0';
        there = scene_is_in(real, name, limits);
    }
    free(real);
    return there;
}

bool golden_places_have(const struct golden_places *places, const char *name,
                        const struct monge_limits *limits) {
    if (places->root) {
        char *real = realpath(places->root, NULL);
        const bool there = !real || scene_is_in(real, name, limits);
        free(real);
        return there;
    }
    bool there = places->count == 0;
    for (size_t i = 0; i < places->count && !there; i++)
        there = is_in_or_above(places->folders[i], name, limits);
    return there;
}
