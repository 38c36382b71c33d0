/* The lines of a log that wait for their turn, in a file beside it: see log.h. It begins with the size that the log
 * had when the first of them came, which tells where those that have been written since are to be looked for. */
#ifndef MONGE_CLI_LOG_WAITING_H
#define MONGE_CLI_LOG_WAITING_H

#include <pthread.h>
#include <stdbool.h>
#include <stddef.h>

struct log_waiting {
    char *path; /* owned; NULL: lines are not kept */
    int fd;
    pthread_mutex_t lock; /* of what follows, and of the file */
    size_t count;         /* lines whose turn has not come */
};

/* Of the log that is open as `log`, the lines that an earlier run left being moved into it. Where it is no regular
 * file, another run has the lines or none can be kept, nothing is. */
void log_waiting_open(struct log_waiting *waiting, const char *path, int log);

/* A line, with its end, of a unit; and that as many have come into the log. */
void log_waiting_add(struct log_waiting *waiting, int log, size_t unit, const char *line);
void log_waiting_take(struct log_waiting *waiting);

void log_waiting_close(struct log_waiting *waiting);

#endif
