/* Cuts a region into tiles, and gives them to threads: each takes the next until none is left. */
#ifndef MONGE_RENDER_TILES_H
#define MONGE_RENDER_TILES_H

#include "monge.h"

struct tiling {
    struct monge_region region;
    const struct monge_job *job; /* not NULL */
    /* Makes the pixel (x, y) of the region; from many threads at once. Adds to the counts of rays, of which each
     * thread has its own. */
    void (*pixel)(const void *context, uint32_t x, uint32_t y, uint64_t rays[MONGE_RAY_KINDS]);
    const void *context;
    float *
        rgb; /* where the pixels are that job->tiles keeps, as monge_film_pixels has them; NULL: of another kind */
};

/* Makes all pixels, each once. False when job->cancel was set before that was done. Of stats, rays and threads
 * are filled. */
bool tiles_run(const struct tiling *tiling, struct monge_stats *stats);

#endif
