/* Where a run writes: never over what it reads. */
#ifndef MONGE_CLI_GOLDEN_TARGETS_H
#define MONGE_CLI_GOLDEN_TARGETS_H

#include "cli/golden/run.h"

/* Whether the folders of --output and --report are none but folders; and whether they, and the files of --json and --junit, keep out of the goldens and of the scenes
 * of the run, and no two of the files are the same. False: told. */
bool golden_check_targets(const struct golden_run *run, const struct option_value *option);

#endif
