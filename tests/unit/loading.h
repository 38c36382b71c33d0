/* Scenes from texts, for tests of what comes out of lang/ and scene/. */
#ifndef MONGE_TESTS_LOADING_H
#define MONGE_TESTS_LOADING_H

#include <string.h>

#include "lang/file.h"
#include "lang/lang.h"
#include "lang/node.h"
#include "near.h"
#include "scene/scene.h"

struct loaded {
    struct arena arena;
    struct diagnostics diag;
    struct object_value *file; /* NULL: no scene */
    struct scene scene;
    bool ok;
};

static const struct lang_limits loading_limits = {100, 1000000};

static inline void load_text(struct loaded *l, const char *text) {
    *l = (struct loaded){0};
    const struct source *source = file_from_memory(&l->arena, "t", text, strlen(text));
    l->file = lang_read(&l->arena, &l->diag, source, &loading_limits);
    l->ok = l->file && scene_build(&l->arena, &l->diag, l->file, &l->scene) && l->diag.errors == 0;
}

/* The same of a text that must be right. */
static inline void load_good(struct loaded *l, const char *text) {
    load_text(l, text);
    if (l->ok) return;
    printf("%s\n", text);
    diag_print(&l->diag, stdout);
    fail_msg("the scene should have loaded");
}

static inline void unload(struct loaded *l) {
    arena_free(&l->arena);
    diag_free(&l->diag);
}

#endif
