#include "base/table.h"

#include <stdint.h>
#include <string.h>

/* FNV-1a, 64 bits. */
static uint64_t hash_name(const char *name) {
    uint64_t h = 0xcbf29ce484222325u;
    for (; *name; name++) h = (h ^ (unsigned char)*name) * 0x100000001b3u;
    return h ^ h >> 32;
}

/* The slot that has the name, or the free one where it belongs. */
static struct table_slot *slot_of(const struct table *table, const char *name) {
    size_t i = (size_t)hash_name(name) & (table->capacity - 1);
    while (table->slots[i].name && strcmp(table->slots[i].name, name) != 0)
        i = (i + 1) & (table->capacity - 1);
    return &table->slots[i];
}

void *table_find(const struct table *table, const char *name) {
    return table->capacity ? slot_of(table, name)->value : NULL;
}

static void grow(struct arena *arena, struct table *table) {
    struct table larger = {.count = table->count, .capacity = table->capacity ? 2 * table->capacity : 16};
    larger.slots = arena_array(arena, larger.capacity, sizeof *larger.slots);
    for (size_t i = 0; i < table->capacity; i++)
        if (table->slots[i].name) *slot_of(&larger, table->slots[i].name) = table->slots[i];
    *table = larger;
}

void table_put(struct arena *arena, struct table *table, const char *name, void *value) {
    if (4 * (table->count + 1) > 3 * table->capacity) grow(arena, table);
    struct table_slot *slot = slot_of(table, name);
    if (!slot->name) table->count++;
    *slot = (struct table_slot){name, value};
}
