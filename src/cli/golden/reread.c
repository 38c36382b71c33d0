/* The results of a run, read again. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/golden/folder.h"
#include "cli/golden/results.h"
#include "cli/say.h"

/* The index of the word, or of `otherwise`. */
static int index_of(const char *const *words, int count, const char *word, int otherwise) {
    for (int i = 0; word && i < count; i++)
        if (strcmp(words[i], word) == 0) return i;
    return otherwise;
}

static char *read_text(const struct monge_value *mapping, const char *key) {
    const char *text = monge_value_text(monge_value_get(mapping, key));
    return text ? say_text("%s", text) : NULL;
}

static bool read_flag(const struct monge_value *mapping, const char *key) {
    const char *text = monge_value_text(monge_value_get(mapping, key));
    return text && strcmp(text, "true") == 0;
}

static void read_hash(const struct monge_value *mapping, const char *key, char hash[MONGE_HASH_SIZE]) {
    const char *text = monge_value_text(monge_value_get(mapping, key));
    if (text && strlen(text) == MONGE_HASH_SIZE - 1 &&
        strspn(text, "0123456789abcdef") == MONGE_HASH_SIZE - 1)
        memcpy(hash, text, MONGE_HASH_SIZE);
}

static uint32_t read_whole(const struct monge_value *value) {
    const char *text = monge_value_text(value);
    return text ? (uint32_t)strtoul(text, NULL, 10) : 0;
}

static void read_stamp(const struct monge_value *value, struct golden_stamp *stamp) {
    const struct monge_value *size = monge_value_first(monge_value_get(value, "size"));
    read_hash(value, "pixels", stamp->pixels);
    read_hash(value, "scene", stamp->scene);
    read_hash(value, "text", stamp->text);
    read_hash(value, "program", stamp->program);
    for (int i = 0; i < GOLDEN_LAYERS; i++)
        read_hash(value, monge_layer_name(GOLDEN_LAYER[i]), stamp->layers[i]);
    stamp->width = read_whole(size);
    stamp->height = size ? read_whole(monge_value_next(size)) : 0;
    stamp->bits = read_whole(monge_value_get(value, "bits"));
    stamp->options = read_text(value, "options");
}

static void read_case(const struct monge_value *value, struct golden_case *c) {
    const char *kind = monge_value_text(monge_value_get(value, "kind"));
    const char *status = monge_value_text(monge_value_get(value, "status"));
    const struct monge_value *tolerance = monge_value_get(value, "tolerance");
    *c = (struct golden_case){
        .name = read_text(value, "name"),
        .scene = read_text(value, "scene"),
        .scene_name = read_text(value, "scene_name"),
        .rule_options = read_text(value, "rule_options"),
        .kind = (enum monge_golden_kind)index_of(GOLDEN_KIND, 3, kind, MONGE_GOLDEN_PNG),
        .status = (enum golden_status)index_of(GOLDEN_STATUS, GOLDEN_STATUSES, status, GOLDEN_BROKEN),
        .taken = read_flag(value, "taken"),
        .golden_line = read_text(value, "golden_line"),
        .new_path = read_text(monge_value_get(value, "pictures"), "new"),
        .tolerance = {.reason = read_text(tolerance, "reason")},
        .tolerance_text = read_text(tolerance, "text"),
    };
    read_stamp(monge_value_get(value, "stamp"), &c->now);
    read_stamp(monge_value_get(value, "golden_stamp"), &c->old);
    read_hash(value, "golden_file", c->golden_file);
}

static void read_places(const struct monge_value *root, struct golden_places *places) {
    places->root = read_text(root, "root");
    for (const struct monge_value *v = monge_value_first(monge_value_get(root, "folders")); v;
         v = monge_value_next(v))
        if (monge_value_text(v)) golden_places_add(places, monge_value_text(v));
}

static int compare_cases(const void *a, const void *b) {
    return strcmp(((const struct golden_case *)a)->name, ((const struct golden_case *)b)->name);
}

static bool read_cases(struct golden_results *results, const struct monge_value *list) {
    size_t count = 0;
    for (const struct monge_value *v = monge_value_first(list); v; v = monge_value_next(v)) count++;
    results->cases = calloc(count + 1, sizeof *results->cases);
    if (!results->cases) say_no_memory();
    for (const struct monge_value *v = monge_value_first(list); v; v = monge_value_next(v)) {
        read_case(v, &results->cases[results->count++]);
        if (!results->cases[results->count - 1].name) return false;
    }
    if (count > 0) qsort(results->cases, count, sizeof *results->cases, compare_cases);
    return true;
}

/* What is no document at all may have been one of ours. */
static enum golden_reading read_document(struct golden_results *results, const char *path,
                                         struct monge_diagnostics *diag) {
    struct monge_document *document = monge_document_read(path, NULL, diag);
    const struct monge_value *root = document ? monge_document_root(document) : NULL;
    const bool others = root && !monge_value_text(root) && !monge_value_get(root, "golden");
    results->folder = read_text(root, "golden");
    results->from = read_text(root, "from");
    results->interrupted = read_whole(monge_value_get(root, "interrupted"));
    read_places(root, &results->places);
    const bool good = results->folder && read_cases(results, monge_value_get(root, "scenes"));
    const bool unread = monge_diagnostics_failures(diag) > 0;
    if (others) say_error("%s: no results of `monge test`", path);
    if (unread) monge_diagnostics_print(diag, say_stream());
    monge_document_free(document);
    return others || unread ? GOLDEN_UNREAD : good ? GOLDEN_READ : GOLDEN_DAMAGED;
}

enum golden_reading golden_results_read(struct golden_results *results, const char *path) {
    *results = (struct golden_results){0};
    if (access(path, F_OK) != 0 && errno == ENOENT) return GOLDEN_READ;
    if (!golden_check_file(path)) return GOLDEN_UNREAD;
    struct monge_diagnostics *diag = monge_diagnostics_new();
    const enum golden_reading reading = diag ? read_document(results, path, diag) : GOLDEN_UNREAD;
    monge_diagnostics_free(diag);
    if (reading == GOLDEN_READ) return reading;
    golden_results_free(results);
    *results = (struct golden_results){0};
    return reading;
}

void golden_results_free(struct golden_results *results) {
    for (size_t i = 0; i < results->count; i++) golden_case_free(&results->cases[i]);
    free(results->cases);
    free(results->folder);
    free(results->from);
    free(results->accept);
    golden_places_free(&results->places);
}

const struct golden_case *golden_results_find(const struct golden_results *results, const char *name) {
    const struct golden_case key = {.name = (char *)name};
    return results->count ? bsearch(&key, results->cases, results->count, sizeof key, compare_cases) : NULL;
}
