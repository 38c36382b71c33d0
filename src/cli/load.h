/* Loading a scene, with everything that is wrong with it on stderr. */
#ifndef MONGE_CLI_LOAD_H
#define MONGE_CLI_LOAD_H

#include "cli/commands.h"
#include "monge.h"

struct load {
    struct monge_scene *scene; /* owned; NULL where there is none */
    unsigned errors, warnings;
    enum status status;
};

struct load load_scene(const char *path);

#endif
