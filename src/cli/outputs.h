/* Where pictures go. An output is what one load of a scene gives: a picture, or many of its frames. */
#ifndef MONGE_CLI_OUTPUTS_H
#define MONGE_CLI_OUTPUTS_H

#include <pthread.h>

#include "cli/scenes.h"
#include "cli/sweep.h"

struct output {
    const char *scene, *name;     /* its path and its name, of `scenes` */
    struct monge_define *defines; /* owned: a combination of the sweep */
    char *title;                  /* owned: the scene, and the values that tell it from others of the sweep */
    char *path; /* owned; "-": standard output. With --frames a pattern: its {frame} is not known yet */
};

struct claim;

struct plan {
    const char *wanted, *stats, *log; /* the values of -o, --stats and --log; NULL: not given */
    const struct report *report;
    const struct sweep *sweep;
    const struct scenes *scenes;
    const struct option_value *frames; /* NULL: --frames is not given */
    unsigned passes;                   /* a bit 1 << layer for each that --aov asks for */
    struct output *outputs; /* each scene with each combination, the combinations running fastest */
    size_t count;
    pthread_mutex_t lock; /* of what follows */
    struct claim *claims; /* files that are read or written */
    size_t claim_count;
    char *lost; /* owned: the folder that could not be made, as was told; NULL: none */
};

/* Plans the outputs, and sees to it that nothing is written twice, or over a scene, a list or the file of --stats or --log.
 * False when something is wrong, with the reason on stderr or, about files, in the report. Either way to be freed. */
bool plan_begin(struct plan *plan, const struct arguments *args, const struct scenes *scenes,
                const struct sweep *sweep, const struct report *report);
void plan_free(struct plan *plan);

/* Whether a picture can be written there; makes the folders that -o asks for. False: the reason has been told, that of
 * a folder once. As plan_frames, from any thread. */
bool plan_reach(struct plan *plan, const char *path);

/* Whether pictures go where their order matters: to a pipe, a device or standard output. */
bool plan_is_serial(const struct plan *plan);

/* The same for the frames of an output, `last` being the last one of the whole animation, 0 of a still: the paths of
 * frames[0 .. count-1]. NULL when something is wrong. To be freed by paths_free. */
char **plan_frames(struct plan *plan, const struct output *output, const unsigned *frames, size_t count,
                   unsigned last);
void paths_free(char **paths, size_t count);

#endif
