/* A hash table from names to pointers, in an arena. It starts as a zeroed struct. Open addressing:
 *
 *     slots  [ - | gold | - | jade | chrome | - | - | - ]   capacity a power of two, at most 3/4 full
 */
#ifndef MONGE_BASE_TABLE_H
#define MONGE_BASE_TABLE_H

#include "base/arena.h"

struct table_slot {
    const char *name; /* NULL: free */
    void *value;
};

struct table {
    struct table_slot *slots;
    size_t count, capacity;
};

/* The value under the name, or NULL. */
void *table_find(const struct table *table, const char *name);

/* Puts the value (not NULL) under the name, in place of one that is there. The name is not copied. */
void table_put(struct arena *arena, struct table *table, const char *name, void *value);

#endif
