#include "shape/flat.h"

#include "shape/numeric.h"
#include "shape/patch.h"

static double row_point(const double row[4], vec3 p) {
    return row[0] * p.x + row[1] * p.y + row[2] * p.z + row[3];
}

static double row_direction(const double row[4], vec3 d) {
    return row[0] * d.x + row[1] * d.y + row[2] * d.z;
}

/* The crossing at (x, y) of object space, or beyond an edge by no more than its rounding: of the map
 * itself, and of t, which a grazing ray turns into more. */
static bool square_covers(const struct flat *f, ray r, double t, double x, double y) {
    const double past_x = fabs(x) - 0.5, past_y = fabs(y) - 0.5;
    if (past_x <= 0.0 && past_y <= 0.0) return true;
    if (!(past_x < 0.01 && past_y < 0.01)) return false; /* no rounding that matters is so large */
    const vec3 size = vec3_madd(vec3_abs(r.org), fabs(t), vec3_abs(r.dir));
    const vec3 off = vec3_scale(affine_magnitude(&f->object_from_world, size), ROUNDING);
    const vec3 d = affine_direction(&f->object_from_world, r.dir);
    return past_x <= off.x + off.z * fabs(d.x / d.z) && past_y <= off.y + off.z * fabs(d.y / d.z);
}

bool flat_first_crossing(const struct flat *f, ray r, double t_min, double t_max, struct crossing *out) {
    const double(*m)[4] = f->object_from_world.m;
    const double t = -row_point(m[2], r.org) / row_direction(m[2], r.dir);
    if (!(t > t_min && t <= t_max && t < INFINITY)) return false; /* in the plane: 0/0 */
    if (f->outline != FLAT_PLANE) {
        const double x = row_point(m[0], r.org) + t * row_direction(m[0], r.dir);
        const double y = row_point(m[1], r.org) + t * row_direction(m[1], r.dir);
        if (!(f->outline == FLAT_DISC ? x * x + y * y <= 1.0 : square_covers(f, r, t, x, y))) return false;
    }
    *out = (struct crossing){t, SHAPE_SIDE};
    return true;
}

struct surface flat_surface(const struct flat *f, ray r, double t) {
    const struct patch patch = {.axis = 2, .at = 0.0, .sign = 1.0};
    const double width = f->outline == FLAT_PLANE ? 0.0 : f->outline == FLAT_DISC ? 2.0 : 1.0;
    const vec3 reach = map_size(&f->world_from_object, (vec3){width, width, 0.0});
    return patch_surface(&patch, &f->object_from_world, reach, r, t);
}
