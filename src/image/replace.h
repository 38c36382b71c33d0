/* A file that appears complete under its name or not at all.
 *
 *     struct replacement file;
 *     if (!replace_begin(&file, "king.png")) return false;      a file without a name
 *     const bool good = fputs("...", file.stream) >= 0;
 *     return replace_end(&file, good);                          synced, and king.png
 *
 * A process that is killed in between leaves nothing. Only where the system has no files without names, and for the
 * moment in which an older file is replaced, is there one called .king.png.h3k9zq.tmp. */
#ifndef MONGE_IMAGE_REPLACE_H
#define MONGE_IMAGE_REPLACE_H

#include <stdbool.h>
#include <stdio.h>

struct replacement {
    FILE *stream;    /* to write to */
    char *target;    /* owned; symbolic links followed; NULL where stream writes to it directly */
    char *temporary; /* owned; beside the target; NULL where there is none, yet or at all */
};

/* Opens a new file in the folder of `path`, with the permissions of the file there or else
 * those of any new file. What is there but is no regular file (a pipe, a device) is opened itself;
 * "-" is stdout. False: errno says why, nothing is left behind. */
bool replace_begin(struct replacement *file, const char *path);

/* Ends the writing: puts the file in its place. False, with errno, when it is not `good`, which leaves errno as it is,
 * or anything since replace_begin has failed: nothing is left behind. Either way *file is done with. */
bool replace_end(struct replacement *file, bool good);

#endif
