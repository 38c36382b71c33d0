/* Templates in use. What one contains is gathered in a set of its own, once; if that is worth it the set
 * becomes a geometry, and every use like it an instance. Sets that differ in their materials alone are one
 * geometry: its primitives have slots, and each instance the materials. Small ones are carried out where
 * they stand: a ray goes into few primitives faster than into a space of their own. */
#include <string.h>

#include "scene/builder.h"

enum {
    WORTH = 16, /* primitives, instances carried out, from which on a set becomes a geometry */
};

/* What is known of uses with the same contents; where they are not exact, what became of the last one. */
struct placed {
    enum { PLACED_NEW, PLACED_GATHERED, PLACED_CARRIED_OUT } state;
    uint32_t geometry;         /* GATHERED */
    const uint32_t *materials; /* GATHERED: for the slots; MATERIAL_INHERITED: the level's */
    const uint32_t *filled;    /* the same as they were last, with that of the level; NULL: not yet */
};

/* What the table has under the contents; if nothing, a new zeroed entry. */
static struct placed *find_placed(struct builder *b, struct table *table, const struct hash *contents) {
    char name[HASH_TEXT_SIZE];
    hash_text(contents, name);
    struct placed *placed = table_find(table, name);
    if (placed) return placed;
    placed = arena_alloc(b->arena, sizeof *placed);
    table_put(b->arena, table, arena_text(b->arena, name, HASH_TEXT_SIZE - 1), placed);
    return placed;
}

/* The materials of a use in the level that is open for it. */
static const uint32_t *fill_materials(struct builder *b, struct placed *placed) {
    const uint32_t slots = b->scene->geometries[placed->geometry].slots;
    uint32_t at = 0;
    while (at < slots && placed->materials[at] != MATERIAL_INHERITED) at++;
    if (at == slots) return placed->materials;
    const uint32_t own = material_index(b, b->level->material);
    if (own == MATERIAL_INHERITED) return placed->materials;
    if (placed->filled && placed->filled[at] == own) return placed->filled;
    uint32_t *filled = arena_room(b->arena, slots * sizeof *filled);
    memcpy(filled, placed->materials, slots * sizeof *filled);
    filled[at] = own;
    return placed->filled = filled;
}

/* The use as an instance, at the place of the level that is open for it. */
static void add_instance(struct builder *b, const struct object_value *use, struct placed *placed) {
    const uint32_t *materials = fill_materials(b, placed);
    place_origin(b, use);
    instance_add(b, use->span, b->level->world_from_node, placed->geometry, materials);
}

static void count_use(struct builder *b) {
    struct primitives *p = &b->set->primitives;
    p->uses = builder_grow(b, p->uses, p->use_count, &b->set->use_room, sizeof *p->uses);
    p->uses[p->use_count++] = b->level->template;
}

/* A set to gather in: one that was closed before gives its room. */
static void open_set(struct builder *b) {
    struct set *set = b->free_sets;
    if (set)
        b->free_sets = set->outer;
    else
        set = arena_alloc(b->arena, sizeof *set);
    struct primitives *p = &set->primitives;
    p->count = p->sphere_count = p->flat_count = p->quadric_count = p->instance_count = p->use_count = 0;
    set->outer = b->set;
    b->set = set;
}

static void close_set(struct builder *b) {
    struct set *set = b->set;
    b->set = set->outer;
    set->outer = b->free_sets;
    b->free_sets = set;
}

enum lang_use instances_open(struct builder *b, const struct object_value *object,
                             const struct hash *contents, bool exact) {
    struct placed *placed = find_placed(b, &b->placed, contents);
    level_open(b, object, placed);
    count_use(b);
    if (placed->state == PLACED_CARRIED_OUT) return LANG_USE_READ;
    if (exact && placed->state == PLACED_GATHERED) {
        add_instance(b, object, placed);
        level_close(b);
        return LANG_USE_PLACED;
    }
    level_push(b, (struct level){.world_from_node = AFFINE_IDENTITY,
                                 .use = object,
                                 .placed = placed,
                                 .template = b->level->template,
                                 .object = ORIGIN_NO_OBJECT});
    open_set(b);
    return LANG_USE_READ;
}

/* How many instances stand within each other, and how many primitives they come to (a million and more
 * count as that). */
static void measure(const struct builder *b, const struct primitives *p, uint32_t *height, uint32_t *weight) {
    enum { MANY = 1000000 };
    *height = 0;
    *weight = p->count - p->instance_count;
    for (uint32_t i = 0; i < p->instance_count; i++) {
        const uint32_t g = p->instances[i].geometry;
        if (b->geometry_height[g] + 1 > *height) *height = b->geometry_height[g] + 1;
        *weight = *weight > MANY ? MANY : *weight + b->geometry_weight[g];
    }
}

static uint32_t add_geometry(struct builder *b, const struct primitives *p, uint32_t height,
                             uint32_t weight) {
    struct scene *scene = b->scene;
    const uint32_t i = scene->geometry_count;
    scene->geometries = builder_grow(b, scene->geometries, i, &b->geometry_room, sizeof *scene->geometries);
    b->geometry_height = builder_grow(b, b->geometry_height, i, &b->height_room, sizeof *b->geometry_height);
    b->geometry_weight = builder_grow(b, b->geometry_weight, i, &b->weight_room, sizeof *b->geometry_weight);
    scene->geometries[i] = *p;
    b->geometry_height[i] = height;
    b->geometry_weight[i] = weight;
    return scene->geometry_count++;
}

/* The materials that slots stand for, by slot. */
struct slots {
    uint32_t material[MATERIAL_SLOTS], count;
};

/* The slot that stands for the material, a new one if it is new; the material itself where there is none left.
 * The last is kept for what is inherited, which must have one. */
static uint32_t slot_for(struct slots *slots, uint32_t material) {
    for (uint32_t i = 0; i < slots->count; i++)
        if (slots->material[i] == material) return MATERIAL_SLOT | i;
    if (slots->count >= MATERIAL_SLOTS - 1 && material != MATERIAL_INHERITED) return material;
    slots->material[slots->count] = material;
    return MATERIAL_SLOT | slots->count++;
}

static const uint32_t *slots_for(struct builder *b, struct slots *slots, const uint32_t *materials,
                                 uint32_t count) {
    uint32_t *list = arena_room(b->arena, count * sizeof *list);
    for (uint32_t i = 0; i < count; i++) list[i] = slot_for(slots, materials[i]);
    return list;
}

/* Puts slots in the place of the set's materials, in the order in which they appear; returns those. */
static const uint32_t *take_materials(struct builder *b, struct primitives *p) {
    struct slots slots = {.count = 0};
    const uint32_t *before = NULL, *after = NULL; /* of the last instance: many have the same */
    for (uint32_t i = 0; i < p->count; i++) {
        if (primitive_ref_kind(p->info[i].ref) != PRIMITIVE_INSTANCE) {
            p->info[i].material = slot_for(&slots, p->info[i].material);
            continue;
        }
        struct instance *instance = &p->instances[primitive_ref_index(p->info[i].ref)];
        if (instance->materials != before) {
            before = instance->materials;
            after = slots_for(b, &slots, before, b->scene->geometries[instance->geometry].slots);
        }
        instance->materials = after;
    }
    p->slots = slots.count;
    uint32_t *materials = arena_room(b->arena, slots.count * sizeof *materials);
    return memcpy(materials, slots.material, slots.count * sizeof *materials);
}

/* The geometry with the contents of the set: one that is there, or a new one, which takes its arrays. Of another
 * template it is another one, which can be told by its origins. */
static uint32_t find_geometry(struct builder *b, struct set *set, uint32_t template, uint32_t height,
                              uint32_t weight) {
    struct hash contents;
    hash_begin(&contents);
    hash_integer(&contents, template);
    primitives_hash(&set->primitives, b->scene->geometries, &contents);
    struct placed *known = find_placed(b, &b->geometries, &contents);
    if (known->state == PLACED_GATHERED) return known->geometry;
    *known = (struct placed){.state = PLACED_GATHERED,
                             .geometry = add_geometry(b, &set->primitives, height, weight)};
    *set = (struct set){.outer = set->outer}; /* it is among the free ones: without arrays now */
    return known->geometry;
}

bool instances_close(struct builder *b) {
    struct placed *placed = b->level->placed;
    const bool gathering = b->level->use != NULL;
    if (!gathering) {
        level_close(b);
        return false;
    }
    struct set *set = b->set;
    const struct object_value *use = b->level->use;
    const uint32_t template = b->level->template;
    uint32_t height, weight;
    measure(b, &set->primitives, &height, &weight);
    close_set(b);
    level_close(b);
    if (weight < WORTH || height + 1 >= INSTANCE_MAX_DEPTH) {
        placed->state = PLACED_CARRIED_OUT;
        return true; /* the level of the use is open: read the objects into the set around */
    }
    *placed = (struct placed){.state = PLACED_GATHERED, .materials = take_materials(b, &set->primitives)};
    placed->geometry = find_geometry(b, set, template, height, weight);
    add_instance(b, use, placed);
    level_close(b);
    return false;
}

static void forget(struct table *table, uint32_t geometries) {
    for (size_t i = 0; i < table->capacity; i++) {
        struct placed *placed = table->slots[i].value;
        if (placed && placed->state == PLACED_GATHERED && placed->geometry >= geometries)
            placed->state = PLACED_NEW;
    }
}

void instances_take_back(struct builder *b, uint32_t geometries) {
    forget(&b->placed, geometries);
    forget(&b->geometries, geometries);
    b->scene->geometry_count = geometries;
}
