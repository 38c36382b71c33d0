#include "render/render.h"

#include "render/lights.h"
#include "render/tiles.h"

/* One rendering, shared by its threads. */
struct rendering {
    struct tracer tracer;
    struct view view;
    struct monge_film *film;
    const vec3 *samples;       /* settings.samples places within a pixel, x and y in 0..1 */
    struct media_origin media; /* at the eye, for a perspective camera */
};

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
        places[i] = (vec3){.x = (i + 0.5) / count, .y = radical_inverse(i) + 0.5 / cells};
    return places;
}

static void render_pixel(const void *context, uint32_t x, uint32_t y, struct tracing *tracing) {
    const struct rendering *rd = context;
    const struct monge_settings *s = &rd->tracer.settings;
    const struct monge_region *region = &rd->film->region;
    vec3 sum = {0, 0, 0};
    for (uint32_t i = 0; i < s->samples; i++) {
        const double px = ((double)(region->x + x) + rd->samples[i].x) / s->width;
        const double py = ((double)(region->y + y) + rd->samples[i].y) / s->height;
        const ray r = camera_ray(&rd->view, px, py);
        struct media_origin here;
        if (rd->view.orthographic) media_at(rd->tracer.scene, rd->tracer.accel, &tracing->watch, r, &here);
        sum = vec3_add(
            sum, trace_ray(&rd->tracer, r, rd->view.orthographic ? &here.media : &rd->media.media, tracing));
    }
    float *pixel = film_pixel(rd->film, x, y);
    pixel[0] = (float)(sum.x / s->samples);
    pixel[1] = (float)(sum.y / s->samples);
    pixel[2] = (float)(sum.z / s->samples);
}

bool render_film(const struct scene *scene, const struct accel *accel, const struct monge_job *job,
                 struct monge_film *film, struct monge_stats *stats, struct diagnostics *diag) {
    jmp_buf full;
    struct arena arena = {.on_full = &full};
    if (setjmp(full)) {
        arena_free(&arena);
        return false;
    }
    struct rendering rd = {.tracer = {.scene = scene, .accel = accel, .settings = film->settings},
                           .film = film};
    rd.view = camera_view(scene, accel, film->settings.width, film->settings.height);
    rd.samples = sample_places(&arena, film->settings.samples);
    struct accel_watch watch = {.cancel = job->cancel};
    media_at(scene, accel, &watch, (ray){rd.view.eye, rd.view.forward}, &rd.media);
    lights_set(&rd.tracer, &arena, &rd.view);
    const struct tiling tiling = {film->region, job, scene, diag, render_pixel, &rd, film->rgb};
    const bool done = tiles_goes_on(&watch, scene, diag) && tiles_run(&tiling, stats);
    arena_free(&arena);
    return done;
}
