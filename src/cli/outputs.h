/* Where pictures go. An output is what one load of a scene gives: a picture, or many of its frames. */
#ifndef MONGE_CLI_OUTPUTS_H
#define MONGE_CLI_OUTPUTS_H

#include "cli/sweep.h"

struct output {
    const char *scene;            /* as the user gave it; "-": standard input */
    char *name;                   /* owned: the scene's file name without .yaml or .yml; "stdin" */
    struct monge_define *defines; /* owned: a combination of the sweep */
    char *title;                  /* owned: the scene, and the values that tell it from others of the sweep */
    char *path; /* owned; "-": standard output. With --frames a pattern: its {frame} is not known yet */
};

struct claim;

struct plan {
    const char *wanted, *stats; /* the values of -o and --stats; NULL: not given */
    const struct sweep *sweep;
    const struct option_value *frames; /* NULL: --frames is not given */
    unsigned passes;                   /* a bit 1 << layer for each that --aov asks for */
    size_t scene_count;
    struct output *outputs; /* each scene with each combination, the combinations running fastest */
    size_t count;
    struct claim *claims; /* files that are read or written */
    size_t claim_count;
};

/* Plans the outputs, makes the folders that -o asks for, and sees to it that nothing is written twice, or
 * over a scene or the file of --stats, or where nothing can be written. False when something is wrong, with
 * the reason on stderr. Either way to be freed. */
bool plan_begin(struct plan *plan, const struct arguments *args, const struct sweep *sweep);
void plan_free(struct plan *plan);

/* The same for the frames of an output, `last` being the last one of the whole animation: the paths of
 * frames[0 .. count-1]. NULL when something is wrong. To be freed by paths_free. */
char **plan_frames(struct plan *plan, const struct output *output, const unsigned *frames, size_t count,
                   unsigned last);
void paths_free(char **paths, size_t count);

#endif
