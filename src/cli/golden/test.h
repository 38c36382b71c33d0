#ifndef MONGE_CLI_GOLDEN_TEST_H
#define MONGE_CLI_GOLDEN_TEST_H

#include "cli/options.h"

enum status test_command(const struct arguments *args);

#endif
