/* Where the picture of each scene goes. */
#ifndef MONGE_CLI_OUTPUTS_H
#define MONGE_CLI_OUTPUTS_H

#include "cli/commands.h"

struct output {
    const char *scene; /* as the user gave it; "-": standard input */
    char *name;        /* owned: the scene's file name without .yaml or .yml; "stdin" */
    char *path;        /* owned; "-": standard output */
};

/* Fills outputs[0 .. count-1] by the value of -o (NULL: not given), makes the folders that it asks
 * for, and sees to it that nothing is written twice, or over a scene or the file of --stats (NULL:
 * not given), or where nothing can be written. False when something is wrong, with the reason on
 * stderr. Either way the outputs are to be freed. */
bool outputs_plan(const char *wanted, const char *stats, char **scenes, size_t count, struct output *outputs);

void outputs_free(struct output *outputs, size_t count); /* not the array itself */

#endif
