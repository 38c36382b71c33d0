/* --limit: what the reading of a scene, and its picture, may take. */
#ifndef MONGE_CLI_LIMITS_H
#define MONGE_CLI_LIMITS_H

#include "cli/options.h"
#include "monge.h"

struct limits {
    struct monge_limits load;
    size_t pixels; /* of a picture */
};

/* Reads all --limit; what none names has its default. False, with the reason on stderr, when one is wrong. */
bool limits_read(const struct arguments *args, struct limits *limits);

/* The names that it knows, from 0 up to a NULL. */
const char *limits_name(size_t i);

#endif
