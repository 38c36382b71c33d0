#include "base/arena.h"

#include <stdalign.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef MONGE_HOSTILE
enum { ARENA_BLOCK_SIZE = 64 };
#else
enum { ARENA_BLOCK_SIZE = 64 * 1024 };
#endif

struct arena_block {
    struct arena_block *next;
    size_t used, size; /* bytes of `data` */
    alignas(max_align_t) unsigned char data[];
};

static _Noreturn void arena_full(struct arena *arena) {
    while (arena->parent) arena = arena->parent;
    if (arena->on_full) longjmp(*arena->on_full, 1);
    fputs("out of memory\n", stderr);
    abort();
}

jmp_buf *arena_catch(struct arena *arena, jmp_buf *full) {
    while (arena->parent) arena = arena->parent;
    jmp_buf *before = arena->on_full;
    arena->on_full = full;
    return before;
}

static bool has_room(const struct arena *arena, size_t bytes) {
    for (; arena; arena = arena->parent)
        if (arena->limit && (bytes > arena->limit || arena->total > arena->limit - bytes)) return false;
    return true;
}

static struct arena_block *arena_grow(struct arena *arena, size_t size) {
    const size_t room = size > ARENA_BLOCK_SIZE ? size : ARENA_BLOCK_SIZE;
    if (room > SIZE_MAX - sizeof(struct arena_block)) arena_full(arena);
    const size_t bytes = sizeof(struct arena_block) + room;
    struct arena_block *block = has_room(arena, bytes) ? malloc(bytes) : NULL;
    if (!block) arena_full(arena);
    *block = (struct arena_block){.next = arena->head, .size = room};
    arena->head = block;
    for (struct arena *a = arena; a; a = a->parent) a->total += bytes;
    return block;
}

void *arena_room(struct arena *arena, size_t size) {
    const size_t unit = alignof(max_align_t);
    if (size > SIZE_MAX - unit) arena_full(arena);
    const size_t rounded = (size + unit - 1) / unit * unit;
    struct arena_block *block = arena->head;
    if (!block || block->size - block->used < rounded) block = arena_grow(arena, rounded);
    void *result = block->data + block->used;
    block->used += rounded;
    return result;
}

void *arena_alloc(struct arena *arena, size_t size) { return memset(arena_room(arena, size), 0, size); }

void *arena_array(struct arena *arena, size_t count, size_t size) {
    if (size && count > SIZE_MAX / size) arena_full(arena);
    return arena_alloc(arena, count * size);
}

/* The link to the block that holds `array` alone; NULL: it shares its block. */
static struct arena_block **own_block(struct arena *arena, const void *array, size_t size) {
    if (!array || size <= ARENA_BLOCK_SIZE) return NULL;
    struct arena_block **link = &arena->head;
    while (*link && (*link)->data != array) link = &(*link)->next;
    return *link && (*link)->used == (*link)->size ? link : NULL;
}

void *arena_resize(struct arena *arena, void *array, size_t from, size_t to) {
    const size_t unit = alignof(max_align_t), rounded = (to + unit - 1) / unit * unit;
    struct arena_block **link = own_block(arena, array, from);
    if (!link) {
        void *larger = arena_alloc(arena, to);
        return from ? memcpy(larger, array, from) : larger;
    }
    const size_t more = rounded - (*link)->size;
    struct arena_block *block = has_room(arena, more) ? realloc(*link, sizeof *block + rounded) : NULL;
    if (!block) arena_full(arena);
    *link = block;
    block->used = block->size = rounded;
    for (struct arena *a = arena; a; a = a->parent) a->total += more;
    return block->data;
}

char *arena_text(struct arena *arena, const char *text, size_t length) {
    char *copy = arena_alloc(arena, length + 1);
    if (length) memcpy(copy, text, length);
    return copy;
}

char *arena_format(struct arena *arena, const char *format, ...) {
    va_list args, again;
    va_start(args, format);
    va_copy(again, args);
    const int length = vsnprintf(NULL, 0, format, args);
    char *text = arena_alloc(arena, (size_t)length + 1);
    vsnprintf(text, (size_t)length + 1, format, again);
    va_end(again);
    va_end(args);
    return text;
}

struct arena_mark arena_mark(const struct arena *arena) {
    return (struct arena_mark){arena->head, arena->head ? arena->head->used : 0};
}

void arena_release(struct arena *arena, struct arena_mark mark) {
    while (arena->head != mark.block) {
        struct arena_block *block = arena->head;
        arena->head = block->next;
        for (struct arena *a = arena; a; a = a->parent) a->total -= sizeof *block + block->size;
        free(block);
    }
    if (arena->head) arena->head->used = mark.used;
}

void arena_free(struct arena *arena) { arena_release(arena, (struct arena_mark){NULL, 0}); }
