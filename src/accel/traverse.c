/* Walks the hierarchy along a ray, near children first, with a stack of the far ones, and on into the
 * hierarchies of the instances that it comes to. */
#include "accel/bvh.h"

/* A ray as the boxes see it: t = (plane - org) * inverse. Origins moved by the rounding of that
 * subtraction, each to the side that widens the box, so the test never misses a box that the exact
 * ray meets (to the same end as Ize, "Robust BVH ray traversal", 2013). */
struct box_ray {
    double inverse[3];
    double near_org[3], far_org[3];
    size_t near_plane[3], far_plane[3]; /* which of a node's six planes come first and last */
};

/* What was found so far; a candidate must have t <= best.t. */
struct search {
    double t_min;
    bool clear; /* which trees are searched */
    struct budget budget;
    struct crossing best;
    struct occurrence which;           /* of the best; the number UINT32_MAX: none yet */
    uint32_t path[INSTANCE_MAX_DEPTH]; /* numbers of the instances that the search is in, outermost first */
};

/* The ray in one set of primitives, that of the scene or of a geometry. t is the same in all. */
struct level {
    const struct accel *accel;
    uint32_t depth; /* of instances around */
    ray r;
    struct box_ray boxes; /* r again */
};

static struct box_ray box_ray_make(ray r) {
    const double org[3] = {r.org.x, r.org.y, r.org.z}, dir[3] = {r.dir.x, r.dir.y, r.dir.z};
    const double slack = vec3_max_abs(r.org) * 0x1p-49;
    struct box_ray b;
    for (int k = 0; k < 3; k++) {
        b.inverse[k] = 1.0 / dir[k];
        const bool down = b.inverse[k] < 0.0;
        b.near_plane[k] = (size_t)(down ? 3 + k : k);
        b.far_plane[k] = (size_t)(down ? k : 3 + k);
        b.near_org[k] = down ? org[k] - slack : org[k] + slack;
        b.far_org[k] = down ? org[k] + slack : org[k] - slack;
    }
    return b;
}

static inline double larger(double a, double b) { return a > b ? a : b; }
static inline double smaller(double a, double b) { return a < b ? a : b; }

/* Whether the ray meets the node's box within t_min .. t_max; *enter is where, or just t_min.
 * Written out by axis: -O2 does not unroll, and this is where the time goes.
 * Along the plane of a face 0 * infinity is not a number. In this order of terms neither *enter nor leave becomes that:
 * at most the bounds of other axes are lost with it, and the box is met for nothing. */
static inline bool box_meet(const struct bvh_node *node, const struct box_ray *b, double t_min, double t_max,
                            double *enter) {
    const float *plane = node->bounds;
    const double near_x = ((double)plane[b->near_plane[0]] - b->near_org[0]) * b->inverse[0];
    const double near_y = ((double)plane[b->near_plane[1]] - b->near_org[1]) * b->inverse[1];
    const double near_z = ((double)plane[b->near_plane[2]] - b->near_org[2]) * b->inverse[2];
    const double far_x = ((double)plane[b->far_plane[0]] - b->far_org[0]) * b->inverse[0];
    const double far_y = ((double)plane[b->far_plane[1]] - b->far_org[1]) * b->inverse[1];
    const double far_z = ((double)plane[b->far_plane[2]] - b->far_org[2]) * b->inverse[2];
    *enter = larger(larger(near_x, near_y), larger(near_z, t_min));
    const double leave = smaller(smaller(far_x, far_y), smaller(far_z, t_max));
    return *enter <= leave;
}

/* Whether a primitive of the level comes before the best one, at the same t. */
static bool comes_first(const struct search *s, const struct level *level, uint32_t number) {
    for (uint32_t i = 0; i < level->depth; i++)
        if (s->path[i] != s->which.number[i]) return s->path[i] < s->which.number[i];
    return number < s->which.number[level->depth];
}

static inline void take(struct search *s, const struct level *level, uint32_t number,
                        struct crossing crossing) {
    s->best = crossing;
    s->which.depth = level->depth;
    for (uint32_t i = 0; i < level->depth; i++) s->which.number[i] = s->path[i];
    s->which.number[level->depth] = number;
}

/* Tests a run of shapes; true ends an any-hit search, whose end is left out of its range. */
static inline bool search_run(struct search *s, const struct level *level, const primitive_ref *refs,
                              uint32_t count, bool any) {
    const struct primitives *primitives = level->accel->primitives;
    for (uint32_t i = 0; i < count; i++) {
        struct crossing crossing;
        if (!shape_first_crossing(primitives, refs[i], level->r, s->t_min, s->best.t, &crossing)) continue;
        if (any) {
            if (crossing.t < s->best.t) return true;
            continue;
        }
        const uint32_t number = primitives_number(primitives, refs[i]);
        if (crossing.t < s->best.t || comes_first(s, level, number)) take(s, level, number, crossing);
    }
    return false;
}

/* True ends the search: an any-hit one that has found one, and each whose budget is used up. */
static bool search_instance(struct search *s, const struct level *around, uint32_t index, bool any);

/* The same of a run that may have instances in it. */
static bool search_mixed_run(struct search *s, const struct level *level, const primitive_ref *refs,
                             uint32_t count, bool any) {
    for (uint32_t i = 0; i < count; i++) {
        const bool instance = primitive_ref_kind(refs[i]) == PRIMITIVE_INSTANCE;
        if (instance ? search_instance(s, level, primitive_ref_index(refs[i]), any)
                     : search_run(s, level, refs + i, 1, any))
            return true;
    }
    return false;
}

/* Far children to come back to, each with the t where the ray enters it. */
struct stack {
    struct {
        uint32_t node;
        double enter;
    } at[ACCEL_MAX_DEPTH];
    int depth;
};

/* The child to go to first, the other one on the stack if it is met too; NULL where none is. A box
 * that begins just at the best t is met: it may hold an equal hit of a lower number. */
static inline const struct bvh_node *descend(const struct bvh *bvh, const struct bvh_node *node,
                                             const struct box_ray *boxes, const struct search *s,
                                             struct stack *stack) {
    const bool down = boxes->near_plane[node->axis] >= 3;
    const uint32_t near = node->first + down, far = node->first + !down;
    double near_enter, far_enter;
    const bool meets_near = box_meet(&bvh->nodes[near], boxes, s->t_min, s->best.t, &near_enter);
    const bool meets_far = box_meet(&bvh->nodes[far], boxes, s->t_min, s->best.t, &far_enter);
    if (!meets_near) return meets_far ? &bvh->nodes[far] : NULL;
    if (meets_far) {
        stack->at[stack->depth].node = far;
        stack->at[stack->depth++].enter = far_enter;
    }
    return &bvh->nodes[near];
}

static inline const struct bvh_node *pop(const struct bvh *bvh, struct stack *stack, double t_best) {
    while (stack->depth > 0)
        if (stack->at[--stack->depth].enter <= t_best) return &bvh->nodes[stack->at[stack->depth].node];
    return NULL;
}

/* True when an any-hit search has found one, or the budget is used up; else s->best is the nearest. */
static inline bool search_tree(struct search *s, const struct level *level, bool any) {
    const struct bvh *bvh = accel_tree(level->accel, s->clear);
    if (bvh->unbounded_count && search_mixed_run(s, level, bvh->unbounded, bvh->unbounded_count, any))
        return true;
    if (!bvh->node_count) return false;
    struct stack stack;
    stack.depth = 0;
    double enter;
    if (!box_meet(bvh->nodes, &level->boxes, s->t_min, s->best.t, &enter)) return false;
    for (const struct bvh_node *node = bvh->nodes; node;) {
        const struct bvh_node *child = NULL;
        if (!node->count)
            child = descend(bvh, node, &level->boxes, s, &stack);
        else if (node->axis == LEAF_WITH_INSTANCES
                     ? search_mixed_run(s, level, bvh->refs + node->first, node->count, any)
                     : search_run(s, level, bvh->refs + node->first, node->count, any))
            return true;
        node = child ? child : pop(bvh, &stack, s->best.t);
    }
    return false;
}

static bool search_nearest(struct search *s, const struct level *level) {
    return search_tree(s, level, false);
}
static bool search_any(struct search *s, const struct level *level) { return search_tree(s, level, true); }

static inline void level_begin(struct level *level, const struct accel *accel, uint32_t depth, ray r) {
    level->accel = accel;
    level->depth = depth;
    level->r = r;
    level->boxes = box_ray_make(r);
}

static bool search_instance(struct search *s, const struct level *around, uint32_t index, bool any) {
    const struct primitives *primitives = around->accel->primitives;
    s->path[around->depth] = primitives->instance_number[index];
    if (!budget_take(&s->budget, s->path[0])) return true;
    const ray r = affine_ray(&primitives->instances[index].object_from_world, around->r);
    struct level level;
    level_begin(&level, around->accel->placed[index], around->depth + 1, r);
    return any ? search_any(s, &level) : search_nearest(s, &level);
}

/* ---- The questions ---- */

/* False: not to be searched. */
static inline bool search_begin(struct search *s, struct accel_watch *watch, double t_min, double t_max) {
    s->t_min = t_min;
    s->best.t = t_max;
    s->which.number[0] = UINT32_MAX;
    return budget_begin(&s->budget, watch);
}

static const struct instance *instance_of(const struct primitives *p, uint32_t number) {
    return &p->instances[primitive_ref_index(p->info[number].ref)];
}

/* Sets what `which` tells: the primitive and its material. */
static void resolve(const struct accel *accel, struct hit *hit) {
    const struct instance *chain[INSTANCE_MAX_DEPTH];
    const struct occurrence *which = &hit->which;
    for (uint32_t i = 0; i < which->depth; i++) {
        chain[i] = instance_of(accel->primitives, which->number[i]);
        accel = accel->placed[chain[i] - accel->primitives->instances];
    }
    const struct primitive_info *info = &accel->primitives->info[which->number[which->depth]];
    hit->set = accel->primitives;
    hit->ref = info->ref;
    hit->material = material_in_scene(chain, which->depth, info->material);
}

static inline void occurrence_copy(struct occurrence *to, const struct occurrence *from) {
    to->depth = from->depth;
    for (uint32_t i = 0; i <= from->depth; i++) to->number[i] = from->number[i];
}

static bool search_result(const struct search *s, const struct accel *accel, struct hit *hit) {
    if (s->which.number[0] == UINT32_MAX) return false;
    hit->crossing = s->best;
    occurrence_copy(&hit->which, &s->which);
    resolve(accel, hit);
    return true;
}

bool accel_nearest(const struct accel *accel, struct accel_watch *watch, ray r, double t_min, double t_max,
                   struct hit *hit) {
    struct level level;
    struct search s;
    level_begin(&level, accel, 0, r);
    if (!search_begin(&s, watch, t_min, t_max)) return false;
    s.clear = false;
    if (search_nearest(&s, &level)) return false;
    s.clear = true;
    if (search_nearest(&s, &level)) return false;
    return search_result(&s, accel, hit);
}

bool accel_nearest_clear(const struct accel *accel, struct accel_watch *watch, ray r, double t_min,
                         double t_max, struct hit *hit) {
    if (bvh_is_empty(accel->clear)) return false; /* most scenes */
    struct level level;
    struct search s;
    level_begin(&level, accel, 0, r);
    if (!search_begin(&s, watch, t_min, t_max)) return false;
    s.clear = true;
    if (search_nearest(&s, &level)) return false;
    return search_result(&s, accel, hit);
}

bool accel_any(const struct accel *accel, struct accel_watch *watch, ray r, double t_min, double t_max) {
    struct level level;
    struct search s;
    level_begin(&level, accel, 0, r);
    if (!search_begin(&s, watch, t_min, t_max)) return true;
    s.clear = false;
    return search_any(&s, &level);
}

struct surface accel_surface(const struct accel *accel, ray r, const struct hit *hit) {
    const struct instance *chain[INSTANCE_MAX_DEPTH];
    box3 extent[INSTANCE_MAX_DEPTH];
    const uint32_t depth = hit->which.depth;
    for (uint32_t i = 0; i < depth; i++) {
        chain[i] = instance_of(accel->primitives, hit->which.number[i]);
        r = affine_ray(&chain[i]->object_from_world, r);
        accel = accel->placed[chain[i] - accel->primitives->instances];
        extent[i] = accel_bounds(accel);
    }
    struct surface surface = shape_surface(hit->set, hit->ref, r, hit->crossing);
    for (uint32_t i = depth; i-- > 0;) surface = shape_placed_surface(chain[i], &surface, extent[i]);
    return surface;
}
