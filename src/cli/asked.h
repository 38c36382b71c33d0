/* What the command line asks for, where it differs from what a scene says: as a text that is the same for the same. */
#ifndef MONGE_CLI_ASKED_H
#define MONGE_CLI_ASKED_H

#include "cli/options.h"
#include "monge.h"

/* "--size 320x240 --samples 4 -D a=1 --frames 3": the options that change pixels, in the order of the table, then the
 * parameters by name and the frame, unless it is the first. "" where nothing is asked for. To be freed. */
char *asked_text(const struct option_value *option, const struct monge_define *defines, size_t define_count,
                 unsigned frame);

#endif
