/* The library's face: what is wrong, settings and rendering. Scenes are loaded in load.c. */
#include "monge.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/diag_write.h"
#include "base/json.h"
#include "base/parallel.h"
#include "base/program.h"
#include "base/wrap.h"
#include "face.h"
#include "image/pixels.h"
#include "image/png.h"
#include "lang/stories.h"
#include "render/layers.h"
#include "render/render.h"

const char *monge_version(void) { return MONGE_VERSION; }
const char *monge_program(void) { return program_hash; }

/* ---- Diagnostics ---- */

struct monge_diagnostics *monge_diagnostics_new(void) {
    return calloc(1, sizeof(struct monge_diagnostics));
}

void monge_diagnostics_free(struct monge_diagnostics *diag) {
    if (diag) diag_free(&diag->list);
    free(diag);
}

unsigned monge_diagnostics_errors(const struct monge_diagnostics *diag) { return diag->list.errors; }
unsigned monge_diagnostics_warnings(const struct monge_diagnostics *diag) { return diag->list.warnings; }
unsigned monge_diagnostics_failures(const struct monge_diagnostics *diag) { return diag->list.failures; }

/* One of the stories' codes, which are static. */
static const char *known_code(const char *code) {
    const struct diag_story *story = diag_find_story(stories, code);
    assert(story);
    return story->code;
}

void monge_diagnostics_fail(struct monge_diagnostics *diag, const char *code, const char *message) {
    diag_failure(&diag->list, known_code(code), "%s", message);
}

void monge_diagnostics_warn(struct monge_diagnostics *diag, const char *code, const char *message) {
    diag_warning(&diag->list, (struct span){0}, known_code(code), "%s", message);
}

void monge_diagnostics_append(struct monge_diagnostics *diag, const struct monge_diagnostics *from,
                              bool again) {
    diag_append(&diag->list, &from->list, again);
}

bool monge_diagnostics_take(struct monge_diagnostics *diag, struct monge_problem *first) {
    const struct diagnostic *d = diag_take(&diag->list);
    if (d)
        *first = (struct monge_problem){d->code, d->message, d->place.file, d->place.line, d->place.column};
    return d != NULL;
}

void monge_diagnostics_print(const struct monge_diagnostics *diag, FILE *out) {
    diag_print(&diag->list, out);
}
void monge_diagnostics_print_new(struct monge_diagnostics *diag, FILE *out) {
    diag_print_new(&diag->list, out);
}

void monge_diagnostics_write(const struct monge_diagnostics *diag, enum monge_format format, FILE *out) {
    switch (format) {
    case MONGE_FORMAT_TEXT: diag_print(&diag->list, out); break;
    case MONGE_FORMAT_JSON: diag_write_json(&diag->list, out); break;
    case MONGE_FORMAT_SARIF: diag_write_sarif(&diag->list, stories, MONGE_VERSION, out); break;
    }
}

const char *monge_code(size_t index) { return index < stories.count ? stories.first[index].code : NULL; }
const char *monge_code_summary(size_t index) {
    return index < stories.count ? stories.first[index].summary : NULL;
}

bool monge_explain(const char *code, FILE *out) {
    const struct diag_story *story = diag_find_story(stories, code);
    if (story) diag_explain(story, out);
    return story != NULL;
}

void monge_write_json_string(const char *text, FILE *out) { json_string(text, out); }
void monge_write_wrapped(const char *text, int column, int indent, FILE *out) {
    wrap_print(out, text, column, indent);
}

/* ---- Settings ---- */

struct monge_settings monge_scene_settings(const struct monge_scene *scene) {
    return scene->scene.settings;
}

/* ---- Rendering ---- */

static double seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static bool region_inside(const struct monge_region *r, const struct monge_settings *s) {
    return r->width >= 1 && r->height >= 1 && r->x < s->width && r->y < s->height &&
           r->width <= s->width - r->x && r->height <= s->height - r->y;
}

/* Of all that can change a pixel, and nothing else. */
static struct hash fingerprint(const struct scene *scene, const struct monge_settings *s) {
    struct hash hash;
    hash_begin(&hash);
    scene_hash(scene, &hash);
    const uint64_t numbers[] = {s->width, s->height, s->samples, s->bits, s->encoding, s->shading, s->depth};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) hash_integer(&hash, numbers[i]);
    hash_double(&hash, s->shadow);
    return hash;
}

unsigned monge_processors(void) { return parallel_processors(); }

void monge_scene_hash(const struct monge_scene *scene, const struct monge_settings *settings,
                      char hash[MONGE_HASH_SIZE]) {
    const struct hash made = fingerprint(&scene->scene, settings);
    hash_text(&made, hash);
}

/* What its picture says of the scene and of how it was asked for. */
static bool stamp_film(struct monge_film *film, const struct monge_scene *scene,
                       const struct monge_job *job) {
    film->files = strdup(scene->included);
    film->options = strdup(job && job->options ? job->options : "");
    return film->files && film->options;
}

struct monge_film *monge_render(struct monge_scene *scene, const struct monge_settings *settings,
                                const struct monge_region *region, const struct monge_job *job,
                                struct monge_stats *stats) {
    const struct monge_job no_job = {0};
    const struct monge_region whole = {0, 0, settings->width, settings->height};
    struct monge_stats no_stats;
    if (!stats) stats = &no_stats;
    *stats = (struct monge_stats){0};
    if (monge_settings_check(settings) || !region_inside(region ? region : &whole, settings)) return NULL;

    const double begin = seconds();
    const bool prepared_before = scene->accel != NULL;
    if (!monge_scene_prepare(scene)) return NULL;
    const double built = seconds();
    struct monge_film *film = film_new(settings, region ? *region : whole);
    if (!film) return NULL;
    film->scene = fingerprint(&scene->scene, settings);
    film->texts = scene->texts_hash;
    const bool done =
        stamp_film(film, scene, job) && render_film(&scene->scene, scene->accel, job ? job : &no_job, film,
                                                    stats, job && job->diag ? &job->diag->list : NULL);
    stats->build_seconds = prepared_before ? 0.0 : built - begin;
    stats->render_seconds = seconds() - built;
    if (done) return film;
    if (job && job->tiles) job->tiles->stopped(job->tiles->context);
    monge_film_free(film);
    return NULL;
}

bool monge_film_note_passes(struct monge_film *film, const char *passes) {
    free(film->passes);
    film->passes = strdup(passes);
    return film->passes != NULL;
}

bool monge_film_write_png(const struct monge_film *film, const char *path, struct monge_diagnostics *diag) {
    char message[1024];
    if (png_write_film(film, path, message, sizeof message)) return true;
    diag_failure(&diag->list, "cannot-write", "%s", message);
    return false;
}

bool monge_film_hash(const struct monge_film *film, char hash[MONGE_HASH_SIZE]) {
    struct hash pixels;
    const bool good = pixels_hash_film(film, &pixels);
    if (good) hash_text(&pixels, hash);
    return good;
}

void monge_film_scene_hash(const struct monge_film *film, char hash[MONGE_HASH_SIZE]) {
    hash_text(&film->scene, hash);
}

/* The shapes of a scene, with their materials. */
static struct hash hash_objects(const struct scene *scene) {
    struct hash hash;
    const struct scene objects = {.materials = scene->materials,
                                  .primitives = scene->primitives,
                                  .geometries = scene->geometries,
                                  .geometry_count = scene->geometry_count};
    hash_begin(&hash);
    scene_hash(&objects, &hash);
    return hash;
}

/* What made the picture: all of it, and the camera apart from the rest. */
static void stamp_layers(struct monge_layers *layers, const struct scene *scene,
                         const struct monge_settings *settings) {
    struct scene others = *scene;
    struct hash given, hash = fingerprint(scene, settings);
    hash_text(&hash, layers->scene);
    others.camera = (struct camera){.projection = CAMERA_PERSPECTIVE};
    hash = fingerprint(&others, settings);
    hash_text(&hash, layers->camera.others);
    hash = hash_objects(scene);
    hash_text(&hash, layers->camera.objects);
    hash_begin(&given);
    camera_hash(&scene->camera, &given);
    hash_text(&given, layers->camera.given);
}

struct monge_layers *monge_render_layers(struct monge_scene *scene, const struct monge_settings *settings,
                                         const struct monge_region *region, unsigned wanted,
                                         const struct monge_job *job) {
    const struct monge_job no_job = {0};
    const struct monge_region whole = {0, 0, settings->width, settings->height};
    if (!region) region = &whole;
    if (monge_settings_check(settings) || !region_inside(region, settings)) return NULL;
    if (!monge_scene_prepare(scene)) return NULL;
    struct monge_layers *layers = layers_new(settings->width, settings->height, *region, wanted);
    if (!layers) return NULL;
    stamp_layers(layers, &scene->scene, settings);
    if (render_layers(&scene->scene, scene->accel, settings, job ? job : &no_job, layers,
                      job && job->diag ? &job->diag->list : NULL))
        return layers;
    monge_layers_free(layers);
    return NULL;
}
