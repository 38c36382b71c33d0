/* render --skip-unchanged: whether a picture is what rendering would make again. */
#ifndef MONGE_CLI_UNCHANGED_H
#define MONGE_CLI_UNCHANGED_H

#include <stdbool.h>

#include "monge.h"

/* Whether the file `path` is a whole picture that this program made from the scene file as it is now, with what it
 * includes, and with these options (as asked_text has them), and with a set of passes, which are whole as well. False
 * also where anything of that cannot be read. */
bool unchanged_picture(const char *path, const char *scene, const char *options, unsigned passes,
                       const struct monge_limits *limits);

#endif
