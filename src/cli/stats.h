/* render --stats: what each picture took, as JSON. */
#ifndef MONGE_CLI_STATS_H
#define MONGE_CLI_STATS_H

#include "monge.h"

struct picture {
    const char *scene; /* as the user knows it; "-" for the standard streams, here and in output */
    char *output;      /* owned */
    unsigned frame;    /* 0: --frames is not given */
    const struct monge_define *defines;
    size_t define_count;
    bool done; /* else the rest means nothing */
    struct monge_settings settings;
    struct monge_region region; /* what was rendered of it: the size of the file */
    struct monge_stats stats;
    size_t primitives;
    double load_seconds, write_seconds;
    uint64_t peak_memory_bytes; /* of the process, until the picture was done */
};

uint64_t stats_peak_memory(void);

/* Writes all pictures to `path`, "-" being standard output. A file is complete or absent. False, with
 * the reason on stderr, when it cannot. */
bool stats_write(const char *path, const struct picture *pictures, size_t count);

#endif
