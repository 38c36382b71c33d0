/* Whether there is room for a file, before it is worth hours of work. */
#ifndef MONGE_CLI_ROOM_H
#define MONGE_CLI_ROOM_H

#include <stdbool.h>
#include <stdint.h>

/* Whether the folder of `path` takes a new file of so many bytes, at least 1: tried with one that leaves nothing behind.
 * False: errno is ENOSPC, EDQUOT or EROFS. Whatever else is wrong is for the writing to find. */
bool room_for(const char *path, uint64_t bytes);

#endif
