/* A run of `monge render`: what its parts share. */
#ifndef MONGE_CLI_WORK_H
#define MONGE_CLI_WORK_H

#include <stdatomic.h>

#include "cli/load.h"
#include "cli/log.h"
#include "cli/outputs.h"
#include "cli/progress.h"

/* An output and what it has become: one load of a scene, and its pictures one after another on one thread. */
struct unit {
    struct work *work;
    const struct output *output;
    struct picture *pictures; /* those tried so far; a scene that cannot be loaded counts as one */
    size_t count;
    struct monge_diagnostics *apart; /* owned: what it has for a document of --format, until its turn */
    struct problem problem;          /* what went wrong first with the picture at work */
    struct progress_unit progress;
    enum status status;
};

struct work {
    struct arguments args;
    struct loader loader;
    struct plan plan;
    struct progress progress;
    struct log log;
    struct unit *units; /* one for each output of the plan */
    size_t begun;       /* so many of them */
    size_t outcomes[3]; /* pictures, by theirs */
    atomic_bool tight;  /* a picture could not be written */
    const char *scene;  /* of the unit that was told last, */
    char *said; /* what it said, owned; and how often after that the others of the scene said the same */
    size_t repeated;
    const char *documented; /* the scene of which a document of --format was told last */
    enum status worst;
};

static inline bool work_wants(const struct work *work, enum option_id option) {
    return work->args.option[option].given;
}

#endif
