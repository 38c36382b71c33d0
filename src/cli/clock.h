#ifndef MONGE_CLI_CLOCK_H
#define MONGE_CLI_CLOCK_H

#include <time.h>

/* Seconds since some fixed moment, to measure with. */
static inline double clock_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

#endif
