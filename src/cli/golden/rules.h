/* Rules of golden.yaml that do nothing: warnings. */
#ifndef MONGE_CLI_GOLDEN_RULES_H
#define MONGE_CLI_GOLDEN_RULES_H

#include "cli/golden/run.h"

/* Of a tolerance whose goldens have no pixels. */
void golden_warn_of_tolerances(const struct golden_run *run);

/* Of names and patterns that no scene matches, and of rules that come too late; in a run of all scenes. */
void golden_warn_of_unused(const struct golden_run *run);

#endif
