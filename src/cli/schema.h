#ifndef MONGE_CLI_SCHEMA_H
#define MONGE_CLI_SCHEMA_H

#include "cli/options.h"

enum status schema_command(const struct arguments *args);

#endif
