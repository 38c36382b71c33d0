#include "render/render.h"

#include "base/parallel.h"
#include "render/camera.h"
#include "render/trace.h"

#ifdef MONGE_HOSTILE
enum { TILE_SIZE = 1 };
#else
enum { TILE_SIZE = 32 }; /* pixels a side */
#endif

/* One rendering, shared by its threads: each takes the next tile until none is left. */
struct rendering {
    struct tracer tracer;
    struct view view;
    const struct monge_job *job;
    struct monge_film *film;
    uint32_t tiles_across, tile_count;
    atomic_uint next_tile;
    atomic_uint_fast64_t pixels_done;
    atomic_flag reporting;     /* a thread is in job->progress */
    const vec3 *samples;       /* settings.samples places within a pixel, x and y in 0..1 */
    struct media_origin media; /* at the eye, for a perspective camera */
    atomic_uint_fast64_t rays[MONGE_RAY_KINDS];
};

/* ---- What is decided once ---- */

/* Van der Corput's sequence in base 2. */
static double radical_inverse(uint32_t i) {
    double result = 0.0;
    for (double digit = 0.5; i; i >>= 1, digit *= 0.5) result += i & 1 ? digit : 0.0;
    return result;
}

/* Hammersley's points, moved to the middle of their cells; one alone is the pixel's centre. */
static vec3 *sample_places(struct arena *arena, uint32_t count) {
    vec3 *places = arena_array(arena, count, sizeof *places);
    uint32_t cells = 1;
    while (cells < count) cells *= 2;
    for (uint32_t i = 0; i < count; i++)
        places[i] = (vec3){(i + 0.5) / count, radical_inverse(i) + 0.5 / cells, 0.0};
    return places;
}

/* A key light above the camera's left shoulder, so far away that it lights an endless floor evenly up to the
 * horizon, and a weak one in its eye, whose shadows it cannot see. */
static struct light *default_lights(struct arena *arena, const struct view *view, uint32_t *count) {
    struct light *lights = arena_array(arena, 2, sizeof *lights);
    const vec3 across =
        vec3_madd(vec3_scale(vec3_normalize(view->right), -0.6), 0.8, vec3_normalize(view->up));
    const vec3 to_key = vec3_scale(vec3_sub(across, view->forward), 1000.0 * view->distance);
    lights[0] = (struct light){LIGHT_POINT, vec3_add(view->eye, to_key), {0.95, 0.93, 0.9}};
    lights[1] = (struct light){LIGHT_POINT, view->eye, {0.15, 0.17, 0.2}};
    *count = 2;
    return lights;
}

static void set_lights(struct arena *arena, struct rendering *rd, const struct scene *scene) {
    struct tracer *tracer = &rd->tracer;
    if (scene->default_lights) {
        tracer->lights = default_lights(arena, &rd->view, &tracer->light_count);
        tracer->ambient = (vec3){0.12, 0.12, 0.13};
        return;
    }
    struct light *points = arena_array(arena, scene->light_count ? scene->light_count : 1, sizeof *points);
    for (uint32_t i = 0; i < scene->light_count; i++) {
        if (scene->lights[i].kind == LIGHT_POINT)
            points[tracer->light_count++] = scene->lights[i];
        else
            tracer->ambient = vec3_add(tracer->ambient, scene->lights[i].color);
    }
    tracer->lights = points;
}

/* ---- Tiles ---- */

static void render_pixel(const struct rendering *rd, uint32_t x, uint32_t y, uint64_t rays[MONGE_RAY_KINDS]) {
    const struct monge_settings *s = &rd->tracer.settings;
    const struct monge_region *region = &rd->film->region;
    vec3 sum = {0, 0, 0};
    for (uint32_t i = 0; i < s->samples; i++) {
        const double px = ((double)(region->x + x) + rd->samples[i].x) / s->width;
        const double py = ((double)(region->y + y) + rd->samples[i].y) / s->height;
        const ray r = camera_ray(&rd->view, px, py);
        struct media_origin here;
        if (rd->view.orthographic) media_at(rd->tracer.scene, rd->tracer.accel, r, &here);
        sum = vec3_add(
            sum, trace_ray(&rd->tracer, r, rd->view.orthographic ? &here.media : &rd->media.media, rays));
    }
    float *pixel = film_pixel(rd->film, x, y);
    pixel[0] = (float)(sum.x / s->samples);
    pixel[1] = (float)(sum.y / s->samples);
    pixel[2] = (float)(sum.z / s->samples);
}

/* Never waits: while one thread reports, the others go on. */
static void report(struct rendering *rd, uint64_t done) {
    if (!rd->job->progress || atomic_flag_test_and_set(&rd->reporting)) return;
    rd->job->progress(rd->job->context, done, (uint64_t)rd->film->region.width * rd->film->region.height);
    atomic_flag_clear(&rd->reporting);
}

static bool is_cancelled(const struct rendering *rd) {
    return rd->job->cancel && atomic_load(rd->job->cancel);
}

/* Pixels of the film, as are x and y of render_pixel. */
static struct monge_region tile_region(const struct rendering *rd, uint32_t tile) {
    const struct monge_region *film = &rd->film->region;
    const uint32_t x = tile % rd->tiles_across * TILE_SIZE, y = tile / rd->tiles_across * TILE_SIZE;
    const uint32_t width = film->width - x, height = film->height - y;
    return (struct monge_region){x, y, width < TILE_SIZE ? width : TILE_SIZE,
                                 height < TILE_SIZE ? height : TILE_SIZE};
}

/* False: cancelled. */
static bool render_pixels(const struct rendering *rd, const struct monge_region *tile,
                          uint64_t rays[MONGE_RAY_KINDS]) {
    for (uint32_t y = tile->y; y < tile->y + tile->height; y++)
        for (uint32_t x = tile->x; x < tile->x + tile->width; x++) {
            if (is_cancelled(rd)) return false;
            render_pixel(rd, x, y, rays);
        }
    return true;
}

/* Where somebody keeps the tiles: renders it only where it is not known. */
static bool fill_tile(const struct rendering *rd, const struct monge_region *tile,
                      uint64_t rays[MONGE_RAY_KINDS]) {
    const struct monge_tiles *tiles = rd->job->tiles;
    const struct monge_region *film = &rd->film->region;
    const struct monge_region in_picture = {film->x + tile->x, film->y + tile->y, tile->width, tile->height};
    const size_t stride = 3 * (size_t)film->width;
    float *rgb = film_pixel(rd->film, tile->x, tile->y);
    if (tiles && tiles->known(tiles->context, &in_picture, rgb, stride)) return true;
    if (!render_pixels(rd, tile, rays)) return false;
    if (tiles) tiles->done(tiles->context, &in_picture, rgb, stride);
    return true;
}

static void render_tile(struct rendering *rd, uint32_t number, uint64_t rays[MONGE_RAY_KINDS]) {
    const struct monge_region tile = tile_region(rd, number);
    const uint64_t pixels = (uint64_t)tile.width * tile.height;
    if (fill_tile(rd, &tile, rays)) report(rd, atomic_fetch_add(&rd->pixels_done, pixels) + pixels);
}

static void render_tiles(void *context, unsigned thread) {
    struct rendering *rd = context;
    uint64_t rays[MONGE_RAY_KINDS] = {0};
    (void)thread;
    for (;;) {
        const uint32_t tile = atomic_fetch_add(&rd->next_tile, 1);
        if (tile >= rd->tile_count || is_cancelled(rd)) break;
        render_tile(rd, tile, rays);
    }
    for (int kind = 0; kind < MONGE_RAY_KINDS; kind++) atomic_fetch_add(&rd->rays[kind], rays[kind]);
}

bool render_film(const struct scene *scene, const struct accel *accel, const struct monge_job *job,
                 struct monge_film *film, struct monge_stats *stats) {
    jmp_buf full;
    struct arena arena = {.on_full = &full};
    if (setjmp(full)) {
        arena_free(&arena);
        return false;
    }
    struct rendering rd = {.tracer = {.scene = scene, .accel = accel, .settings = film->settings},
                           .job = job,
                           .film = film,
                           .reporting = ATOMIC_FLAG_INIT};
    rd.view = camera_view(scene, accel, film->settings.width, film->settings.height);
    rd.samples = sample_places(&arena, film->settings.samples);
    media_at(scene, accel, (ray){rd.view.eye, rd.view.forward}, &rd.media);
    set_lights(&arena, &rd, scene);
    rd.tiles_across = (film->region.width + TILE_SIZE - 1) / TILE_SIZE;
    rd.tile_count = rd.tiles_across * ((film->region.height + TILE_SIZE - 1) / TILE_SIZE);

    stats->threads = job->threads ? job->threads : parallel_processors();
    if (stats->threads > PARALLEL_MAX_THREADS) stats->threads = PARALLEL_MAX_THREADS;
    if (stats->threads > rd.tile_count) stats->threads = rd.tile_count;
    parallel_run(stats->threads, render_tiles, &rd);
    for (int kind = 0; kind < MONGE_RAY_KINDS; kind++) stats->rays[kind] = rd.rays[kind];
    arena_free(&arena);
    return !is_cancelled(&rd);
}
