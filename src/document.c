/* The library's face: documents as they stand. A monge_value is a node. */
#include <stdlib.h>
#include <string.h>

#include "face.h"
#include "lang/file.h"
#include "lang/node.h"
#include "lang/problem.h"

struct monge_document {
    struct arena arena;
    const struct node *root;
};

static const struct node *read_document(struct arena *arena, struct diagnostics *diag, const char *path,
                                        const struct monge_limits *limits) {
    const struct node_limits within = {(unsigned)limits->nesting, limits->values};
    struct node_problem problem = {0};
    const struct source *source = file_read(arena, diag, path, limits->file_bytes);
    const struct node *root = source ? node_parse(arena, diag, source, &within, NULL, &problem) : NULL;
    if (problem.text) problem_report(diag, &problem);
    return root;
}

struct monge_document *monge_document_read(const char *path, const struct monge_limits *given,
                                           struct monge_diagnostics *diag) {
    const struct monge_limits limits = face_limits(given);
    struct monge_document *document = calloc(1, sizeof *document);
    jmp_buf full;
    diag_begin(&diag->list);
    if (document) document->arena = (struct arena){.limit = limits.memory_bytes, .on_full = &full};
    if (document && setjmp(full) == 0)
        document->root = read_document(&document->arena, &diag->list, path, &limits);
    else
        face_report_full(&diag->list, path, limits.memory_bytes);
    if (document && document->root) return document;
    monge_document_free(document);
    return NULL;
}

void monge_document_free(struct monge_document *document) {
    if (document) arena_free(&document->arena);
    free(document);
}

static const struct node *node_of(const struct monge_value *value) {
    return value ? node_resolve((const struct node *)value) : NULL;
}

static const struct monge_value *value_of(const struct node *node) {
    return (const struct monge_value *)node;
}

const struct monge_value *monge_document_root(const struct monge_document *document) {
    return value_of(document->root);
}

const struct monge_value *monge_value_get(const struct monge_value *mapping, const char *key) {
    const struct node *node = node_of(mapping);
    return node && node->kind == NODE_MAPPING ? value_of(node_get(node, key)) : NULL;
}

const struct monge_value *monge_value_first(const struct monge_value *list) {
    const struct node *node = node_of(list);
    return node && node->kind == NODE_SEQUENCE ? value_of(node->first) : NULL;
}

const struct monge_value *monge_value_next(const struct monge_value *item) {
    return value_of(((const struct node *)item)->next);
}

const char *monge_value_text(const struct monge_value *value) {
    const struct node *node = node_of(value);
    return node && node->kind == NODE_SCALAR && (node->quoted || !node_is_null(node)) ? node->text : NULL;
}
