/* Where the objects of a scene were written, for messages about what has been built of them. Nothing of
 * it changes a pixel.
 *
 *     info     [o0][o0][o0][o1][o2][o1][o2]    a loop places many at one place: they share an origin
 *     origins  [3:5 "pawn"][9:5][10:7]         as do those that come again soon after
 */
#ifndef MONGE_SCENE_ORIGIN_H
#define MONGE_SCENE_ORIGIN_H

#include "base/arena.h"
#include "base/source.h"

#define ORIGIN_NO_TEMPLATE UINT32_MAX
#define ORIGIN_NO_OBJECT                                                                                     \
    UINT32_MAX /* of a primitive: the shape itself; in a geometry, that of the instance */

struct origin {
    const char *name; /* the object's, or that of the innermost group or use around with one; NULL: none */
    uint32_t line, column; /* from 0 */
    uint32_t file : 24;    /* index into origins.files */
    uint32_t kind : 8;     /* of the shape: of grammar_kinds; of a use: KIND_TEMPLATE */
    uint32_t template;     /* index of the innermost template that it stands in, or ORIGIN_NO_TEMPLATE */
};

/* What an author would call an object: the innermost with a name of those in the scene's own list and its groups;
 * else the innermost with a name within templates; else the use that the list has, or the shape, which is not kept
 * here: its origin tells all of it. */
struct object_place {
    const char *name;      /* NULL: none */
    const char *kind;      /* "sphere", "group", "use of leg" */
    uint32_t line, column; /* from 0 */
    uint32_t file;         /* index into origins.files */
};

enum { ORIGINS_RECENT = 256 };

/* Starts zeroed. */
struct origins {
    struct origin *list;
    uint32_t count, room;
    const struct source **files;
    uint32_t file_count, file_room;
    uint32_t recent[ORIGINS_RECENT]; /* by place: an index to look at first */
    struct object_place *objects;    /* one that comes again late may be there twice */
    uint32_t object_count, object_room;
    uint32_t recent_objects[ORIGINS_RECENT];
};

/* The index of an origin like this one, added where there was none lately; its `file` is set from the
 * span's source here. The name is copied. */
uint32_t origins_add(struct origins *origins, struct arena *arena, struct span span, struct origin origin);

/* The same for an object. `kind` is "use of" for the template `used`, or a word by itself where that is NULL, then
 * static. */
uint32_t origins_add_object(struct origins *origins, struct arena *arena, struct span span, const char *name,
                            const char *kind, const char *used);

/* The index of the source, added where it is new. */
uint32_t origins_file(struct origins *origins, struct arena *arena, const struct source *source);

/* Puts copies in the arena in the place of the sources, with their texts as long as those are small
 * together: from then on spans made of origins outlive the load. */
void origins_keep(struct origins *origins, struct arena *arena);

/* The first character of the object. */
struct span origins_span(const struct origins *origins, uint32_t index);

#endif
