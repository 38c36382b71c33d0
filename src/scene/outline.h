/* The tree of a scene as it was evaluated, for people: a sink that notes what it passes on.
 *
 *     group `tower` x9 for i       what stands at one place within its parent is one node, however often it
 *       box x9                     was placed
 *       use leg x36 (height = 2)   of a template the members are those of its first use
 */
#ifndef MONGE_SCENE_OUTLINE_H
#define MONGE_SCENE_OUTLINE_H

#include "lang/lang.h"

enum {
    OUTLINE_LISTED = 20, /* members of a node that are kept; the others are counted */
    OUTLINE_NODES = 1000,
};

struct outline_node {
    const char *what; /* "sphere", "group"; of a use the template's name */
    bool is_use;
    const char *name;            /* the object's; NULL: none */
    const char *loop;            /* the variables of its `for`, "i, j"; NULL: none */
    const char *with, *material; /* what the first use was given; the name of the material; NULL: none */
    bool varies;                 /* other uses were given other values */
    const char *file;
    uint32_t line, column; /* from 1 */
    uint64_t count;        /* how often it was placed */
    uint64_t more;         /* members that are not listed */
    uint32_t listed;
    struct outline_node *first, *last, *next, *outer;
    struct hash contents; /* of the first use */
    bool known;           /* whether it has that hash */
};

struct outline {
    struct outline_node root; /* the scene; its members are what there is */
    struct arena *arena;
    struct diagnostics *diag;
    struct lang_sink sink; /* that everything is passed on to */
    struct outline_node *at;
    unsigned unlisted; /* levels that are open and not noted */
    unsigned nodes;
    struct outline_node marked;
};

/* An outline in the arena, and *sink becomes one that notes and passes on to what it was. */
struct outline *outline_begin(struct arena *arena, struct diagnostics *diag, struct lang_sink *sink);

#endif
