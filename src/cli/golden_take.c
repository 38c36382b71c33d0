#include "cli/golden_take.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/aov.h"
#include "cli/golden_folder.h"
#include "cli/say.h"

bool golden_can_take(const struct golden_case *c) {
    return c->new_path &&
           (c->status == GOLDEN_CHANGED || c->status == GOLDEN_NEW || c->status == GOLDEN_MISSING);
}

/* The layers of the picture come along; those of the old one go. */
static bool take_layers(const char *folder, const char *from, const char *to) {
    bool good = true;
    for (enum monge_layer layer = 0; good && layer < MONGE_LAYERS; layer++) {
        char *new = aov_path(layer, from), *old = aov_path(layer, to);
        good = golden_check_inside(folder, old) &&
               (golden_is_file(new) ? golden_copy(new, old) : golden_remove(folder, old));
        free(new);
        free(old);
    }
    return good;
}

/* The picture last: while it is the old one, the case still fails. */
static bool take_picture(const char *folder, const struct golden_case *c) {
    char *to = golden_path(folder, c->name, ".png");
    const bool good = golden_check_inside(folder, to) && golden_make_folders(to) &&
                      take_layers(folder, c->new_path, to) && golden_copy(c->new_path, to);
    free(to);
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
    bool good = true;
    golden_lock_remove(lock, c->name);
    if (!c->golden_path) return true;
    for (enum monge_layer layer = 0; good && layer < MONGE_LAYERS; layer++) {
        char *path = aov_path(layer, c->golden_path);
        good = golden_remove(folder, path);
        free(path);
    }
    return good && golden_remove(folder, c->golden_path);
}
