/* The texts of a scene as a fingerprint: of the files' bytes, and of where the included ones are. */
#ifndef MONGE_LANG_TEXTS_H
#define MONGE_LANG_TEXTS_H

#include "lang/lang.h"

/* The hash of the texts of a reading. The scene's own path is not in it. */
struct hash texts_hash(const struct lang_result *result);

/* The paths of what the scene includes, one a line, for texts_hash_again. To be freed; NULL: no memory. */
char *texts_files(const struct lang_result *result);

/* What texts_hash would be now, the scene in `path` including `files`: nothing is evaluated. False, with a failure
 * in diag, where a file cannot be read. `limit` is of the bytes of a file. */
bool texts_hash_again(const char *path, const char *files, size_t limit, struct diagnostics *diag,
                      struct hash *hash);

#endif
