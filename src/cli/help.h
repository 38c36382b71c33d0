/* monge help, and the usage text of each command. */
#ifndef MONGE_CLI_HELP_H
#define MONGE_CLI_HELP_H

#include <stdio.h>

#include "cli/options.h"

enum status help_command(const struct arguments *args);

/* All about a command, or with COMMAND_NONE about monge. */
void help_print(FILE *out, enum command_id command);

/* The doc of an option with its range: "samples a pixel (1 to 65536)". In `text`, which it returns. */
char *help_option_doc(enum option_id option, char *text, size_t size);

#endif
