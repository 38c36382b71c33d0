/* Memory by lifetime: everything allocated from an arena is freed with it, at once.
 *
 *     head -> [block: used |####......| ] -> [older block] -> ...
 *
 * An allocation never returns NULL. When memory runs out, or the arena would grow past its limit,
 * arena_alloc leaves by longjmp to `on_full`, which the owner has set; without one it aborts. Arenas
 * with a parent count against its limit as well, and leave by its way. */
#ifndef MONGE_BASE_ARENA_H
#define MONGE_BASE_ARENA_H

#include <setjmp.h>
#include <stdalign.h>
#include <stddef.h>

struct arena_block {
    struct arena_block *next;
    size_t used, size; /* bytes of `data` */
    alignas(max_align_t) unsigned char data[];
};

struct arena {
    struct arena_block *head;
    struct arena_block *spare; /* NULL: none */
    size_t total;              /* bytes taken from the system, those of its children too */
    size_t limit;              /* 0: none */
    jmp_buf *on_full;          /* may be NULL */
    struct arena *parent;      /* NULL: none; outlives the arena */
};

/* An empty arena is a zeroed struct arena, with limit and on_full as wanted. */
void *arena_alloc(struct arena *arena, size_t size);               /* zeroed, aligned for any type */
static inline void *arena_room(struct arena *arena, size_t size);  /* the same, not zeroed */
void *arena_array(struct arena *arena, size_t count, size_t size); /* zeroed; count * size may not overflow */
/* `array` of `from` bytes with room for `to`, which is more; what it had stays, what is new is not zeroed. A
 * large one takes no room twice. `array` may be NULL. */
void *arena_resize(struct arena *arena, void *array, size_t from, size_t to);
char *arena_text(struct arena *arena, const char *text, size_t length); /* a copy, with a final zero */
char *arena_format(struct arena *arena, const char *format, ...) __attribute__((format(printf, 2, 3)));
void arena_free(struct arena *arena); /* leaves it empty, ready for use */

/* From now on the way out of the arena, which is its outermost parent's, is `full`; returns the one before. */
jmp_buf *arena_catch(struct arena *arena, jmp_buf *full);

/* A mark to go back to: what was allocated since is freed, but for one block that waits for the next need.
 * Marks nest. */
struct arena_mark {
    struct arena_block *block;
    size_t used;
};
struct arena_mark arena_mark(const struct arena *arena);
void arena_release(struct arena *arena, struct arena_mark mark);

/* ---- Here for speed ---- */

void *arena_room_in_new_block(struct arena *arena, size_t size);

static inline void *arena_room(struct arena *arena, size_t size) {
    const size_t unit = alignof(max_align_t), rounded = (size + unit - 1) / unit * unit;
    struct arena_block *block = arena->head;
    if (!block || rounded < size || block->size - block->used < rounded)
        return arena_room_in_new_block(arena, size);
    void *result = block->data + block->used;
    block->used += rounded;
    return result;
}

#endif
