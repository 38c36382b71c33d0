/* Where the scenes of goldens are looked for, so that an orphan can be told from a golden that is not of the run. */
#ifndef MONGE_CLI_GOLDEN_PLACES_H
#define MONGE_CLI_GOLDEN_PLACES_H

#include "monge.h"

/* All empty: nothing is known, and nothing is an orphan. */
struct golden_places {
    char *root; /* owned: the folder that all names count from; NULL: none, but */
    char *
        *folders; /* owned: those of the run; a part of what the goldens are of may be all that a folder is */
    size_t count;
};

void golden_places_add(struct golden_places *places, const char *folder); /* to the folders */
void golden_places_free(struct golden_places *places);

/* Whether a scene of that name is there: below the root; without one, in a folder or in any above it. True as well where
 * that cannot be known. */
bool golden_places_have(const struct golden_places *places, const char *name,
                        const struct monge_limits *limits);

#endif
