/* render --skip-unchanged: whether a picture is what rendering would make again. */
#ifndef MONGE_CLI_UNCHANGED_H
#define MONGE_CLI_UNCHANGED_H

#include "cli/picture.h"

/* NULL where the file of `picture` is a whole one that this program made from its scene file as it is now, with what it
 * includes, and with these options (as asked_text has them) and a set of passes that are whole as well: then the region's
 * size and the hashes become those that the file has. Else why it is not, or cannot be known to be: "its text differs".
 * Static. */
const char *unchanged_reason(struct picture *picture, const char *options, unsigned passes,
                             const struct monge_limits *limits);

#endif
