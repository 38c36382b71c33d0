/* Cuts a region into tiles, and gives them to threads: each takes the next until none is left. */
#ifndef MONGE_RENDER_TILES_H
#define MONGE_RENDER_TILES_H

#include "render/trace.h"

struct tiling {
    struct monge_region region;
    const struct monge_job *job; /* not NULL */
    const struct scene *scene;
    struct diagnostics *diag; /* what is wrong with it; NULL: nobody wants to know */
    /* Makes the pixel (x, y) of the region; from many threads at once, of which each has its own `tracing`. */
    void (*pixel)(const void *context, uint32_t x, uint32_t y, struct tracing *tracing);
    const void *context;
    float *
        rgb; /* where the pixels are that job->tiles keeps, as monge_film_pixels has them; NULL: of another kind */
};

/* Makes all pixels, each once. False when job->cancel was set before that was done, or a watch has stopped because of
 * the scene, which is told to diag. Of stats, rays and threads are filled. */
bool tiles_run(const struct tiling *tiling, struct monge_stats *stats);

/* Whether a watch still goes on; tells diag, which may be NULL, where it has stopped because of the scene. */
bool tiles_goes_on(const struct accel_watch *watch, const struct scene *scene, struct diagnostics *diag);

#endif
