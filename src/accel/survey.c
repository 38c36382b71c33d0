/* Questions to the hierarchy that are not about what a ray hits. */
#include "accel/bvh.h"

/* Nodes to come back to. Each level of the tree leaves one. */
struct stack {
    uint32_t node[ACCEL_MAX_DEPTH];
    int depth;
};

/* ---- What is around a point ---- */

struct around {
    void (*visit)(void *context, const struct hit *hit, ray in_set);
    void *context;
    bool clear; /* which of the two trees */
    bool over;  /* the budget is used up */
    struct budget budget;
    struct hit hit; /* being made: `which` leads to the set that the search is in */
    const struct instance *chain[INSTANCE_MAX_DEPTH]; /* the same way */
};

static bool node_holds(const struct bvh_node *node, vec3 p) {
    const float *b = node->bounds;
    return (double)b[0] <= p.x && p.x <= (double)b[3] && (double)b[1] <= p.y && p.y <= (double)b[4] &&
           (double)b[2] <= p.z && p.z <= (double)b[5];
}

static void around_set(struct around *a, const struct accel *accel, ray r);

static void around_run(struct around *a, const struct accel *accel, ray r, const primitive_ref *refs,
                       uint32_t count) {
    const struct primitives *p = accel->primitives;
    struct occurrence *which = &a->hit.which;
    for (uint32_t i = 0; i < count && !a->over; i++) {
        const uint32_t number = which->number[which->depth] = primitives_number(p, refs[i]);
        if (primitive_ref_kind(refs[i]) == PRIMITIVE_INSTANCE) {
            const uint32_t index = primitive_ref_index(refs[i]);
            const struct instance *instance = &p->instances[index];
            a->over |= !budget_take(&a->budget, which->number[0]);
            if (a->over) return;
            a->chain[which->depth++] = instance;
            around_set(a, accel->placed[index], affine_ray(&instance->object_from_world, r));
            which->depth--;
            continue;
        }
        a->hit.set = p;
        a->hit.ref = refs[i];
        a->hit.material = material_in_scene(a->chain, which->depth, p->info[number].material);
        a->visit(a->context, &a->hit, r);
    }
}

static void around_set(struct around *a, const struct accel *accel, ray r) {
    const struct bvh *bvh = accel_tree(accel, a->clear);
    around_run(a, accel, r, bvh->unbounded, bvh->unbounded_count);
    if (!bvh->node_count) return;
    struct stack stack = {.depth = 1}; /* the root */
    while (stack.depth > 0 && !a->over) {
        const struct bvh_node *node = &bvh->nodes[stack.node[--stack.depth]];
        while (node_holds(node, r.org)) {
            if (node->count) {
                around_run(a, accel, r, bvh->refs + node->first, node->count);
                break;
            }
            stack.node[stack.depth++] = node->first + 1;
            node = &bvh->nodes[node->first];
        }
    }
}

static void around_begin(struct around *a, const struct accel *accel, struct accel_watch *watch, ray r) {
    if (budget_begin(&a->budget, watch)) around_set(a, accel, r);
}

void accel_around(const struct accel *accel, struct accel_watch *watch, ray r,
                  void (*visit)(void *context, const struct hit *hit, ray in_set), void *context) {
    struct around a = {.visit = visit, .context = context, .clear = true};
    around_begin(&a, accel, watch, r);
}

void accel_around_opaque(const struct accel *accel, struct accel_watch *watch, ray r,
                         void (*visit)(void *context, const struct hit *hit, ray in_set), void *context) {
    struct around a = {.visit = visit, .context = context, .clear = false};
    around_begin(&a, accel, watch, r);
}

box3 accel_placed_bounds(const struct accel *accel, uint32_t index) {
    const struct accel *placed = accel->placed[index];
    if (placed->opaque->unbounded_count || placed->clear->unbounded_count) return BOX3_ALL;
    return shape_placed_bounds(&accel->primitives->instances[index], accel_bounds(placed));
}

/* ---- How far a scene reaches ---- */

#ifdef MONGE_HOSTILE
enum { REACH_BUDGET = 1 << 12 };
#else
enum { REACH_BUDGET = 1 << 18 }; /* boxes looked into; after that a box stands for what is in it */
#endif

struct reach {
    double most;
    double slack;  /* what would not add more than this is left out */
    uint32_t left; /* of the budget */
};

/* The direction as a set sees it: a point p of the set reaches offset + dot(along, p). */
struct measure {
    vec3 along;
    double offset;
};

static double box_reach(const struct measure *m, box3 b) {
    return m->offset + m->along.x * (m->along.x > 0.0 ? b.max.x : b.min.x) +
           m->along.y * (m->along.y > 0.0 ? b.max.y : b.min.y) +
           m->along.z * (m->along.z > 0.0 ? b.max.z : b.min.z);
}

static double node_reach(const struct measure *m, const struct bvh_node *node) {
    const float *b = node->bounds;
    return box_reach(
        m, (box3){{(double)b[0], (double)b[1], (double)b[2]}, {(double)b[3], (double)b[4], (double)b[5]}});
}

/* Whether to look into a box that reaches so far. */
static bool worth_it(struct reach *reach, double most) {
    if (!(most > reach->most + reach->slack)) return false;
    if (reach->left) return reach->left--, true;
    reach->most = most;
    return false;
}

static void reach_set(struct reach *reach, const struct accel *accel, const struct measure *m);

static void reach_run(struct reach *reach, const struct accel *accel, const struct measure *m,
                      const primitive_ref *refs, uint32_t count) {
    const struct primitives *p = accel->primitives;
    for (uint32_t i = 0; i < count; i++) {
        if (primitive_ref_kind(refs[i]) == PRIMITIVE_INSTANCE) {
            const affine *map = &p->instances[primitive_ref_index(refs[i])].world_from_object;
            const struct accel *placed = accel->placed[primitive_ref_index(refs[i])];
            const vec3 x = affine_column(*map, 0), y = affine_column(*map, 1), z = affine_column(*map, 2);
            const struct measure inner = {
                {vec3_dot(x, m->along), vec3_dot(y, m->along), vec3_dot(z, m->along)},
                m->offset + vec3_dot(affine_column(*map, 3), m->along)};
            reach_set(reach, placed, &inner);
        } else {
            const double most = m->offset + shape_support(p, refs[i], m->along);
            if (most > reach->most && most < INFINITY) reach->most = most;
        }
    }
}

/* The part that reaches further comes first: then there is little else to look into. Nothing bounded
 * reaches beyond `limit`; the boxes of nodes do, by their margin. */
static void reach_tree(struct reach *reach, const struct accel *accel, const struct bvh *bvh,
                       const struct measure *m, double limit) {
    reach_run(reach, accel, m, bvh->unbounded, bvh->unbounded_count);
    if (!bvh->node_count) return;
    struct stack stack = {.depth = 1}; /* the root */
    while (stack.depth > 0) {
        const struct bvh_node *node = &bvh->nodes[stack.node[--stack.depth]];
        while (worth_it(reach, box3_lower(node_reach(m, node), limit))) {
            if (node->count) {
                reach_run(reach, accel, m, bvh->refs + node->first, node->count);
                break;
            }
            const bool second =
                node_reach(m, &bvh->nodes[node->first + 1]) > node_reach(m, &bvh->nodes[node->first]);
            stack.node[stack.depth++] = node->first + !second;
            node = &bvh->nodes[node->first + second];
        }
    }
}

static void reach_set(struct reach *reach, const struct accel *accel, const struct measure *m) {
    const box3 bounds = accel_bounds(accel);
    if (box3_is_empty(bounds)) return;
    const double limit = box_reach(m, bounds);
    if (!worth_it(reach, limit)) return;
    reach_tree(reach, accel, accel->opaque, m, limit);
    reach_tree(reach, accel, accel->clear, m, limit);
}

static double shapes_support(const struct primitives *p, vec3 direction) {
    double most = -INFINITY;
    for (uint32_t i = 0; i < p->count; i++) {
        const double one = shape_support(p, p->info[i].ref, direction);
        if (one > most && one < INFINITY) most = one;
    }
    return most;
}

double accel_support(const struct accel *accel, vec3 direction) {
    if (!accel->primitives->instance_count) return shapes_support(accel->primitives, direction);
    const struct measure to = {direction, 0.0}, fro = {vec3_neg(direction), 0.0};
    const box3 bounds = accel_bounds(accel);
    struct reach reach = {.most = -INFINITY, .left = REACH_BUDGET};
    if (box3_is_bounded(bounds)) reach.slack = 1e-6 * (box_reach(&to, bounds) + box_reach(&fro, bounds));
    reach_set(&reach, accel, &to);
    return reach.most;
}

box3 accel_extent(const struct accel *accel) {
    const box3 bounds = accel_bounds(accel);
    if (!accel->primitives->instance_count || box3_is_empty(bounds)) return bounds;
    const vec3 min = {-accel_support(accel, (vec3){-1, 0, 0}), -accel_support(accel, (vec3){0, -1, 0}),
                      -accel_support(accel, (vec3){0, 0, -1})};
    const vec3 max = {accel_support(accel, (vec3){1, 0, 0}), accel_support(accel, (vec3){0, 1, 0}),
                      accel_support(accel, (vec3){0, 0, 1})};
    return (box3){min, max};
}
