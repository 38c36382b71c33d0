/* Goldens whose scene is gone. */
#ifndef MONGE_CLI_GOLDEN_ORPHANS_H
#define MONGE_CLI_GOLDEN_ORPHANS_H

#include "cli/golden/run.h"

/* Whether the run is one of all scenes, which tells of what there is none any more: it has places. */
bool golden_looks_for_orphans(const struct golden_run *run, const struct golden_results *results);

/* Adds a case for each to the results, which have all cases of the run: for a golden that no scene of the run has made, and
 * none that is in the results' places may make. A scene that is broken keeps its goldens. */
void golden_find_orphans(const struct golden_run *run, struct golden_results *results);

#endif
