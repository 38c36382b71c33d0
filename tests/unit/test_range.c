/* What is proven of quadrics: by hand, and never against what points show. */
#include <string.h>

#include "near.h"
#include "shape/range.h"

#define EVERYWHERE BOX3_ALL
#define UNIT_BALL  .xx = 1, .yy = 1, .zz = 1, .constant = -1

static struct row {
    const char *name;
    struct quadric_form form;
    bool empty;
} rows[] = {
    {"a ball", {UNIT_BALL, .clip = EVERYWHERE}, false},
    {"x^2 + y^2 + z^2 = -1", {.xx = 1, .yy = 1, .zz = 1, .constant = 1, .clip = EVERYWHERE}, true},
    {"x^2 = -1", {.xx = 1, .constant = 1, .clip = EVERYWHERE}, true},
    {"x^2 + y = -1", {.xx = 1, .y = 1, .constant = 1, .clip = EVERYWHERE}, false},
    {"(x + y)^2 = -1", {.xx = 1, .yy = 1, .xy = 2, .constant = 1, .clip = EVERYWHERE}, true},
    {"(x + y)^2 = 1", {.xx = 1, .yy = 1, .xy = 2, .constant = -1, .clip = EVERYWHERE}, false},
    {"x^2 + y^2 + 3 x y = -1", {.xx = 1, .yy = 1, .xy = 3, .constant = 1, .clip = EVERYWHERE}, false},
    {"all of space has no surface", {.xx = -1, .yy = -1, .zz = -1, .constant = -1, .clip = EVERYWHERE}, true},
    {"all of a box has one", {.xx = -1, .constant = -1, .clip = {{0, 0, 0}, {1, 1, 1}}}, false},
    {"but none if it is open",
     {.xx = -1, .constant = -1, .clip = {{0, 0, 0}, {1, 1, 1}}, .open = true},
     true},
    {"a box beside the ball", {UNIT_BALL, .clip = {{0.6, 0.6, 0.6}, {1, 1, 1}}}, true},
    {"a box at its edge", {UNIT_BALL, .clip = {{0.57, 0.57, 0.57}, {1, 1, 1}}}, false},
    {"a box within it, open", {UNIT_BALL, .clip = {{0, 0, 0}, {0.5, 0.5, 0.5}}, .open = true}, true},
    {"half of space beside the ball",
     {UNIT_BALL, .clip = {{1.1, -INFINITY, -INFINITY}, {INFINITY, INFINITY, INFINITY}}},
     true},
    {"(x + y)^2 / 2 = -1", {.xx = 0.5, .yy = 0.5, .xy = 1, .constant = 1, .clip = EVERYWHERE}, true},
    {"(y + z)^2 / 2 = -1", {.yy = 0.5, .zz = 0.5, .yz = 1, .constant = 1, .clip = EVERYWHERE}, true},
    {"(z + x)^2 / 2 = -1", {.zz = 0.5, .xx = 0.5, .zx = 1, .constant = 1, .clip = EVERYWHERE}, true},
    {"(x + y + z)^2 = -1",
     {.xx = 1, .yy = 1, .zz = 1, .xy = 2, .yz = 2, .zx = 2, .constant = 1, .clip = EVERYWHERE},
     true},
    {"x^2 + (x - 2 y)^2 + (y - 3 z)^2 = -1",
     {.xx = 2, .yy = 5, .zz = 9, .xy = -4, .yz = -6, .constant = 1, .clip = EVERYWHERE},
     true},
    {"x^2 + (x - 2 y)^2 - (y - 3 z)^2 = -1",
     {.xx = 2, .yy = 3, .zz = -9, .xy = -4, .yz = 6, .constant = 1, .clip = EVERYWHERE},
     false},
    {"(x + y + 1)^2 = -1",
     {.xx = 1, .yy = 1, .xy = 2, .x = 2, .y = 2, .constant = 2, .clip = EVERYWHERE},
     true},
    {"(x + y + 1)^2 = 0",
     {.xx = 1, .yy = 1, .xy = 2, .x = 2, .y = 2, .constant = 1, .clip = EVERYWHERE},
     false},
    {"(y + z + 1)^2 = -1",
     {.yy = 1, .zz = 1, .yz = 2, .y = 2, .z = 2, .constant = 2, .clip = EVERYWHERE},
     true},
    {"(z + x + 1)^2 = -1",
     {.zz = 1, .xx = 1, .zx = 2, .z = 2, .x = 2, .constant = 2, .clip = EVERYWHERE},
     true},
    {"(x + y)^2 + z = -1", {.xx = 1, .yy = 1, .xy = 2, .z = 1, .constant = 1, .clip = EVERYWHERE}, false},
    {"-(x + y)^2 = 1", {.xx = -1, .yy = -1, .xy = -2, .constant = -1, .clip = EVERYWHERE}, true},
    {"(x + y)^2 = -1, of any size",
     {.xx = 1e-9, .yy = 1e-9, .xy = 2e-9, .constant = 1e-9, .clip = EVERYWHERE},
     true},
    {"(x + y)^2 = -1e-15 is not told from 0",
     {.xx = 1e9, .yy = 1e9, .xy = 2e9, .constant = 1e-6, .clip = EVERYWHERE},
     false},
    {"(x + y)^2 = -1e-12 is not, either",
     {.xx = 1, .yy = 1, .xy = 2, .constant = 1e-12, .clip = EVERYWHERE},
     false},
    {"(x + y)^2 = -1.01e-12 is", {.xx = 1, .yy = 1, .xy = 2, .constant = 1.01e-12, .clip = EVERYWHERE}, true},
    {"x^2 = -1, of any size: small", {.xx = 1e-9, .constant = 1e-9, .clip = EVERYWHERE}, true},
    {"x^2 = -1, of any size: large", {.xx = 1e9, .constant = 1e9, .clip = EVERYWHERE}, true},
    {"x y = -1 for x > 1", {.xy = 1, .constant = 1, .clip = {{1, -INFINITY, 0}, {9, INFINITY, 1}}}, false},
    {"above the ball", {UNIT_BALL, .clip = {{-9, 1.1, -9}, {9, INFINITY, 9}}}, true},
    {"below the ball", {UNIT_BALL, .clip = {{-9, -INFINITY, -9}, {9, -1.1, 9}}}, true},
    {"in front of the ball", {UNIT_BALL, .clip = {{-9, -9, 1.1}, {9, 9, INFINITY}}}, true},
    {"behind the ball", {UNIT_BALL, .clip = {{-9, -9, -INFINITY}, {9, 9, -1.1}}}, true},
    {"left of the ball", {UNIT_BALL, .clip = {{-INFINITY, -9, -9}, {-1.1, 9, 9}}}, true},
    {"x y = 7 for less", {.xy = 1, .constant = -7, .clip = {{1, 2, 0}, {2, 3, 1}}, .open = true}, true},
    {"x y = 5 within", {.xy = 1, .constant = -5, .clip = {{1, 2, 0}, {2, 3, 1}}, .open = true}, false},
    {"x y = 1 for more", {.xy = 1, .constant = -1, .clip = {{1, 2, 0}, {2, 3, 1}}}, true},
    {"y z = 7 for less", {.yz = 1, .constant = -7, .clip = {{0, 1, 2}, {1, 2, 3}}, .open = true}, true},
    {"y z = 5 within", {.yz = 1, .constant = -5, .clip = {{0, 1, 2}, {1, 2, 3}}, .open = true}, false},
    {"z x = 7 for less", {.zx = 1, .constant = -7, .clip = {{1, 0, 2}, {2, 1, 3}}, .open = true}, true},
    {"z x = 5 within", {.zx = 1, .constant = -5, .clip = {{1, 0, 2}, {2, 1, 3}}, .open = true}, false},
    {"(x + y)^2 = -1, of any size: tiny",
     {.xx = 1e-100, .yy = 1e-100, .xy = 2e-100, .constant = 1e-100, .clip = EVERYWHERE},
     true},
    {"x^2 = 0", {.xx = 1, .clip = EVERYWHERE}, false},
    {"-x^2 = 0", {.xx = -1, .clip = EVERYWHERE}, false},
    {"nothing is 0 everywhere", {.clip = EVERYWHERE}, false},
    {"x^2 + 2e-12 y z = -1, far out", {.xx = 1, .yz = 2e-12, .constant = 1, .clip = EVERYWHERE}, false},
    {"1e-12 (x + y)^2 + 1e-6 (x + y) = -1 is not told",
     {.xx = 1e-12, .yy = 1e-12, .xy = 2e-12, .x = 1e-6, .y = 1e-6, .constant = 1, .clip = EVERYWHERE},
     false},
    {"a plane in half of space",
     {.x = 1, .clip = {{-1, -INFINITY, -INFINITY}, {INFINITY, INFINITY, INFINITY}}},
     false},
};

static void check_row(void **state) {
    const struct row *row = *state;
    assert_int_equal(form_is_empty(&row->form), row->empty);
}

/* All of a half of space has a surface: where it is cut. */
static void check_halves(void **state) {
    (void)state;
    for (int i = 0; i < 6; i++) {
        struct quadric_form form = {.xx = -1, .constant = -1, .clip = EVERYWHERE};
        double *const sides[] = {&form.clip.min.x, &form.clip.min.y, &form.clip.min.z,
                                 &form.clip.max.x, &form.clip.max.y, &form.clip.max.z};
        assert_true(form_is_empty(&form));
        *sides[i] = 0;
        assert_false(form_is_empty(&form));
        form.open = true;
        assert_true(form_is_empty(&form));
    }
}

/* ---- Boxes with and without ends ---- */

/* Where a t^2 + 2 b t, and a product, have their least and largest values: at the ends, and at the vertex. What has no end
 * goes on for longer than matters. */
static int places_in(const double range[2], double a, double b, double places[3]) {
    int count = 0;
    for (int i = 0; i < 2; i++) places[count++] = fmax(-1e6, fmin(1e6, range[i]));
    if (a != 0 && range[0] <= -b / a && -b / a <= range[1]) places[count++] = -b / a;
    return count;
}

/* A square and a line in one variable, and the product of the two others: nothing is in two parts, so that all is known
 * of them, to the last value. All numbers are exact. */
static void check_parts(void **state) {
    (void)state;
    struct random r = random_begin();
    static const double ends[] = {-INFINITY, -2, -1, 0, 1, 2, INFINITY};
    int empty = 0, held = 0;
    for (int i = 0; i < 50000; i++) {
        struct quadric_form f = {.constant = random_below(&r, 9) - 4.0};
        double *const square[] = {&f.xx, &f.yy, &f.zz}, *const line[] = {&f.x, &f.y, &f.z},
                      *const product[] = {&f.yz, &f.zx, &f.xy};
        const int k = (int)random_below(&r, 3), u = (k + 1) % 3, v = (k + 2) % 3;
        const double a = random_below(&r, 3) - 1.0, b = random_below(&r, 5) - 2.0,
                     c = random_below(&r, 5) - 2.0;
        *square[k] = a, *line[k] = 2 * b, *product[k] = c;
        double range[3][2];
        bool bounded = true;
        for (int axis = 0; axis < 3; axis++) {
            unsigned from, to; /* no end is a place */
            do {
                from = random_below(&r, 6), to = random_below(&r, 6) + 1;
            } while (from > to);
            range[axis][0] = ends[from], range[axis][1] = ends[to];
            bounded &= from > 0 && to < 6;
        }
        double places[3][3], least = INFINITY, most = -INFINITY;
        const int n = places_in(range[k], a, b, places[k]);
        places_in(range[u], 0, 0, places[u]);
        places_in(range[v], 0, 0, places[v]);
        for (int p = 0; p < n; p++)
            for (int q = 0; q < 4; q++) {
                const double t = places[k][p];
                const double value =
                    a * t * t + 2 * b * t + c * places[u][q % 2] * places[v][q / 2] + f.constant;
                least = fmin(least, value), most = fmax(most, value);
            }
        const box3 box = {{range[0][0], range[1][0], range[2][0]}, {range[0][1], range[1][1], range[2][1]}};
        f.clip = EVERYWHERE;
        assert_int_equal(form_holds_box(&f, box), bounded && most < 0);
        held += bounded && most < 0;
        f.clip = box;
        f.open = true;
        assert_int_equal(form_is_empty(&f), least > 0 || most < 0);
        f.open = false;
        if (memcmp(&box, &EVERYWHERE, sizeof box)) assert_int_equal(form_is_empty(&f), least > 0);
        empty += least > 0 || most < 0;
    }
    printf("# %d empty, %d held\n", empty, held);
    assert_true(empty > 10000 && held > 1000);
}

/* ---- Boxes inside ---- */

static struct held {
    const char *name;
    box3 box;
    bool held;
} boxes[] = {
    {"a box well within", {{-0.4, -0.4, -0.4}, {0.4, 0.4, 0.4}}, true},
    {"at the face of min x", {{-0.5, -0.1, -0.1}, {0.1, 0.1, 0.1}}, false},
    {"at the face of min y", {{-0.1, -0.5, -0.1}, {0.1, 0.1, 0.1}}, false},
    {"at the face of min z", {{-0.1, -0.1, -0.5}, {0.1, 0.1, 0.1}}, false},
    {"at the face of max x", {{-0.1, -0.1, -0.1}, {0.5, 0.1, 0.1}}, false},
    {"at the face of max y", {{-0.1, -0.1, -0.1}, {0.1, 0.5, 0.1}}, false},
    {"at the face of max z", {{-0.1, -0.1, -0.1}, {0.1, 0.1, 0.5}}, false},
    {"nearly to a corner", {{0, 0, 0}, {0.49, 0.49, 0.49}}, true},
};

/* Of a ball within a box from -0.5 to 0.5 that it fills, corners and all. */
static void check_held(void **state) {
    const struct held *row = *state;
    struct quadric_form form = {
        .xx = 1, .yy = 1, .zz = 1, .constant = -0.75, .clip = {{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}}};
    assert_int_equal(form_holds_box(&form, row->box), row->held);
    form.open = true;
    assert_false(form_holds_box(&form, row->box));
    form = (struct quadric_form){.clip = form.clip}; /* 0, which is the surface, everywhere */
    assert_false(form_holds_box(&form, row->box));
}

/* Of a form that is negative everywhere: what is within the clip on each side, and not at it. */
static void check_held_within(void **state) {
    (void)state;
    struct random r = random_begin();
    int held = 0;
    for (int i = 0; i < 20000; i++) {
        double sides[4][3];
        bool within = true;
        for (int k = 0; k < 3; k++) {
            sides[0][k] = random_below(&r, 5), sides[1][k] = sides[0][k] + random_below(&r, 3);
            sides[2][k] = sides[0][k] - (random_below(&r, 9) ? 1.0 + random_below(&r, 9) : 0.0);
            sides[3][k] = sides[1][k] + (random_below(&r, 9) ? 1.0 + random_below(&r, 9) : 0.0);
            within &= sides[2][k] < sides[0][k] && sides[1][k] < sides[3][k];
        }
        const double *min = sides[0], *max = sides[1], *low = sides[2], *high = sides[3];
        const box3 box = {{min[0], min[1], min[2]}, {max[0], max[1], max[2]}};
        const struct quadric_form form = {.constant = -1,
                                          .clip = {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}}};
        assert_int_equal(form_holds_box(&form, box), within);
        held += within;
    }
    assert_true(held > 5000);
}

static double value_at(const struct quadric_form *f, vec3 p) {
    return f->xx * p.x * p.x + f->yy * p.y * p.y + f->zz * p.z * p.z + f->xy * p.x * p.y + f->yz * p.y * p.z +
           f->zx * p.z * p.x + f->x * p.x + f->y * p.y + f->z * p.z + f->constant;
}

static vec3 point_in(struct random *r, box3 box) {
    return (vec3){random_between(r, box.min.x, box.max.x), random_between(r, box.min.y, box.max.y),
                  random_between(r, box.min.z, box.max.z)};
}

/* Whatever points of both signs show has a surface, and no point of a box that is held is outside. */
static void check_random(void **state) {
    (void)state;
    struct random r = random_begin();
    int empty = 0, held = 0;
    for (int i = 0; i < 20000; i++) {
        struct quadric_form f = {.clip = {{-1, -1, -1}, {1, 1, 1}}, .open = random_below(&r, 2)};
        double *const terms[] = {&f.xx, &f.yy, &f.zz, &f.xy, &f.yz, &f.zx, &f.x, &f.y, &f.z, &f.constant};
        for (size_t k = 0; k < COUNT(terms); k++)
            *terms[k] = random_below(&r, 3) ? random_between(&r, -1, 1) : 0.0;
        const vec3 corner = random_vec3(&r, -1.1, 0.9);
        const box3 box = {corner, vec3_add(corner, vec3_all(random_between(&r, 0.01, 0.4)))};
        const bool is_empty = form_is_empty(&f), holds = form_holds_box(&f, box);
        bool in = false, out = false;
        for (int k = 0; k < 50; k++) {
            const double value = value_at(&f, point_in(&r, f.clip));
            in |= value < 0.0;
            out |= value > 0.0;
            if (holds) assert_true(value_at(&f, point_in(&r, box)) < 0.0);
        }
        if (is_empty) assert_false(in && (out || !f.open));
        empty += is_empty;
        held += holds;
    }
    printf("# %d empty, %d held\n", empty, held);
    assert_true(empty > 100 && held > 100);
}

/* Sums of squares of up to three linear functions that all vanish in one point: a little above 0 nothing is left of the
 * surface, a little below something is. */
static void check_sums_of_squares(void **state) {
    (void)state;
    struct random r = random_begin();
    int empties = 0, positive = 0;
    for (int i = 0; i < 20000; i++) {
        const double sign = random_below(&r, 2) ? 1 : -1, above = random_below(&r, 2) ? 1e-6 : -1e-6;
        const vec3 zero = random_vec3(&r, -1, 1);
        struct quadric_form f = {.clip = EVERYWHERE};
        for (unsigned k = random_below(&r, 3) + 1; k > 0; k--) {
            vec3 a = random_vec3(&r, -1, 1);
            if (random_below(&r, 3) == 0) a.x = 0;
            if (random_below(&r, 3) == 0) a.y = 0;
            a = vec3_scale(vec3_normalize(a), sqrt(random_between(&r, 0.5, 2)));
            const double b = -vec3_dot(a, zero);
            f.xx += a.x * a.x, f.yy += a.y * a.y, f.zz += a.z * a.z;
            f.xy += 2 * a.x * a.y, f.yz += 2 * a.y * a.z, f.zx += 2 * a.z * a.x;
            f.x += 2 * a.x * b, f.y += 2 * a.y * b, f.z += 2 * a.z * b;
            f.constant += b * b;
        }
        f.constant += above;
        double *const terms[] = {&f.xx, &f.yy, &f.zz, &f.xy, &f.yz, &f.zx, &f.x, &f.y, &f.z, &f.constant};
        for (size_t k = 0; k < COUNT(terms); k++) *terms[k] *= sign;
        if (above < 0) assert_false(form_is_empty(&f));
        empties += above > 0 && form_is_empty(&f);
        positive += above > 0;
    }
    printf("# %d of %d empty\n", empties, positive);
    assert_true(empties > 0.97 * positive);
}

/* ---- Where rounding decides ---- */

/* The terms of the form at the point, in long double; returns the sum of their magnitudes. */
static long double terms_at(const struct quadric_form *f, vec3 at, long double *sum) {
    const long double x = at.x, y = at.y, z = at.z;
    const long double terms[] = {f->xx * x * x, f->yy * y * y, f->zz * z * z, f->xy * x * y, f->yz * y * z,
                                 f->zx * z * x, f->x * x,      f->y * y,      f->z * z,      f->constant};
    long double size = 0;
    *sum = 0;
    for (size_t i = 0; i < COUNT(terms); i++) *sum += terms[i], size += fabsl(terms[i]);
    return size;
}

/* Boxes that are a point, of which the range is one value; that one is next to 0, as two large terms cancel. What is said
 * is true all the same; and it is said where the value is farther from 0 than slack allows. */
static void check_cancelling(void **state) {
    (void)state;
    struct random r = random_begin();
    int in = 0, out = 0, told = 0;
    for (int i = 0; i < 100000; i++) {
        const vec3 at = random_vec3(&r, -3, 3);
        struct quadric_form f = {.clip = {at, at}};
        double *const terms[] = {&f.xx, &f.yy, &f.zz, &f.xy, &f.yz, &f.zx, &f.x, &f.y, &f.z, &f.constant};
        const double basis[] = {at.x * at.x, at.y * at.y, at.z * at.z, at.x * at.y, at.y * at.z,
                                at.z * at.x, at.x,        at.y,        at.z,        1};
        for (size_t k = 0; k < COUNT(terms); k++)
            *terms[k] =
                random_below(&r, 2) ? random_between(&r, -1, 1) * pow(10, random_between(&r, -9, 0)) : 0;
        const unsigned last = random_below(&r, COUNT(terms));
        long double value;
        *terms[last] = 0;
        terms_at(&f, at, &value);
        *terms[last] = (double)(-value / (long double)basis[last]);
        const double nudge = random_below(&r, 2) ? random_between(&r, -1e-10, 1e-10) : 0;
        *terms[last] *= 1 + nudge;
        const long double size = terms_at(&f, at, &value);
        const bool open_empty = (f.open = true, form_is_empty(&f));
        f.open = false;
        const bool empty = form_is_empty(&f);
        f.clip = EVERYWHERE;
        const bool holds = form_holds_box(&f, (box3){at, at});
        if (holds && !(value < 0)) fail_msg("held at %Lg of %Lg", value, size);
        if (empty && !(value > 0)) fail_msg("empty at %Lg of %Lg", value, size);
        if (open_empty && value == 0) fail_msg("open and empty at 0 of %Lg", size);
        if (value < -2e-11L * size) assert_true(holds && open_empty);
        if (value > 2e-11L * size) assert_true(empty && open_empty);
        in += value < 0;
        out += value > 0;
        told += holds || empty;
    }
    printf("# %d in, %d out, %d told\n", in, out, told);
    assert_true(in > 20000 && out > 20000 && told > 10000);
}

/* Without x y, y z and z x, and in boxes without an end on the sides where the form grows: its least value is at the
 * corner. It is next to 0 there, as large terms cancel; what is said to be empty is. */
static void check_cancelling_at_a_corner(void **state) {
    (void)state;
    struct random r = random_begin();
    int in = 0, out = 0, told = 0;
    for (int i = 0; i < 50000; i++) {
        const vec3 at = random_vec3(&r, -3, 3);
        struct quadric_form f = {.open = random_below(&r, 2)};
        double *const square[] = {&f.xx, &f.yy, &f.zz}, *const linear[] = {&f.x, &f.y, &f.z};
        const double corner[] = {at.x, at.y, at.z};
        for (int k = 0; k < 3; k++) {
            if (random_below(&r, 3))
                *square[k] = random_between(&r, 0, 1) * pow(10, random_between(&r, -9, 0));
            if (random_below(&r, 3))
                *linear[k] = random_between(&r, -1, 1) * pow(10, random_between(&r, -9, 0));
        }
        long double value;
        const unsigned last = random_below(&r, 4);
        double *const term = last < 3 ? linear[last] : &f.constant;
        *term = 0;
        terms_at(&f, at, &value);
        *term = (double)(-value / (long double)(last < 3 ? corner[last] : 1));
        if (random_below(&r, 2)) *term *= 1 + random_between(&r, -1e-10, 1e-10);
        double min[3], max[3];
        for (int k = 0; k < 3; k++) {
            const bool falls = 2 * *square[k] * corner[k] + *linear[k] < 0;
            min[k] = falls ? -INFINITY : corner[k];
            max[k] = falls ? corner[k] : INFINITY;
        }
        f.clip = (box3){{min[0], min[1], min[2]}, {max[0], max[1], max[2]}};
        const long double size = terms_at(&f, at, &value);
        const bool empty = form_is_empty(&f);
        if (empty && !(value > 0)) fail_msg("empty at %Lg of %Lg", value, size);
        if (value > 2e-11L * size) assert_true(empty);
        in += value < 0;
        out += value > 0;
        told += empty;
    }
    printf("# %d in, %d out, %d told\n", in, out, told);
    assert_true(in > 10000 && out > 10000 && told > 1000);
}

/* The same with products of the one variable whose range has no end, from the corner: each of its parts grows. */
static void check_cancelling_at_an_end(void **state) {
    (void)state;
    struct random r = random_begin();
    int out = 0, told = 0;
    for (int i = 0; i < 50000; i++) {
        const vec3 at = random_vec3(&r, -3, 3);
        const double corner[] = {at.x, at.y, at.z};
        struct quadric_form f = {.open = true};
        double *const product[] = {&f.yz, &f.zx, &f.xy};
        const int k = (int)random_below(&r, 3), u = (k + 1) % 3, v = (k + 2) % 3;
        const double up = random_below(&r, 2) ? 1 : -1;
        *product[u] = copysign(random_between(&r, 0, 1), up * corner[v]);
        *product[v] = copysign(random_between(&r, 0, 1), up * corner[u]);
        double *const term = random_below(&r, 2) ? product[v] : &f.constant;
        long double value;
        *term = 0;
        terms_at(&f, at, &value);
        *term = (double)(-value / (long double)(term == &f.constant ? 1 : corner[k] * corner[u]));
        if (term != &f.constant && *term * up * corner[u] < 0) continue; /* it would fall */
        if (random_below(&r, 2)) *term *= 1 + random_between(&r, -1e-10, 1e-10);
        double min[] = {at.x, at.y, at.z}, max[] = {at.x, at.y, at.z};
        *(up > 0 ? &max[k] : &min[k]) = up * INFINITY;
        f.clip = (box3){{min[0], min[1], min[2]}, {max[0], max[1], max[2]}};
        const long double size = terms_at(&f, at, &value);
        const bool empty = form_is_empty(&f);
        if (empty && !(value > 0)) fail_msg("empty at %Lg of %Lg", value, size);
        if (value > 2e-11L * size) assert_true(empty);
        out += value > 0;
        told += empty;
    }
    printf("# %d out, %d told\n", out, told);
    assert_true(out > 10000 && told > 1000);
}

int main(void) {
    struct CMUnitTest tests[COUNT(rows) + COUNT(boxes) + 8];
    size_t n = 0;
    for (size_t i = 0; i < COUNT(rows); i++)
        tests[n++] = (struct CMUnitTest){rows[i].name, check_row, NULL, NULL, &rows[i]};
    for (size_t i = 0; i < COUNT(boxes); i++)
        tests[n++] = (struct CMUnitTest){boxes[i].name, check_held, NULL, NULL, &boxes[i]};
    tests[n++] = (struct CMUnitTest){"sums of squares", check_sums_of_squares, NULL, NULL, NULL};
    tests[n++] = (struct CMUnitTest){"terms that cancel", check_cancelling, NULL, NULL, NULL};
    tests[n++] =
        (struct CMUnitTest){"terms that cancel at a corner", check_cancelling_at_a_corner, NULL, NULL, NULL};
    tests[n++] =
        (struct CMUnitTest){"terms that cancel at an end", check_cancelling_at_an_end, NULL, NULL, NULL};
    tests[n++] = (struct CMUnitTest){"held within the clip", check_held_within, NULL, NULL, NULL};
    tests[n++] = (struct CMUnitTest){"halves of space", check_halves, NULL, NULL, NULL};
    tests[n++] = (struct CMUnitTest){"parts that share nothing", check_parts, NULL, NULL, NULL};
    tests[n++] = (struct CMUnitTest){"random forms", check_random, NULL, NULL, NULL};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
