/* The library's face: texts of scenes, imported and formatted. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "face.h"
#include "image/replace.h"
#include "lang/file.h"
#include "lang/format.h"
#include "lang/import.h"
#include "lang/node.h"
#include "lang/spelling.h"

static bool write_text(const char *text, size_t size, const char *path, struct diagnostics *diag) {
    struct replacement file;
    if (replace_begin(&file, path)) {
        const bool good = fwrite(text, 1, size, file.stream) == size;
        if (replace_end(&file, good)) return true;
    }
    diag_failure(diag, "cannot-write", "cannot write %s: %s",
                 strcmp(path, "-") == 0 ? "standard output" : path, strerror(errno));
    return false;
}

/* ---- Importing ---- */

static bool import_text(struct arena *arena, const char *path, const char *out_path,
                        const struct monge_limits *limits, struct diagnostics *diag) {
    const struct lang_limits within = face_lang_limits(limits);
    const struct source *source = file_read(arena, diag, path, limits->file_bytes);
    const char *text = source ? lang_import(arena, diag, source, &within) : NULL;
    return text && write_text(text, strlen(text), out_path, diag);
}

bool monge_import(const char *path, const char *out_path, const struct monge_limits *given,
                  struct monge_diagnostics *diag) {
    const struct monge_limits limits = face_limits(given);
    jmp_buf full;
    struct arena arena = {.limit = limits.memory_bytes, .on_full = &full};
    volatile bool done = false;
    if (setjmp(full) == 0) {
        done = import_text(&arena, path, out_path, &limits, &diag->list);
    } else {
        face_report_full(&diag->list, path, limits.memory_bytes);
    }
    arena_free(&arena);
    return done;
}

/* ---- Formatting ---- */

void monge_text_free(struct monge_text *text) {
    free(text->bytes);
    *text = (struct monge_text){NULL, 0};
}

/* Reads `path`, or formats `given` where there is no path; the result is in the arena, NULL reported. */
static const char *read_or_format(struct arena *arena, struct diagnostics *diag,
                                  const struct monge_limits *limits, const char *path, const char *name,
                                  const struct monge_text *given, size_t *size) {
    if (!path) {
        const struct lang_limits within = face_lang_limits(limits);
        return format_text(arena, diag, file_from_memory(arena, name, given->bytes, given->size), &within,
                           size);
    }
    const struct source *source = file_read_bytes(arena, diag, path, limits->file_bytes);
    *size = source ? source->size : 0;
    return source ? source->text : NULL;
}

/* The same as a text of its own. */
static bool make_text(struct diagnostics *diag, const struct monge_limits *given_limits, const char *path,
                      const char *name, const struct monge_text *given, struct monge_text *made) {
    const struct monge_limits limits = face_limits(given_limits);
    struct arena arena = {.limit = limits.memory_bytes};
    jmp_buf full;
    size_t size = 0;
    *made = (struct monge_text){NULL, 0};
    arena.on_full = &full;
    if (setjmp(full) == 0) {
        const char *text = read_or_format(&arena, diag, &limits, path, name, given, &size);
        if (text) *made = (struct monge_text){malloc(size + 1), size};
        if (made->bytes) ((char *)memcpy(made->bytes, text, size))[size] = '\0';
        if (text && !made->bytes) diag_failure(diag, "out-of-memory", "%s: out of memory", name);
    } else {
        face_report_full(diag, name, limits.memory_bytes);
    }
    arena_free(&arena);
    return made->bytes != NULL;
}

bool monge_text_read(const char *path, const struct monge_limits *limits, struct monge_text *text,
                     struct monge_diagnostics *diag) {
    return make_text(&diag->list, limits, path, path, NULL, text);
}

bool monge_format(const char *name, const struct monge_text *text, const struct monge_limits *limits,
                  struct monge_text *formatted, struct monge_diagnostics *diag) {
    return make_text(&diag->list, limits, NULL, name, text, formatted);
}

bool monge_text_write(const char *path, const struct monge_text *text, struct monge_diagnostics *diag) {
    return write_text(text->bytes, text->size, path, &diag->list);
}

/* ---- What a text is ---- */

static bool forget(void *context, struct node *item) {
    (void)context, (void)item;
    return true;
}

static void ignore(void *context, struct node *root) { (void)context, (void)root; }

static bool is_nearly_scene(const char *key) {
    struct spelling spelling = spelling_begin(key);
    spelling_offer(&spelling, "scene");
    return spelling.best;
}

static enum monge_text_kind kind_of(const struct node *root) {
    if (root->kind != NODE_MAPPING || root->count == 0) return MONGE_TEXT_OTHER;
    if (node_get(root, "scene")) return MONGE_TEXT_SCENE;
    uint32_t known = 0;
    for (const struct node *key = root->first; key; key = key->next->next) {
        if (key->kind != NODE_SCALAR) continue;
        known += grammar_find_key(&grammar_kinds[KIND_FILE], key->text) >= 0;
        if (is_nearly_scene(key->text)) return MONGE_TEXT_SCENE;
    }
    return known == root->count ? MONGE_TEXT_DEFINITIONS : known > 0 ? MONGE_TEXT_SCENE : MONGE_TEXT_OTHER;
}

static enum monge_text_kind parse_kind(struct arena *arena, struct diagnostics *diag,
                                       const struct monge_text *text, const struct monge_limits *given) {
    const struct node_stream stream = {.key = "scene", .begin = ignore, .item = forget};
    const struct monge_limits limits = face_limits(given);
    const struct node_limits node_limits = {(unsigned)limits.nesting, limits.values};
    struct node_problem problem = {0};
    arena->limit = limits.memory_bytes;
    const struct source *source = file_from_memory(arena, "", text->bytes, text->size);
    const struct node *root = node_parse(arena, diag, source, &node_limits, &stream, &problem);
    if (root) return kind_of(root);
    const bool empty = diag->first && strcmp(diag->first->code, "empty-file") == 0;
    return empty ? MONGE_TEXT_EMPTY : MONGE_TEXT_SCENE;
}

enum monge_text_kind monge_text_kind(const struct monge_text *text, const struct monge_limits *limits) {
    struct diagnostics diag = {0};
    jmp_buf full;
    struct arena arena = {.on_full = &full};
    volatile enum monge_text_kind kind = MONGE_TEXT_SCENE;
    if (setjmp(full) == 0) kind = parse_kind(&arena, &diag, text, limits);
    arena_free(&arena);
    diag_free(&diag);
    return kind;
}
