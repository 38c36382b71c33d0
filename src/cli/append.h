/* Whole lines at the end of a file that other programs may write to as well. */
#ifndef MONGE_CLI_APPEND_H
#define MONGE_CLI_APPEND_H

#include <stdbool.h>

/* Adds the text to a file that is open with O_APPEND: all of it or, in a regular file, nothing. False: errno says why. */
bool append_whole(int fd, const char *text);

#endif
