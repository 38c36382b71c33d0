/* Reads a scene: its files, its names, its objects one by one, then the rest. */
#include "lang/lang.h"

#include <string.h>
#include <sys/stat.h>

#include "lang/checker.h"
#include "lang/problem.h"

void lang_memory_free(struct lang_memory *memory) {
    arena_free(&memory->scratch);
    arena_free(&memory->kept);
    arena_free(&memory->nodes);
}

/* ---- Objects while the file is read ----
 * Whatever needs a name that is not there yet stays in its list, and what follows with it, until all of
 * the file is known. */

struct streaming {
    struct checker *ck;
    struct unit *unit;
    bool over; /* an item had to wait: all further ones do */
};

static void stream_begin(void *context, struct node *root) {
    struct streaming *s = context;
    s->unit->root = root;
    define_names(s->ck, s->unit);
}

static bool stream_item(void *context, struct node *item) {
    struct streaming *s = context;
    struct checker *ck = s->ck;
    if (s->over) return false;
    if (ck->stopped) return true;
    const size_t steps = ck->steps, objects = ck->objects;
    ck->input->sink->mark(ck->input->sink->context);
    ck->waiting = false;
    ck->around =
        (struct surrounding){&grammar_kinds[KIND_FILE], &grammar_kinds[KIND_FILE].keys[KEY_FILE_SCENE]};
    place_item(ck, item);
    ck->around = (struct surrounding){0};
    if (!ck->waiting) return true;
    ck->waiting = false;
    ck->steps = steps;
    ck->objects = objects;
    ck->input->sink->take_back(ck->input->sink->context);
    s->over = true;
    return false;
}

/* ---- The file ---- */

static struct unit *read_scene(struct checker *ck) {
    struct stat file;
    const struct lang_input *input = ck->input;
    struct unit *unit = arena_alloc(&ck->memory->kept, sizeof *unit);
    *unit = (struct unit){.source = input->source, .path = input->path};
    if (input->path && stat(input->path, &file) == 0) {
        unit->device = (uint64_t)file.st_dev;
        unit->inode = (uint64_t)file.st_ino;
    }
    ck->units = unit;
    struct streaming streaming = {ck, unit, false};
    const struct node_stream stream = {&streaming, "scene", stream_begin, stream_item};
    const struct node_limits limits = {input->limits.nesting, input->limits.values};
    struct node_problem problem = {0};
    unit->root = node_parse(&ck->memory->nodes, ck->diag, input->source, &limits, &stream, &problem);
    if (problem.text) problem_report(ck->diag, &problem);
    return unit->root ? unit : NULL;
}

/* What an included file has besides definitions is for when it is rendered itself: no slip in it passes. */
static void check_included(struct checker *ck) {
    const struct object_value *animation = ck->animation;
    ck->rehearsing = ck->included = true;
    for (const struct unit *unit = ck->units; unit; unit = unit->next) {
        if (!unit->includer || !unit->root || unit->root->kind != NODE_MAPPING) continue;
        const struct node *moving = node_get(unit->root, "animation");
        if (moving && !animation) ck->animation = check_object(ck, &grammar_kinds[KIND_ANIMATION], moving);
        const struct object_value *file = check_object(ck, &grammar_kinds[KIND_FILE], unit->root);
        if (file && file->fields[KEY_FILE_SCENE])
            place_members(ck, KIND_FILE, KEY_FILE_SCENE, file->fields[KEY_FILE_SCENE]->node);
        ck->animation = animation;
    }
    ck->rehearsing = ck->included = false;
}

static struct object_list named_materials(struct checker *ck) {
    struct object_list list = {arena_array(ck->arena, ck->materials.count + 1, sizeof *list.items), 0};
    for (const struct definition *def = ck->materials.first; def; def = def->next)
        if (def->object) list.items[list.count++] = def->object;
    return list;
}

/* A path from the folder that another file is in, where it lies there. */
static const char *path_below(const char *path, const char *file) {
    const char *slash = strrchr(file, '/');
    const size_t folder = slash ? (size_t)(slash - file) + 1 : 0;
    return strncmp(path, file, folder) == 0 ? path + folder : path;
}

/* All files; the units have the newest first. */
static void list_texts(struct checker *ck, struct lang_result *result) {
    for (const struct unit *unit = ck->units; unit; unit = unit->next) result->text_count++;
    struct lang_text *texts = arena_array(&ck->memory->kept, result->text_count, sizeof *texts);
    uint32_t i = result->text_count;
    for (const struct unit *unit = ck->units; unit; unit = unit->next)
        texts[--i] = (struct lang_text){unit->includer ? path_below(unit->path, ck->input->path) : unit->path,
                                        unit->source};
    result->texts = texts;
}

/* What stays of a reading, for lang_read_frame. */
struct reading {
    struct checker checker;
    struct lang_input input;
    struct lang_files files; /* where the input has none */
    struct unit *scene;
    struct checker ready; /* as it was after the reading, for each frame */
};

static struct reading *begin_reading(struct lang_memory *memory, struct diagnostics *diag,
                                     const struct lang_input *input) {
    memory->kept.parent = memory->scratch.parent = &memory->nodes;
    struct reading *reading = arena_alloc(&memory->kept, sizeof *reading);
    reading->input = *input;
    if (!input->frame) reading->input.frame = 1;
    if (!input->files) reading->input.files = &reading->files;
    reading->files.arena = &memory->kept;
    reading->checker = (struct checker){.arena = &memory->scratch,
                                        .memory = memory,
                                        .diag = diag,
                                        .input = &reading->input,
                                        .provisional = true};
    reading->checker.parameters_end = &reading->checker.first_parameter;
    return reading;
}

/* The file itself does not count as moving: lang_read_frame can read it again. */
static struct object_value *read_file(struct checker *ck, struct arena *arena, const struct unit *unit) {
    struct arena *before = ck->arena;
    const bool moved = ck->moved;
    ck->arena = arena;
    struct object_value *file = check_object(ck, &grammar_kinds[KIND_FILE], unit->root);
    ck->arena = before;
    ck->moved = moved;
    return file;
}

struct lang_result lang_read(struct lang_memory *memory, struct diagnostics *diag,
                             const struct lang_input *input) {
    struct reading *reading = begin_reading(memory, diag, input);
    struct checker *ck = &reading->checker;
    const unsigned errors = diag->errors + diag->failures;
    struct unit *unit = reading->scene = read_scene(ck);
    if (!unit) return (struct lang_result){0};
    ck->provisional = false;
    define_names(ck, unit);
    struct object_value *file = read_file(ck, &memory->kept, unit);
    if (file && file->fields[KEY_FILE_SCENE])
        place_members(ck, KIND_FILE, KEY_FILE_SCENE, file->fields[KEY_FILE_SCENE]->node);
    if (file) check_included(ck);
    if (file) define_check_given(ck);
    if (file) file->failed = diag->errors + diag->failures != errors;
    if (file && !file->failed) define_warn_unused(ck);
    const unsigned frames = ck->animation ? (unsigned)object_number(ck->animation, KEY_ANIMATION_FRAMES) : 0;
    ck->arena = &memory->kept;
    reading->ready = *ck;
    struct lang_result result = {file, named_materials(ck), ck->moved, frames, ck, NULL, 0};
    list_texts(ck, &result);
    return result;
}

void lang_read_frame(struct lang_result *result, struct diagnostics *diag, unsigned frame) {
    struct checker *ck = result->reading;
    struct reading *reading = (struct reading *)ck; /* its first member */
    const unsigned errors = diag->errors;
    arena_free(&ck->memory->scratch);
    *ck = reading->ready; /* the frame before may have stopped anywhere */
    reading->input.frame = frame;
    ck->diag = diag;
    ck->steps = 0;
    struct object_value *file = read_file(ck, &ck->memory->scratch, reading->scene);
    if (file) file->failed = diag->errors != errors;
    result->file = file;
}

const struct object_value *lang_read_goldens(struct lang_memory *memory, struct diagnostics *diag,
                                             const struct lang_input *input) {
    struct checker *ck = &begin_reading(memory, diag, input)->checker;
    const struct node_limits limits = {input->limits.nesting, input->limits.values};
    struct node_problem problem = {0};
    const struct node *root = node_parse(&memory->nodes, diag, input->source, &limits, NULL, &problem);
    if (problem.text) problem_report(diag, &problem);
    ck->provisional = false;
    return root ? check_object(ck, &grammar_kinds[KIND_GOLDENS], root) : NULL;
}
