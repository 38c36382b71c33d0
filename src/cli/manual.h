/* The manual page monge(1). */
#ifndef MONGE_CLI_MANUAL_H
#define MONGE_CLI_MANUAL_H

#include <stdio.h>

void manual_print(FILE *out); /* as roff, with the man macros */

#endif
