#include "base/arena.h"

#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef MONGE_HOSTILE
enum { ARENA_BLOCK_SIZE = 64, ARENA_SPARES = false }; /* what is used after its release is found */
#else
enum { ARENA_BLOCK_SIZE = 64 * 1024, ARENA_SPARES = true };
#endif

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

static void count_bytes(struct arena *arena, size_t more, size_t less) {
    for (; arena; arena = arena->parent) arena->total += more - less;
}

static void free_block(struct arena *arena, struct arena_block *block) {
    count_bytes(arena, 0, sizeof *block + block->size);
    free(block);
}

static void free_spare(struct arena *arena) {
    if (arena->spare) free_block(arena, arena->spare);
    arena->spare = NULL;
}

static struct arena_block *new_block(struct arena *arena, size_t size) {
    const size_t room = size > ARENA_BLOCK_SIZE ? size : ARENA_BLOCK_SIZE;
    if (room > SIZE_MAX - sizeof(struct arena_block)) arena_full(arena);
    const size_t bytes = sizeof(struct arena_block) + room;
    struct arena_block *block = has_room(arena, bytes) ? malloc(bytes) : NULL;
    if (!block) arena_full(arena);
    *block = (struct arena_block){.size = room};
    count_bytes(arena, bytes, 0);
    return block;
}

void *arena_room_in_new_block(struct arena *arena, size_t size) {
    const size_t unit = alignof(max_align_t);
    if (size > SIZE_MAX - unit) arena_full(arena);
    const size_t rounded = (size + unit - 1) / unit * unit;
    if (arena->spare && arena->spare->size < rounded) free_spare(arena);
    struct arena_block *block = arena->spare ? arena->spare : new_block(arena, rounded);
    arena->spare = NULL;
    block->next = arena->head;
    block->used = rounded;
    arena->head = block;
    return block->data;
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
    count_bytes(arena, more, 0);
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
        if (ARENA_SPARES && !arena->spare && block->size == ARENA_BLOCK_SIZE)
            arena->spare = block;
        else
            free_block(arena, block);
    }
    if (arena->head) arena->head->used = mark.used;
}

void arena_free(struct arena *arena) {
    arena_release(arena, (struct arena_mark){NULL, 0});
    free_spare(arena);
}
