/* How far a batch of pictures is: a bar in the last line of a terminal,
 *
 *     king  [##########--------------]  41%  0:12 left
 *     3 of 12 pictures  king  [##########--------------]  41%  0:12 left
 *
 * drawn with carriage returns alone, so that whatever ends the program, the terminal needs no mending; or, for
 * programs, JSON objects on stderr, one a line. All functions but begin and end may be called from any thread.
 *
 * The time that is left is estimated from the work of a picture, its pixels times its samples, and from the seconds
 * that a piece of work has taken: of a scene that is being rendered its own, of one that has not begun the mean. The
 * work of a scene that is not loaded yet is the mean of those that are known. While several are at work each second
 * is shared among them, so that all seconds together are those of the clock. */
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
    struct progress_unit *next;    /* of those at work, in the order in which they began */
    size_t pictures, done;         /* of the unit; until more is known, it is thought to have one */
    const char *name;              /* of the picture at work; the caller's; NULL: none is rendered */
    const struct picture *picture; /* the same */
    uint64_t pixels, of_pixels;    /* of it, that are done */
    uint64_t known;                /* of these, that were so before it began */
    double work;                   /* of a whole picture; 0: not known yet */
    double reading;                /* the share of the time before that was known */
    double seconds;                /* the share of the time that its rendering has had */
    double worked;                 /* what came of it */
};

struct progress {
    enum progress_wish wish; /* NEVER: nothing is shown; else ALWAYS or JSON */
    pthread_mutex_t lock;    /* of all that follows up to `columns` and of is_over, and of the units */
    size_t units, pictures;  /* in the batch; the pictures as far as they are known */
    size_t begun;            /* units */
    size_t done[3];          /* pictures, by their outcome */
    struct progress_unit *first;
    size_t known_units;         /* whose work is known, */
    double known_work, reading; /* how much that is, and the time before it was */
    double worked, seconds;     /* rendered of it, and how long that took */
    double part;                /* 0 to 1: the greatest that was shown since there is something rendered */
    double start, now, shown;   /* seconds by clock_seconds; now: up to which they are shared */
    size_t columns;             /* of the line that stands; 0: none */
    pthread_t ticker;           /* shows again, about once a second, what does not change, */
    bool ticks;                 /* where it could be started; */
    bool is_over;               /* tells it to end, with the signal: */
    pthread_cond_t ended;
};

/* `quiet` makes a wish of auto mean never. missing: what was asked for and is not there, which counts as pictures
 * that failed. */
void progress_begin(struct progress *progress, enum progress_wish wish, bool quiet, size_t units,
                    size_t missing);
void progress_end(struct progress *progress);

void progress_unit_begin(struct progress_unit *unit, struct progress *progress);
void progress_unit_end(struct progress_unit *unit);

void progress_pictures(struct progress_unit *unit, size_t pictures); /* so many the unit has */

/* The next one is rendered, of which some pixels are known already. The texts are the caller's until it is done. */
void progress_picture(struct progress_unit *unit, const char *name, const struct picture *picture,
                      uint64_t known);
void progress_update(void *unit, uint64_t done, uint64_t total); /* of its pixels; as monge_job's */
void progress_rendered(struct progress_unit *unit); /* no more of it is; it may still be written */
void progress_done(struct progress_unit *unit, enum outcome outcome); /* it is done */

/* Seconds until all is done. Negative: there is no ground for an estimate yet. */
double progress_seconds_left(const struct progress *progress);

/* Clears the line of the bar. */
void progress_hide(struct progress *progress);

/* The same, and nothing is shown until it goes on: so that something else may be printed in one piece. In between nothing else
 * here may be called by the same thread. */
void progress_pause(struct progress *progress);
void progress_resume(struct progress *progress);

#endif
