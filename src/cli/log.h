/* render --log: a line of JSON for each picture, in their order, as soon as it is done. */
#ifndef MONGE_CLI_LOG_H
#define MONGE_CLI_LOG_H

#include <stdbool.h>

#include "cli/picture.h"

struct log {
    const char *path; /* NULL: there is none */
    int fd;
    bool failed; /* it has been told that it cannot be written */
};

/* Opens the file to write behind what is there; "-" is standard output. NULL: no log. False, with the reason on
 * stderr, when it cannot be opened. */
bool log_open(struct log *log, const char *path);

/* Writes the picture's line, whole: other programs may write to the same file. What goes wrong is told once. */
void log_picture(struct log *log, const struct picture *picture);

/* False when a line could not be written. */
bool log_close(struct log *log);

#endif
