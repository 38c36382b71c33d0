/* The files of goldens, each of one scene: the pictures, and the passes beside them. */
#ifndef MONGE_CLI_GOLDEN_CLAIMS_H
#define MONGE_CLI_GOLDEN_CLAIMS_H

#include <stdbool.h>
#include <stddef.h>

struct golden_claim;

struct golden_claims {
    struct golden_claim *all;
    size_t count;
};

/* With golden.lock, which is the goldens' own. */
void golden_claims_begin(struct golden_claims *claims);

/* That the scene has a golden of that name, with passes or without. `scene` must last as long as the claims. */
void golden_claims_add(struct golden_claims *claims, const char *name, bool passes, const char *scene);

/* Whether no file is that of two goldens, nor a folder on the way to another. False: told. */
bool golden_claims_check(struct golden_claims *claims);

void golden_claims_free(struct golden_claims *claims);

#endif
