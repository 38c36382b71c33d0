#ifndef MONGE_CLI_GOLDEN_ACCEPT_H
#define MONGE_CLI_GOLDEN_ACCEPT_H

#include "cli/options.h"

enum status accept_command(const struct arguments *args);

#endif
