/* An axis-aligned box. Empty when some min > max; unbounded sides are infinite. */
#ifndef MONGE_BASE_BOX3_H
#define MONGE_BASE_BOX3_H

#include "base/vec3.h"

typedef struct {
    vec3 min, max;
} box3;

#define BOX3_EMPTY ((box3){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}})
#define BOX3_ALL   ((box3){{-INFINITY, -INFINITY, -INFINITY}, {INFINITY, INFINITY, INFINITY}})

static inline double box3_lower(double a, double b) { return b < a ? b : a; }
static inline double box3_upper(double a, double b) { return b > a ? b : a; }

static inline box3 box3_union(box3 a, box3 b) {
    return (box3){{box3_lower(a.min.x, b.min.x), box3_lower(a.min.y, b.min.y), box3_lower(a.min.z, b.min.z)},
                  {box3_upper(a.max.x, b.max.x), box3_upper(a.max.y, b.max.y), box3_upper(a.max.z, b.max.z)}};
}

static inline box3 box3_add_point(box3 a, vec3 p) { return box3_union(a, (box3){p, p}); }

static inline bool box3_is_empty(box3 a) {
    return !(a.min.x <= a.max.x && a.min.y <= a.max.y && a.min.z <= a.max.z);
}

/* Every side finite (and the box not empty). */
static inline bool box3_is_bounded(box3 a) {
    return !box3_is_empty(a) && vec3_is_finite(a.min) && vec3_is_finite(a.max);
}

static inline vec3 box3_center(box3 a) { return vec3_scale(vec3_add(a.min, a.max), 0.5); }

#endif
