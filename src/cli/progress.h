/* A progress bar in the last line of a terminal:
 *
 *     king  [##########--------------]  41%  0:12 left
 *
 * Drawn with carriage returns alone: whatever ends the program, the terminal needs no mending. */
#ifndef MONGE_CLI_PROGRESS_H
#define MONGE_CLI_PROGRESS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum progress_wish { PROGRESS_AUTO, PROGRESS_ALWAYS, PROGRESS_NEVER }; /* as --progress has them */

struct progress {
    const char *name;
    double begun, drawn; /* seconds by clock_seconds */
    size_t columns;      /* of the line that stands; 0: none */
};

/* Whether to show one; `quiet` makes auto mean never. */
bool progress_wanted(enum progress_wish wish, bool quiet);

void progress_begin(struct progress *progress, const char *name);    /* name stays the caller's */
void progress_update(void *progress, uint64_t done, uint64_t total); /* as monge_job's; draws at times */
void progress_end(struct progress *progress);                        /* clears the line */

#endif
