#include "shape/patch.h"

#include "shape/numeric.h"

/* The function of a patch about a point of object space. */
struct level {
    double value;
    vec3 gradient;
    double size; /* of the terms that add up to the value, also where a line through the point is
                    closer to the origin */
    double bend; /* no second derivative, along a unit direction, is larger */
};

static struct level form_level(const struct quadric_form *f, vec3 p) {
    const double square = vec3_max_abs((vec3){f->xx, f->yy, f->zz});
    const double mixed = vec3_max_abs((vec3){f->xy, f->yz, f->zx});
    const double line = vec3_max_abs((vec3){f->x, f->y, f->z});
    const double reach = fabs(p.x) + fabs(p.y) + fabs(p.z);
    return (struct level){
        .value = form_value(f, p),
        .gradient = {2.0 * f->xx * p.x + f->xy * p.y + f->zx * p.z + f->x,
                     2.0 * f->yy * p.y + f->xy * p.x + f->yz * p.z + f->y,
                     2.0 * f->zz * p.z + f->zx * p.x + f->yz * p.y + f->z},
        .size = ((square + mixed) * reach + line) * reach + fabs(f->constant),
        .bend = 2.0 * (square + mixed),
    };
}

static struct level plane_level(const struct patch *patch, vec3 p) {
    const double along = vec3_component(p, patch->axis), sign = patch->sign;
    return (struct level){
        .value = sign * (along - patch->at),
        .gradient = {patch->axis == 0 ? sign : 0.0, patch->axis == 1 ? sign : 0.0,
                     patch->axis == 2 ? sign : 0.0},
        .size = fabs(along) + fabs(patch->at),
    };
}

static struct level patch_level(const struct patch *patch, vec3 p) {
    return patch->form ? form_level(patch->form, p) : plane_level(patch, p);
}

/* One step of Newton's method from `point` of world space, down the gradient. Where the gradient is
 * too small for the value (about the apex of a cone) the step would lead anywhere: none is made. */
static vec3 newton_step(const affine *object_from_world, const struct level *level, vec3 gradient,
                        vec3 point) {
    const double slope2 = vec3_dot(gradient, gradient);
    const vec3 along = affine_direction(object_from_world, gradient);
    const double bend = level->bend * vec3_dot(along, along);
    if (!(2.0 * fabs(level->value) * bend < slope2 * slope2)) return point;
    return vec3_madd(point, -level->value / slope2, gradient);
}

/* How far from the surface `point` and the origins of rays about it may be found, along the normal.
 * All is counted in the value of the function, where the roundings of the map and of the terms add
 * up, and then divided by its slope; about a singular point its bend is what separates the sides. */
static double patch_error(const affine *object_from_world, const struct level *level, vec3 gradient,
                          vec3 normal, vec3 point, vec3 reach) {
    const vec3 size = affine_magnitude(object_from_world, vec3_add(vec3_abs(point), reach));
    const vec3 off = vec3_scale(size, ROUNDING);
    const double noise =
        vec3_dot(vec3_abs(level->gradient), off) + level->bend * vec3_dot(off, off) + ROUNDING * level->size;
    const double smooth = noise / vec3_length(gradient);
    if (level->bend == 0.0) return smooth;
    const vec3 along = affine_direction(object_from_world, normal);
    const double singular = 2.0 * sqrt(noise / (level->bend * vec3_dot(along, along)));
    return smooth < singular ? smooth : singular;
}

struct surface patch_surface(const struct patch *patch, const affine *object_from_world, vec3 reach, ray r,
                             double t) {
    vec3 point = ray_at(r, t), gradient = {0, 0, 0};
    struct level level = {0};
    for (int step = 0; step < 2; step++) {
        level = patch_level(patch, affine_point(object_from_world, point));
        gradient = affine_normal(object_from_world, level.gradient);
        point = newton_step(object_from_world, &level, gradient, point);
    }
    const vec3 outwards = vec3_max_abs(gradient) > 0.0 ? gradient : vec3_neg(r.dir); /* apex: any will do */
    const vec3 normal = vec3_normalize(outwards);
    return (struct surface){point, normal,
                            patch_error(object_from_world, &level, gradient, normal, point, reach)};
}
