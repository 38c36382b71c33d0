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
    bool quoted;               /* a scalar in quotes or a block scalar */
    bool merged;               /* a key that a merge key brought here */
    uint32_t count;            /* scalar: bytes of text; sequence: items; mapping: pairs */
    uint32_t anchor;           /* of a node that an anchor names: its number, from 1; else 0 */
    union {
        const char *text;      /* scalar: zero-terminated */
        struct node *first;    /* sequence, mapping: the first child or NULL */
        struct node *target;   /* alias: the anchored node, never an alias itself */
    };
    struct node *next; /* sibling */
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
    const char *text, *context; /* its words, static; text NULL: there is none */
    struct span at, context_at; /* where it stopped; where what it was reading begins */
    struct span quoted_at, quoted_end; /* of the last text in quotes before; source NULL: none */
};

/* Parses the only document of `source`. NULL when it is empty or breaks a limit, which is reported to
 * `diag`, or not YAML, which is left to *problem (zeroed before by the caller) and not reported. */
struct node *node_parse(struct arena *arena, struct diagnostics *diag, const struct source *source,
                        const struct node_limits *limits, struct node_problem *problem);

#endif
