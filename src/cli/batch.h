/* Many units of work on several threads at once. Whatever ends first: what they say, and what becomes of them, comes
 * in their order.
 *
 *     units   0 done, 1 at work, 2 done, 3 at work, 4 not begun      on two threads
 *     told    0                                                      2 waits until 1 is done
 */
#ifndef MONGE_CLI_BATCH_H
#define MONGE_CLI_BATCH_H

#include <stdbool.h>
#include <stddef.h>

struct batch {
    size_t count;
    unsigned jobs; /* units at once, at least 1 */
    bool held;     /* what a unit says is held back until its turn, even of one at once */
    void *context;
    bool (*run)(void *context, size_t index); /* on any thread; false: no further unit is to be begun */
    void (*ended)(void *context, size_t index,
                  const char *said); /* in order, one at a time; said: to be told */
};

/* Returns how many have been run, which are the first ones: all, but for a false run and a signal. A further unit is
 * begun only while the process uses less than half of the machine's memory, or none is at work. */
size_t batch_run(const struct batch *batch);

#endif
