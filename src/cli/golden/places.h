/* Where the scenes of goldens are looked for, so that an orphan can be told from a golden that is not of the run.
 *
 * A golden is called as its scene's path ends, from some folder. With a root that is known. Without one it may be a folder of
 * the run, one above it, of which the run has only a part, or another one altogether, of an earlier run. */
#ifndef MONGE_CLI_GOLDEN_PLACES_H
#define MONGE_CLI_GOLDEN_PLACES_H

#include "cli/matches.h"
#include "monge.h"

struct golden_place;

/* All empty: nothing is known, and nothing is an orphan. */
struct golden_places {
    char *root;     /* owned; NULL: none, but */
    char **folders; /* owned: those of the run */
    size_t count;
    /* Of these, as soon as they are asked for: */
    struct golden_place *all; /* owned: where a path may begin that ends in a name */
    size_t all_count;
    bool unknown;          /* one of them is not there */
    bool searched;         /* the current folder, for */
    struct matches others; /* scenes below it, not in the folders */
};

void golden_places_add(struct golden_places *places, const char *folder); /* to the folders */
void golden_places_free(struct golden_places *places);

/* Whether a scene that a golden of that name may be of is there: below the root; without one, in a folder or in any above it, or
 * elsewhere below the current folder. True as well where that cannot be known. limits may be NULL. */
bool golden_places_have(struct golden_places *places, const char *name, const struct monge_limits *limits);

#endif
