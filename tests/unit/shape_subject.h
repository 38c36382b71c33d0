/* What test_shape_random.c tries: shapes under random maps, random rays at them, and the same shapes in
 * long double, straight from their definition. */
#ifndef MONGE_TESTS_SHAPE_SUBJECT_H
#define MONGE_TESTS_SHAPE_SUBJECT_H

#include "shape_forms.h"

enum { SPHERE = FORM_COUNT, SQUARE, DISC, PLANE, SUBJECT_COUNT };

static const char *subject_name(int kind) {
    static const char *const others[] = {"sphere", "square", "disc", "plane"};
    return kind < FORM_COUNT ? form_names[kind] : others[kind - FORM_COUNT];
}

/* Random numbers by splitmix64. */
static uint64_t seed = 20081;
static uint64_t random_state;

static double uniform(double low, double high) {
    uint64_t z = random_state += 0x9e3779b97f4a7c15;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9;
    z = (z ^ z >> 27) * 0x94d049bb133111eb;
    return low + (high - low) * (double)((z ^ z >> 31) >> 11) * 0x1p-53;
}

static void begin(int kind) { random_state = seed * 1000003 + (uint64_t)kind; }

static bool chance(double probability) { return uniform(0, 1) < probability; }

/* 10^e: repeated products will do for a test. */
static double power_of_ten(double low, double high) {
    double e = uniform(low, high), power = 1;
    for (; e >= 1; e--) power *= 10;
    for (; e < 0; e++) power /= 10;
    return power * (1 + 9 * e);
}

/* One statement each: C does not order the calls in one. */
static vec3 random_in(box3 b) {
    const double x = uniform(b.min.x, b.max.x);
    const double y = uniform(b.min.y, b.max.y);
    const double z = uniform(b.min.z, b.max.z);
    return (vec3){x, y, z};
}

static vec3 random_unit(void) {
    for (;;) {
        const vec3 v = random_in((box3){{-1, -1, -1}, {1, 1, 1}});
        const double length = vec3_length(v);
        if (length < 1 && length > 0.1) return vec3_scale(v, 1 / length);
    }
}

static affine random_rotation(void) { return affine_rotate(random_unit(), uniform(-180, 180)); }

/* A scale per axis, mirrored as often as not: alike, a little apart, or 1 : 1000 : 0.001. */
static affine random_scale(bool harsh) {
    static const vec3 apart[] = {{1, 1000, 0.001}, {0.001, 1, 1000}, {1000, 0.001, 1}, {0.001, 1000, 1}};
    vec3 by = {1, 1, 1};
    if (harsh && chance(0.3))
        by = apart[(int)uniform(0, 4)];
    else if (chance(0.6))
        by = random_in((box3){{0.3, 0.3, 0.3}, {3, 3, 3}});
    return affine_scale(
        (vec3){chance(0.5) ? by.x : -by.x, chance(0.5) ? by.y : -by.y, chance(0.5) ? by.z : -by.z});
}

static affine random_shear(void) {
    const double s = uniform(-2, 2);
    return affine_columns((vec3){1, 0, 0}, (vec3){s, 1, 0}, (vec3){uniform(-1, 1), 0, 1}, (vec3){0, 0, 0});
}

/* world_from_object: scenes of size 1e-4 .. 1e6, near the origin or a million sizes from it. */
static affine random_map(bool harsh) {
    const double size = power_of_ten(-4, 6);
    affine map = affine_scale(vec3_all(size));
    if (chance(0.8)) map = affine_compose(map, random_rotation());
    if (chance(0.3)) map = affine_compose(map, random_shear());
    map = affine_compose(map, random_scale(harsh));
    if (chance(0.5)) map = affine_compose(map, random_rotation());
    const double away = chance(0.2) ? 0 : chance(0.3) ? 1e6 : 10;
    return affine_compose(affine_translate(vec3_scale(random_unit(), away * size)), map);
}

struct subject {
    struct alone a;
    int kind;
    affine map;    /* world_from_object; of a sphere, scale and translation alone */
    box3 extent;   /* object space */
    double length; /* of its longest side in the world */
};

static void make_subject(struct subject *s, int kind, const struct quadric_form *form, affine map) {
    s->kind = kind;
    s->map = map;
    s->extent =
        form ? form->extent : (box3)BOX(-1, -1, kind == SPHERE ? -1 : 0, 1, 1, kind == SPHERE ? 1 : 0);
    if (kind == SQUARE) s->extent = (box3)BOX(-0.5, -0.5, 0, 0.5, 0.5, 0);
    if (kind == SPHERE) {
        const double radius = vec3_length(affine_column(map, 0));
        s->map = affine_compose(affine_translate(affine_column(map, 3)), affine_scale(vec3_all(radius)));
        alone_sphere(&s->a, affine_column(map, 3), radius);
    } else if (form) {
        alone_quadric(&s->a, form, map);
    } else {
        alone_flat(&s->a, kind == DISC ? FLAT_DISC : kind == PLANE ? FLAT_PLANE : FLAT_SQUARE, map);
    }
    const box3 b = s->extent;
    s->length = 0;
    for (int i = 0; i < 8; i++) {
        const vec3 d = {b.max.x - b.min.x, i & 1 ? b.max.y - b.min.y : b.min.y - b.max.y,
                        i & 2 ? b.max.z - b.min.z : b.min.z - b.max.z};
        const double length = vec3_length(affine_direction(&s->map, d));
        if (length > s->length) s->length = length;
    }
}

static const struct quadric_form *form_of(int kind) { return kind < FORM_COUNT ? &forms[kind] : NULL; }

static void random_subject(struct subject *s, int kind, bool harsh) {
    make_subject(s, kind, form_of(kind), random_map(harsh));
}

static vec3 random_direction(const struct subject *s) {
    const vec3 d = random_unit();
    return chance(0.5) ? d : vec3_normalize(affine_direction(&s->map, d));
}

/* Towards a point of the extent, from inside of it to a hundred times its length away. */
static ray random_ray(const struct subject *s) {
    const vec3 target = affine_point(&s->map, random_in(s->extent)), d = random_direction(s);
    const double away = s->length * power_of_ten(-2, 2), speed = power_of_ten(-2, 2);
    return (ray){vec3_madd(target, -away, d), vec3_scale(d, speed)};
}

typedef struct {
    long double x, y, z;
} lvec;

static lvec lvec_of(vec3 v) { return (lvec){v.x, v.y, v.z}; }

static lvec lmadd(lvec a, long double t, vec3 d) {
    return (lvec){a.x + t * (long double)d.x, a.y + t * (long double)d.y, a.z + t * (long double)d.z};
}

static long double lrow(const double m[4], lvec p) { return m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3]; }

static lvec lobject(const affine *m, lvec p) {
    return (lvec){lrow(m->m[0], p), lrow(m->m[1], p), lrow(m->m[2], p)};
}

static long double lform(const struct quadric_form *f, lvec p) {
    return f->xx * p.x * p.x + f->yy * p.y * p.y + f->zz * p.z * p.z + f->xy * p.x * p.y + f->yz * p.y * p.z +
           f->zx * p.z * p.x + f->x * p.x + f->y * p.y + f->z * p.z + f->constant;
}

/* The function whose zero is the part, of a point of the world; negative inside. */
static long double lvalue(const struct subject *s, int part, lvec p) {
    if (s->kind == SPHERE) {
        const lvec q = lmadd(p, -1, s->a.sphere.center);
        return q.x * q.x + q.y * q.y + q.z * q.z - (long double)s->a.sphere.radius * s->a.sphere.radius;
    }
    if (s->kind > SPHERE) return lrow(s->a.flat.object_from_world.m[2], p);
    const struct quadric_form *f = s->a.quadric.form;
    const lvec q = lobject(&s->a.quadric.object_from_world, p);
    switch (part) {
    case SHAPE_CUT_MIN_X: return f->clip.min.x - q.x;
    case SHAPE_CUT_MAX_X: return q.x - f->clip.max.x;
    case SHAPE_CUT_MIN_Y: return f->clip.min.y - q.y;
    case SHAPE_CUT_MAX_Y: return q.y - f->clip.max.y;
    case SHAPE_CUT_MIN_Z: return f->clip.min.z - q.z;
    case SHAPE_CUT_MAX_Z: return q.z - f->clip.max.z;
    default: return lform(f, q);
    }
}

static int part_count(const struct subject *s) { return s->kind < FORM_COUNT ? 7 : 1; }

/* The gradient in the world by central differences, which for a quadric have no error but rounding. */
static vec3 lgradient(const struct subject *s, int part, vec3 at, double step) {
    double g[3];
    for (int i = 0; i < 3; i++) {
        const vec3 e = {i == 0, i == 1, i == 2};
        const lvec p = lvec_of(at);
        g[i] =
            (double)((lvalue(s, part, lmadd(p, step, e)) - lvalue(s, part, lmadd(p, -step, e))) / (2 * step));
    }
    return (vec3){g[0], g[1], g[2]};
}

/* A step that leads to about one unit of object space at most. */
static double step_of(const struct subject *s) {
    if (s->kind == SPHERE) return s->a.sphere.radius;
    const affine *m = s->kind < FORM_COUNT ? &s->a.quadric.object_from_world : &s->a.flat.object_from_world;
    double most = 0;
    for (int i = 0; i < 3; i++) most = box3_upper(most, vec3_max_abs(affine_column(*m, i)));
    return 1 / most;
}

#endif
