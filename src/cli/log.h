/* render --log: a line of JSON for each picture, in the order of the batch.
 *
 *     pictures.log           the lines of those before which all are done
 *     .pictures.log.waiting  those of the others that are done: NUMBER OF THE UNIT, a tab, the line
 *
 * A line waits there until its turn comes, so that a run which is killed leaves none out: the next one with the same
 * log begins by moving them over. Of two runs at once with the same log one keeps them, the other goes without. */
#ifndef MONGE_CLI_LOG_H
#define MONGE_CLI_LOG_H

#include <pthread.h>
#include <stdbool.h>

#include "cli/log_waiting.h"
#include "cli/picture.h"

struct log {
    const char *path; /* NULL: there is none */
    const struct report *report;
    int fd;
    char started[32]; /* when the run did: 2026-11-22T09:30:00.125Z */
    struct log_waiting waiting;
    bool failed; /* it has been told that it cannot be written */
};

/* Opens the file to write behind what is there; "-" is standard output. NULL: no log. False, with the reason
 * told, when it cannot be opened. */
bool log_open(struct log *log, const char *path, const struct report *report);

/* Keeps the line of a picture that is done, until its turn. From any thread, those of a unit in their order. */
void log_keep(struct log *log, size_t unit, const struct picture *picture);

/* Its turn: writes the line, whole, as other programs may write to the same file. What goes wrong is told once. */
void log_picture(struct log *log, const struct picture *picture);

/* False when a line could not be written. */
bool log_close(struct log *log);

#endif
