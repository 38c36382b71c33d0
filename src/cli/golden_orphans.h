/* Goldens whose scene is gone. */
#ifndef MONGE_CLI_GOLDEN_ORPHANS_H
#define MONGE_CLI_GOLDEN_ORPHANS_H

#include "cli/golden_run.h"

/* Adds a case for each to the results, which have all cases of the run. With a root, a scene is gone that is not
 * below it any more; without one, every golden is an orphan that no scene of the run has, and they are looked for only
 * if `all`: the run is of all scenes. A scene that was not tested, or that is broken, keeps its goldens. */
void golden_find_orphans(const struct golden_run *run, bool all, struct golden_results *results);

#endif
