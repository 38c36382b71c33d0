#include "cli/golden/claims.h"

#include <stdlib.h>
#include <string.h>

#include "cli/aov.h"
#include "cli/say.h"

struct golden_claim {
    char *file; /* owned: below the folder of the goldens */
    const char *scene;
    size_t order; /* as it was added */
};

static void add(struct golden_claims *claims, char *file, const char *scene) {
    claims->all = realloc(claims->all, (claims->count + 1) * sizeof *claims->all);
    if (!claims->all) say_no_memory();
    claims->all[claims->count] = (struct golden_claim){file, scene, claims->count};
    claims->count++;
}

void golden_claims_begin(struct golden_claims *claims) {
    *claims = (struct golden_claims){0};
    add(claims, say_text("golden.lock"), "monge test");
}

void golden_claims_add(struct golden_claims *claims, const char *name, bool passes, const char *scene) {
    char *picture = say_text("%s.png", name);
    for (enum monge_layer layer = 0; passes && layer < MONGE_LAYERS; layer++)
        add(claims, aov_path(layer, picture), scene);
    add(claims, picture, scene);
}

static int compare_files(const void *a, const void *b) {
    return strcmp(((const struct golden_claim *)a)->file, ((const struct golden_claim *)b)->file);
}

static int compare_claims(const void *a, const void *b) {
    const struct golden_claim *p = a, *q = b;
    const int order = compare_files(p, q);
    return order ? order : p->order < q->order ? -1 : p->order > q->order;
}

static const struct golden_claim *find(const struct golden_claims *claims, char *file) {
    const struct golden_claim key = {.file = file};
    return bsearch(&key, claims->all, claims->count, sizeof key, compare_files);
}

/* Whether no folder on the way to the file is a file itself. */
static bool has_folders(const struct golden_claims *claims, const struct golden_claim *claim) {
    char *path = say_text("%s", claim->file);
    bool good = true;
    for (char *slash = strchr(path, '/'); good && slash; slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        const struct golden_claim *other = find(claims, path);
        good = !other;
        if (other)
            say_error("%s writes %s, which is a folder of what %s writes, %s: rename one of them",
                      other->scene, path, claim->scene, claim->file);
        *slash = '/';
    }
    free(path);
    return good;
}

bool golden_claims_check(struct golden_claims *claims) {
    if (claims->count > 1) qsort(claims->all, claims->count, sizeof *claims->all, compare_claims);
    bool good = true;
    for (size_t i = 0; good && i < claims->count; i++) {
        const struct golden_claim *claim = &claims->all[i], *next = claim + 1;
        good = i + 1 == claims->count || compare_files(claim, next) != 0;
        if (!good)
            say_error("%s and %s would both write %s: rename one of them", claim->scene, next->scene,
                      claim->file);
        good = good && has_folders(claims, claim);
    }
    return good;
}

void golden_claims_free(struct golden_claims *claims) {
    for (size_t i = 0; i < claims->count; i++) free(claims->all[i].file);
    free(claims->all);
}
