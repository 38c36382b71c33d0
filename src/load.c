/* The library's face: from files to a scene, and from frame to frame. */
#include "face.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

#include "lang/file.h"
#include "lang/texts.h"
#include "render/examine.h"
#include "render/info.h"

/* ---- Limits ---- */

static const struct monge_limits default_limits = {.file_bytes = (size_t)1 << 30,
                                                   .memory_bytes = (size_t)8 << 30,
                                                   .values = 100 * 1000 * 1000,
                                                   .nesting = 100,
                                                   .recursion = 100,
                                                   .steps = 10 * 1000 * 1000,
                                                   .objects = 20 * 1000 * 1000};

enum { MAX_NESTING = 1000, MAX_RECURSION = 1000 }; /* what the stack of a thread has room for */

static size_t chosen(size_t wanted, size_t otherwise) { return wanted ? wanted : otherwise; }
static size_t least(size_t a, size_t b) { return a < b ? a : b; }

struct monge_limits face_limits(const struct monge_limits *given) {
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

struct lang_limits face_lang_limits(const struct monge_limits *limits) {
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

static const char *copy_text(struct arena *arena, const char *text) {
    return arena_text(arena, text, strlen(text));
}

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
        .limits = face_lang_limits(&load->options.limits),
        .defines = copy_defines(load),
        .define_count = load->options.define_count,
        .frame = load->options.frame,
        .untrusted = load->options.untrusted,
        .files = &scene->files,
    };
    return true;
}

/* Reads all of the input into a scene of its own; *result lives in `memory`. outline: NULL where none is wanted. */
static bool read_all(struct lang_input input, struct outline **outline, struct diagnostics *diag,
                     struct lang_memory *memory, struct arena *arena, struct scene *scene,
                     struct lang_result *result) {
    const unsigned errors = diag->errors;
    struct lang_sink sink;
    struct builder *builder = scene_begin(arena, diag, scene, &sink);
    if (outline) *outline = outline_begin(arena, diag, &sink);
    input.sink = &sink;
    *result = lang_read(memory, diag, &input);
    return result->file && scene_end(builder, result) && diag->errors == errors;
}

/* What it says of its tests: to stay when the text goes. */
static bool keep_tolerance(struct load *load) {
    struct monge_tolerance *tolerance = &load->scene->tolerance;
    const struct object_value *object = object_object(load->scene->result.file, KEY_FILE_TOLERANCE);
    if (!object) return true;
    const bool good = face_tolerance(load->diag, object, tolerance);
    const size_t size = good ? strlen(tolerance->reason) + 1 : 0;
    char *reason = good ? malloc(size) : NULL;
    tolerance->reason = reason ? memcpy(reason, tolerance->reason, size) : NULL;
    if (good && !reason) diag_failure(load->diag, "out-of-memory", "%s: out of memory", load->name);
    return tolerance->reason;
}

static bool load_scene(struct load *load) {
    struct monge_scene *scene = load->scene;
    if (!read_input(load) ||
        !read_all(scene->input, load->options.outline ? &scene->outline : NULL, load->diag, &scene->memory,
                  &scene->body, &scene->scene, &scene->result) ||
        !keep_tolerance(load))
        return false;
    scene->texts_hash = texts_hash(&scene->result);
    scene->included = texts_files(&scene->result);
    if (!scene->included) diag_failure(load->diag, "out-of-memory", "%s: out of memory", load->name);
    return scene->included != NULL;
}

void face_report_full(struct diagnostics *diag, const char *name, size_t memory_bytes) {
    diag->frame = NULL; /* what was under way is over */
    diag_failure(diag, "limit-memory",
                 "%s: takes more memory than there is, or than %zu bytes (the limit `memory_bytes`)", name,
                 memory_bytes);
}

/* Loads with arenas that come back here when they are full. */
static bool load_guarded(struct load *load) {
    jmp_buf full;
    struct arena *nodes = &load->scene->memory.nodes;
    nodes->on_full = &full;
    nodes->limit = load->options.limits.memory_bytes;
    load->scene->body.parent = load->scene->texts.parent = nodes;
    if (setjmp(full) == 0) return load_scene(load);
    face_report_full(load->diag, load->name, load->options.limits.memory_bytes);
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
    if (!moving)
        arena_free(&scene->texts);
    else if (load->text)
        keep_text(scene);
}

static struct monge_load_options load_options(const struct monge_load_options *given) {
    const struct monge_load_options none = {.frame = 0};
    return given ? *given : none;
}

static struct monge_scene *run_load(struct load *load) {
    if (load->options.again)
        diag_begin_again(load->diag);
    else
        diag_begin(load->diag);
    load->scene = calloc(1, sizeof *load->scene);
    if (!load->scene) {
        diag_failure(load->diag, "out-of-memory", "%s: out of memory", load->name);
        return NULL;
    }
    load->options.limits = face_limits(&load->options.limits);
    const bool ok = load_guarded(load);
    load->diag->frame = NULL;
    keep_for_frames(load);
    if (ok) return load->scene;
    monge_scene_free(load->scene);
    return NULL;
}

struct monge_scene *monge_load_file(const char *path, const struct monge_load_options *options,
                                    struct monge_diagnostics *diag) {
    struct load load = {.options = load_options(options), .diag = &diag->list, .name = path};
    return run_load(&load);
}

struct monge_scene *monge_load_memory(const char *name, const char *text, size_t size,
                                      const struct monge_load_options *options,
                                      struct monge_diagnostics *diag) {
    struct load load = {
        .options = load_options(options), .diag = &diag->list, .name = name, .text = text, .size = size};
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
    if (setjmp(full) == 0)
        good = scene->result.moves ? make_all(next) : make_view(next);
    else
        face_report_full(next->diag, scene->input.path, scene->memory_bytes);
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
    free(scene->included);
    free((char *)scene->tolerance.reason);
    free(scene);
}

bool monge_files_hash(const char *path, const char *files, const struct monge_limits *limits,
                      struct monge_diagnostics *diag, char hash[MONGE_HASH_SIZE]) {
    struct hash now;
    const bool good = texts_hash_again(path, files, face_limits(limits).file_bytes, &diag->list, &now);
    if (good) hash_text(&now, hash);
    return good;
}

void monge_scene_text_hash(const struct monge_scene *scene, char hash[MONGE_HASH_SIZE]) {
    hash_text(&scene->texts_hash, hash);
}

size_t monge_scene_primitives(const struct monge_scene *scene) { return scene->scene.primitives.count; }

static struct accel *scene_accel(struct monge_scene *scene) {
    const struct scene *s = &scene->scene;
    bool *clear = arena_array(&scene->body, s->material_count, sizeof *clear);
    for (uint32_t i = 0; i < s->material_count; i++)
        clear[i] = vec3_max_abs(s->materials[i].refraction) > 0.0;
    return accel_build(&scene->body, &s->primitives, s->geometries, s->geometry_count, clear);
}

bool monge_scene_prepare(struct monge_scene *scene) {
    jmp_buf full;
    if (scene->accel) return true;
    scene->built_bytes = scene->body.total;
    const struct arena_mark before = arena_mark(&scene->body);
    scene->body.on_full = &full;
    if (setjmp(full) == 0)
        scene->accel = scene_accel(scene);
    else
        arena_release(&scene->body, before);
    scene->body.on_full = NULL;
    return scene->accel != NULL;
}

void monge_scene_examine(struct monge_scene *scene, struct monge_diagnostics *diag) {
    enum {
        MANY = 1 << 18
    }; /* primitives: a hierarchy for the question alone would take longer than the load */
    if (!scene->accel && scene->scene.primitives.count > MANY) return;
    jmp_buf full;
    struct arena scratch = {.on_full = &full};
    if (!monge_scene_prepare(scene)) return;
    if (setjmp(full) == 0)
        examine_scene(&scene->scene, scene->accel, scene->result.frames > 0, &scratch, &diag->list);
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
    (format == MONGE_FORMAT_TEXT ? info_print : info_write_json)(&info, &scene->scene, scene->accel,
                                                                 scene->outline, out);
    arena_free(&scratch);
    return true;
}
