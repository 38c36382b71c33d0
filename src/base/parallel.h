/* Runs a piece of work on several threads at once. */
#ifndef MONGE_BASE_PARALLEL_H
#define MONGE_BASE_PARALLEL_H

enum { PARALLEL_MAX_THREADS = 1024 };

/* Calls work(context, thread) once for each thread number 0 .. threads-1, at the same time, and
 * returns when all have come back. Where the system gives fewer threads than asked for, the calls
 * that are left run on the caller's thread: the work is always done. threads is 1 or more. */
void parallel_run(unsigned threads, void (*work)(void *context, unsigned thread), void *context);

/* Processors that this process may run on; at least 1. */
unsigned parallel_processors(void);

#endif
