#include "render/tiles.h"

#include "base/parallel.h"

#ifdef MONGE_HOSTILE
enum { TILE_SIZE = 1 };
#else
enum { TILE_SIZE = 32 }; /* pixels a side */
#endif

/* Shared by the threads. */
struct run {
    const struct tiling *tiling;
    uint32_t tiles_across, tile_count;
    atomic_uint next_tile;
    atomic_uint_fast64_t pixels_done;
    atomic_flag reporting; /* a thread is in job->progress */
    atomic_uint_fast64_t rays[MONGE_RAY_KINDS];
};

/* Never waits: while one thread reports, the others go on. */
static void report(struct run *run, uint64_t done) {
    const struct tiling *tiling = run->tiling;
    if (!tiling->job->progress || atomic_flag_test_and_set(&run->reporting)) return;
    tiling->job->progress(tiling->job->context, done, (uint64_t)tiling->region.width * tiling->region.height);
    atomic_flag_clear(&run->reporting);
}

static bool is_cancelled(const struct tiling *tiling) {
    return tiling->job->cancel && atomic_load(tiling->job->cancel);
}

static void make_tile(struct run *run, uint32_t tile, uint64_t rays[MONGE_RAY_KINDS]) {
    const struct tiling *tiling = run->tiling;
    const struct monge_region *region = &tiling->region;
    const uint32_t x0 = tile % run->tiles_across * TILE_SIZE, y0 = tile / run->tiles_across * TILE_SIZE;
    const uint32_t x1 = x0 + TILE_SIZE < region->width ? x0 + TILE_SIZE : region->width;
    const uint32_t y1 = y0 + TILE_SIZE < region->height ? y0 + TILE_SIZE : region->height;
    for (uint32_t y = y0; y < y1; y++)
        for (uint32_t x = x0; x < x1; x++) {
            if (is_cancelled(tiling)) return;
            tiling->pixel(tiling->context, x, y, rays);
        }
    const uint64_t pixels = (uint64_t)(x1 - x0) * (y1 - y0);
    report(run, atomic_fetch_add(&run->pixels_done, pixels) + pixels);
}

static void make_tiles(void *context, unsigned thread) {
    struct run *run = context;
    uint64_t rays[MONGE_RAY_KINDS] = {0};
    (void)thread;
    for (;;) {
        const uint32_t tile = atomic_fetch_add(&run->next_tile, 1);
        if (tile >= run->tile_count || is_cancelled(run->tiling)) break;
        make_tile(run, tile, rays);
    }
    for (int kind = 0; kind < MONGE_RAY_KINDS; kind++) atomic_fetch_add(&run->rays[kind], rays[kind]);
}

bool tiles_run(const struct tiling *tiling, struct monge_stats *stats) {
    const struct monge_region *region = &tiling->region;
    struct run run = {.tiling = tiling, .reporting = ATOMIC_FLAG_INIT};
    run.tiles_across = (region->width + TILE_SIZE - 1) / TILE_SIZE;
    run.tile_count = run.tiles_across * ((region->height + TILE_SIZE - 1) / TILE_SIZE);
    stats->threads = tiling->job->threads ? tiling->job->threads : parallel_processors();
    if (stats->threads > PARALLEL_MAX_THREADS) stats->threads = PARALLEL_MAX_THREADS;
    if (stats->threads > run.tile_count) stats->threads = run.tile_count;
    parallel_run(stats->threads, make_tiles, &run);
    for (int kind = 0; kind < MONGE_RAY_KINDS; kind++) stats->rays[kind] = run.rays[kind];
    return !is_cancelled(tiling);
}
