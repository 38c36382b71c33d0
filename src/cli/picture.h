/* A picture of a batch, and what has become of it. */
#ifndef MONGE_CLI_PICTURE_H
#define MONGE_CLI_PICTURE_H

#include "cli/report.h"
#include "monge.h"

enum outcome { PICTURE_FAILED, PICTURE_RENDERED, PICTURE_UNCHANGED /* the file was right already */ };

struct picture {
    const char *scene; /* as the user knows it; "-" for the standard streams, here and in output */
    char *output;      /* owned; NULL: it was not known yet */
    unsigned frame;    /* 0: --frames is not given, or the scene is a still */
    const struct monge_define *defines;
    size_t define_count;
    enum outcome outcome;
    const char
        *reason; /* with --dry-run: why it would be rendered; "": nobody asked; NULL: it would not. Static */
    struct problem problem; /* of one that failed; owned */
    /* Of a picture that was rendered; of one that is unchanged, the region and the hashes: */
    struct monge_settings settings;
    struct monge_region region; /* what was rendered of it: the size of the file */
    struct monge_stats stats;
    size_t primitives;
    double load_seconds, write_seconds;
    uint64_t peak_memory_bytes;       /* of the process, until the picture was done */
    char scene_hash[MONGE_HASH_SIZE]; /* of the evaluated scene and the settings */
    char pixel_hash[MONGE_HASH_SIZE]; /* "" where nobody asked */
};

void picture_free(struct picture *picture);

/* As a JSON object in one line; README.md has its members. started: when the run did, to be told with its
 * process; NULL: neither. */
void picture_write_json(const struct picture *picture, const char *started, FILE *out);

#endif
