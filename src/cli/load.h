/* Loading a scene, with everything that is wrong with it told to the report. */
#ifndef MONGE_CLI_LOAD_H
#define MONGE_CLI_LOAD_H

#include "cli/report.h"

struct load {
    struct monge_scene *scene; /* owned; NULL where there is none */
    unsigned errors, warnings; /* of this scene */
    enum status status;
};

struct load load_scene(const char *path, struct report *report);

#endif
