/* The library's face: ties the stations together. */
#include "monge.h"

#include <assert.h>
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
#include "lang/format.h"
#include "lang/import.h"
#include "lang/lang.h"
#include "lang/stories.h"
#include "render/examine.h"
#include "render/info.h"
#include "render/render.h"
#include "scene/scene.h"

struct monge_diagnostics {
    struct diagnostics list;
};

/* The part of `scene` that a later frame made lives in `view`; what it could keep, in `body` as before. */
struct monge_scene {
    struct arena body, view;
    struct scene scene;
    struct accel *accel; /* in `body`; NULL: not prepared */
    /* Of an animation, else empty: */
    struct arena texts;        /* its files, and what `input` points to */
    struct lang_input input;   /* to read it again */
    struct lang_files files;
    size_t memory_bytes;       /* for that */
    struct lang_memory memory; /* of the reading, where only the file itself depends on the frame */
    struct lang_result result; /* in `memory` */
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
void monge_diagnostics_print_new(struct monge_diagnostics *diag, FILE *out) { diag_print_new(&diag->list, out); }

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
    .recursion = 100, .steps = 10 * 1000 * 1000, .objects = 20 * 1000 * 1000};

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

/* One load. */
struct load {
    struct monge_load_options options; /* limits: effective */
    struct diagnostics *diag;
    const char *name, *text; /* text NULL: the file `name` */
    size_t size;
    struct monge_scene *scene;
};

static const struct source *read_source(struct load *load) {
    if (load->text) return file_from_memory(&load->scene->texts, load->name, load->text, load->size);
    return file_read(&load->scene->texts, load->diag, load->name, load->options.limits.file_bytes);
}

static const char *copy_text(struct arena *arena, const char *text) { return arena_text(arena, text, strlen(text)); }

static const struct lang_define *copy_defines(struct load *load) {
    struct arena *arena = &load->scene->texts;
    struct lang_define *defines = arena_array(arena, load->options.define_count + 1, sizeof *defines);
    for (size_t i = 0; i < load->options.define_count; i++) {
        const struct monge_define *given = &load->options.defines[i];
        defines[i] = (struct lang_define){copy_text(arena, given->name), copy_text(arena, given->value)};
    }
    return defines;
}

static bool read_input(struct load *load) {
    struct monge_scene *scene = load->scene;
    const struct source *source = read_source(load);
    if (!source) return false;
    scene->files.arena = &scene->texts;
    scene->memory_bytes = load->options.limits.memory_bytes;
    scene->input = (struct lang_input){
        .source = source,
        .path = copy_text(&scene->texts, load->name),
        .limits = lang_limits(&load->options.limits),
        .defines = copy_defines(load),
        .define_count = load->options.define_count,
        .frame = load->options.frame,
        .untrusted = load->options.untrusted,
        .files = &scene->files,
    };
    return true;
}

/* Reads all of the input into a scene of its own; *result lives in `memory`. outline: NULL where none is wanted. */
static bool read_all(struct lang_input input, struct outline **outline, struct diagnostics *diag, struct lang_memory *memory, struct arena *arena, struct scene *scene,
                     struct lang_result *result) {
    const unsigned errors = diag->errors;
    struct lang_sink sink;
    struct builder *builder = scene_begin(arena, diag, scene, &sink);
    if (outline) *outline = outline_begin(arena, diag, &sink);
    input.sink = &sink;
    *result = lang_read(memory, diag, &input);
    return result->file && scene_end(builder, result) && diag->errors == errors;
}

static bool load_scene(struct load *load) {
    struct monge_scene *scene = load->scene;
    return read_input(load) && read_all(scene->input, load->options.outline ? &scene->outline : NULL, load->diag, &scene->memory, &scene->body, &scene->scene, &scene->result);
}

static void report_full(struct diagnostics *diag, const char *name, size_t memory_bytes) {
    diag->frame = NULL; /* what was under way is over */
    diag_failure(diag, "limit-memory", "%s: takes more memory than there is, or than %zu bytes (the limit `memory_bytes`)", name, memory_bytes);
}

/* Loads with arenas that come back here when they are full. */
static bool load_guarded(struct load *load) {
    jmp_buf full;
    struct arena *nodes = &load->scene->memory.nodes;
    nodes->on_full = &full;
    nodes->limit = load->options.limits.memory_bytes;
    load->scene->body.parent = load->scene->texts.parent = nodes;
    if (setjmp(full) == 0) return load_scene(load);
    report_full(load->diag, load->name, load->options.limits.memory_bytes);
    return false;
}

/* What came from the caller's memory must stay: for other frames. */
static void keep_text(struct monge_scene *scene) {
    const struct source *given = scene->input.source;
    struct source *source = arena_alloc(&scene->texts, sizeof *source);
    *source = (struct source){given->name, arena_text(&scene->texts, given->text, given->size), given->size};
    *(struct source *)given = *source; /* spans point to it */
    scene->input.source = source;
}

/* Frees what no other frame needs. */
static void keep_for_frames(struct load *load) {
    struct monge_scene *scene = load->scene;
    scene->memory.nodes.on_full = NULL;
    scene->body.parent = scene->texts.parent = NULL;
    const bool moving = scene->result.frames > 1;
    if (!moving || scene->result.moves) lang_memory_free(&scene->memory);
    if (!moving) arena_free(&scene->texts);
    else if (load->text) keep_text(scene);
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
    keep_for_frames(load);
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

/* ---- Other frames ---- */

unsigned monge_scene_frames(const struct monge_scene *scene) { return scene->result.frames; }

/* The next frame while it is made: its memory, and what in it is new. */
struct frame_load {
    struct monge_scene *scene;
    struct diagnostics *diag;
    unsigned frame;
    struct lang_memory memory; /* of a reading of all; empty where only the file is read again */
    struct arena arena;
    struct scene made;
};

/* Only what the file itself says of settings, camera and lights. */
static bool make_view(struct frame_load *next) {
    struct monge_scene *scene = next->scene;
    next->made = scene->scene;
    lang_read_frame(&scene->result, next->diag, next->frame);
    return scene->result.file && scene_view(&next->arena, next->diag, scene->result.file, &next->made);
}

static bool make_all(struct frame_load *next) {
    struct lang_input input = next->scene->input;
    struct lang_result result;
    input.frame = next->frame;
    return read_all(input, NULL, next->diag, &next->memory, &next->arena, &next->made, &result);
}

static bool make_frame(struct frame_load *next) {
    struct monge_scene *scene = next->scene;
    struct arena *root = scene->result.moves ? &next->memory.nodes : &scene->memory.nodes;
    jmp_buf full;
    root->on_full = &full;
    root->limit = scene->memory_bytes;
    next->arena.parent = scene->texts.parent = root;
    volatile bool good = false;
    if (setjmp(full) == 0) good = scene->result.moves ? make_all(next) : make_view(next);
    else report_full(next->diag, scene->input.path, scene->memory_bytes);
    root->on_full = NULL;
    scene->texts.parent = NULL;
    if (!good) arena_free(&next->arena);
    if (scene->result.moves) next->arena.parent = NULL;
    lang_memory_free(&next->memory);
    return good;
}

/* The new frame takes the place of the one before, whose primitives and hierarchy stay where they serve. */
static void take_frame(struct monge_scene *scene, const struct frame_load *next) {
    const bool kept = !scene->result.moves || (scene->accel && scene_same_shapes(&scene->scene, &next->made));
    const struct scene before = scene->scene;
    arena_free(&scene->view);
    scene->scene = next->made;
    if (kept) {
        scene->view = next->arena;
        scene->scene.primitives = before.primitives;
        scene->scene.geometries = before.geometries;
        return;
    }
    arena_free(&scene->body);
    scene->body = next->arena;
    scene->view = (struct arena){0};
    scene->accel = NULL;
}

bool monge_scene_set_frame(struct monge_scene *scene, unsigned frame, struct monge_diagnostics *diag) {
    struct frame_load next = {.scene = scene, .diag = &diag->list, .frame = frame};
    assert(frame >= 1 && frame <= scene->result.frames);
    diag_begin_again(&diag->list);
    const bool good = make_frame(&next);
    diag->list.frame = NULL;
    if (good) take_frame(scene, &next);
    return good;
}

void monge_scene_free(struct monge_scene *scene) {
    if (!scene) return;
    arena_free(&scene->view);
    arena_free(&scene->body);
    arena_free(&scene->texts);
    lang_memory_free(&scene->memory);
    free(scene);
}

size_t monge_scene_primitives(const struct monge_scene *scene) { return scene->scene.primitives.count; }

static struct accel *scene_accel(struct monge_scene *scene) {
    const struct scene *s = &scene->scene;
    bool *clear = arena_array(&scene->body, s->material_count, sizeof *clear);
    for (uint32_t i = 0; i < s->material_count; i++) clear[i] = vec3_max_abs(s->materials[i].refraction) > 0.0;
    return accel_build(&scene->body, &s->primitives, s->geometries, s->geometry_count, clear);
}

bool monge_scene_prepare(struct monge_scene *scene) {
    jmp_buf full;
    if (scene->accel) return true;
    scene->built_bytes = scene->body.total;
    const struct arena_mark before = arena_mark(&scene->body);
    scene->body.on_full = &full;
    if (setjmp(full) == 0) scene->accel = scene_accel(scene);
    else arena_release(&scene->body, before);
    scene->body.on_full = NULL;
    return scene->accel != NULL;
}

void monge_scene_examine(struct monge_scene *scene, struct monge_diagnostics *diag) {
    jmp_buf full;
    struct arena scratch = {.on_full = &full};
    if (!monge_scene_prepare(scene)) return;
    if (setjmp(full) == 0) examine_scene(&scene->scene, scene->accel, scene->result.frames > 0, &scratch, &diag->list);
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
    info.accel_bytes = scene->body.total - scene->built_bytes;
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
