/* render --skip-unchanged: whether a picture is what rendering would make again. */
#ifndef MONGE_CLI_UNCHANGED_H
#define MONGE_CLI_UNCHANGED_H

#include "monge.h"

/* NULL where the file `path` is a whole picture that this program made from the scene file as it is now, with what it
 * includes, and with these options (as asked_text has them) and a set of passes that are whole as well; else why it is
 * not, or cannot be known to be: "its text differs". Static. */
const char *unchanged_reason(const char *path, const char *scene, const char *options, unsigned passes,
                             const struct monge_limits *limits);

#endif
