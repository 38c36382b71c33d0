/* Walks the hierarchy along a ray, near children first, with a stack of the far ones. */
#include "accel/bvh.h"

/* A ray as the boxes see it: t = (plane - org) * inverse. Origins moved by the rounding of that
 * subtraction, each to the side that widens the box, so the test never misses a box that the exact
 * ray meets (to the same end as Ize, "Robust BVH ray traversal", 2013). */
struct box_ray {
    double inverse[3];
    double near_org[3], far_org[3];
    size_t near_plane[3], far_plane[3]; /* which of a node's six planes come first and last */
};

/* What was found so far; a candidate must have t <= crossing.t. */
struct search {
    const struct primitives *primitives;
    ray r;
    struct box_ray boxes; /* r again */
    double t_min;
    struct hit best;
};

static struct box_ray box_ray_make(ray r) {
    const double org[3] = {r.org.x, r.org.y, r.org.z}, dir[3] = {r.dir.x, r.dir.y, r.dir.z};
    const double slack = vec3_max_abs(r.org) * 0x1p-49;
    struct box_ray b;
    for (int k = 0; k < 3; k++) {
        /* Clamped, as 0 * infinity is not a number: a ray along the plane of a face. */
        b.inverse[k] = fabs(dir[k]) > 1e-300 ? 1.0 / dir[k] : copysign(1e300, dir[k]);
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
 * Written out by axis: -O2 does not unroll, and this is where the time goes. */
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

/* Tests a run of primitives; true ends an any-hit search, whose end is left out of its range. */
static inline bool search_run(struct search *s, const primitive_ref *refs, uint32_t count, bool any) {
    for (uint32_t i = 0; i < count; i++) {
        struct crossing crossing;
        if (!shape_first_crossing(s->primitives, refs[i], s->r, s->t_min, s->best.crossing.t, &crossing))
            continue;
        if (any) {
            if (crossing.t < s->best.crossing.t) return true;
            continue;
        }
        const uint32_t number = primitives_number(s->primitives, refs[i]);
        if (crossing.t < s->best.crossing.t || number < s->best.number)
            s->best = (struct hit){number, crossing};
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
                                             const struct search *s, struct stack *stack) {
    const struct box_ray *boxes = &s->boxes;
    const bool down = boxes->near_plane[node->axis] >= 3;
    const uint32_t near = node->first + down, far = node->first + !down;
    double near_enter, far_enter;
    const bool meets_near = box_meet(&bvh->nodes[near], boxes, s->t_min, s->best.crossing.t, &near_enter);
    const bool meets_far = box_meet(&bvh->nodes[far], boxes, s->t_min, s->best.crossing.t, &far_enter);
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

/* True when an any-hit search has found one; else s->best is the nearest. */
static inline bool search_all(struct search *s, const struct bvh *bvh, bool any) {
    if (search_run(s, bvh->unbounded, bvh->unbounded_count, any)) return true;
    if (!bvh->node_count) return false;
    struct stack stack;
    stack.depth = 0;
    double enter;
    if (!box_meet(bvh->nodes, &s->boxes, s->t_min, s->best.crossing.t, &enter)) return false;
    for (const struct bvh_node *node = bvh->nodes; node;) {
        const struct bvh_node *child = NULL;
        if (!node->count)
            child = descend(bvh, node, s, &stack);
        else if (search_run(s, bvh->refs + node->first, node->count, any))
            return true;
        node = child ? child : pop(bvh, &stack, s->best.crossing.t);
    }
    return false;
}

static bool search_result(const struct search *s, struct hit *hit) {
    if (s->best.number == UINT32_MAX) return false;
    *hit = s->best;
    return true;
}

bool accel_nearest(const struct accel *accel, ray r, double t_min, double t_max, struct hit *hit) {
    struct search s = {accel->primitives, r, box_ray_make(r), t_min, {UINT32_MAX, {.t = t_max}}};
    search_all(&s, accel->opaque, false);
    search_all(&s, accel->clear, false);
    return search_result(&s, hit);
}

bool accel_nearest_clear(const struct accel *accel, ray r, double t_min, double t_max, struct hit *hit) {
    if (!accel->clear->node_count && !accel->clear->unbounded_count) return false; /* most scenes */
    struct search s = {accel->primitives, r, box_ray_make(r), t_min, {UINT32_MAX, {.t = t_max}}};
    search_all(&s, accel->clear, false);
    return search_result(&s, hit);
}

bool accel_any(const struct accel *accel, ray r, double t_min, double t_max) {
    struct search s = {accel->primitives, r, box_ray_make(r), t_min, {UINT32_MAX, {.t = t_max}}};
    return search_all(&s, accel->opaque, true);
}
