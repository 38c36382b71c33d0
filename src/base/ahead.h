/* A thread of its own that works some pieces ahead of the one that takes them.
 *
 *     fill -> [ 0 | 1 | 2 | 3 ] -> next     slots in turn, each again when what it had is done with
 */
#ifndef MONGE_BASE_AHEAD_H
#define MONGE_BASE_AHEAD_H

#include <stdbool.h>

struct ahead;

/* Calls fill(context, slot) for the slots 0 .. slots-1 round and round in a new thread, each as soon as it is
 * free, until it returns false: that slot was the last. NULL: there is no thread to be had. */
struct ahead *ahead_begin(unsigned slots, bool (*fill)(void *context, unsigned slot), void *context);

/* Waits for the next slot that is full. The one before is free from now on. Not after the last. */
unsigned ahead_next(struct ahead *ahead);

/* Ends the thread, when `fill` has returned, wherever it is; nothing is called any more. `ahead` may be NULL. */
void ahead_end(struct ahead *ahead);

#endif
