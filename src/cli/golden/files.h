/* The files that tell of a run: results.json, and what --json, --junit and --report ask for. */
#ifndef MONGE_CLI_GOLDEN_FILES_H
#define MONGE_CLI_GOLDEN_FILES_H

#include "cli/golden/results.h"
#include "cli/options.h"

/* `output` is the folder of the run. False, with the reason told, where one of them cannot be written: the others
 * are. */
bool golden_files_write(const struct golden_results *results, const char *output,
                        const struct option_value *option);

#endif
