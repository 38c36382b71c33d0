/* Shapes under random maps and random rays, against what must hold of each and against slower
 * arithmetic: long double and bisection. The seed is printed; SHAPE_SEED=n in the environment sets it. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "shape_subject.h"

/* How far a normal may be off: the map rounds the point where it is taken, and the point itself is off
 * by the error, each times the curvature. */
static double normal_rounding(const struct subject *s, vec3 p, double error, double slope) {
    const double step = step_of(s);
    if (s->kind >= SPHERE) return 1e-9 + 4 * error / step;
    const double map = 1e-14 * vec3_max_abs(affine_magnitude(&s->a.quadric.object_from_world, p));
    return 1e-10 + 10 * (map / step + error / (step * step)) / slope;
}

/* The sum of |factor| |number| over all numbers that the value of the part is computed from, where the ray leaves to the
 * end of the shape: one unit of rounding in each moves the surface by so much, as far as that is linear. */
static double rounding_at(const struct subject *s, int part, vec3 p, double slope) {
    if (s->kind == SPHERE) {
        const vec3 out = vec3_normalize(vec3_sub(p, s->a.sphere.center));
        return vec3_dot(vec3_abs(out), vec3_abs(p)) + s->a.sphere.radius;
    }
    const affine *back =
        s->kind < FORM_COUNT ? &s->a.quadric.object_from_world : &s->a.flat.object_from_world;
    const vec3 x = vec3_abs(affine_column(s->map, 0)), y = vec3_abs(affine_column(s->map, 1)),
               z = vec3_abs(affine_column(s->map, 2));
    const vec3 width = s->kind == PLANE ? (vec3){0, 0, 0} : vec3_sub(s->extent.max, s->extent.min);
    const vec3 far =
        vec3_add(vec3_abs(p), vec3_madd(vec3_madd(vec3_scale(x, width.x), width.y, y), width.z, z));
    const vec3 size = affine_magnitude(back, far), at = affine_point(back, p);
    if (s->kind > SPHERE) return size.z / slope;
    const struct quadric_form *f = s->a.quadric.form;
    if (part != SHAPE_SIDE) {
        const int axis = (part - 1) / 2;
        return (axis == 0   ? size.x + fabs(at.x)
                : axis == 1 ? size.y + fabs(at.y)
                            : size.z + fabs(at.z)) /
               slope;
    }
    double sum = 0;
    const double o[] = {at.x, at.y, at.z}, by[] = {size.x, size.y, size.z};
    const double m[3][3] = {
        {f->xx, f->xy / 2, f->zx / 2}, {f->xy / 2, f->yy, f->yz / 2}, {f->zx / 2, f->yz / 2, f->zz}};
    const double linear[] = {f->x, f->y, f->z};
    for (int i = 0; i < 3; i++) {
        double g = linear[i];
        for (int j = 0; j < 3; j++) g += 2 * m[i][j] * o[j], sum += fabs(m[i][j] * o[i] * o[j]);
        sum += fabs(g) * by[i] + fabs(linear[i] * o[i]);
    }
    return (sum + fabs(f->constant)) / slope;
}

/* Sixteen units are counted in each (ROUNDING), and little more than that. Where the surface is nearly singular it is all
 * but linear: the error is some part of its size. */
static void check_error(const struct subject *s, double error, double unit) {
    const double most = s->kind > SPHERE ? 16.1 : 40; /* of a flat it is linear everywhere */
    if (error > 1e-6 * step_of(s)) return;
    if (!(error >= 15.9 * unit && error < most * unit + 1e-26 * s->length))
        fail_msg("error of %g, %g units", error, error / unit);
}

static void check_one_surface(const struct subject *s, ray r, struct crossing c) {
    const struct surface got = shape_surface(&s->a.p, s->a.ref, r, c);
    const double step = step_of(s);
    const vec3 gradient = lgradient(s, (int)c.part, got.point, step);
    const double slope = vec3_length(gradient);
    const long double off = fabsl(lvalue(s, (int)c.part, lvec_of(got.point))) / slope;
    if (!(fabs(vec3_length(got.normal) - 1) < 1e-15))
        fail_msg("normal of length %.17g", vec3_length(got.normal));
    if (!(off <= got.error)) fail_msg("off the surface by %Lg, error %g", off, got.error);
    if (!(got.error < 1e-6 * (s->length + vec3_max_abs(got.point)))) fail_msg("error of %g", got.error);
    check_error(s, got.error, 0x1p-52 * rounding_at(s, (int)c.part, got.point, slope));
    const vec3 drift = vec3_sub(got.point, ray_at(r, c.t));
    const double distance = s->length + vec3_max_abs(r.org) + vec3_max_abs(got.point);
    if (!(vec3_max_abs(drift) < 1e-9 * distance))
        fail_msg("moved by %g of %g", vec3_max_abs(drift), distance);
    const vec3 turn = vec3_sub(got.normal, vec3_scale(gradient, 1 / slope));
    const double vague = normal_rounding(s, got.point, got.error, slope);
    if (!(vec3_max_abs(turn) < vague)) fail_msg("normal off by %g, not %g", vec3_max_abs(turn), vague);
}

static void check_surfaces(void **state) {
    const int kind = *(int *)*state;
    begin(kind);
    int seen = 0;
    for (int i = 0; i < 20000; i++) {
        struct subject s;
        random_subject(&s, kind, true);
        const ray r = random_ray(&s);
        struct crossing c[SHAPE_MAX_CROSSINGS];
        const int count = shape_crossings(&s.a.p, s.a.ref, r, c);
        for (int k = 0; k < count; k++) check_one_surface(&s, r, c[k]);
        seen += count;
    }
    assert_true(seen > 2000);
}

/* From all over to closer to the tangent plane than doubles can tell; against the normal where
 * `side` is -1. Its length is anything. */
static vec3 random_leaving(const struct subject *s, vec3 normal, double side) {
    vec3 d = random_direction(s);
    if (chance(0.6)) {
        d = vec3_madd(d, -vec3_dot(d, normal), normal);
        d = vec3_madd(vec3_normalize(d), side * (chance(0.2) ? 0 : power_of_ten(-18, 0)), normal);
    }
    if (side * vec3_dot(d, normal) < 0) d = vec3_neg(d);
    return vec3_scale(d, power_of_ten(-2, 2));
}

static int crossings_ahead(const struct subject *s, ray r) {
    struct crossing c[SHAPE_MAX_CROSSINGS];
    const int count = shape_crossings(&s->a.p, s->a.ref, r, c);
    int ahead = 0;
    for (int i = 0; i < count; i++) ahead += c[i].t > 0;
    return ahead;
}

/* How far the rounding of the map alone moves a cut face in the world. */
static double face_rounding(const struct subject *s, int part, vec3 p) {
    if (part == SHAPE_SIDE) return 0;
    const affine *m = &s->a.quadric.object_from_world;
    const int axis = (part - 1) / 2;
    const vec3 size = affine_magnitude(m, p), row = {m->m[axis][0], m->m[axis][1], m->m[axis][2]};
    return 1e-14 * (axis == 0 ? size.x : axis == 1 ? size.y : size.z) / vec3_length(row);
}

/* Whether the point is well within all parts but `part`, and there is room behind that. */
static bool has_room(const struct subject *s, int part, struct surface at) {
    for (int i = 0; i < part_count(s); i++) {
        const vec3 p = vec3_madd(at.point, i == part ? -4 * at.error : 0, at.normal);
        const long double value = lvalue(s, i, lvec_of(p));
        if (i == part && !(value < 0)) return false;
        if (i == part || value == -INFINITY || (s->kind == CUBE && i == SHAPE_SIDE)) continue;
        const double slope = vec3_length(lgradient(s, i, at.point, step_of(s)));
        if (!(-value > slope * (4 * at.error + face_rounding(s, i, at.point)))) return false;
    }
    return true;
}

/* Outwards, a convex shape is not met again; inwards, the far wall once. With half of the error
 * already, so that some margin is known to be there. Returns the failures; *tried counts the rays. */
static int check_leaving(const struct subject *s, ray r, struct crossing c, int *tried) {
    const struct surface at = shape_surface(&s->a.p, s->a.ref, r, c);
    const double offset = 0.5 * at.error;
    const bool solid = s->kind <= SPHERE;
    const ray out = {vec3_madd(at.point, offset, at.normal), random_leaving(s, at.normal, 1)};
    const ray in = {vec3_madd(at.point, -offset, at.normal), random_leaving(s, at.normal, -1)};
    int bad = crossings_ahead(s, out) != 0 || shape_contains(&s->a.p, s->a.ref, out.org);
    *tried += 1;
    if (solid && !has_room(s, (int)c.part, at)) return bad;
    *tried += 1;
    bad += crossings_ahead(s, in) != (solid ? 1 : 0) || shape_contains(&s->a.p, s->a.ref, in.org) != solid;
    return bad;
}

/* Moves the subject so that the ray meets it next to the origin: rounding is then that of its size alone. */
static void bring_to_origin(struct subject *s, ray *r) {
    struct crossing c[SHAPE_MAX_CROSSINGS];
    if (!shape_crossings(&s->a.p, s->a.ref, *r, c)) return;
    const vec3 back = vec3_neg(shape_surface(&s->a.p, s->a.ref, *r, c[0]).point);
    make_subject(s, s->kind, form_of(s->kind), affine_compose(affine_translate(back), s->map));
    r->org = vec3_add(r->org, back);
}

static void check_offsets(void **state) {
    const int kind = *(int *)*state;
    begin(kind);
    int seen = 0, tried = 0, bad = 0;
    for (int i = 0; i < 50000; i++) {
        struct subject s;
        random_subject(&s, kind, true);
        ray r = random_ray(&s);
        if (chance(0.3)) bring_to_origin(&s, &r);
        struct crossing c[SHAPE_MAX_CROSSINGS];
        const int count = shape_crossings(&s.a.p, s.a.ref, r, c);
        for (int k = 0; k < count; k++) bad += check_leaving(&s, r, c[k], &tried);
        seen += count;
    }
    if (bad) fail_msg("%d of %d rays left to the wrong side", bad, tried);
    assert_true(seen > 5000 && tried > 1.99 * seen);
}

enum { SAMPLES = 400 };

static bool linside(const struct subject *s, lvec p) {
    for (int i = 0; i < part_count(s); i++)
        if (!(lvalue(s, i, p) < 0)) return false;
    return true;
}

static bool lcut_inside(const struct subject *s, lvec p) {
    for (int i = 1; i < part_count(s); i++)
        if (!(lvalue(s, i, p) <= 0)) return false;
    return true;
}

/* Where, between two places that differ in `inside`, it changes. */
static long double bisect(const struct subject *s, ray r, long double low, long double high, bool open) {
    const lvec org = lvec_of(r.org);
    const bool from = open ? lvalue(s, 0, lmadd(org, low, r.dir)) < 0 : linside(s, lmadd(org, low, r.dir));
    for (int i = 0; i < 80; i++) {
        const long double mid = (low + high) / 2;
        const lvec p = lmadd(org, mid, r.dir);
        *((open ? lvalue(s, 0, p) < 0 : linside(s, p)) == from ? &low : &high) = mid;
    }
    return low;
}

/* The crossings found by walking along the line in steps; closer ones it may step over. */
static int walk(const struct subject *s, ray r, double start, double step, long double found[SAMPLES]) {
    const bool open = s->a.quadric.form->open;
    int count = 0;
    bool before = false;
    for (int i = 0; i <= SAMPLES; i++) {
        const lvec p = lmadd(lvec_of(r.org), start + i * step, r.dir);
        const bool now = open ? lvalue(s, 0, p) < 0 : linside(s, p);
        if (i > 0 && now != before) {
            const long double t = bisect(s, r, start + (i - 1) * step, start + i * step, open);
            if (!open || lcut_inside(s, lmadd(lvec_of(r.org), t, r.dir))) found[count++] = t;
        }
        before = now;
    }
    return count;
}

/* Whether any two crossings of the line are too close for the steps of the walk, or one is at its end. */
static bool is_crowded(const struct crossing *c, int count, double start, double step) {
    for (int i = 0; i < count; i++) {
        if (c[i].t < start + step || c[i].t > start + (SAMPLES - 1) * step) return true;
        if (i > 0 && c[i].t - c[i - 1].t < 2 * step) return true;
    }
    return false;
}

/* Of something open, the roots that the clip leaves out count too, and its rim is nowhere certain. */
static bool is_crowded_open(const struct subject *s, ray r, double step) {
    struct quadric_form whole = *s->a.quadric.form;
    whole.clip = BOX3_ALL;
    struct subject all = *s;
    all.a.p.quadrics = &all.a.quadric;
    all.a.quadric.form = &whole;
    struct crossing c[SHAPE_MAX_CROSSINGS];
    const int count = shape_crossings(&all.a.p, all.a.ref, r, c);
    for (int i = 0; i < count; i++)
        if (lcut_inside(s, lmadd(lvec_of(r.org), c[i].t - 1e-6 * step, r.dir)) !=
            lcut_inside(s, lmadd(lvec_of(r.org), c[i].t + 1e-6 * step, r.dir)))
            return true;
    return count == 2 && c[1].t - c[0].t < 2 * step;
}

/* Returns whether there was something to compare. */
static bool compare_with_walk(const struct subject *s, ray r, double length) {
    struct crossing c[SHAPE_MAX_CROSSINGS];
    const int count = shape_crossings(&s->a.p, s->a.ref, r, c);
    const double middle =
        -vec3_dot(vec3_sub(r.org, affine_point(&s->map, (vec3){0, 0, 0})), r.dir) / vec3_dot(r.dir, r.dir);
    const double half = length / vec3_length(r.dir), start = middle - half * 1.01, step = 2 * half / SAMPLES;
    long double found[SAMPLES];
    if (is_crowded(c, count, start, step)) return false;
    if (s->a.quadric.form->open && is_crowded_open(s, r, step)) return false;
    const int walked = walk(s, r, start, step, found);
    if (walked == count + 2) { /* one that is grazed to rounding may be missed */
        for (int i = 0; i + 1 < walked; i++)
            if (found[i + 1] - found[i] < 1e-6 * step) return false;
    }
    if (walked != count) fail_msg("%d crossings, walked over %d", count, walked);
    for (int i = 0; i < count; i++)
        if (!(fabsl(c[i].t - found[i]) < 1e-5 * step)) fail_msg("t %.17g, walked %.17Lg", c[i].t, found[i]);
    return count > 0;
}

static void check_walks(void **state) {
    const int kind = *(int *)*state;
    begin(kind);
    int compared = 0;
    for (int i = 0; i < 2000; i++) {
        struct subject s;
        random_subject(&s, kind, false);
        compared += compare_with_walk(&s, random_ray(&s), 2 * s.length);
    }
    assert_true(compared > 300);
}

static double coefficient(void) { return chance(0.3) ? 0 : uniform(-1, 1); }

static void random_form(struct quadric_form *f) {
    const bool walls[] = {chance(0.6), chance(0.6), chance(0.6), chance(0.6), chance(0.6), chance(0.6)};
    const box3 clip = {{walls[0] ? uniform(-2, -0.2) : -INFINITY, walls[1] ? uniform(-2, -0.2) : -INFINITY,
                        walls[2] ? uniform(-2, -0.2) : -INFINITY},
                       {walls[3] ? uniform(0.2, 2) : INFINITY, walls[4] ? uniform(0.2, 2) : INFINITY,
                        walls[5] ? uniform(0.2, 2) : INFINITY}};
    *f = (struct quadric_form){.xx = coefficient(),
                               .yy = coefficient(),
                               .zz = coefficient(),
                               .xy = coefficient(),
                               .yz = coefficient(),
                               .zx = coefficient(),
                               .x = coefficient(),
                               .y = coefficient(),
                               .z = coefficient(),
                               .constant = coefficient(),
                               .clip = clip,
                               .extent = clip,
                               .open = chance(0.3)};
}

static void check_any_quadric(void **state) {
    (void)state;
    begin(SUBJECT_COUNT);
    int compared = 0;
    for (int i = 0; i < 30000; i++) {
        struct quadric_form form;
        struct subject s;
        random_form(&form);
        make_subject(&s, 0, &form, chance(0.5) ? AFFINE_IDENTITY : random_map(false));
        s.extent = (box3)BOX(-2, -2, -2, 2, 2, 2);
        s.length = 4 * vec3_max_abs(affine_column(s.map, 0));
        compared += compare_with_walk(&s, random_ray(&s), 3 * s.length);
    }
    assert_true(compared > 3000);
}

/* In order, in pairs, the middle of each pair inside and of each gap outside; and the first crossing
 * of a window is the first of them in it, to the bit. */
static void check_one_list(const struct subject *s, ray r) {
    struct crossing c[SHAPE_MAX_CROSSINGS], first;
    const int count = shape_crossings(&s->a.p, s->a.ref, r, c);
    const bool solid = shape_is_solid(&s->a.p, s->a.ref);
    if (solid) assert_true(count % 2 == 0);
    for (int i = 0; i + 1 < count; i++) {
        assert_true(c[i].t < c[i + 1].t);
        const double gap = (c[i + 1].t - c[i].t) * vec3_length(r.dir);
        const vec3 middle = ray_at(r, (c[i].t + c[i + 1].t) / 2);
        if (!solid || gap < 1e-3 * s->length) continue;
        if (shape_contains(&s->a.p, s->a.ref, middle) != (i % 2 == 0)) fail_msg("middle %d of %d", i, count);
    }
    const double span = count ? c[count - 1].t - c[0].t : 1, low = count ? c[0].t - span : 0;
    const double a = chance(0.2) && count ? c[0].t : low + uniform(0, 3) * span, b = a + uniform(0, 2) * span;
    int i = 0;
    while (i < count && !(c[i].t > a)) i++;
    const bool want = i < count && c[i].t <= b;
    assert_int_equal(shape_first_crossing(&s->a.p, s->a.ref, r, a, b, &first), want);
    if (want) assert_true(first.t == c[i].t && first.part == c[i].part);
}

static void check_lists(void **state) {
    const int kind = *(int *)*state;
    begin(kind);
    for (int i = 0; i < 30000; i++) {
        struct subject s;
        random_subject(&s, kind, false);
        check_one_list(&s, random_ray(&s));
    }
}

/* A ray towards a point on the rim of a cap, pulled a little inwards, goes in and out; at the rim
 * itself it does that or misses, but never leaks. */
static void check_rims(void **state) {
    const int kind = *(int *)*state;
    const struct quadric_form *f = &forms[kind];
    const double z = f->extent.min.z, radius = sqrt(-(f->zz * z * z + f->constant));
    begin(kind);
    for (int i = 0; i < 50000; i++) {
        struct subject s;
        random_subject(&s, kind, false);
        const bool near = vec3_length(affine_column(s.map, 3)) < 1e4 * s.length;
        const double within = near && chance(0.5) ? 1e-7 : 0;
        const vec3 around = vec3_normalize((vec3){uniform(-1, 1), uniform(-1, 1), 0});
        const vec3 rim = vec3_madd((vec3){0, 0, z}, radius, around), middle = box3_center(f->extent);
        const vec3 at = vec3_madd(rim, within, vec3_sub(middle, rim));
        const vec3 target = affine_point(&s.map, at), d = random_direction(&s);
        const ray r = {vec3_madd(target, -s.length * uniform(2, 9), d), d};
        struct crossing c[SHAPE_MAX_CROSSINGS];
        const int count = shape_crossings(&s.a.p, s.a.ref, r, c);
        if (count % 2 != 0 || (within > 0 && count == 0)) fail_msg("%d crossings, %g within", count, within);
    }
}

/* Two squares side by side, each with a transform of its own: no ray passes between them. */
static void check_crack(void **state) {
    (void)state;
    begin(SQUARE);
    for (int i = 0; i < 200000; i++) {
        struct subject left, right;
        const affine map = random_map(false);
        make_subject(&left, SQUARE, NULL, map);
        make_subject(&right, SQUARE, NULL, affine_compose(map, affine_translate((vec3){1, 0, 0})));
        const vec3 target = affine_point(&map, (vec3){0.5, uniform(-0.49, 0.49), 0}),
                   d = random_direction(&left);
        const ray r = {vec3_madd(target, -left.length * power_of_ten(-1, 3), d), d};
        if (!crossings_ahead(&left, r) && !crossings_ahead(&right, r)) fail_msg("a crack at ray %d", i);
    }
}

static vec3 turned(vec3 v, bool turn) { return turn ? (vec3){v.y, v.x, v.z} : v; }

/* The same where a little error of t is a long way across the seam, in x or in y: rays that graze squares of
 * different sizes, far from the origin along their normal. */
static void check_grazed_crack(void **state) {
    (void)state;
    begin(SQUARE);
    for (int i = 0; i < 20000; i++) {
        struct subject left, right;
        const bool turn = i % 2;
        const double away = uniform(1e5, 1e6), size = uniform(0.5, 3);
        const vec3 beside = turned((vec3){0.5 + 0.5 * size, 0, away}, turn);
        make_subject(&left, SQUARE, NULL, affine_translate((vec3){0, 0, away}));
        make_subject(&right, SQUARE, NULL,
                     affine_compose(affine_translate(beside), affine_scale(vec3_all(size))));
        const vec3 target = turned((vec3){0.5, uniform(-0.2, 0.2), away}, turn);
        const vec3 across = {chance(0.5) ? 1 : -1, uniform(-0.1, 0.1), power_of_ten(-4, -1)};
        const vec3 d = turned(across, turn);
        const ray r = {vec3_madd(target, -power_of_ten(-1, 1), d), d};
        if (!crossings_ahead(&left, r) && !crossings_ahead(&right, r)) fail_msg("a crack at ray %d", i);
    }
}

static box3 grow(box3 b, double by) {
    return (box3){vec3_sub(b.min, vec3_all(by)), vec3_add(b.max, vec3_all(by))};
}

static bool box_holds(box3 b, vec3 p) {
    return b.min.x <= p.x && p.x <= b.max.x && b.min.y <= p.y && p.y <= b.max.y && b.min.z <= p.z &&
           p.z <= b.max.z;
}

static void check_bounds_hold(void **state) {
    const int kind = *(int *)*state;
    begin(kind);
    for (int i = 0; i < 30000; i++) {
        struct subject s;
        random_subject(&s, kind, true);
        const box3 bounds = shape_bounds(&s.a.p, s.a.ref);
        const ray r = random_ray(&s);
        struct crossing c[SHAPE_MAX_CROSSINGS];
        const int count = shape_crossings(&s.a.p, s.a.ref, r, c);
        for (int k = 0; k < count; k++) {
            const struct surface at = shape_surface(&s.a.p, s.a.ref, r, c[k]);
            if (!box_holds(grow(bounds, at.error), at.point)) fail_msg("a point outside of the bounds");
        }
    }
}

/* The shape's own points at height z of object space, farthest from the axis. */
static box3 add_ring(box3 b, const struct subject *s, double z) {
    const double radius2 = s->kind == DISC ? 1
                           : s->kind == SPHERE
                               ? 1 - z * z
                               : -((forms[s->kind].zz * z + forms[s->kind].z) * z + forms[s->kind].constant);
    if (!(radius2 >= 0)) return b;
    for (int i = 0; i < 90; i++) {
        const affine turn = affine_rotate((vec3){0, 0, 1}, 4 * i);
        b = box3_add_point(b, affine_point(&s->map, affine_point(&turn, (vec3){sqrt(radius2), 0, z})));
    }
    return b;
}

/* A box of the shape's own points in the world. */
static box3 reached_by(const struct subject *s) {
    box3 reached = BOX3_EMPTY;
    if (s->kind == CUBE || s->kind == SQUARE) {
        for (int i = 0; i < 8; i++) {
            const vec3 corner = {i & 1 ? 0.5 : -0.5, i & 2 ? 0.5 : -0.5,
                                 s->kind == SQUARE ? 0.0
                                 : i & 4           ? 0.5
                                                   : -0.5};
            reached = box3_add_point(reached, affine_point(&s->map, corner));
        }
        return reached;
    }
    for (int k = 0; k <= 200; k++)
        reached = add_ring(reached, s, s->extent.min.z + (s->extent.max.z - s->extent.min.z) * k / 200);
    return reached;
}

static void check_bounds_tight(void **state) {
    const int kind = *(int *)*state;
    begin(kind);
    for (int i = 0; i < 100; i++) {
        struct subject s;
        random_subject(&s, kind, false);
        const box3 reached = reached_by(&s);
        const box3 bounds = shape_bounds(&s.a.p, s.a.ref);
        const vec3 have = vec3_sub(bounds.max, bounds.min), need = vec3_sub(reached.max, reached.min);
        const double slack = 1e-8 * (s.length + vec3_max_abs(bounds.max));
        if (!(have.x <= 1.01 * need.x + slack && have.y <= 1.01 * need.y + slack &&
              have.z <= 1.01 * need.z + slack))
            fail_msg("bounds %g %g %g, needed %g %g %g", have.x, have.y, have.z, need.x, need.y, need.z);
    }
}

/* How far it reaches along any direction: as its points do, seen by a map that brings that direction to x. */
static void check_support(void **state) {
    const int kind = *(int *)*state;
    begin(kind);
    for (int i = 0; i < 100; i++) {
        struct subject s;
        random_subject(&s, kind, false);
        const vec3 d = vec3_scale(random_direction(&s), power_of_ten(-2, 2));
        const double got = shape_support(&s.a.p, s.a.ref, d);
        const double slack = 1e-8 * vec3_length(d) * (s.length + vec3_length(affine_column(s.map, 3)));
        s.map = affine_compose((affine){{{d.x, d.y, d.z, 0}, {0}, {0}}}, s.map);
        const box3 reached = reached_by(&s);
        const double least = reached.max.x, most = least + 0.005 * (reached.max.x - reached.min.x);
        if (!(got >= least - slack && got <= most + slack))
            fail_msg("reaches %g, not %g to %g", got, least, most);
    }
}

/* x^2 and y^2 may be up to this at height z. */
static double section_at(const struct quadric_form *f, double z) {
    return -((f->zz * z + f->z) * z + f->constant);
}

/* What has ellipses about z as its sections: an upright form cut to a slab, or to where it ends by itself. */
static void random_upright(struct quadric_form *f) {
    double low, high;
    do {
        *f = (struct quadric_form){.xx = uniform(0.2, 3),
                                   .yy = uniform(0.2, 3),
                                   .zz = coefficient(),
                                   .z = coefficient(),
                                   .constant = uniform(-2, 0.5)};
        low = uniform(-2, 1);
        high = low + uniform(0.1, 2);
        const double disc = f->z * f->z - 4 * f->zz * f->constant;
        if (f->zz > 0 && disc > 0 && chance(0.3)) low = -0.5 * (f->z + sqrt(disc)) / f->zz;
        if (f->zz > 0 && disc > 0 && chance(0.3)) high = -0.5 * (f->z - sqrt(disc)) / f->zz;
    } while (!(low < high && section_at(f, low) > -1e-12 && section_at(f, high) > -1e-12));
    f->clip = (box3)SLAB(low, high);
    f->extent = (box3)BOX(-99, -99, low, 99, 99, high);
}

/* How far its points reach along the direction, which is of object space; -INFINITY where it has none. */
static double upright_reach(const struct quadric_form *f, vec3 d) {
    double most = -INFINITY;
    for (int k = 0; k <= 500; k++) {
        const double z = f->extent.min.z + (f->extent.max.z - f->extent.min.z) * k / 500;
        if (!(section_at(f, z) > -1e-12)) continue;
        const double section = fmax(section_at(f, z), 0);
        for (int i = 0; i < 90; i++) {
            const double turn = i * 0.069813170079773182; /* 4 degrees */
            const vec3 p = {sqrt(section / f->xx) * cos(turn), sqrt(section / f->yy) * sin(turn), z};
            most = box3_upper(most, vec3_dot(p, d));
        }
    }
    return most;
}

static void check_upright(void **state) {
    (void)state;
    begin(SUBJECT_COUNT + 1);
    for (int i = 0; i < 500; i++) {
        struct quadric_form form;
        struct alone a;
        random_upright(&form);
        alone_quadric(&a, &form, AFFINE_IDENTITY);
        const vec3 d = i % 7 ? random_unit() : (vec3){i % 3 == 0, i % 3 == 1, i % 3 == 2};
        const double most = upright_reach(&form, d), least = -upright_reach(&form, vec3_neg(d));
        const double got = shape_support(&a.p, a.ref, d), room = 2e-3 * (most - least) + 1e-12;
        if (!(got >= most - 1e-12 && got <= most + room))
            fail_msg("form %d reaches %g, not %g", i, got, most);
        a.quadric.world_from_object = (affine){{{d.x, d.y, d.z, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}}};
        a.quadric.object_from_world =
            (affine){{{d.x, 0, 0, 0}, {d.y, 0, 0, 0}, {d.z, 0, 0, 0}}}; /* of a point on d */
        const box3 bounds = shape_bounds(&a.p, a.ref);
        assert_true(bounds.min.x <= least && bounds.min.x >= least - room);
        assert_true(bounds.max.x >= most && bounds.max.x <= most + room);
    }
}

/* The rounding of what an instance places, and how far its maps are from each other's inverse, in long double. */
static void check_placed_surfaces(void **state) {
    (void)state;
    begin(SUBJECT_COUNT + 2);
    for (int i = 0; i < 20000; i++) {
        struct instance placed = {.world_from_object = random_map(false)};
        if (!affine_invert(placed.world_from_object, &placed.object_from_world)) continue;
        const affine *back = &placed.object_from_world, *there = &placed.world_from_object;
        const bool gap = chance(0.5), bounded = chance(0.5);
        if (gap) *(affine *)back = affine_compose(affine_translate(vec3_scale(random_unit(), 1e-3)), *back);
        const box3 any = {vec3_scale(random_unit(), uniform(1, 9)), {9, 9, 9}};
        const box3 extent = bounded ? any : chance(0.5) ? BOX3_EMPTY : BOX3_ALL;
        struct surface of = {vec3_scale(random_unit(), power_of_ten(-3, 1)), random_unit(), 0};
        if (chance(0.5)) of.error = 1e-3 * uniform(0, 1);
        const struct surface got = shape_placed_surface(&placed, &of, extent);
        const vec3 width = bounded ? vec3_sub(extent.max, extent.min) : (vec3){0, 0, 0};
        const double n[] = {of.normal.x, of.normal.y, of.normal.z},
                     p[] = {of.point.x, of.point.y, of.point.z}, w[] = {width.x, width.y, width.z},
                     world[] = {got.point.x, got.point.y, got.point.z};
        long double off = 0, terms = 0, normal2 = 0, drift = 0, size = 0;
        vec3 along = {0, 0, 0};
        for (int k = 0; k < 3; k++) {
            long double at = -(long double)p[k] + back->m[k][3], sum = fabs(back->m[k][3]), column = 0;
            long double to = there->m[k][3];
            for (int j = 0; j < 3; j++) {
                long double far = fabs(world[j]);
                for (int l = 0; l < 3; l++) far += fabsl((long double)there->m[j][l] * w[l]);
                at += (long double)back->m[k][j] * world[j];
                sum += fabsl(back->m[k][j] * far);
                column += (long double)back->m[j][k] * n[j];
                to += (long double)there->m[k][j] * p[j];
                size = fmaxl(size, fabsl((long double)there->m[k][j] * p[j]));
            }
            off += n[k] * at;
            terms += fabs(n[k]) * sum;
            normal2 += column * column;
            *(k == 0 ? &along.x : k == 1 ? &along.y : &along.z) = (double)column;
            drift = fmaxl(drift, fabsl(to - world[k]));
            size = fmaxl(size, fabs(there->m[k][3]));
        }
        assert_true(drift < 1e-15L * size);
        const double want = (double)((of.error + fabsl(off) + 16 * 0x1p-52L * terms) / sqrtl(normal2));
        if (!(fabs(got.error - want) <= 0.1 * want)) fail_msg("error of %g, not %g", got.error, want);
        const vec3 turn = vec3_sub(got.normal, vec3_scale(along, (double)(1 / sqrtl(normal2))));
        assert_true(vec3_max_abs(turn) < 1e-12);
    }
}

static int kinds[SUBJECT_COUNT];
static struct CMUnitTest tests[12 * SUBJECT_COUNT];
static char names[12 * SUBJECT_COUNT][64];
static size_t test_count;

static void add_test(const char *what, CMUnitTestFunction check, int kind) {
    snprintf(names[test_count], sizeof names[0], "%s: %s", what, kind < 0 ? "all" : subject_name(kind));
    tests[test_count] =
        (struct CMUnitTest){names[test_count], check, NULL, NULL, kind < 0 ? NULL : &kinds[kind]};
    test_count++;
}

int main(void) {
    const char *given = getenv("SHAPE_SEED");
    if (given) seed = strtoull(given, NULL, 10);
    print_message("SHAPE_SEED=%llu\n", (unsigned long long)seed);
    for (int kind = 0; kind < SUBJECT_COUNT; kind++) {
        const bool convex = kind < CONVEX_FORMS || (kind >= SPHERE && kind != PLANE); /* and has an end */
        const bool rimmed = kind == CYLINDER || kind == CONE || kind == FRUSTUM || kind == HYPERBOLOID;
        const bool round = kind < FORM_COUNT ? kind != CUBE && kind != TILTED && kind != SADDLE
                                             : kind != SQUARE && kind != PLANE;
        kinds[kind] = kind;
        add_test("points, normals and errors", check_surfaces, kind);
        if (convex) add_test("rays that leave", check_offsets, kind);
        if (kind < FORM_COUNT) add_test("crossings against a walk", check_walks, kind);
        add_test("lists of crossings", check_lists, kind);
        if (rimmed) add_test("no leak at the rim", check_rims, kind);
        add_test("bounds hold", check_bounds_hold, kind);
        if (!round && kind != CUBE && kind != SQUARE) continue;
        add_test("bounds are tight", check_bounds_tight, kind);
        add_test("its reach", check_support, kind);
    }
    add_test("crossings against a walk, random quadrics", check_any_quadric, -1);
    add_test("reach and bounds, random upright quadrics", check_upright, -1);
    add_test("points, normals and errors that are placed", check_placed_surfaces, -1);
    add_test("no crack between squares", check_crack, -1);
    add_test("no crack between squares that are grazed", check_grazed_crack, -1);
    return _cmocka_run_group_tests("shape_random", tests, test_count, NULL, NULL);
}
