/* How far a batch of pictures is: a bar in the last line of a terminal,
 *
 *     king  [##########--------------]  41%  0:12 left
 *     3 of 12 pictures  [##########--------------]  41%  0:12 left
 *
 * drawn with carriage returns alone, so that whatever ends the program, the terminal needs no mending; or, for
 * programs, JSON objects on stderr, one a line. All functions but begin and end may be called from any thread. */
#ifndef MONGE_CLI_PROGRESS_H
#define MONGE_CLI_PROGRESS_H

#include <pthread.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "cli/picture.h"

enum progress_wish {
    PROGRESS_AUTO,
    PROGRESS_ALWAYS,
    PROGRESS_NEVER,
    PROGRESS_JSON
}; /* as --progress has them */

/* A unit of the batch: pictures that are made one after another. */
struct progress_unit {
    struct progress *progress;
    size_t pictures, done; /* of the unit; until more is known, it is thought to have one */
    const char *name;      /* of the picture at work; the caller's */
    uint64_t pixels, of_pixels;
};

struct progress {
    enum progress_wish wish; /* NEVER: nothing is shown; else ALWAYS or JSON */
    pthread_mutex_t lock;    /* of all that follows, and of the units */
    size_t units, pictures;  /* in the batch; the pictures as far as they are known */
    size_t done[3];          /* pictures, by their outcome */
    double parts, unchanged; /* units' worth that is done, of that what needed no rendering */
    double begun, shown;     /* seconds by clock_seconds */
    size_t columns;          /* of the line that stands; 0: none */
};

/* `quiet` makes a wish of auto mean never. */
void progress_begin(struct progress *progress, enum progress_wish wish, bool quiet, size_t units);
void progress_end(struct progress *progress);

void progress_pictures(struct progress_unit *unit, size_t pictures);  /* so many the unit has */
void progress_picture(struct progress_unit *unit, const char *name);  /* the next one is rendered */
void progress_update(void *unit, uint64_t done, uint64_t total);      /* of its pixels; as monge_job's */
void progress_done(struct progress_unit *unit, enum outcome outcome); /* it is done */

/* Clears the line of the bar, so that something else may be printed. */
void progress_hide(struct progress *progress);

#endif
