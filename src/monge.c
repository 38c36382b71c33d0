/* The library's face: ties the stations together. */
#include "monge.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "accel/accel.h"
#include "image/png.h"
#include "image/replace.h"
#include "lang/file.h"
#include "lang/format.h"
#include "lang/lang.h"
#include "render/render.h"
#include "scene/scene.h"

struct monge_diagnostics {
    struct diagnostics list;
};

struct monge_scene {
    struct arena arena; /* of the scene and its hierarchy */
    struct scene scene;
    struct accel *accel; /* NULL: not prepared */
};

const char *monge_version(void) { return MONGE_VERSION; }

/* ---- Diagnostics ---- */

struct monge_diagnostics *monge_diagnostics_new(void) { return calloc(1, sizeof(struct monge_diagnostics)); }

void monge_diagnostics_free(struct monge_diagnostics *diag) {
    if (diag) diag_free(&diag->list);
    free(diag);
}

unsigned monge_diagnostics_errors(const struct monge_diagnostics *diag) { return diag->list.errors; }
unsigned monge_diagnostics_warnings(const struct monge_diagnostics *diag) { return diag->list.warnings; }
unsigned monge_diagnostics_failures(const struct monge_diagnostics *diag) { return diag->list.failures; }
void monge_diagnostics_print(const struct monge_diagnostics *diag, FILE *out) { diag_print(&diag->list, out); }

/* ---- Loading ---- */

static const struct monge_limits default_limits = {
    .file_bytes = (size_t)1 << 30, .memory_bytes = (size_t)8 << 30, .values = 100 * 1000 * 1000, .nesting = 100};

static struct monge_limits effective_limits(const struct monge_limits *given) {
    struct monge_limits limits = given ? *given : default_limits;
    if (!limits.file_bytes) limits.file_bytes = default_limits.file_bytes;
    if (!limits.memory_bytes) limits.memory_bytes = default_limits.memory_bytes;
    if (!limits.values) limits.values = default_limits.values;
    if (!limits.nesting) limits.nesting = default_limits.nesting;
    return limits;
}

/* One load. The description and the text it points into die with it; the scene stays. */
struct load {
    struct monge_limits limits;
    struct diagnostics *diag;
    const char *name, *text; /* text NULL: the file `name` */
    size_t size;
    struct arena description;
    struct monge_scene *scene;
};

static bool load_scene(struct load *load) {
    struct monge_scene *scene = load->scene;
    const struct lang_limits limits = {load->limits.nesting, load->limits.values};
    struct diagnostics *diag = load->diag;
    const unsigned errors = diag->errors;
    const struct source *source = load->text ? file_from_memory(&load->description, load->name, load->text, load->size)
                                             : file_read(&load->description, diag, load->name, load->limits.file_bytes);
    if (!source) return false;
    const struct object_value *file = lang_read(&load->description, diag, source, &limits);
    return file && scene_build(&scene->arena, diag, file, &scene->scene) && diag->errors == errors;
}

/* Loads with arenas that come back here when they are full. */
static bool load_guarded(struct load *load) {
    jmp_buf full;
    load->description.on_full = load->scene->arena.on_full = &full;
    load->description.limit = load->scene->arena.limit = load->limits.memory_bytes;
    if (setjmp(full) == 0) return load_scene(load);
    diag_failure(load->diag, "limit-memory", "%s: takes more memory than there is, or than %zu bytes (the limit `memory_bytes`)",
                 load->name, load->limits.memory_bytes);
    return false;
}

static struct monge_scene *run_load(struct load *load) {
    load->scene = calloc(1, sizeof *load->scene);
    if (!load->scene) {
        diag_failure(load->diag, "out-of-memory", "%s: out of memory", load->name);
        return NULL;
    }
    const bool ok = load_guarded(load);
    arena_free(&load->description);
    load->scene->arena.on_full = NULL;
    load->scene->arena.limit = 0;
    if (ok) return load->scene;
    monge_scene_free(load->scene);
    return NULL;
}

struct monge_scene *monge_load_file(const char *path, const struct monge_limits *limits, struct monge_diagnostics *diag) {
    struct load load = {.limits = effective_limits(limits), .diag = &diag->list, .name = path};
    return run_load(&load);
}

struct monge_scene *monge_load_memory(const char *name, const char *text, size_t size, const struct monge_limits *limits,
                                      struct monge_diagnostics *diag) {
    struct load load = {.limits = effective_limits(limits), .diag = &diag->list, .name = name, .text = text, .size = size};
    return run_load(&load);
}

void monge_scene_free(struct monge_scene *scene) {
    if (scene) arena_free(&scene->arena);
    free(scene);
}

size_t monge_scene_primitives(const struct monge_scene *scene) { return scene->scene.primitives.count; }

static struct accel *scene_accel(struct monge_scene *scene) {
    const struct scene *s = &scene->scene;
    bool *clear = arena_array(&scene->arena, s->primitives.count, sizeof *clear);
    for (uint32_t i = 0; i < s->primitives.count; i++)
        clear[i] = vec3_max_abs(s->materials[s->primitives.info[i].material].refraction) > 0.0;
    return accel_build(&scene->arena, &s->primitives, clear);
}

bool monge_scene_prepare(struct monge_scene *scene) {
    jmp_buf full;
    if (scene->accel) return true;
    const struct arena_mark before = arena_mark(&scene->arena);
    scene->arena.on_full = &full;
    if (setjmp(full) == 0) scene->accel = scene_accel(scene);
    else arena_release(&scene->arena, before);
    scene->arena.on_full = NULL;
    return scene->accel != NULL;
}

/* ---- Formatting ---- */

void monge_text_free(struct monge_text *text) {
    free(text->bytes);
    *text = (struct monge_text){NULL, 0};
}

/* Reads `path`, or formats `given` where there is no path; the result is in the arena, NULL reported. */
static const char *read_or_format(struct arena *arena, struct diagnostics *diag, const struct monge_limits *limits, const char *path,
                                  const char *name, const struct monge_text *given, size_t *size) {
    if (!path) {
        const struct lang_limits lang_limits = {limits->nesting, limits->values};
        return format_text(arena, diag, file_from_memory(arena, name, given->bytes, given->size), &lang_limits, size);
    }
    const struct source *source = file_read_bytes(arena, diag, path, limits->file_bytes);
    *size = source ? source->size : 0;
    return source ? source->text : NULL;
}

/* The same as a text of its own. */
static bool make_text(struct diagnostics *diag, const struct monge_limits *given_limits, const char *path, const char *name,
                      const struct monge_text *given, struct monge_text *made) {
    const struct monge_limits limits = effective_limits(given_limits);
    struct arena arena = {.limit = limits.memory_bytes};
    jmp_buf full;
    size_t size = 0;
    *made = (struct monge_text){NULL, 0};
    arena.on_full = &full;
    if (setjmp(full) == 0) {
        const char *text = read_or_format(&arena, diag, &limits, path, name, given, &size);
        if (text) *made = (struct monge_text){malloc(size + 1), size};
        if (made->bytes) ((char *)memcpy(made->bytes, text, size))[size] = '\0';
        if (text && !made->bytes) diag_failure(diag, "out-of-memory", "%s: out of memory", name);
    } else {
        diag_failure(diag, "limit-memory", "%s: takes more memory than there is, or than %zu bytes (the limit `memory_bytes`)", name, limits.memory_bytes);
    }
    arena_free(&arena);
    return made->bytes != NULL;
}

bool monge_text_read(const char *path, const struct monge_limits *limits, struct monge_text *text, struct monge_diagnostics *diag) {
    return make_text(&diag->list, limits, path, path, NULL, text);
}

bool monge_format(const char *name, const struct monge_text *text, const struct monge_limits *limits, struct monge_text *formatted,
                  struct monge_diagnostics *diag) {
    return make_text(&diag->list, limits, NULL, name, text, formatted);
}

bool monge_text_write(const char *path, const struct monge_text *text, struct monge_diagnostics *diag) {
    struct replacement file;
    if (replace_begin(&file, path)) {
        fwrite(text->bytes, 1, text->size, file.stream);
        if (replace_commit(&file)) return true;
    }
    diag_failure(&diag->list, "cannot-write", "cannot write %s: %s", path, strerror(errno));
    return false;
}

/* ---- Settings ---- */

struct monge_settings monge_scene_settings(const struct monge_scene *scene) { return scene->scene.settings; }

/* ---- Rendering ---- */

static double seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static bool region_inside(const struct monge_region *r, const struct monge_settings *s) {
    return r->width >= 1 && r->height >= 1 && r->x < s->width && r->y < s->height && r->width <= s->width - r->x &&
           r->height <= s->height - r->y;
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

struct monge_film *monge_render(struct monge_scene *scene, const struct monge_settings *settings,
                                const struct monge_region *region, const struct monge_job *job, struct monge_stats *stats) {
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
    const bool done = render_film(&scene->scene, scene->accel, job ? job : &no_job, film, stats);
    stats->build_seconds = prepared_before ? 0.0 : built - begin;
    stats->render_seconds = seconds() - built;
    if (done) return film;
    monge_film_free(film);
    return NULL;
}

bool monge_film_write_png(const struct monge_film *film, const char *path, struct monge_diagnostics *diag) {
    char message[1024];
    if (png_write_film(film, path, message, sizeof message)) return true;
    diag_failure(&diag->list, "cannot-write", "%s", message);
    return false;
}
