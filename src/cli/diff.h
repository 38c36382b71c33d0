/* monge diff */
#ifndef MONGE_CLI_DIFF_H
#define MONGE_CLI_DIFF_H

#include "cli/options.h"

enum status diff_command(const struct arguments *args);

#endif
