/* Completion scripts for shells. */
#ifndef MONGE_CLI_COMPLETION_H
#define MONGE_CLI_COMPLETION_H

#include <stdio.h>

enum completion_shell { COMPLETION_BASH, COMPLETION_ZSH, COMPLETION_FISH }; /* as --completion has them */

void completion_print(FILE *out, enum completion_shell shell);

#endif
