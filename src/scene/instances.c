/* Templates in use. What one contains is gathered in a set of its own, once; if that is worth it the set
 * becomes a geometry, and every use like it an instance. Small ones are carried out where they stand:
 * a ray goes into few primitives faster than into a space of their own. */
#include "scene/builder.h"

enum {
    WORTH = 16, /* primitives, instances carried out, from which on a set becomes a geometry */
};

/* What is known of uses with the same contents. */
struct placed {
    enum { PLACED_NEW, PLACED_GATHERED, PLACED_CARRIED_OUT } state;
    uint32_t geometry; /* GATHERED */
    struct placed *next;
};

static struct placed *find_placed(struct builder *b, const struct hash *contents) {
    char name[HASH_TEXT_SIZE];
    hash_text(contents, name);
    struct placed *placed = table_find(&b->placed, name);
    if (placed) return placed;
    placed = arena_alloc(b->arena, sizeof *placed);
    table_put(b->arena, &b->placed, arena_text(b->arena, name, HASH_TEXT_SIZE - 1), placed);
    return placed;
}

/* The use as an instance, at the place of the level that is open for it. */
static void add_instance(struct builder *b, const struct object_value *use, uint32_t geometry) {
    place_origin(b, use);
    instance_add(b, use->span, b->level->world_from_node, geometry, material_index(b, b->level->material));
}

static void count_use(struct builder *b) {
    struct primitives *p = &b->set->primitives;
    p->uses = builder_grow(b, p->uses, p->use_count, &b->set->use_room, sizeof *p->uses);
    p->uses[p->use_count++] = b->level->template;
}

enum lang_use instances_open(struct builder *b, const struct object_value *object, const struct hash *contents) {
    struct placed *placed = contents ? find_placed(b, contents) : NULL;
    level_open(b, object, placed);
    count_use(b);
    if (!placed || placed->state == PLACED_CARRIED_OUT) return LANG_USE_READ;
    if (placed->state == PLACED_GATHERED) {
        add_instance(b, object, placed->geometry);
        level_close(b);
        return LANG_USE_PLACED;
    }
    level_push(b, (struct level){.world_from_node = AFFINE_IDENTITY, .use = object, .placed = placed, .template = b->level->template});
    struct set *set = arena_alloc(b->arena, sizeof *set);
    set->outer = b->set;
    b->set = set;
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

static uint32_t add_geometry(struct builder *b, const struct primitives *p, uint32_t height, uint32_t weight) {
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

bool instances_close(struct builder *b) {
    struct placed *placed = b->level->placed;
    const bool gathering = b->level->use != NULL;
    if (!gathering) {
        level_close(b);
        return false;
    }
    const struct primitives *p = &b->set->primitives;
    const struct object_value *use = b->level->use;
    uint32_t height, weight;
    measure(b, p, &height, &weight);
    b->set = b->set->outer;
    level_close(b);
    if (weight < WORTH || height + 1 >= INSTANCE_MAX_DEPTH) {
        placed->state = PLACED_CARRIED_OUT;
        return true; /* the level of the use is open: read the objects into the set around */
    }
    placed->state = PLACED_GATHERED;
    placed->geometry = add_geometry(b, p, height, weight);
    add_instance(b, use, placed->geometry);
    level_close(b);
    return false;
}

void instances_take_back(struct builder *b, uint32_t geometries) {
    for (size_t i = 0; i < b->placed.capacity; i++) {
        struct placed *placed = b->placed.slots[i].value;
        if (placed && placed->state == PLACED_GATHERED && placed->geometry >= geometries) placed->state = PLACED_NEW;
    }
    b->scene->geometry_count = geometries;
}
