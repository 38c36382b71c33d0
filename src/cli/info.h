#ifndef MONGE_CLI_INFO_H
#define MONGE_CLI_INFO_H

#include "cli/options.h"

enum status info_command(const struct arguments *args);

#endif
