/* render --stats: what each picture took, as JSON. */
#ifndef MONGE_CLI_STATS_H
#define MONGE_CLI_STATS_H

#include <stdbool.h>

#include "cli/picture.h"
#include "cli/report.h"

uint64_t stats_peak_memory(void);

/* Writes all pictures to `path`, "-" being standard output. A file is complete or absent. False, with
 * the reason told, when it cannot. */
bool stats_write(const char *path, const struct picture *pictures, size_t count, const struct report *report);

#endif
