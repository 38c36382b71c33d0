/* What counts as the same. */
#ifndef MONGE_BASE_SAME_H
#define MONGE_BASE_SAME_H

#include <stdbool.h>
#include <string.h>

#include "base/vec3.h"

/* Texts, or none on either side: NULL. */
static inline bool same_text(const char *a, const char *b) { return a == b || (a && b && strcmp(a, b) == 0); }

/* But for what another program rounds in another way. */
static inline bool same_vector(vec3 a, vec3 b) {
    return vec3_length(vec3_sub(a, b)) <= 1e-9 * (vec3_length(a) + vec3_length(b));
}

#endif
