/* Scene files as sources. */
#ifndef MONGE_LANG_FILE_H
#define MONGE_LANG_FILE_H

#include "base/diag.h"

/* Reads the whole of `path` ("-": standard input) into the arena, without a byte order mark. NULL
 * when it cannot be read or is longer than `limit` bytes: a failure in diag. */
const struct source *file_read(struct arena *arena, struct diagnostics *diag, const char *path, size_t limit);

/* The same with every byte, a byte order mark too. */
const struct source *file_read_bytes(struct arena *arena, struct diagnostics *diag, const char *path,
                                     size_t limit);

/* As file_read, of a text in memory, which must outlive the source. */
const struct source *file_from_memory(struct arena *arena, const char *name, const char *text, size_t size);

#endif
