/* A YAML file as a tree of nodes with spans, before any of it is given a meaning.
 *
 *     mapping -> key scalar -> value -> key scalar -> value     children linked by `next`;
 *     sequence -> item -> item -> item                          a mapping's are keys and values in turn
 *
 * An alias is the anchored node itself, shared: the tree is a graph without cycles. Merge keys (<<)
 * are already merged. Everything belongs to the arena of the load. */
#ifndef MONGE_LANG_NODE_H
#define MONGE_LANG_NODE_H

#include "base/diag.h"

enum node_kind { NODE_SCALAR, NODE_SEQUENCE, NODE_MAPPING, NODE_ALIAS };

struct node {
    struct span span; /* a scalar's text; a collection's first character */
    enum node_kind kind;
    bool quoted;     /* a scalar in quotes or a block scalar */
    bool merged;     /* a key that a merge key brought here */
    bool passing;    /* of an item that is handed over while the file is read, see node_stream */
    bool rehearsed;  /* lang/: what stands here has been checked without values */
    uint32_t count;  /* scalar: bytes of text; sequence: items; mapping: pairs */
    uint32_t anchor; /* of a node that an anchor names: its number, from 1; else 0 */
    union {
        const char *text;    /* scalar: zero-terminated */
        struct node *first;  /* sequence, mapping: the first child or NULL */
        struct node *target; /* alias: the anchored node, never an alias itself */
    };
    struct node *next; /* sibling */
    struct expr *expr; /* lang/: of a scalar that was parsed as an expression; else NULL */
};

/* What stands for the node: an alias's target, else the node itself. */
static inline const struct node *node_resolve(const struct node *node) {
    return node->kind == NODE_ALIAS ? node->target : node;
}

/* Whether the node is a plain scalar without text, `~` or `null`: a key with no value. */
bool node_is_null(const struct node *node);

struct node_limits {
    unsigned nesting; /* collections within each other */
    size_t nodes;     /* in one file, those behind aliases each time */
};

/* What libyaml says of a text that is not YAML. */
struct node_problem {
    const char *text, *context;        /* its words, static; text NULL: there is none */
    struct span at, context_at;        /* where it stopped; where what it was reading begins */
    struct span quoted_at, quoted_end; /* of the last text in quotes before; source NULL: none */
};

/* Hands over the items of the list under one key of the root mapping as soon as they are read, so that
 * a long list need never be in memory as a whole. */
struct node_stream {
    void *context;
    const char *key;
    void (*begin)(void *context, struct node *root); /* before the first: the pairs of the root so far */
    bool (*item)(void *context,
                 struct node *item); /* true: the item is forgotten; else it stays in its list */
};

/* The value of that key in a mapping, or NULL. */
struct node *node_get(const struct node *mapping, const char *key);

/* Parses the only document of `source`. NULL when it is empty or breaks a limit, which is reported to
 * `diag`, or not YAML, which is left to *problem (zeroed before by the caller) and not reported.
 * stream may be NULL. */
struct node *node_parse(struct arena *arena, struct diagnostics *diag, const struct source *source,
                        const struct node_limits *limits, const struct node_stream *stream,
                        struct node_problem *problem);

#endif
