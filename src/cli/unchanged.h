/* render --skip-unchanged: whether a picture is what rendering would make again. */
#ifndef MONGE_CLI_UNCHANGED_H
#define MONGE_CLI_UNCHANGED_H

#include <stdbool.h>

#include "cli/picture.h"

/* Whether the file of `picture` is a whole picture that this program made from its scene file as it is now, with what it
 * includes, and with these options (as asked_text has them). False also where anything of that cannot be read. True:
 * the region's size and the hashes are those that the file has. */
bool unchanged_picture(struct picture *picture, const char *options, const struct monge_limits *limits);

#endif
