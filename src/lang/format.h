/* A scene's text in the canonical style, comments and all. */
#ifndef MONGE_LANG_FORMAT_H
#define MONGE_LANG_FORMAT_H

#include "lang/lang.h"

/* The text of `source`, its meaning and its comments unchanged: formatting the result gives the result.
 * It may be wrong as a scene, but must be YAML. NULL, reported to diag, when it is not, or has no
 * canonical form. A final zero follows the *size bytes, in the arena, whose on_full must be set. */
char *format_text(struct arena *arena, struct diagnostics *diag, const struct source *source,
                  const struct lang_limits *limits, size_t *size);

#endif
