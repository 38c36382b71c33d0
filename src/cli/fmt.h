/* monge fmt */
#ifndef MONGE_CLI_FMT_H
#define MONGE_CLI_FMT_H

#include "cli/options.h"

enum status fmt_command(const struct arguments *args);

#endif
