/* Three doubles: a point, a direction, a normal or a linear colour. What it is, and in which space,
 * the field or the argument says. Everything here is exact-order IEEE arithmetic: no contraction. */
#ifndef MONGE_BASE_VEC3_H
#define MONGE_BASE_VEC3_H

#include <math.h>
#include <stdbool.h>

typedef struct {
    double x, y, z;
} vec3;

static inline vec3 vec3_add(vec3 a, vec3 b) { return (vec3){a.x + b.x, a.y + b.y, a.z + b.z}; }
static inline vec3 vec3_sub(vec3 a, vec3 b) { return (vec3){a.x - b.x, a.y - b.y, a.z - b.z}; }
static inline vec3 vec3_mul(vec3 a, vec3 b) { return (vec3){a.x * b.x, a.y * b.y, a.z * b.z}; }
static inline vec3 vec3_scale(vec3 a, double s) { return (vec3){a.x * s, a.y * s, a.z * s}; }
static inline vec3 vec3_neg(vec3 a) { return (vec3){-a.x, -a.y, -a.z}; }
static inline vec3 vec3_all(double s) { return (vec3){s, s, s}; }
static inline vec3 vec3_abs(vec3 a) { return (vec3){fabs(a.x), fabs(a.y), fabs(a.z)}; }

/* a + s b */
static inline vec3 vec3_madd(vec3 a, double s, vec3 b) {
    return (vec3){a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}

static inline double vec3_dot(vec3 a, vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

static inline vec3 vec3_cross(vec3 a, vec3 b) {
    return (vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/* The largest magnitude among the components. */
static inline double vec3_max_abs(vec3 a) {
    const vec3 b = vec3_abs(a);
    const double yz = b.y > b.z ? b.y : b.z;
    return b.x > yz ? b.x : yz;
}

/* Whether a squared length neither overflowed nor lost digits to underflow. */
static inline bool vec3_is_plain(double length2) { return length2 > 1e-280 && length2 < 1e280; }

/* Euclidean length; right for components of any finite size. */
static inline double vec3_length(vec3 a) {
    const double length2 = vec3_dot(a, a);
    if (vec3_is_plain(length2)) return sqrt(length2);
    const double big = vec3_max_abs(a);
    if (!(big > 0.0)) return 0.0;
    const vec3 unit = {a.x / big, a.y / big, a.z / big};
    return big * sqrt(vec3_dot(unit, unit));
}

/* `a` at length one; the null vector stays null. */
static inline vec3 vec3_normalize(vec3 a) {
    const double length2 = vec3_dot(a, a);
    if (vec3_is_plain(length2)) return vec3_scale(a, 1.0 / sqrt(length2));
    const double big = vec3_max_abs(a);
    if (!(big > 0.0)) return a;
    const vec3 unit = {a.x / big, a.y / big, a.z / big};
    return vec3_scale(unit, 1.0 / sqrt(vec3_dot(unit, unit)));
}

static inline bool vec3_is_finite(vec3 a) { return isfinite(a.x) && isfinite(a.y) && isfinite(a.z); }

#endif
