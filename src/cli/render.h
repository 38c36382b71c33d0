#ifndef MONGE_CLI_RENDER_H
#define MONGE_CLI_RENDER_H

#include "cli/options.h"

enum status render_command(const struct arguments *args);

#endif
