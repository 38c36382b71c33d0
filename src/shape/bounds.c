#include "shape/numeric.h"
#include "shape/shape.h"

/* Hits follow object_from_world, the box world_from_object, and each is the other's inverse only to
 * rounding: a point p is hit up to |world_from_object(object_from_world(p)) - p| outside of `box`. */
static box3 bounds_pad(box3 box, const affine *world_from_object, const affine *object_from_world) {
    const vec3 size = {box3_upper(-box.min.x, box.max.x), box3_upper(-box.min.y, box.max.y),
                       box3_upper(-box.min.z, box.max.z)};
    affine gap = affine_compose(*world_from_object, *object_from_world);
    for (int i = 0; i < 3; i++) gap.m[i][i] -= 1.0;
    const vec3 rounding = affine_magnitude(world_from_object, affine_magnitude(object_from_world, size));
    const vec3 pad = vec3_madd(affine_magnitude(&gap, size), ROUNDING, rounding);
    return (box3){vec3_sub(box.min, pad), vec3_add(box.max, pad)};
}

static box3 sphere_bounds(const struct sphere *s) {
    const double size = vec3_max_abs(s->center) + s->radius;
    const vec3 half = vec3_all(s->radius + ROUNDING * size);
    return (box3){vec3_sub(s->center, half), vec3_add(s->center, half)};
}

static box3 flat_bounds(const struct flat *f) {
    const affine *m = &f->world_from_object;
    if (f->outline == FLAT_PLANE) return BOX3_ALL;
    const vec3 x = affine_column(*m, 0), y = affine_column(*m, 1), center = affine_column(*m, 3);
    const vec3 disc = {sqrt(x.x * x.x + y.x * y.x), sqrt(x.y * x.y + y.y * y.y), sqrt(x.z * x.z + y.z * y.z)};
    const vec3 half = f->outline == FLAT_DISC ? disc : map_size(m, (vec3){0.5, 0.5, 0.0});
    const box3 box = {vec3_sub(center, half), vec3_add(center, half)};
    return bounds_pad(box, m, &f->object_from_world);
}

/* Q = xx x^2 + yy y^2 + (zz z^2 + z z + constant): its sections across z are ellipses about z. */
static bool form_is_upright(const struct quadric_form *f) {
    return f->xx > 0.0 && f->yy > 0.0 && f->xy == 0.0 && f->yz == 0.0 && f->zx == 0.0 && f->x == 0.0 &&
           f->y == 0.0;
}

/* The square of how far the ellipse xx x^2 + yy y^2 = 1 reaches along row[0] x + row[1] y. */
static double upright_width2(const struct quadric_form *f, const double row[4]) {
    return row[0] * row[0] / f->xx + row[1] * row[1] / f->yy;
}

/* The largest `slope` z and reach of the section at z, within an upright Q <= 0 and its extent. The
 * section with Q = xx x^2 + yy y^2 - R(z) gives slope z + sqrt(width2 R(z)); that is largest at
 * an end or where its derivative vanishes. Never too small: R < 0 counts as 0. */
static double upright_support(const struct quadric_form *f, double width2, double slope) {
    const double low = f->extent.min.z, high = f->extent.max.z;
    double z[4] = {low, high, low, low};
    if (f->zz != 0.0) {
        const double middle = -0.5 * f->z / f->zz, top = -0.5 * f->z * middle - f->constant;
        const double away = sqrt(slope * slope * top / (f->zz * (width2 * f->zz + slope * slope)));
        z[2] = middle - away;
        z[3] = middle + away;
    } else {
        const double section = 0.25 * width2 * f->z * f->z / (slope * slope);
        z[2] = -(section + f->constant) / f->z;
    }
    double most = -INFINITY;
    for (int i = 0; i < 4; i++) {
        if (!(low <= z[i] && z[i] <= high)) continue; /* NaN: the derivative has no zero */
        const double section = -((f->zz * z[i] + f->z) * z[i] + f->constant);
        most = box3_upper(most, slope * z[i] + sqrt(width2 * box3_upper(section, 0.0)));
    }
    return most;
}

static void upright_range(const struct quadric *q, int axis, double *min, double *max) {
    const double *row = q->world_from_object.m[axis], width2 = upright_width2(q->form, row);
    *min = box3_upper(*min, row[3] - upright_support(q->form, width2, -row[2]));
    *max = box3_lower(*max, row[3] + upright_support(q->form, width2, row[2]));
}

static box3 quadric_bounds(const struct quadric *q) {
    const box3 extent = q->form->extent;
    if (!box3_is_bounded(extent)) return BOX3_ALL;
    const vec3 center = affine_point(&q->world_from_object, box3_center(extent));
    const vec3 half = map_size(&q->world_from_object, vec3_scale(vec3_sub(extent.max, extent.min), 0.5));
    box3 box = {vec3_sub(center, half), vec3_add(center, half)};
    if (form_is_upright(q->form)) {
        upright_range(q, 0, &box.min.x, &box.max.x);
        upright_range(q, 1, &box.min.y, &box.max.y);
        upright_range(q, 2, &box.min.z, &box.max.z);
    }
    return bounds_pad(box, &q->world_from_object, &q->object_from_world);
}

box3 shape_bounds(const struct primitives *p, primitive_ref ref) {
    const uint32_t index = primitive_ref_index(ref);
    switch (primitive_ref_kind(ref)) {
    case PRIMITIVE_SPHERE: return sphere_bounds(&p->spheres[index]);
    case PRIMITIVE_FLAT: return flat_bounds(&p->flats[index]);
    case PRIMITIVE_INSTANCE: return BOX3_ALL;
    case PRIMITIVE_QUADRIC: break;
    }
    return quadric_bounds(&p->quadrics[index]);
}

box3 shape_placed_bounds(const struct instance *instance, box3 box) {
    const affine *m = &instance->world_from_object;
    if (box3_is_empty(box)) return BOX3_EMPTY;
    const vec3 center = affine_point(m, box3_center(box));
    const vec3 half = map_size(m, vec3_scale(vec3_sub(box.max, box.min), 0.5));
    return bounds_pad((box3){vec3_sub(center, half), vec3_add(center, half)}, m,
                      &instance->object_from_world);
}

/* ---- Along any direction ---- */

static double flat_support(const struct flat *f, vec3 direction) {
    const double x = vec3_dot(affine_column(f->world_from_object, 0), direction);
    const double y = vec3_dot(affine_column(f->world_from_object, 1), direction);
    const double center = vec3_dot(affine_column(f->world_from_object, 3), direction);
    switch (f->outline) {
    case FLAT_PLANE: return INFINITY;
    case FLAT_SQUARE: return center + 0.5 * (fabs(x) + fabs(y));
    case FLAT_DISC: break;
    }
    return center + sqrt(x * x + y * y);
}

static double quadric_support(const struct quadric *q, vec3 direction) {
    const box3 extent = q->form->extent;
    if (!box3_is_bounded(extent)) return INFINITY;
    const affine m = q->world_from_object;
    const double row[4] = {vec3_dot(affine_column(m, 0), direction), vec3_dot(affine_column(m, 1), direction),
                           vec3_dot(affine_column(m, 2), direction),
                           vec3_dot(affine_column(m, 3), direction)};
    const double x = box3_upper(row[0] * extent.min.x, row[0] * extent.max.x);
    const double y = box3_upper(row[1] * extent.min.y, row[1] * extent.max.y);
    const double z = box3_upper(row[2] * extent.min.z, row[2] * extent.max.z);
    double most = x + y + z;
    if (form_is_upright(q->form))
        most = box3_lower(most, upright_support(q->form, upright_width2(q->form, row), row[2]));
    return row[3] + most;
}

double shape_support(const struct primitives *p, primitive_ref ref, vec3 direction) {
    const uint32_t index = primitive_ref_index(ref);
    const struct sphere *sphere;
    switch (primitive_ref_kind(ref)) {
    case PRIMITIVE_SPHERE:
        sphere = &p->spheres[index];
        return vec3_dot(sphere->center, direction) + sphere->radius * vec3_length(direction);
    case PRIMITIVE_FLAT: return flat_support(&p->flats[index], direction);
    case PRIMITIVE_INSTANCE: return INFINITY;
    case PRIMITIVE_QUADRIC: break;
    }
    return quadric_support(&p->quadrics[index], direction);
}
