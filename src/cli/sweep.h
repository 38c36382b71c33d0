/* The values that -D gives the parameters of a scene, and the sweep through all that their lists combine to.
 *
 *     -D a=1,2 -D b=x,y    a=1 b=x, a=1 b=y, a=2 b=x, a=2 b=y: later lists run fastest
 */
#ifndef MONGE_CLI_SWEEP_H
#define MONGE_CLI_SWEEP_H

#include "cli/options.h"
#include "cli/report.h"
#include "monge.h"

struct axis {
    char *name;
    char **values;
    size_t count; /* at least 1 */
};

struct sweep {
    struct axis *axes; /* one for each parameter that is given, in the order of the command line */
    size_t count;
    size_t total; /* combinations; 1 without -D */
};

/* Reads all -D. False, with the reason on stderr, when one makes no sense. Either way to be freed. */
bool sweep_read(const struct arguments *args, struct sweep *sweep);

/* Warns of each -D that was read and counts for nothing, since a later one sets its parameter to something else. `place`
 * begins what is told: "" is the command line. */
void sweep_warn(const struct arguments *args, const char *place, const struct report *report);

void sweep_free(struct sweep *sweep);

/* Combination number `index`: sweep->count values, in defines[]; the texts stay the sweep's. */
void sweep_combination(const struct sweep *sweep, size_t index, struct monge_define *defines);

/* "a=1, b=x" of those parameters that have several values; "" where there are none. To be freed. */
char *sweep_describe(const struct sweep *sweep, const struct monge_define *defines);

#endif
