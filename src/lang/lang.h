/* From text to a checked, evaluated description. */
#ifndef MONGE_LANG_LANG_H
#define MONGE_LANG_LANG_H

#include "lang/description.h"

struct lang_limits {
    unsigned nesting; /* collections within each other */
    size_t values;    /* in the file, those behind aliases each time */
};

/* Reads the scene in `source`, all its mistakes reported to `diag`. NULL when nothing can be said
 * of it as a scene: it is not YAML or not a mapping. Else the scene; diag tells whether it was right.
 * The result lives in `arena` and points into nothing else but the source. */
struct object_value *lang_read(struct arena *arena, struct diagnostics *diag, const struct source *source,
                               const struct lang_limits *limits);

#endif
