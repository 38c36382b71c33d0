#include "shape/range.h"

/* Relative to the largest term: far more than what rounding does to a sum of ten. */
static const double slack = 1e-12;

struct range {
    double min, max;
};

/* A product of numbers: each has an end, so that 0 times even the largest is 0. */
static double times(double a, double b) { return a == 0.0 || b == 0.0 ? 0.0 : a * b; }

static double finite_size(double value) { return fabs(value) < INFINITY ? fabs(value) : 0.0; }

static double range_size(struct range r) { return box3_upper(finite_size(r.min), finite_size(r.max)); }

/* The largest that a t^2 becomes at a finite end, for the rounding of its sum with b t: where that is larger by far, the
 * sum tells. */
static double square_size(double a, struct range t) {
    const double most = range_size(t);
    return fabs(a) * most * most;
}

static struct range range_add(struct range a, struct range b) {
    return (struct range){a.min + b.min, a.max + b.max};
}

static struct range range_with(struct range r, double value) {
    return (struct range){box3_lower(r.min, value), box3_upper(r.max, value)};
}

/* a t^2 + b t: its values at the ends, which may be infinite, and at the vertex; without a that is no number, or infinite. */
static struct range range_axis(double a, double b, struct range t) {
    const double places[] = {t.min, t.max, -0.5 * b / a};
    struct range r = {INFINITY, -INFINITY};
    for (int k = 0; k < 3; k++)
        if (t.min <= places[k] && places[k] <= t.max)
            r = range_with(r, times(times(a, places[k]) + b, places[k]));
    return r;
}

static struct range range_product(double factor, struct range a, struct range b) {
    const double corners[] = {times(a.min, b.min), times(a.min, b.max), times(a.max, b.min),
                              times(a.max, b.max)};
    struct range r = {INFINITY, -INFINITY};
    for (int i = 0; i < 4; i++) r = range_with(r, times(factor, corners[i]));
    return r;
}

/* The values of Q in the box; wider by the rounding, and where x y, y z or z x have a part in it. Rounding decides where
 * the parts of an end cancel: as much of them is above 0 then as below, so that the finite ends of all but the constant tell
 * how large they are, and square_size the two that one of them is made of. */
static struct range form_range(const struct quadric_form *f, box3 box) {
    const struct range x = {box.min.x, box.max.x}, y = {box.min.y, box.max.y}, z = {box.min.z, box.max.z};
    const struct range parts[] = {
        range_axis(f->xx, f->x, x), range_axis(f->yy, f->y, y), range_axis(f->zz, f->z, z),
        range_product(f->xy, x, y), range_product(f->yz, y, z), range_product(f->zx, z, x),
    };
    struct range sum = {f->constant, f->constant};
    double most = square_size(f->xx, x) + square_size(f->yy, y) + square_size(f->zz, z);
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        sum = range_add(sum, parts[i]);
        most = box3_upper(most, range_size(parts[i]));
    }
    return (struct range){sum.min - slack * most, sum.max + slack * most};
}

/* Whether sign * Q > 0 everywhere: squares are completed in one variable after the other; what is left
 * when no variable has a square must be a positive constant. */
static bool is_positive(const struct quadric_form *f, double sign) {
    double m[4][4] = {{f->xx, 0.5 * f->xy, 0.5 * f->zx, 0.5 * f->x},
                      {0.5 * f->xy, f->yy, 0.5 * f->yz, 0.5 * f->y},
                      {0.5 * f->zx, 0.5 * f->yz, f->zz, 0.5 * f->z},
                      {0.5 * f->x, 0.5 * f->y, 0.5 * f->z, f->constant}};
    double most = 0.0;
    for (int i = 0; i < 16; i++) most = box3_upper(most, fabs(m[i / 4][i % 4]));
    const double least = slack * most;
    bool done[4] = {false, false, false, false};
    for (;;) {
        int best = -1;
        for (int i = 0; i < 3; i++)
            if (!done[i] && (best < 0 || sign * m[i][i] > sign * m[best][best])) best = i;
        if (best < 0 || !(sign * m[best][best] > least)) break;
        done[best] = true;
        for (int i = 0; i < 4; i++)
            for (int j = 0; j < 4; j++)
                if (!done[i] && !done[j]) m[i][j] -= m[i][best] * m[best][j] / m[best][best];
    }
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            if (!done[i] && !done[j] && fabs(m[i][j]) >= least) return false;
    return sign * m[3][3] > least;
}

static bool is_everywhere(box3 box) {
    return box.min.x == -INFINITY && box.min.y == -INFINITY && box.min.z == -INFINITY &&
           box.max.x == INFINITY && box.max.y == INFINITY && box.max.z == INFINITY;
}

bool form_is_empty(const struct quadric_form *form) {
    const struct range values = form_range(form, form->clip);
    if (values.min > 0.0 || is_positive(form, 1.0)) return true;
    if (!form->open && !is_everywhere(form->clip)) return false; /* all of the box */
    return values.max < 0.0 || is_positive(form, -1.0);
}

bool form_holds_box(const struct quadric_form *form, box3 box) {
    const vec3 min = form->clip.min, max = form->clip.max;
    if (form->open) return false;
    if (!(min.x < box.min.x && min.y < box.min.y && min.z < box.min.z)) return false;
    if (!(box.max.x < max.x && box.max.y < max.y && box.max.z < max.z)) return false;
    return form_range(form, box).max < 0.0;
}
