#ifndef MONGE_CLI_EXPLAIN_H
#define MONGE_CLI_EXPLAIN_H

#include "cli/options.h"

enum status explain_command(const struct arguments *args);

#endif
