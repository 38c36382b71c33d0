/* Templates in use. What one contains is gathered in a set of its own, once; if that is worth it the set
 * becomes a geometry, and every use like it an instance. Sets that differ in their only material are one
 * geometry: the material is then the instance's. Small ones are carried out where they stand:
 * a ray goes into few primitives faster than into a space of their own. */
#include "scene/builder.h"

enum {
    WORTH = 16, /* primitives, instances carried out, from which on a set becomes a geometry */
};

/* What is known of uses with the same contents; where they are not exact, what became of the last one. */
struct placed {
    enum { PLACED_NEW, PLACED_GATHERED, PLACED_CARRIED_OUT } state;
    uint32_t geometry; /* GATHERED */
    uint32_t material; /* GATHERED: of the instance, where it is not the level's: else MATERIAL_INHERITED */
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

/* The use as an instance, at the place of the level that is open for it. */
static void add_instance(struct builder *b, const struct object_value *use, const struct placed *placed) {
    const uint32_t material =
        placed->material == MATERIAL_INHERITED ? material_index(b, b->level->material) : placed->material;
    place_origin(b, use);
    instance_add(b, use->span, b->level->world_from_node, placed->geometry, material);
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

static uint32_t *material_of(struct primitives *p, uint32_t number) {
    const primitive_ref ref = p->info[number].ref;
    return primitive_ref_kind(ref) == PRIMITIVE_INSTANCE ? &p->instances[primitive_ref_index(ref)].material
                                                         : &p->info[number].material;
}

/* The only material of the set, which now inherits it; MATERIAL_INHERITED: there is none, or several. */
static uint32_t take_material(struct primitives *p) {
    const uint32_t first = *material_of(p, 0);
    for (uint32_t i = 1; i < p->count; i++)
        if (*material_of(p, i) != first) return MATERIAL_INHERITED;
    for (uint32_t i = 0; i < p->count; i++) *material_of(p, i) = MATERIAL_INHERITED;
    return first;
}

/* The geometry with the contents of the set: one that is there, or a new one, which takes its arrays. */
static uint32_t find_geometry(struct builder *b, struct set *set, uint32_t height, uint32_t weight) {
    struct hash contents;
    hash_begin(&contents);
    primitives_hash(&set->primitives, &contents);
    struct placed *known = find_placed(b, &b->geometries, &contents);
    if (known->state == PLACED_GATHERED) return known->geometry;
    *known = (struct placed){PLACED_GATHERED, add_geometry(b, &set->primitives, height, weight),
                             MATERIAL_INHERITED};
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
    uint32_t height, weight;
    measure(b, &set->primitives, &height, &weight);
    close_set(b);
    level_close(b);
    if (weight < WORTH || height + 1 >= INSTANCE_MAX_DEPTH) {
        placed->state = PLACED_CARRIED_OUT;
        return true; /* the level of the use is open: read the objects into the set around */
    }
    *placed = (struct placed){.state = PLACED_GATHERED, .material = take_material(&set->primitives)};
    placed->geometry = find_geometry(b, set, height, weight);
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
