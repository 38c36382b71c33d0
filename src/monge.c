/* The library's face: ties the stations together. */
#include "monge.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "accel/accel.h"
#include "base/diag_write.h"
#include "base/json.h"
#include "image/png.h"
#include "image/replace.h"
#include "lang/file.h"
#include "lang/import.h"
#include "lang/format.h"
#include "lang/lang.h"
#include "lang/stories.h"
#include "render/examine.h"
#include "render/info.h"
#include "render/render.h"
#include "scene/scene.h"

struct monge_diagnostics {
    struct diagnostics list;
};

struct monge_scene {
    struct arena arena; /* of the scene and its hierarchy */
    struct scene scene;
    struct accel *accel; /* NULL: not prepared */
    unsigned frames;     /* of its animation; 0: none */
    struct outline *outline; /* NULL: not wanted */
    size_t built_bytes;      /* of the scene, without the hierarchy */
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

void monge_diagnostics_write(const struct monge_diagnostics *diag, enum monge_format format, FILE *out) {
    switch (format) {
    case MONGE_FORMAT_TEXT: diag_print(&diag->list, out); break;
    case MONGE_FORMAT_JSON: diag_write_json(&diag->list, out); break;
    case MONGE_FORMAT_SARIF: diag_write_sarif(&diag->list, stories, MONGE_VERSION, out); break;
    }
}

const char *monge_code(size_t index) { return index < stories.count ? stories.first[index].code : NULL; }
const char *monge_code_summary(size_t index) { return index < stories.count ? stories.first[index].summary : NULL; }

bool monge_explain(const char *code, FILE *out) {
    const struct diag_story *story = diag_find_story(stories, code);
    if (story) diag_explain(story, out);
    return story != NULL;
}

void monge_write_json_string(const char *text, FILE *out) { json_string(text, out); }

/* ---- Loading ---- */

static const struct monge_limits default_limits = {
    .file_bytes = (size_t)1 << 30, .memory_bytes = (size_t)8 << 30, .values = 100 * 1000 * 1000, .nesting = 100,
    .recursion = 100, .steps = 100 * 1000 * 1000, .objects = 20 * 1000 * 1000};

enum { MAX_NESTING = 1000, MAX_RECURSION = 1000 }; /* what the stack of a thread has room for */

static size_t chosen(size_t wanted, size_t otherwise) { return wanted ? wanted : otherwise; }
static size_t least(size_t a, size_t b) { return a < b ? a : b; }

static struct monge_limits effective_limits(const struct monge_limits *given) {
    if (!given) return default_limits;
    return (struct monge_limits){
        .file_bytes = chosen(given->file_bytes, default_limits.file_bytes),
        .memory_bytes = chosen(given->memory_bytes, default_limits.memory_bytes),
        .values = chosen(given->values, default_limits.values),
        .nesting = least(chosen(given->nesting, default_limits.nesting), MAX_NESTING),
        .recursion = least(chosen(given->recursion, default_limits.recursion), MAX_RECURSION),
        .steps = chosen(given->steps, default_limits.steps),
        .objects = chosen(given->objects, default_limits.objects),
    };
}

static struct lang_limits lang_limits(const struct monge_limits *limits) {
    return (struct lang_limits){.file_bytes = limits->file_bytes,
                                .nesting = (unsigned)limits->nesting,
                                .values = limits->values,
                                .recursion = (unsigned)limits->recursion,
                                .steps = limits->steps,
                                .objects = limits->objects};
}

/* One load. The description and the text it points into die with it; the scene stays. */
struct load {
    struct monge_load_options options; /* limits: effective */
    struct diagnostics *diag;
    const char *name, *text; /* text NULL: the file `name` */
    size_t size;
    struct lang_memory memory;
    struct monge_scene *scene;
};

static const struct source *read_source(struct load *load) {
    if (load->text) return file_from_memory(&load->memory.nodes, load->name, load->text, load->size);
    return file_read(&load->memory.nodes, load->diag, load->name, load->options.limits.file_bytes);
}

/* monge_define and lang_define have the same members. */
static const struct lang_define *lang_defines(struct load *load) {
    struct lang_define *defines = arena_array(&load->memory.nodes, load->options.define_count + 1, sizeof *defines);
    for (size_t i = 0; i < load->options.define_count; i++)
        defines[i] = (struct lang_define){load->options.defines[i].name, load->options.defines[i].value};
    return defines;
}

static bool load_scene(struct load *load) {
    struct monge_scene *scene = load->scene;
    const unsigned errors = load->diag->errors;
    const struct source *source = read_source(load);
    if (!source) return false;
    struct lang_sink sink;
    struct builder *builder = scene_begin(&scene->arena, load->diag, &scene->scene, &sink);
    if (load->options.outline) scene->outline = outline_begin(&scene->arena, load->diag, &sink);
    const struct lang_input input = {
        .source = source,
        .path = load->name,
        .limits = lang_limits(&load->options.limits),
        .defines = lang_defines(load),
        .define_count = load->options.define_count,
        .frame = load->options.frame,
        .untrusted = load->options.untrusted,
        .sink = &sink,
    };
    const struct lang_result result = lang_read(&load->memory, load->diag, &input);
    scene->frames = result.frames;
    return result.file && scene_end(builder, &result) && load->diag->errors == errors;
}

/* Loads with arenas that come back here when they are full. */
static bool load_guarded(struct load *load) {
    jmp_buf full;
    load->memory.nodes.on_full = &full;
    load->memory.nodes.limit = load->options.limits.memory_bytes;
    load->scene->arena.parent = &load->memory.nodes;
    if (setjmp(full) == 0) return load_scene(load);
    diag_failure(load->diag, "limit-memory", "%s: takes more memory than there is, or than %zu bytes (the limit `memory_bytes`)",
                 load->name, load->options.limits.memory_bytes);
    return false;
}

static struct monge_load_options load_options(const struct monge_load_options *given) {
    const struct monge_load_options none = {.frame = 0};
    return given ? *given : none;
}

static struct monge_scene *run_load(struct load *load) {
    diag_begin(load->diag);
    load->scene = calloc(1, sizeof *load->scene);
    if (!load->scene) {
        diag_failure(load->diag, "out-of-memory", "%s: out of memory", load->name);
        return NULL;
    }
    load->options.limits = effective_limits(&load->options.limits);
    const bool ok = load_guarded(load);
    load->diag->frame = NULL;
    load->scene->arena.parent = NULL;
    lang_memory_free(&load->memory);
    if (ok) return load->scene;
    monge_scene_free(load->scene);
    return NULL;
}

struct monge_scene *monge_load_file(const char *path, const struct monge_load_options *options, struct monge_diagnostics *diag) {
    struct load load = {.options = load_options(options), .diag = &diag->list, .name = path};
    return run_load(&load);
}

struct monge_scene *monge_load_memory(const char *name, const char *text, size_t size, const struct monge_load_options *options,
                                      struct monge_diagnostics *diag) {
    struct load load = {.options = load_options(options), .diag = &diag->list, .name = name, .text = text, .size = size};
    return run_load(&load);
}

unsigned monge_scene_frames(const struct monge_scene *scene) { return scene->frames; }

void monge_scene_free(struct monge_scene *scene) {
    if (scene) arena_free(&scene->arena);
    free(scene);
}

size_t monge_scene_primitives(const struct monge_scene *scene) { return scene->scene.primitives.count; }

static struct accel *scene_accel(struct monge_scene *scene) {
    const struct scene *s = &scene->scene;
    bool *clear = arena_array(&scene->arena, s->material_count, sizeof *clear);
    for (uint32_t i = 0; i < s->material_count; i++) clear[i] = vec3_max_abs(s->materials[i].refraction) > 0.0;
    return accel_build(&scene->arena, &s->primitives, s->geometries, s->geometry_count, clear);
}

bool monge_scene_prepare(struct monge_scene *scene) {
    jmp_buf full;
    if (scene->accel) return true;
    scene->built_bytes = scene->arena.total;
    const struct arena_mark before = arena_mark(&scene->arena);
    scene->arena.on_full = &full;
    if (setjmp(full) == 0) scene->accel = scene_accel(scene);
    else arena_release(&scene->arena, before);
    scene->arena.on_full = NULL;
    return scene->accel != NULL;
}

void monge_scene_examine(struct monge_scene *scene, struct monge_diagnostics *diag) {
    jmp_buf full;
    struct arena scratch = {.on_full = &full};
    if (!monge_scene_prepare(scene)) return;
    if (setjmp(full) == 0) examine_scene(&scene->scene, scene->accel, scene->frames > 0, &scratch, &diag->list);
    arena_free(&scratch);
}

bool monge_scene_info(struct monge_scene *scene, enum monge_format format, FILE *out) {
    jmp_buf full;
    struct arena scratch = {.on_full = &full};
    if (!monge_scene_prepare(scene)) return false;
    if (setjmp(full)) {
        arena_free(&scratch);
        return false;
    }
    struct info info = info_count(&scene->scene, &scratch);
    info.scene_bytes = scene->built_bytes;
    info.accel_bytes = scene->arena.total - scene->built_bytes;
    (format == MONGE_FORMAT_TEXT ? info_print : info_write_json)(&info, &scene->scene, scene->accel, scene->outline, out);
    arena_free(&scratch);
    return true;
}

/* ---- Importing ---- */

static bool write_text(const char *text, const char *path, struct diagnostics *diag) {
    struct replacement file;
    if (replace_begin(&file, path)) {
        fputs(text, file.stream);
        if (replace_commit(&file)) return true;
    }
    diag_failure(diag, "cannot-write", "cannot write %s: %s", strcmp(path, "-") == 0 ? "standard output" : path, strerror(errno));
    return false;
}

static bool import_text(struct arena *arena, const char *path, const char *out_path, const struct monge_limits *limits,
                        struct diagnostics *diag) {
    const struct lang_limits within = lang_limits(limits);
    const struct source *source = file_read(arena, diag, path, limits->file_bytes);
    const char *text = source ? lang_import(arena, diag, source, &within) : NULL;
    return text && write_text(text, out_path, diag);
}

bool monge_import(const char *path, const char *out_path, const struct monge_limits *given, struct monge_diagnostics *diag) {
    const struct monge_limits limits = effective_limits(given);
    jmp_buf full;
    struct arena arena = {.limit = limits.memory_bytes, .on_full = &full};
    volatile bool done = false;
    if (setjmp(full) == 0) {
        done = import_text(&arena, path, out_path, &limits, &diag->list);
    } else {
        diag_failure(&diag->list, "limit-memory", "%s: takes more memory than there is, or than %zu bytes (the limit `memory_bytes`)",
                     path, limits.memory_bytes);
    }
    arena_free(&arena);
    return done;
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
        const struct lang_limits within = lang_limits(limits);
        return format_text(arena, diag, file_from_memory(arena, name, given->bytes, given->size), &within, size);
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
