/* Builds the hierarchy from the top by the surface area heuristic over bins of centroids, after
 * Wald, "On fast construction of SAH-based bounding volume hierarchies", 2007. */
#include "accel/bvh.h"

#include <assert.h>
#include <float.h>
#include <stdlib.h>
#include <string.h>

enum { BINS = 16 };
/* Of a test of two boxes and of one primitive, measured as about that, in tests of a sphere. */
static const float BOXES_COST = 3.0f;
static const float TEST_COST[] = {
    [PRIMITIVE_SPHERE] = 1.0f, [PRIMITIVE_FLAT] = 1.0f, [PRIMITIVE_QUADRIC] = 3.0f};

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

/* The primitives that a tree is built of: those with clear[number] == which, or all if clear is NULL
 * and which is false. */
struct choice {
    const struct primitives *primitives;
    const bool *clear;
    bool which;
};

/* Sorts the chosen primitives into items and the unbounded. */
static void collect(struct builder *b, const struct choice *choice) {
    const struct primitives *primitives = choice->primitives;
    b->bounds = BOX3_EMPTY;
    for (uint32_t i = 0; i < primitives->count; i++) {
        if ((choice->clear && choice->clear[i]) != choice->which) continue;
        const primitive_ref ref = primitives->info[i].ref;
        const box3 box = shape_bounds(primitives, ref);
        const struct bounds around = bounds_around(box);
        if (box3_is_bounded(box)) b->bounds = box3_union(b->bounds, box);
        if (bounds_are_finite(&around))
            b->items[b->item_count++] = (struct item){around, ref};
        else
            b->unbounded[b->unbounded_count++] = ref;
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
    b->items = malloc(((size_t)choice->primitives->count + 1) * sizeof *b->items);
    b->unbounded = malloc(((size_t)choice->primitives->count + 1) * sizeof *b->unbounded);
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

struct accel *accel_build(struct arena *arena, const struct primitives *primitives, const bool *clear) {
    struct accel *accel = arena_alloc(arena, sizeof *accel);
    accel->primitives = primitives;
    accel->opaque = bvh_build(arena, &(struct choice){primitives, clear, false});
    accel->clear = bvh_build(arena, &(struct choice){primitives, clear, true});
    return accel;
}

box3 accel_bounds(const struct accel *accel) { return box3_union(accel->opaque->bounds, accel->clear->bounds); }
