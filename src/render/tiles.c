#include "render/tiles.h"

#include "base/parallel.h"
#include "scene/origin.h"

#ifdef MONGE_HOSTILE
enum { TILE_SIZE = 1 };
#else
enum { TILE_SIZE = 32 }; /* pixels a side */
#endif
enum { MANY_RUNS = 128 };

/* In which tiles are made: in runs of `length`, from each to the one that is `step` further, round and round. */
struct order {
    uint32_t length, runs, step;
};

#define NO_INSTANCE UINT32_MAX

/* Shared by the threads. */
struct run {
    const struct tiling *tiling;
    uint32_t tiles_across, tile_count;
    struct order order;
    atomic_uint next_tile; /* counts them in that order */
    atomic_uint_fast64_t pixels_done;
    atomic_uint too_many_in; /* the number of an instance where a ray was given up; NO_INSTANCE: none */
    atomic_flag reporting;   /* a thread is in job->progress */
    atomic_uint_fast64_t rays[MONGE_RAY_KINDS];
};

/* Never waits: while one thread reports, the others go on. */
static void report(struct run *run, uint64_t done) {
    const struct tiling *tiling = run->tiling;
    if (!tiling->job->progress || atomic_flag_test_and_set(&run->reporting)) return;
    tiling->job->progress(tiling->job->context, done, (uint64_t)tiling->region.width * tiling->region.height);
    atomic_flag_clear(&run->reporting);
}

static bool is_stopped(struct run *run) {
    const atomic_bool *cancel = run->tiling->job->cancel;
    return (cancel && atomic_load(cancel)) || atomic_load(&run->too_many_in) != NO_INSTANCE;
}

/* Pixels of the region. */
static struct monge_region tile_region(const struct run *run, uint32_t tile) {
    const struct monge_region *region = &run->tiling->region;
    const uint32_t x = tile % run->tiles_across * TILE_SIZE, y = tile / run->tiles_across * TILE_SIZE;
    const uint32_t width = region->width - x, height = region->height - y;
    return (struct monge_region){x, y, width < TILE_SIZE ? width : TILE_SIZE,
                                 height < TILE_SIZE ? height : TILE_SIZE};
}

static void count_pixels(struct run *run, uint64_t pixels) {
    report(run, atomic_fetch_add(&run->pixels_done, pixels) + pixels);
}

/* Told of row by row: where there are few tiles, with many samples, one may take long. False: the watch has stopped. */
static bool make_pixels(struct run *run, const struct monge_region *tile, struct tracing *tracing) {
    const struct tiling *tiling = run->tiling;
    for (uint32_t y = tile->y; y < tile->y + tile->height; y++) {
        for (uint32_t x = tile->x; x < tile->x + tile->width; x++) {
            tiling->pixel(tiling->context, x, y, tracing);
            if (tracing->watch.stop != ACCEL_GOES_ON) return false;
        }
        count_pixels(run, tile->width);
    }
    return true;
}

/* Where somebody keeps the tiles: makes it only where it is not known. */
static void fill_tile(struct run *run, const struct monge_region *tile, struct tracing *tracing) {
    const struct tiling *tiling = run->tiling;
    const struct monge_tiles *tiles = tiling->rgb ? tiling->job->tiles : NULL;
    const struct monge_region *region = &tiling->region;
    const struct monge_region in_picture = {region->x + tile->x, region->y + tile->y, tile->width,
                                            tile->height};
    const size_t stride = 3 * (size_t)region->width;
    float *rgb = tiles ? tiling->rgb + tile->y * stride + 3 * (size_t)tile->x : NULL;
    if (tiles && tiles->known(tiles->context, &in_picture, rgb, stride))
        count_pixels(run, (uint64_t)tile->width * tile->height);
    else if (make_pixels(run, tile, tracing) && tiles)
        tiles->done(tiles->context, &in_picture, rgb, stride);
}

static uint32_t greatest_divisor(uint32_t a, uint32_t b) { return b == 0 ? a : greatest_divisor(b, a % b); }

/* Runs of neighbors, which need the same of the scene; runs that follow each other are far apart, so that those that are
 * done stand for all, be the sky ever so quick: the time that is left can be told. A step by the golden section spreads any
 * number of them; without a common divisor with their count it comes to each one. */
static struct order find_order(uint32_t tiles) {
    const uint32_t length = tiles / MANY_RUNS + 1, runs = (tiles + length - 1) / length;
    uint32_t step = (uint32_t)(0.6180339887498949 * runs) + 1;
    while (greatest_divisor(step, runs) != 1) step++;
    return (struct order){length, runs, step};
}

/* The tile that comes `next`; no smaller than their count: there is none. */
static uint32_t tile_of(const struct order *order, uint32_t next) {
    const uint64_t run = (uint64_t)(next / order->length) * order->step % order->runs;
    return (uint32_t)run * order->length + next % order->length;
}

static void make_tile(struct run *run, uint32_t number, struct tracing *tracing) {
    const struct monge_region tile = tile_region(run, number);
    fill_tile(run, &tile, tracing);
}

static void make_tiles(void *context, unsigned thread) {
    struct run *run = context;
    struct tracing tracing = {.watch.cancel = run->tiling->job->cancel};
    (void)thread;
    for (;;) {
        const uint32_t next = atomic_fetch_add(&run->next_tile, 1);
        if (next >= run->order.runs * run->order.length || is_stopped(run)) break;
        const uint32_t tile = tile_of(&run->order, next);
        if (tile < run->tile_count) make_tile(run, tile, &tracing);
    }
    if (tracing.watch.stop == ACCEL_TOO_MANY_ENTRIES) atomic_store(&run->too_many_in, tracing.watch.number);
    for (int kind = 0; kind < MONGE_RAY_KINDS; kind++) atomic_fetch_add(&run->rays[kind], tracing.rays[kind]);
}

static void report_entries(const struct scene *scene, struct diagnostics *diag, uint32_t number) {
    if (!diag) return;
    const struct span span = origins_span(&scene->origins, scene->primitives.info[number].origin);
    struct diagnostic *d =
        diag_error(diag, span, "limit-instances", "a ray comes into more than %d instances of templates here",
                   ACCEL_MAX_ENTRIES);
    diag_help(diag, d,
              "instances at one place multiply with each level: move them apart, or place one alone");
}

bool tiles_goes_on(const struct accel_watch *watch, const struct scene *scene, struct diagnostics *diag) {
    if (watch->stop == ACCEL_TOO_MANY_ENTRIES) report_entries(scene, diag, watch->number);
    return watch->stop == ACCEL_GOES_ON;
}

bool tiles_run(const struct tiling *tiling, struct monge_stats *stats) {
    const struct monge_region *region = &tiling->region;
    struct run run = {.tiling = tiling, .too_many_in = NO_INSTANCE, .reporting = ATOMIC_FLAG_INIT};
    run.tiles_across = (region->width + TILE_SIZE - 1) / TILE_SIZE;
    run.tile_count = run.tiles_across * ((region->height + TILE_SIZE - 1) / TILE_SIZE);
    run.order = find_order(run.tile_count);
    stats->threads = tiling->job->threads ? tiling->job->threads : parallel_processors();
    if (stats->threads > PARALLEL_MAX_THREADS) stats->threads = PARALLEL_MAX_THREADS;
    if (stats->threads > run.tile_count) stats->threads = run.tile_count;
    parallel_run(stats->threads, make_tiles, &run);
    for (int kind = 0; kind < MONGE_RAY_KINDS; kind++) stats->rays[kind] = run.rays[kind];
    const uint32_t too_many_in = atomic_load(&run.too_many_in);
    if (too_many_in != NO_INSTANCE) report_entries(tiling->scene, tiling->diag, too_many_in);
    return !is_stopped(&run);
}
