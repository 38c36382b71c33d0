/* Builds the hierarchy from the top by the surface area heuristic over bins of centroids, after
 * Wald, "On fast construction of SAH-based bounding volume hierarchies", 2007. */
#include "accel/bvh.h"

#include <assert.h>
#include <float.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/table.h"

enum { BINS = 16 };
/* Of a test of two boxes and of one primitive, measured as about that, in tests of a sphere. */
static const float BOXES_COST = 3.0f;
static const float TEST_COST[] = {[PRIMITIVE_SPHERE] = 1.0f,
                                  [PRIMITIVE_FLAT] = 1.0f,
                                  [PRIMITIVE_QUADRIC] = 3.0f,
                                  [PRIMITIVE_INSTANCE] = 10.0f};

/* A box that a union of nothing leaves upside down. */
struct bounds {
    float min[3], max[3];
};

static const struct bounds NOWHERE = {{FLT_MAX, FLT_MAX, FLT_MAX}, {-FLT_MAX, -FLT_MAX, -FLT_MAX}};

struct item {
    struct bounds box;
    primitive_ref ref;
};

struct builder {
    struct item *items; /* each node's are adjacent */
    struct bvh_node *nodes;
    size_t node_count, node_room;
    uint32_t item_count;
    primitive_ref *unbounded;
    uint32_t unbounded_count;
    box3 bounds;
};

struct bin {
    struct bounds box;
    uint32_t count;
};

/* Items whose centroid falls into a bin of `axis` below `bin` go left. */
struct split {
    int axis;
    uint32_t bin;
    float origin, scale; /* of the bins of that axis */
    float cost;
};

static inline float lower(float a, float b) { return b < a ? b : a; }
static inline float upper(float a, float b) { return b > a ? b : a; }

/* Written out by axis here and below: -O2 does not unroll, and this is where the time goes. */
static inline void bounds_add(struct bounds *a, const struct bounds *b) {
    *a = (struct bounds){
        {lower(a->min[0], b->min[0]), lower(a->min[1], b->min[1]), lower(a->min[2], b->min[2])},
        {upper(a->max[0], b->max[0]), upper(a->max[1], b->max[1]), upper(a->max[2], b->max[2])}};
}

static float bounds_area(const struct bounds *a) {
    const float x = a->max[0] - a->min[0], y = a->max[1] - a->min[1], z = a->max[2] - a->min[2];
    return x * y + y * z + z * x;
}

static float item_center(const struct item *item, int axis) {
    return 0.5f * item->box.min[axis] + 0.5f * item->box.max[axis];
}

/* ---- From primitives to items ---- */

static float float_below(double x) {
    const float f = (float)x;
    return (double)f > x ? nextafterf(f, -INFINITY) : f;
}

static float float_above(double x) {
    const float f = (float)x;
    return (double)f < x ? nextafterf(f, INFINITY) : f;
}

/* `box` with a margin of 2^-22 of its distance from the origin: a hit computed in doubles is off by
 * far less, so it lies within even where the shape is flat along an axis. */
static struct bounds bounds_around(box3 box) {
    const double far_min = vec3_max_abs(box.min), far_max = vec3_max_abs(box.max);
    const vec3 margin = vec3_all((far_min > far_max ? far_min : far_max) * 0x1p-22);
    const vec3 min = vec3_sub(box.min, margin), max = vec3_add(box.max, margin);
    return (struct bounds){{float_below(min.x), float_below(min.y), float_below(min.z)},
                           {float_above(max.x), float_above(max.y), float_above(max.z)}};
}

static bool bounds_are_finite(const struct bounds *b) {
    for (int k = 0; k < 3; k++)
        if (!isfinite(b->min[k]) || !isfinite(b->max[k])) return false;
    return true;
}

/* Which materials of a set are clear. */
struct clear {
    const bool *materials; /* of the scene; NULL: none */
    uint64_t slots;        /* bit by bit */
};

static bool is_clear(const struct clear *clear, uint32_t material) {
    if (material & MATERIAL_SLOT) return clear->slots >> (material & ~MATERIAL_SLOT) & 1;
    return clear->materials && clear->materials[material];
}

/* What a tree is built of: the part of accel->primitives that is clear, or the part that is not. */
struct choice {
    const struct accel *accel;
    struct clear clear;
    bool which;
};

static void add_unbounded(struct builder *b, primitive_ref ref) { b->unbounded[b->unbounded_count++] = ref; }

static void add_bounded(struct builder *b, primitive_ref ref, box3 box) {
    const struct bounds around = bounds_around(box);
    if (box3_is_bounded(box)) b->bounds = box3_union(b->bounds, box);
    if (bounds_are_finite(&around))
        b->items[b->item_count++] = (struct item){around, ref};
    else
        add_unbounded(b, ref);
}

/* What two boxes around the same have in common. */
static box3 common(box3 a, box3 b) {
    return (box3){{box3_upper(a.min.x, b.min.x), box3_upper(a.min.y, b.min.y), box3_upper(a.min.z, b.min.z)},
                  {box3_lower(a.max.x, b.max.x), box3_lower(a.max.y, b.max.y), box3_lower(a.max.z, b.max.z)}};
}

static box3 node_box(const struct bvh_node *node) {
    const float *b = node->bounds;
    return (box3){{(double)b[0], (double)b[1], (double)b[2]}, {(double)b[3], (double)b[4], (double)b[5]}};
}

/* A few boxes of the tree, turned one by one, leave less air around than its whole box. */
static box3 instance_bounds(const struct instance *instance, const struct bvh *placed) {
    enum { BOXES = 8 };
    uint32_t nodes[BOXES] = {0}, count = 1;
    const box3 whole = shape_placed_bounds(instance, placed->bounds);
    for (uint32_t before = 0; before < count;) { /* level by level, until nothing splits */
        before = count;
        for (uint32_t i = 0; i < before && count < BOXES; i++) {
            const struct bvh_node *node = &placed->nodes[nodes[i]];
            if (node->count) continue;
            nodes[i] = node->first;
            nodes[count++] = node->first + 1;
        }
    }
    box3 parts = BOX3_EMPTY;
    for (uint32_t i = 0; i < count; i++)
        parts = box3_union(parts, shape_placed_bounds(instance, node_box(&placed->nodes[nodes[i]])));
    return common(whole, parts);
}

static void collect_instance(struct builder *b, const struct choice *choice, primitive_ref ref) {
    const uint32_t index = primitive_ref_index(ref);
    const struct bvh *placed = accel_tree(choice->accel->placed[index], choice->which);
    const struct instance *instance = &choice->accel->primitives->instances[index];
    if (bvh_is_empty(placed)) return;
    if (!placed->unbounded_count) {
        add_bounded(b, ref, instance_bounds(instance, placed));
    } else {
        const box3 box = shape_placed_bounds(instance, placed->bounds);
        if (box3_is_bounded(box)) b->bounds = box3_union(b->bounds, box);
        add_unbounded(b, ref);
    }
}

/* Sorts the chosen primitives into items and the unbounded. */
static void collect(struct builder *b, const struct choice *choice) {
    const struct primitives *primitives = choice->accel->primitives;
    b->bounds = BOX3_EMPTY;
    for (uint32_t i = 0; i < primitives->count; i++) {
        const struct primitive_info *info = &primitives->info[i];
        if (primitive_ref_kind(info->ref) == PRIMITIVE_INSTANCE)
            collect_instance(b, choice, info->ref);
        else if (is_clear(&choice->clear, info->material) == choice->which)
            add_bounded(b, info->ref, shape_bounds(primitives, info->ref));
    }
}

/* ---- Splitting ---- */

static uint32_t bin_of(const struct split *bins, const struct item *item) {
    const float place = (item_center(item, bins->axis) - bins->origin) * bins->scale;
    return place < (float)(BINS - 1) ? (uint32_t)place : BINS - 1;
}

/* The best place to split among the borders of the bins. */
static void sweep(const struct bin bins[BINS], struct split *split) {
    float right_cost[BINS];
    struct bounds box = NOWHERE;
    uint32_t count = 0;
    for (int i = BINS - 1; i > 0; i--) {
        bounds_add(&box, &bins[i].box);
        count += bins[i].count;
        right_cost[i] = count ? bounds_area(&box) * (float)count : INFINITY;
    }
    box = NOWHERE;
    count = 0;
    for (uint32_t i = 1; i < BINS; i++) {
        bounds_add(&box, &bins[i - 1].box);
        count += bins[i - 1].count;
        if (!count) continue;
        const float cost = bounds_area(&box) * (float)count + right_cost[i];
        if (cost < split->cost) {
            split->cost = cost;
            split->bin = i;
        }
    }
}

/* The cheapest split over all three axes; its cost is infinite where there is none: the centroids
 * coincide, or numbers are near the ends of float's range. */
static struct split find_split(const struct item *items, uint32_t count, const struct bounds *centers) {
    struct split axes[3], best = {.cost = INFINITY};
    struct bin bins[3][BINS];
    int used = 0;
    for (int k = 0; k < 3; k++) {
        const float scale = (float)BINS / (centers->max[k] - centers->min[k]);
        if (!(scale > 0.0f && scale < INFINITY)) continue;
        for (int i = 0; i < BINS; i++) bins[used][i] = (struct bin){NOWHERE, 0};
        axes[used++] = (struct split){.axis = k, .origin = centers->min[k], .scale = scale, .cost = INFINITY};
    }
    for (uint32_t i = 0; i < count; i++) {
        for (int k = 0; k < used; k++) {
            struct bin *bin = &bins[k][bin_of(&axes[k], &items[i])];
            bounds_add(&bin->box, &items[i].box);
            bin->count++;
        }
    }
    for (int k = 0; k < used; k++) {
        sweep(bins[k], &axes[k]);
        if (axes[k].cost < best.cost) best = axes[k];
    }
    return best;
}

static void item_swap(struct item *a, struct item *b) {
    const struct item keep = *a;
    *a = *b;
    *b = keep;
}

/* Brings the items of the left side to the front; returns how many there are. */
static uint32_t partition(struct item *items, uint32_t count, const struct split *split) {
    uint32_t left = 0, right = count;
    while (left < right) {
        if (bin_of(split, &items[left]) < split->bin)
            left++;
        else
            item_swap(&items[left], &items[--right]);
    }
    return left;
}

/* Hoare's selection: puts the smaller half by centroid along `axis` to the front; returns its size. */
static uint32_t partition_at_median(struct item *items, uint32_t count, int axis) {
    const int64_t middle = count / 2;
    int64_t low = 0, high = (int64_t)count - 1;
    while (low < high) {
        const float pivot = item_center(&items[(low + high) / 2], axis);
        int64_t i = low, j = high;
        while (i <= j) {
            while (item_center(&items[i], axis) < pivot) i++;
            while (item_center(&items[j], axis) > pivot) j--;
            if (i <= j) item_swap(&items[i++], &items[j--]);
        }
        if (middle <= j)
            high = j;
        else if (middle >= i)
            low = i;
        else
            break;
    }
    return (uint32_t)middle;
}

static int widest_axis(const struct bounds *b) {
    const float x = b->max[0] - b->min[0], y = b->max[1] - b->min[1], z = b->max[2] - b->min[2];
    if (x >= y && x >= z) return 0;
    return y >= z ? 1 : 2;
}

/* ---- The tree ---- */

/* How many halvings bring `count` down to one. */
static unsigned halvings(uint32_t count) {
    unsigned levels = 0;
    while (levels < 32 && (uint64_t)1 << levels < count) levels++;
    return levels;
}

/* Room for two more nodes; returns the index of the first, 0 when memory is out. */
static size_t add_pair(struct builder *b) {
    if (b->node_count + 2 > b->node_room) {
        const size_t room = b->node_room * 2;
        struct bvh_node *nodes = room <= UINT32_MAX ? realloc(b->nodes, room * sizeof *nodes) : NULL;
        if (!nodes) return 0;
        b->nodes = nodes;
        b->node_room = room;
    }
    b->node_count += 2;
    return b->node_count - 2;
}

static int compare_items(const void *a, const void *b) {
    const primitive_ref x = ((const struct item *)a)->ref, y = ((const struct item *)b)->ref;
    return (x > y) - (x < y);
}

/* Whether splitting so few items further costs more than testing each when the node is entered. */
static bool is_leaf(const struct item *items, uint32_t count, const struct bounds *box,
                    const struct split *split) {
    if (count > ACCEL_LEAF_SIZE) return false;
    float test = 0.0f;
    for (uint32_t i = 0; i < count; i++) test += TEST_COST[primitive_ref_kind(items[i].ref)];
    const float area = bounds_area(box);
    return !(BOXES_COST * area + split->cost * test / (float)count < area * test);
}

/* Makes nodes[index] of items first .. first+count-1. False: memory is out. The recursion is no
 * deeper than ACCEL_MAX_DEPTH: where `depth` leaves just the levels that halving needs, it halves. */
static bool build_node(struct builder *b, size_t index, uint32_t first, uint32_t count, unsigned depth) {
    struct item *items = b->items + first;
    struct bounds box = NOWHERE, centers = NOWHERE;
    for (uint32_t i = 0; i < count; i++) {
        bounds_add(&box, &items[i].box);
        const float c[3] = {item_center(&items[i], 0), item_center(&items[i], 1), item_center(&items[i], 2)};
        bounds_add(&centers, &(struct bounds){{c[0], c[1], c[2]}, {c[0], c[1], c[2]}});
    }
    struct bvh_node node = {.first = first, .count = (uint16_t)count};
    memcpy(node.bounds, &box, sizeof node.bounds);

    struct split split = {.cost = INFINITY};
    if (count > 1 && depth + 1 + halvings(count) <= ACCEL_MAX_DEPTH)
        split = find_split(items, count, &centers);
    if (is_leaf(items, count, &box, &split)) {
        qsort(items, count, sizeof *items, compare_items);
        const bool instances = primitive_ref_kind(items[count - 1].ref) == PRIMITIVE_INSTANCE;
        node.axis = instances ? LEAF_WITH_INSTANCES : LEAF_OF_SHAPES;
        b->nodes[index] = node;
        return true;
    }
    if (!(split.cost < INFINITY)) split.axis = widest_axis(&centers);
    const uint32_t left = split.cost < INFINITY ? partition(items, count, &split)
                                                : partition_at_median(items, count, split.axis);
    assert(left > 0 && left < count);
    const size_t pair = add_pair(b);
    if (!pair) return false;
    node.first = (uint32_t)pair;
    node.count = 0;
    node.axis = (uint16_t)split.axis;
    b->nodes[index] = node;
    return build_node(b, pair, first, left, depth + 1) &&
           build_node(b, pair + 1, first + left, count - left, depth + 1);
}

/* False: memory is out. */
static bool build(struct builder *b, const struct choice *choice) {
    const size_t room = (size_t)choice->accel->primitives->count + 1;
    b->items = malloc(room * sizeof *b->items);
    b->unbounded = malloc(room * sizeof *b->unbounded);
    if (!b->items || !b->unbounded) return false;
    collect(b, choice);
    if (!b->item_count) return true;
    b->node_room = 2 + (size_t)b->item_count / 2;
    b->nodes = malloc(b->node_room * sizeof *b->nodes);
    if (!b->nodes) return false;
    b->node_count = 2;
    memset(b->nodes, 0, 2 * sizeof *b->nodes);
    return build_node(b, 0, 0, b->item_count, 0);
}

/* ---- The result ---- */

/* arena_alloc, but NULL where that would leave by longjmp: the builder must be freed first. */
static void *arena_try(struct arena *arena, size_t size) {
    jmp_buf full;
    jmp_buf *const outer = arena->on_full;
    void *volatile memory = NULL;
    arena->on_full = &full;
    if (!setjmp(full)) memory = arena_alloc(arena, size);
    arena->on_full = outer;
    return memory;
}

/* Copies what was built into the arena, at its exact size. NULL: the arena is full. */
static struct bvh *settle(const struct builder *b, struct arena *arena) {
    enum { CACHE_LINE = 64 };
    const size_t refs = (size_t)b->item_count + b->unbounded_count;
    unsigned char *memory = arena_try(arena, CACHE_LINE + b->node_count * sizeof *b->nodes +
                                                 refs * sizeof(primitive_ref) + sizeof(struct bvh));
    if (!memory) return NULL;
    struct bvh *bvh = (struct bvh *)(void *)memory;
    memory += sizeof *bvh;
    memory += (CACHE_LINE - (uintptr_t)memory % CACHE_LINE) % CACHE_LINE;
    struct bvh_node *nodes = (struct bvh_node *)(void *)memory;
    primitive_ref *bounded = (primitive_ref *)(void *)(nodes + b->node_count);
    primitive_ref *unbounded = bounded + b->item_count;
    if (b->node_count) memcpy(nodes, b->nodes, b->node_count * sizeof *nodes);
    for (uint32_t i = 0; i < b->item_count; i++) bounded[i] = b->items[i].ref;
    for (uint32_t i = 0; i < b->unbounded_count; i++) unbounded[i] = b->unbounded[i];
    *bvh = (struct bvh){
        .nodes = nodes,
        .node_count = (uint32_t)b->node_count,
        .refs = bounded,
        .unbounded = unbounded,
        .unbounded_count = b->unbounded_count,
        .bounds = b->bounds,
    };
    return bvh;
}

static const struct bvh *bvh_build(struct arena *arena, const struct choice *choice) {
    struct builder b = {0};
    const struct bvh *bvh = build(&b, choice) ? settle(&b, arena) : NULL;
    free(b.items);
    free(b.nodes);
    free(b.unbounded);
    return bvh ? bvh : arena_alloc(arena, SIZE_MAX); /* no memory: leave as a full arena does */
}

/* ---- Geometries ---- */

/* One of the hierarchies of a geometry. */
struct variant {
    uint64_t clear; /* slots, bit by bit */
    const struct accel *built;
    struct variant *next;
};

struct geometry {
    uint32_t depth;                 /* instances within each other, below its own primitives */
    struct variant *first, *latest; /* all of them; the one that was asked for last */
};

struct build {
    struct arena *arena;
    const struct primitives *geometries;
    struct geometry *known; /* by index of geometry */
    struct table variants;  /* by geometry and clear slots */
    const bool *clear;
};

/* What the instance places, in a set with these clear materials. New variants are added. */
static struct variant *variant_of(struct build *build, const struct instance *instance,
                                  const struct clear *around) {
    struct geometry *g = &build->known[instance->geometry];
    uint64_t clear = 0;
    for (uint32_t i = 0; i < build->geometries[instance->geometry].slots; i++)
        clear |= (uint64_t)is_clear(around, instance->materials[i]) << i;
    if (g->latest && g->latest->clear == clear) return g->latest;
    char name[32];
    snprintf(name, sizeof name, "%" PRIu32 " %" PRIx64, instance->geometry, clear);
    g->latest = table_find(&build->variants, name);
    if (g->latest) return g->latest;
    g->latest = arena_alloc(build->arena, sizeof *g->latest);
    *g->latest = (struct variant){.clear = clear, .next = g->first};
    table_put(build->arena, &build->variants, arena_text(build->arena, name, strlen(name)), g->latest);
    return g->first = g->latest;
}

static void measure_depth(struct build *build, uint32_t index) {
    const struct primitives *p = &build->geometries[index];
    struct geometry *g = &build->known[index];
    for (uint32_t i = 0; i < p->instance_count; i++) {
        assert(p->instances[i].geometry < index);
        const struct geometry *inner = &build->known[p->instances[i].geometry];
        if (g->depth <= inner->depth) g->depth = inner->depth + 1;
    }
    assert(g->depth < INSTANCE_MAX_DEPTH);
}

static void find_variants(struct build *build, const struct primitives *p, uint64_t clear_slots) {
    const struct clear clear = {build->clear, clear_slots};
    for (uint32_t i = 0; i < p->instance_count; i++) variant_of(build, &p->instances[i], &clear);
}

static struct accel *build_set(struct build *build, const struct primitives *p, uint64_t clear_slots) {
    const struct clear clear = {build->clear, clear_slots};
    struct accel *accel = arena_alloc(build->arena, sizeof *accel);
    accel->primitives = p;
    accel->placed = arena_array(build->arena, p->instance_count, sizeof *accel->placed);
    for (uint32_t i = 0; i < p->instance_count; i++)
        accel->placed[i] = variant_of(build, &p->instances[i], &clear)->built;
    accel->opaque = bvh_build(build->arena, &(struct choice){accel, clear, false});
    accel->clear = bvh_build(build->arena, &(struct choice){accel, clear, true});
    return accel;
}

struct accel *accel_build(struct arena *arena, const struct primitives *primitives,
                          const struct primitives *geometries, uint32_t geometry_count, const bool *clear) {
    struct geometry *known = arena_array(arena, geometry_count, sizeof *known);
    struct build build = {.arena = arena, .geometries = geometries, .known = known, .clear = clear};
    for (uint32_t i = 0; i < geometry_count; i++) measure_depth(&build, i);
    find_variants(&build, primitives, 0);
    for (uint32_t i = geometry_count; i-- > 0;)
        for (struct variant *v = known[i].first; v; v = v->next)
            find_variants(&build, &geometries[i], v->clear);
    for (uint32_t i = 0; i < geometry_count; i++)
        for (struct variant *v = known[i].first; v; v = v->next)
            v->built = build_set(&build, &geometries[i], v->clear);
    return build_set(&build, primitives, 0);
}

box3 accel_bounds(const struct accel *accel) {
    return box3_union(accel->opaque->bounds, accel->clear->bounds);
}
