#ifndef MONGE_CLI_CHECK_H
#define MONGE_CLI_CHECK_H

#include "cli/options.h"

enum status check_command(const struct arguments *args);

#endif
