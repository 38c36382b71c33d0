#include "render/layers.h"

#include <stdlib.h>
#include <string.h>

#include "render/conditions.h"
#include "render/lights.h"
#include "render/tiles.h"

/* ---- The arrays ---- */

static bool has(unsigned set, enum monge_layer layer) { return set >> layer & 1; }

bool layers_add(struct monge_layers *layers, enum monge_layer layer) {
    const size_t count = layers_pixels(layers);
    void *pixels = NULL;
    switch (layer) {
    case MONGE_LAYER_OBJECT:
    case MONGE_LAYER_MATERIAL: pixels = layers->ids[layer] = calloc(count, sizeof **layers->ids); break;
    case MONGE_LAYER_DEPTH: pixels = layers->depth = calloc(count, sizeof *layers->depth); break;
    case MONGE_LAYER_NORMAL: pixels = layers->normals = calloc(count, 3 * sizeof *layers->normals); break;
    case MONGE_LAYER_SHADOW: pixels = layers->lights = calloc(count, sizeof *layers->lights); break;
    case MONGE_LAYERS: break;
    }
    if (pixels) layers->set |= 1u << layer;
    return pixels != NULL;
}

struct monge_layers *layers_new(uint32_t width, uint32_t height, struct monge_region region, unsigned set) {
    struct monge_layers *layers = calloc(1, sizeof *layers);
    if (!layers) return NULL;
    layers->width = width;
    layers->height = height;
    layers->region = region;
    for (enum monge_layer layer = 0; layer < MONGE_LAYERS; layer++) {
        if (!has(set, layer) || layers_add(layers, layer)) continue;
        monge_layers_free(layers);
        return NULL;
    }
    return layers;
}

void monge_layers_free(struct monge_layers *layers) {
    if (!layers) return;
    free(layers->ids[MONGE_LAYER_OBJECT]);
    free(layers->ids[MONGE_LAYER_MATERIAL]);
    free(layers->depth);
    free(layers->normals);
    free(layers->lights);
    arena_free(&layers->arena);
    free(layers);
}

unsigned monge_layers_set(const struct monge_layers *layers) { return layers->set; }
struct monge_region monge_layers_region(const struct monge_layers *layers) {
    return layers->region;
}
const float *monge_layers_depth(const struct monge_layers *layers) { return layers->depth; }
const uint16_t *monge_layers_normals(const struct monge_layers *layers) { return layers->normals; }
const uint64_t *monge_layers_lights(const struct monge_layers *layers) { return layers->lights; }

const uint32_t *monge_layers_ids(const struct monge_layers *layers, enum monge_layer layer) {
    return layer <= MONGE_LAYER_MATERIAL ? layers->ids[layer] : NULL;
}

static int compare_ids(const void *key, const void *entry) {
    const uint32_t a = *(const uint32_t *)key, b = ((const struct monge_entry *)entry)->id;
    return a < b ? -1 : a > b;
}

const struct monge_entry *monge_layers_entry(const struct monge_layers *layers, enum monge_layer layer,
                                             uint32_t id) {
    if (layer > MONGE_LAYER_MATERIAL || layers->entries[layer].count == 0) return NULL;
    const struct layer_entries *entries = &layers->entries[layer];
    return bsearch(&id, entries->list, entries->count, sizeof *entries->list, compare_ids);
}

/* ---- Objects ----
 * A candidate is an object of the scene's list of them, or, behind all of these, an origin of the scene's own shapes:
 * one that belongs to no such object is one itself. */

/* The candidate that a hit belongs to. */
static uint32_t object_of(const struct scene *scene, const struct occurrence *which) {
    const struct origins *origins = &scene->origins;
    const struct primitives *set = &scene->primitives;
    uint32_t listed = 0, named = ORIGIN_NO_OBJECT;
    for (uint32_t i = 0; i <= which->depth; i++) {
        const struct primitive_info *info = &set->info[which->number[i]];
        const bool has_name = info->object != ORIGIN_NO_OBJECT && origins->objects[info->object].name != NULL;
        if (i == 0)
            listed = info->object != ORIGIN_NO_OBJECT ? info->object : origins->object_count + info->origin;
        if (i == 0 && has_name) return listed;
        if (has_name) named = info->object;
        if (i < which->depth)
            set = &scene->geometries[set->instances[primitive_ref_index(info->ref)].geometry];
    }
    return named != ORIGIN_NO_OBJECT ? named : listed;
}

static struct object_place candidate_place(const struct origins *origins, uint32_t candidate) {
    if (candidate < origins->object_count) return origins->objects[candidate];
    const struct origin *o = &origins->list[candidate - origins->object_count];
    return (struct object_place){NULL, scene_kind_name(o->kind), o->line, o->column, o->file};
}

/* A candidate with its place, to be sorted by that: in the order of the text. */
struct candidate {
    struct object_place place;
    uint32_t number;
};

static int compare_numbers(uint32_t a, uint32_t b) { return a < b ? -1 : a > b; }

static int compare_places(const void *a, const void *b) {
    const struct object_place *p = &((const struct candidate *)a)->place,
                              *q = &((const struct candidate *)b)->place;
    int order = compare_numbers(p->file, q->file);
    if (!order) order = compare_numbers(p->line, q->line);
    if (!order) order = compare_numbers(p->column, q->column);
    return order ? order : strcmp(p->name ? p->name : "", q->name ? q->name : "");
}

static struct candidate *list_candidates(const struct scene *scene, struct arena *arena, uint32_t *count) {
    const struct origins *origins = &scene->origins;
    const struct primitives *p = &scene->primitives;
    struct candidate *list =
        arena_array(arena, (size_t)origins->object_count + origins->count + 1, sizeof *list);
    bool *listed = arena_array(arena, (size_t)origins->count + 1, sizeof *listed);
    *count = 0;
    for (uint32_t i = 0; i < origins->object_count; i++) list[(*count)++].number = i;
    for (uint32_t i = 0; i < p->count; i++) {
        const struct primitive_info *info = &p->info[i];
        if (info->object != ORIGIN_NO_OBJECT || listed[info->origin]) continue;
        listed[info->origin] = true;
        list[(*count)++].number = origins->object_count + info->origin;
    }
    for (uint32_t i = 0; i < *count; i++) list[i].place = candidate_place(origins, list[i].number);
    return list;
}

/* The ids of candidates: from 1 in the order of the text, those that are the same sharing one. *highest is the last. */
static uint32_t *object_ids(const struct scene *scene, struct arena *arena, uint32_t *highest) {
    uint32_t count;
    struct candidate *list = list_candidates(scene, arena, &count);
    uint32_t *ids =
        arena_array(arena, (size_t)scene->origins.object_count + scene->origins.count + 1, sizeof *ids);
    qsort(list, count, sizeof *list, compare_places);
    *highest = 0;
    for (uint32_t i = 0; i < count; i++) {
        *highest += i == 0 || compare_places(&list[i - 1], &list[i]) != 0;
        ids[list[i].number] = *highest;
    }
    return ids;
}

/* ---- Pixels ---- */

/* One rendering of layers, shared by its threads. */
struct surveying {
    struct tracer tracer;
    struct view view;
    struct monge_layers *layers;
    const uint32_t *object_ids; /* by candidate */
};

static uint16_t normal_code(double component) { return (uint16_t)((0.5 * component + 0.5) * 65535.0 + 0.5); }

static void write_sight(const struct surveying *sv, const struct sight *sight, size_t at,
                        struct tracing *tracing) {
    const struct monge_layers *layers = sv->layers;
    if (layers->ids[MONGE_LAYER_OBJECT])
        layers->ids[MONGE_LAYER_OBJECT][at] = sv->object_ids[object_of(sv->tracer.scene, &sight->hit.which)];
    if (layers->ids[MONGE_LAYER_MATERIAL]) layers->ids[MONGE_LAYER_MATERIAL][at] = sight->hit.material + 1;
    if (layers->depth)
        layers->depth[at] = (float)vec3_dot(vec3_sub(sight->surface.point, sv->view.eye), sv->view.forward);
    if (layers->normals) {
        layers->normals[3 * at] = normal_code(sight->normal.x);
        layers->normals[3 * at + 1] = normal_code(sight->normal.y);
        layers->normals[3 * at + 2] = normal_code(sight->normal.z);
    }
    if (layers->lights) layers->lights[at] = trace_lights(&sv->tracer, sight, MONGE_LAYER_LIGHTS, tracing);
}

static void survey_pixel(const void *context, uint32_t x, uint32_t y, struct tracing *tracing) {
    const struct surveying *sv = context;
    const struct monge_layers *layers = sv->layers;
    const struct monge_region *region = &layers->region;
    const size_t at = (size_t)y * region->width + x;
    const ray r = camera_ray(&sv->view, ((double)(region->x + x) + 0.5) / layers->width,
                             ((double)(region->y + y) + 0.5) / layers->height);
    struct sight sight;
    tracing->rays[MONGE_RAY_CAMERA]++;
    if (trace_sight(&sv->tracer, r, tracing, &sight))
        write_sight(sv, &sight, at, tracing);
    else if (layers->depth)
        layers->depth[at] = INFINITY;
}

/* ---- Entries ---- */

static const char *keep(struct arena *arena, const char *text) {
    return text ? arena_text(arena, text, strlen(text)) : NULL;
}

static struct monge_entry object_entry(const struct scene *scene, struct arena *arena, uint32_t candidate) {
    const struct object_place o = candidate_place(&scene->origins, candidate);
    return (struct monge_entry){.name = keep(arena, o.name),
                                .kind = keep(arena, o.kind),
                                .file = keep(arena, scene->origins.files[o.file]->name),
                                .line = o.line + 1,
                                .column = o.column + 1};
}

static struct monge_entry material_entry(const struct scene *scene, struct arena *arena, uint32_t index) {
    const struct material_info *m = &scene->material_info[index];
    struct monge_entry entry = conditions_entry(&m->span, "material", arena);
    struct hash hash;
    char text[HASH_TEXT_SIZE];
    hash_begin(&hash);
    material_hash(&scene->materials[index], &hash);
    hash_text(&hash, text);
    entry.name = keep(arena, m->name);
    entry.hash = keep(arena, text);
    return entry;
}

/* The entries of the ids that pixels have. `index_of` has a candidate by id; NULL: materials. */
static void list_entries(struct monge_layers *layers, enum monge_layer layer, const struct scene *scene,
                         const uint32_t *index_of, struct arena *scratch) {
    struct layer_entries *entries = &layers->entries[layer];
    bool *seen = arena_array(scratch, (size_t)entries->highest + 1, sizeof *seen);
    uint32_t count = 0;
    for (size_t i = 0; i < layers_pixels(layers); i++) seen[layers->ids[layer][i]] = true;
    for (uint32_t id = 1; id <= entries->highest; id++) count += seen[id];
    entries->list = arena_array(&layers->arena, count + 1, sizeof *entries->list);
    for (uint32_t id = 1; id <= entries->highest; id++) {
        if (!seen[id]) continue;
        struct monge_entry *entry = &entries->list[entries->count++];
        *entry = layer == MONGE_LAYER_OBJECT ? object_entry(scene, &layers->arena, index_of[id])
                                             : material_entry(scene, &layers->arena, id - 1);
        entry->id = id;
    }
}

static void list_objects(const struct surveying *sv, struct arena *scratch) {
    const struct origins *origins = &sv->tracer.scene->origins;
    const uint32_t count = origins->object_count + origins->count;
    uint32_t *index_of = arena_array(scratch, (size_t)count + 1, sizeof *index_of);
    for (uint32_t i = count; i-- > 0;) index_of[sv->object_ids[i]] = i;
    list_entries(sv->layers, MONGE_LAYER_OBJECT, sv->tracer.scene, index_of, scratch);
}

/* ---- All of it ---- */

static bool survey(struct surveying *sv, const struct monge_job *job, struct diagnostics *diag,
                   struct arena *scratch) {
    struct monge_layers *layers = sv->layers;
    const struct scene *scene = sv->tracer.scene;
    sv->view = camera_view(scene, sv->tracer.accel, layers->width, layers->height);
    layers->camera.view = sv->view;
    layers->camera.entry = conditions_entry(&scene->camera_place, "camera", &layers->arena);
    layers->conditions = conditions_of(scene, &sv->tracer.settings, &layers->arena);
    lights_set(&sv->tracer, scratch, &sv->view);
    layers->light_count = sv->tracer.light_count;
    sv->object_ids = object_ids(scene, scratch, &layers->entries[MONGE_LAYER_OBJECT].highest);
    layers->entries[MONGE_LAYER_MATERIAL].highest = scene->material_count;
    const struct tiling tiling = {layers->region, job, scene, diag, survey_pixel, sv, NULL};
    struct monge_stats stats;
    if (!tiles_run(&tiling, &stats)) return false;
    if (has(layers->set, MONGE_LAYER_OBJECT)) list_objects(sv, scratch);
    if (has(layers->set, MONGE_LAYER_MATERIAL))
        list_entries(layers, MONGE_LAYER_MATERIAL, scene, NULL, scratch);
    return true;
}

bool render_layers(const struct scene *scene, const struct accel *accel,
                   const struct monge_settings *settings, const struct monge_job *job,
                   struct monge_layers *layers, struct diagnostics *diag) {
    jmp_buf full;
    struct arena scratch = {.on_full = &full};
    struct surveying sv = {.tracer = {.scene = scene, .accel = accel, .settings = *settings},
                           .layers = layers};
    layers->arena.on_full = &full;
    if (setjmp(full)) {
        arena_free(&scratch);
        return false;
    }
    const bool done = survey(&sv, job, diag, &scratch);
    layers->arena.on_full = NULL;
    arena_free(&scratch);
    return done;
}
