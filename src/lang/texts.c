#include "lang/texts.h"

#include <stdlib.h>
#include <string.h>

#include "lang/file.h"

static void add_text(struct hash *hash, const char *name, const struct source *source) {
    hash_bytes(hash, name, strlen(name) + 1);
    hash_bulk(hash, source->text, source->size);
}

struct hash texts_hash(const struct lang_result *result) {
    struct hash hash;
    hash_begin(&hash);
    for (uint32_t i = 0; i < result->text_count; i++)
        add_text(&hash, i == 0 ? "" : result->texts[i].path, result->texts[i].source);
    return hash;
}

char *texts_files(const struct lang_result *result) {
    size_t size = 1;
    for (uint32_t i = 1; i < result->text_count; i++) size += strlen(result->texts[i].path) + 1;
    char *text = malloc(size), *at = text;
    if (!text) return NULL;
    for (uint32_t i = 1; i < result->text_count; i++)
        at += sprintf(at, "%s%s", i > 1 ? "\n" : "", result->texts[i].path);
    *at = '\0';
    return text;
}

/* The scene, and then each of the lines. */
static bool add_files(struct arena *arena, const char *scene, const char *files, size_t limit,
                      struct diagnostics *diag, struct hash *hash) {
    const char *slash = strrchr(scene, '/');
    const int folder = slash ? (int)(slash - scene) + 1 : 0;
    const struct source *source = file_read(arena, diag, scene, limit);
    if (source) add_text(hash, "", source);
    for (const char *line = files, *end; source && *line; line = *end ? end + 1 : end) {
        end = strchrnul(line, '\n');
        const char *name = arena_text(arena, line, (size_t)(end - line));
        const char *path = *name == '/' ? name : arena_format(arena, "%.*s%s", folder, scene, name);
        source = file_read(arena, diag, path, limit);
        if (source) add_text(hash, name, source);
    }
    return source != NULL;
}

bool texts_hash_again(const char *path, const char *files, size_t limit, struct diagnostics *diag,
                      struct hash *hash) {
    jmp_buf full;
    struct arena arena = {.on_full = &full};
    volatile bool good = false;
    hash_begin(hash);
    if (setjmp(full) == 0)
        good = add_files(&arena, path, files, limit, diag, hash);
    else
        diag_failure(diag, "out-of-memory", "%s: out of memory", path);
    arena_free(&arena);
    return good;
}
