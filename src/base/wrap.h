/* Texts in lines for a terminal. */
#ifndef MONGE_BASE_WRAP_H
#define MONGE_BASE_WRAP_H

#include <stdio.h>

enum { WRAP_WIDTH = 80 };

/* The words of a text, which blanks and line ends part, from `column` on, where the cursor is; further lines begin at
 * `indent`. Ends the last one. */
void wrap_print(FILE *out, const char *text, int column, int indent);

#endif
