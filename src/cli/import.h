/* monge import */
#ifndef MONGE_CLI_IMPORT_H
#define MONGE_CLI_IMPORT_H

#include "cli/commands.h"

enum status import_command(const struct arguments *args);

#endif
