#include "shape/sphere.h"

#include "shape/numeric.h"

int sphere_crossings(const struct sphere *s, ray r, struct crossing out[SHAPE_MAX_CROSSINGS]) {
    double enter, leave;
    if (!sphere_chord(s, r, &enter, &leave)) return 0;
    out[0] = (struct crossing){enter, SHAPE_SIDE};
    out[1] = (struct crossing){leave, SHAPE_SIDE};
    return 2;
}

struct surface sphere_surface(const struct sphere *s, ray r, double t) {
    const vec3 out = vec3_sub(ray_at(r, t), s->center);
    const vec3 normal = vec3_max_abs(out) > 0.0 ? vec3_normalize(out) : vec3_normalize(vec3_neg(r.dir));
    const vec3 point = vec3_madd(s->center, s->radius, normal);
    const double size = vec3_dot(vec3_abs(normal), vec3_abs(point)) + s->radius;
    return (struct surface){point, normal, ROUNDING * size};
}

bool sphere_contains(const struct sphere *s, vec3 point) {
    const vec3 out = vec3_sub(point, s->center);
    return vec3_dot(out, out) < s->radius * s->radius;
}
