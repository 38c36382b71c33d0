/* Goldens as text: DIR/golden.lock, a line each, sorted by name, so that two people who change two goldens change
 * two lines.
 *
 *     # Goldens of monge test.
 *     gallery/chess 640x480x8 pixels=27f0... scene=... text=... program=... options=--samples 4
 *
 * A name has no blanks: those, control characters and % are written as %20 and the like, and one of # < = > | where it
 * is the first; in options, which go to the end of the line, control characters and %. Goldens with passes have depth=,
 * normal= and shadow= as well. What is not known of a golden is left out, as are options that are not. */
#ifndef MONGE_CLI_GOLDEN_LOCK_H
#define MONGE_CLI_GOLDEN_LOCK_H

#include "cli/golden/golden.h"

struct golden_line {
    char *name;                /* owned */
    unsigned number;           /* in the file, from 1; 0: it is new */
    bool gone;                 /* removed: it is not written any more */
    struct golden_stamp stamp; /* its options "" where there are none */
};

struct golden_lock {
    char *path;                /* owned */
    struct golden_line *lines; /* by name */
    size_t count;
};

/* Reads DIR/golden.lock; where it is not there, there are no lines. False, with the reason and the line told, where
 * it is no such file: half of a merge, say. Either way to be freed. */
bool golden_lock_read(struct golden_lock *lock, const char *folder);
void golden_lock_free(struct golden_lock *lock);

const struct golden_line *golden_lock_find(const struct golden_lock *lock, const char *name); /* NULL: none */

/* How a line begins that no other golden has, up to its pixels: to look for in a history. To be freed. */
char *golden_lock_line(const char *name, const struct golden_stamp *stamp);

/* All of the line, without its end. To be freed. */
char *golden_lock_text(const char *name, const struct golden_stamp *stamp);

/* Puts a line in, in place of one of that name; the stamp is copied. */
void golden_lock_put(struct golden_lock *lock, const char *name, const struct golden_stamp *stamp);
void golden_lock_remove(struct golden_lock *lock, const char *name);

/* Writes the file; of no lines, none is left. False, with the reason told. */
bool golden_lock_write(const struct golden_lock *lock);

#endif
