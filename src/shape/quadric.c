/* A line meets the clip box in one stretch and the inside of Q in up to two. What they have in common
 * is inside the solid, and each end knows the face that made it, so no cap is ever tested in 2D and
 * a rim cannot leak:
 *
 *     box         enter |---------------------------| leave
 *     Q < 0    -----------------| leave    enter |----------- (a < 0; between its roots where a > 0)
 *     solid             |-------|                |--|
 *                      cut    side             side cut
 */
#include "shape/quadric.h"

#include "shape/numeric.h"
#include "shape/patch.h"

/* A stretch of a line; an end may be infinite, and is no crossing then. */
struct chord {
    struct crossing enter, leave;
};

/* Shortens *in to the part between two faces of the box; `face` names the lower one. False when
 * nothing is left; a line in a face is outside. */
static inline bool chord_cut_axis(double org, double dir, double min, double max, enum shape_part face,
                                  struct chord *in) {
    if (min == -INFINITY && max == INFINITY) return true;
    if (dir == 0.0) return min < org && org < max;
    const double at_min = (min - org) / dir, at_max = (max - org) / dir;
    const double enter = at_min < at_max ? at_min : at_max, leave = at_min < at_max ? at_max : at_min;
    const int backward = dir < 0.0; /* selects without a branch, as all of this does */
    in->enter.part = enter > in->enter.t ? (enum shape_part)((int)face + backward) : in->enter.part;
    in->enter.t = enter > in->enter.t ? enter : in->enter.t;
    in->leave.part = leave < in->leave.t ? (enum shape_part)((int)face + 1 - backward) : in->leave.part;
    in->leave.t = leave < in->leave.t ? leave : in->leave.t;
    return in->enter.t < in->leave.t;
}

static inline bool chord_in_box(const box3 *box, ray r, struct chord *in) {
    *in = (struct chord){{-INFINITY, SHAPE_SIDE}, {INFINITY, SHAPE_SIDE}};
    return chord_cut_axis(r.org.z, r.dir.z, box->min.z, box->max.z, SHAPE_CUT_MIN_Z, in) &&
           chord_cut_axis(r.org.x, r.dir.x, box->min.x, box->max.x, SHAPE_CUT_MIN_X, in) &&
           chord_cut_axis(r.org.y, r.dir.y, box->min.y, box->max.y, SHAPE_CUT_MIN_Y, in);
}

/* Where Q < 0 on a line. */
struct roots {
    int stretches;    /* 0: nowhere; 1: between low and high; 2: below low and above high */
    double low, high; /* infinite where there is no root */
};

/* The roots of a s^2 + 2 b s + c, without cancellation. A double root is none. */
static inline struct roots roots_of(double a, double b, double c) {
    const struct roots all = {1, -INFINITY, INFINITY}, none = {0};
    const double disc = b * b - a * c;
    if (!(disc > 0.0)) return disc <= 0.0 && (a < 0.0 || (a == 0.0 && c < 0.0)) ? all : none;
    const double q = b < 0.0 ? sqrt(disc) - b : -(b + sqrt(disc));
    const double near = c / q;
    if (a == 0.0) return b > 0.0 ? (struct roots){1, -INFINITY, near} : (struct roots){1, near, INFINITY};
    const double far = q / a;
    return (struct roots){a < 0.0 ? 2 : 1, box3_lower(near, far), box3_upper(near, far)};
}

/* Q along the line. The origin is first moved to where the line is closest to that of object space,
 * within `box`: from afar the coefficients would cancel, and close to the apex of a cone they keep
 * their relative precision. */
static inline struct roots roots_on_line(const struct quadric_form *f, ray r, const struct chord *box) {
    const double closest = -vec3_dot(r.org, r.dir) / vec3_dot(r.dir, r.dir);
    const double mid = box3_lower(box3_upper(closest, box->enter.t), box->leave.t);
    const vec3 o = ray_at(r, mid), d = r.dir;
    const vec3 sd = {f->xx * d.x + 0.5 * (f->xy * d.y + f->zx * d.z),
                     f->yy * d.y + 0.5 * (f->xy * d.x + f->yz * d.z),
                     f->zz * d.z + 0.5 * (f->zx * d.x + f->yz * d.y)};
    const double b = vec3_dot(o, sd) + 0.5 * (f->x * d.x + f->y * d.y + f->z * d.z);
    struct roots roots = roots_of(vec3_dot(d, sd), b, form_value(f, o));
    roots.low += mid;
    roots.high += mid;
    return roots;
}

/* What `box` has in common with low < t < high. */
static inline struct chord chord_between(const struct chord *box, double low, double high) {
    return (struct chord){
        .enter = {low > box->enter.t ? low : box->enter.t, low > box->enter.t ? SHAPE_SIDE : box->enter.part},
        .leave = {high < box->leave.t ? high : box->leave.t,
                  high < box->leave.t ? SHAPE_SIDE : box->leave.part},
    };
}

static inline int add_chord(struct chord c, struct crossing *out, int count) {
    if (!(c.enter.t < c.leave.t)) return count;
    out[count] = c.enter;
    out[count + 1] = c.leave;
    return count + 2;
}

static inline int add_root(const struct chord *box, double t, struct crossing *out, int count) {
    if (!(box->enter.t <= t && t <= box->leave.t)) return count;
    out[count] = (struct crossing){t, SHAPE_SIDE};
    return count + 1;
}

/* The crossings in order, the ends at infinity too; returns how many. */
static inline int ends_of(bool open, const struct chord *box, const struct roots *roots,
                          struct crossing out[SHAPE_MAX_CROSSINGS]) {
    if (open) return add_root(box, roots->high, out, add_root(box, roots->low, out, 0));
    if (roots->stretches == 1) return add_chord(chord_between(box, roots->low, roots->high), out, 0);
    const int count = add_chord(chord_between(box, -INFINITY, roots->low), out, 0);
    return add_chord(chord_between(box, roots->high, INFINITY), out, count);
}

/* The line in object space: its part in the box and its roots. False where nothing is in the window. */
static inline bool line_of(const struct quadric *q, ray r, double t_min, double t_max, struct chord *box,
                           struct roots *roots) {
    const ray line = affine_ray(&q->object_from_world, r);
    if (!chord_in_box(&q->form->clip, line, box)) return false;
    if (!(box->leave.t > t_min && box->enter.t <= t_max)) return false;
    *roots = roots_on_line(q->form, line, box);
    return roots->stretches > 0;
}

int quadric_crossings(const struct quadric *q, ray r, struct crossing out[SHAPE_MAX_CROSSINGS]) {
    struct chord box;
    struct roots roots;
    struct crossing ends[SHAPE_MAX_CROSSINGS];
    if (!line_of(q, r, -INFINITY, INFINITY, &box, &roots)) return 0;
    const int count = ends_of(q->form->open, &box, &roots, ends);
    int kept = 0;
    for (int i = 0; i < count; i++)
        if (fabs(ends[i].t) < INFINITY) out[kept++] = ends[i];
    return kept;
}

static inline bool take(struct crossing c, double t_max, struct crossing *out) {
    if (!(c.t <= t_max && c.t < INFINITY)) return false;
    *out = c;
    return true;
}

bool quadric_first_crossing(const struct quadric *q, ray r, double t_min, double t_max,
                            struct crossing *out) {
    struct chord box;
    struct roots roots;
    if (!line_of(q, r, t_min, t_max, &box, &roots)) return false;
    if (!q->form->open && roots.stretches == 1) { /* the common case, without the list */
        const struct chord c = chord_between(&box, roots.low, roots.high);
        if (!(c.enter.t < c.leave.t && c.leave.t > t_min)) return false;
        return take(c.enter.t > t_min ? c.enter : c.leave, t_max, out);
    }
    struct crossing ends[SHAPE_MAX_CROSSINGS];
    const int count = ends_of(q->form->open, &box, &roots, ends);
    for (int i = 0; i < count; i++)
        if (ends[i].t > t_min) return take(ends[i], t_max, out);
    return false;
}

static struct patch patch_of(const struct quadric_form *f, enum shape_part part) {
    if (part == SHAPE_SIDE) return (struct patch){.form = f};
    const int face = (int)part - SHAPE_CUT_MIN_X, axis = face / 2;
    const bool upper = face % 2 == 1;
    const double at = vec3_component(upper ? f->clip.max : f->clip.min, axis);
    return (struct patch){.axis = axis, .at = at, .sign = upper ? 1.0 : -1.0};
}

/* The size of the shape along each world axis; 0 where it has no end. */
static vec3 world_size(const struct quadric *q) {
    const vec3 width = vec3_sub(q->form->extent.max, q->form->extent.min);
    const vec3 finite = {isfinite(width.x) ? width.x : 0.0, isfinite(width.y) ? width.y : 0.0,
                         isfinite(width.z) ? width.z : 0.0};
    return map_size(&q->world_from_object, finite);
}

struct surface quadric_surface(const struct quadric *q, ray r, struct crossing crossing) {
    const struct patch patch = patch_of(q->form, crossing.part);
    return patch_surface(&patch, &q->object_from_world, world_size(q), r, crossing.t);
}

bool quadric_contains(const struct quadric *q, vec3 point) {
    const vec3 p = affine_point(&q->object_from_world, point), min = q->form->clip.min,
               max = q->form->clip.max;
    return !q->form->open && min.x < p.x && p.x < max.x && min.y < p.y && p.y < max.y && min.z < p.z &&
           p.z < max.z && form_value(q->form, p) < 0.0;
}
