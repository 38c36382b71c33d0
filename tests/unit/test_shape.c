/* Shapes at places where the answer is known in closed form. */
#include "near.h"
#include "shape_forms.h"

/* The shapes that the tables name; the canonical one of each kind. */
enum { SPHERE = FORM_COUNT, SQUARE, DISC, PLANE, BALL_2, SLANTED, MIRRORED, STRETCHED };

static const struct quadric_form space = {.constant = -1, .clip = BOX3_ALL, .extent = BOX3_ALL};
static const struct quadric_form quarter = {.xx = 1,
                                            .yy = 1,
                                            .constant = -1,
                                            .clip = BOX(0, 0, -INFINITY, INFINITY, INFINITY, 1),
                                            .extent = BOX3_ALL};
/* Planes: one that is open, in a box; and half of a cube below one, with all squares and products -0. */
static const struct quadric_form open_plane = {.z = 1,
                                               .clip = BOX(-0.5, -0.5, -0.5, 0.5, 0.5, 0.5),
                                               .extent = BOX(-0.5, -0.5, 0, 0.5, 0.5, 0),
                                               .open = true};
static const struct quadric_form half_cube = {.xx = -0.0,
                                              .yy = -0.0,
                                              .zz = -0.0,
                                              .xy = -0.0,
                                              .yz = -0.0,
                                              .zx = -0.0,
                                              .z = 1,
                                              .clip = BOX(-0.5, -0.5, -0.5, 0.5, 0.5, 0.5),
                                              .extent = BOX(-0.5, -0.5, -0.5, 0.5, 0.5, 0)};
enum { SPACE = STRETCHED + 1, QUARTER, OPEN_PLANE, HALF_CUBE, LEANING };

/* With one term more than ellipses about z have, each keeps the extent that it is given. */
#define EXTENT(x, y) .clip = SLAB(-1, 1), .extent = BOX(-(x), -(y), -1, x, y, 1)
static const struct quadric_form leaning[] = {
    {.xx = 1, .yy = 1, .x = -2, .constant = -1, EXTENT(3, 2)},
    {.xx = 1, .yy = 1, .y = 2, .constant = -1, EXTENT(2, 3)},
    {.xx = 1, .yy = 1, .xy = 1, .constant = -1, EXTENT(1.25, 1.25)},
    {.xx = 1, .yy = 1, .yz = 1, .constant = -1, EXTENT(1.25, 1.75)},
    {.xx = 1, .yy = 1, .zx = 1, .constant = -1, EXTENT(1.75, 1.25)},
};

/* Boxes without an end along one axis, and along the two others. */
#define WITHOUT_END(x, y, z)                                                                                 \
    { .constant = -1, .clip = BOX(-(x), -(y), -(z), x, y, z), .extent = BOX(-(x), -(y), -(z), x, y, z) }
static const struct quadric_form endless[] = {
    WITHOUT_END(INFINITY, 1, 1),        WITHOUT_END(1, INFINITY, 1),
    WITHOUT_END(1, 1, INFINITY),        WITHOUT_END(1, INFINITY, INFINITY),
    WITHOUT_END(INFINITY, 1, INFINITY), WITHOUT_END(INFINITY, INFINITY, 1),
};

static void make(struct alone *a, int shape) {
    switch (shape) {
    case SPHERE: alone_sphere(a, (vec3){0, 0, 0}, 1); return;
    case BALL_2: alone_sphere(a, (vec3){1, 2, 3}, 2); return;
    case SQUARE: alone_flat(a, FLAT_SQUARE, AFFINE_IDENTITY); return;
    case DISC: alone_flat(a, FLAT_DISC, AFFINE_IDENTITY); return;
    case PLANE: alone_flat(a, FLAT_PLANE, AFFINE_IDENTITY); return;
    case SLANTED: alone_flat(a, FLAT_SQUARE, affine_rotate((vec3){1, 0, 0}, 90)); return;
    case MIRRORED: alone_quadric(a, &forms[CONE], affine_scale((vec3){1, 1, -1})); return;
    case STRETCHED: alone_quadric(a, &forms[ELLIPSOID], affine_scale((vec3){1, 2, 3})); return;
    case SPACE: alone_quadric(a, &space, AFFINE_IDENTITY); return;
    case QUARTER: alone_quadric(a, &quarter, AFFINE_IDENTITY); return;
    case OPEN_PLANE: alone_quadric(a, &open_plane, AFFINE_IDENTITY); return;
    case HALF_CUBE: alone_quadric(a, &half_cube, AFFINE_IDENTITY); return;
    case LEANING:
    case LEANING + 1:
    case LEANING + 2:
    case LEANING + 3:
    case LEANING + 4: alone_quadric(a, &leaning[shape - LEANING], AFFINE_IDENTITY); return;
    default: alone_quadric(a, &forms[shape], AFFINE_IDENTITY); return;
    }
}

/* clang-format off */
#define SIDE  SHAPE_SIDE
#define MIN_X SHAPE_CUT_MIN_X
#define MAX_X SHAPE_CUT_MAX_X
#define MIN_Z SHAPE_CUT_MIN_Z
#define MAX_Z SHAPE_CUT_MAX_Z
#define MISS  0, {{0, SHAPE_SIDE}}

static struct crossing_row {
    const char *name;
    int shape;
    ray r;
    int count;
    struct crossing want[SHAPE_MAX_CROSSINGS];
} crossing_rows[] = {
    {"sphere through the centre", SPHERE, {{0, 0, -3}, {0, 0, 1}}, 2, {{2, SIDE}, {4, SIDE}}},
    {"sphere from inside", SPHERE, {{0, 0, 0}, {0, 1, 0}}, 2, {{-1, SIDE}, {1, SIDE}}},
    {"sphere behind", SPHERE, {{0, 0, 3}, {0, 0, 1}}, 2, {{-4, SIDE}, {-2, SIDE}}},
    {"sphere, direction of length two", SPHERE, {{0, 0, -3}, {0, 0, 2}}, 2, {{1, SIDE}, {2, SIDE}}},
    {"sphere grazed", SPHERE, {{1, 0, -3}, {0, 0, 1}}, MISS},
    {"sphere missed", SPHERE, {{2, 0, -3}, {0, 0, 1}}, MISS},
    {"sphere, zero direction", SPHERE, {{0, 0, -3}, {0, 0, 0}}, MISS},
    {"sphere, NaN origin", SPHERE, {{NAN, 0, -3}, {0, 0, 1}}, MISS},
    {"sphere, NaN direction", SPHERE, {{0, 0, -3}, {0, NAN, 1}}, MISS},
    {"sphere, infinite origin", SPHERE, {{0, 0, -INFINITY}, {0, 0, 1}}, MISS},
    {"sphere elsewhere", BALL_2, {{1, 2, 0}, {0, 0, 1}}, 2, {{1, SIDE}, {5, SIDE}}},

    {"square", SQUARE, {{0.25, 0.25, -3}, {0, 0, 1}}, 1, {{3, SIDE}}},
    {"square from above", SQUARE, {{0, 0, 3}, {0, 0, -2}}, 1, {{1.5, SIDE}}},
    {"square at its corner", SQUARE, {{0.5, -0.5, 1}, {0, 0, -1}}, 1, {{1, SIDE}}},
    {"square missed in x", SQUARE, {{0.500001, 0, 1}, {0, 0, -1}}, MISS},
    {"square missed in y", SQUARE, {{0, -0.500001, 1}, {0, 0, -1}}, MISS},
    {"square in its own plane", SQUARE, {{-3, 0, 0}, {1, 0, 0}}, MISS},
    {"square in parallel", SQUARE, {{-3, 0, 1}, {1, 0, 0}}, MISS},
    {"square, zero direction", SQUARE, {{0, 0, 1}, {0, 0, 0}}, MISS},
    {"square, NaN origin", SQUARE, {{0, NAN, 1}, {0, 0, -1}}, MISS},
    {"square, turned", SLANTED, {{0, -3, 0.25}, {0, 1, 0}}, 1, {{3, SIDE}}},
    {"disc", DISC, {{0.7, 0.7, -3}, {0, 0, 1}}, 1, {{3, SIDE}}},
    {"disc at its edge", DISC, {{0, 1, -3}, {0, 0, 1}}, 1, {{3, SIDE}}},
    {"disc missed", DISC, {{0.71, 0.71, -3}, {0, 0, 1}}, MISS},
    {"disc, NaN origin", DISC, {{NAN, 0, -3}, {0, 0, 1}}, MISS},
    {"plane far out", PLANE, {{1e6, 1e6, -3}, {0, 0, 1}}, 1, {{3, SIDE}}},
    {"plane in parallel", PLANE, {{0, 0, 1}, {1, 1, 0}}, MISS},
    {"plane in parallel, above", PLANE, {{0, 0, -1}, {1, 1, 0}}, MISS},
    {"square in parallel, above", SQUARE, {{0, 0, -1}, {1, 0, 0}}, MISS},
    {"plane, NaN direction", PLANE, {{0, 0, 1}, {1, NAN, -1}}, MISS},

    {"ellipsoid, long way", STRETCHED, {{0, 0, -5}, {0, 0, 1}}, 2, {{2, SIDE}, {8, SIDE}}},
    {"ellipsoid, short way", STRETCHED, {{-5, 0, 0}, {1, 0, 0}}, 2, {{4, SIDE}, {6, SIDE}}},
    {"ellipsoid grazed", ELLIPSOID, {{1, 0, -3}, {0, 0, 1}}, MISS},
    {"ellipsoid, zero direction", ELLIPSOID, {{0, 0, 0}, {0, 0, 0}}, MISS},
    {"ellipsoid, NaN origin", ELLIPSOID, {{0, NAN, -3}, {0, 0, 1}}, MISS},

    {"cylinder across", CYLINDER, {{-3, 0, 0}, {1, 0, 0}}, 2, {{2, SIDE}, {4, SIDE}}},
    {"cylinder along its axis", CYLINDER, {{0, 0, -3}, {0, 0, 1}}, 2, {{2.5, MIN_Z}, {3.5, MAX_Z}}},
    {"cylinder, axis downwards", CYLINDER, {{0.5, 0, 3}, {0, 0, -1}}, 2, {{2.5, MAX_Z}, {3.5, MIN_Z}}},
    {"cylinder, in by the cap, out by the side", CYLINDER, {{0, 0, -1}, {1, 0, 1}}, 2, {{0.5, MIN_Z},
     {1, SIDE}}},
    {"cylinder from inside", CYLINDER, {{0, 0, 0}, {0, 2, 0}}, 2, {{-0.5, SIDE}, {0.5, SIDE}}},
    {"cylinder, along its side", CYLINDER, {{1, 0, -3}, {0, 0, 1}}, MISS},
    {"cylinder, in the plane of a cap", CYLINDER, {{-3, 0, 0.5}, {1, 0, 0}}, MISS},
    {"cylinder, above a cap", CYLINDER, {{-3, 0, 0.6}, {1, 0, 0}}, MISS},
    {"cylinder grazed", CYLINDER, {{-3, 1, 0}, {1, 0, 0}}, MISS},
    {"cylinder, zero direction inside", CYLINDER, {{0, 0, 0}, {0, 0, 0}}, MISS},
    {"cylinder, NaN in the clipped axis", CYLINDER, {{0, 0, NAN}, {1, 0, 0}}, MISS},
    {"cylinder, NaN direction", CYLINDER, {{-3, 0, 0}, {NAN, 0, 0}}, MISS},
    {"cylinder, infinite direction", CYLINDER, {{-3, 0, 0}, {INFINITY, 0, 0}}, MISS},

    {"cone along its axis", CONE, {{0, 0, -3}, {0, 0, 1}}, 2, {{2, MIN_Z}, {3, MAX_Z}}},
    {"cone along its axis, NaN beside it", CONE, {{NAN, 0, -3}, {0, 0, 1}}, MISS},
    {"cone beside its axis", CONE, {{0.5, 0, -3}, {0, 0, 1}}, 2, {{2, MIN_Z}, {2.5, SIDE}}},
    {"cone across", CONE, {{-3, 0, -0.5}, {1, 0, 0}}, 2, {{2.5, SIDE}, {3.5, SIDE}}},
    {"cone parallel to its side", CONE, {{-0.5, 0, -1.5}, {1, 0, 1}}, 2, {{0.5, MIN_Z}, {1, SIDE}}},
    {"cone, only its rim", CONE, {{0, 0, -2}, {1, 0, 1}}, MISS},
    {"cone, the other nappe", CONE, {{-3, 0, 0.5}, {1, 0, 0}}, MISS},
    {"cone, across at its apex", CONE, {{-3, 0, 0}, {1, 0, 0}}, MISS},
    {"cone mirrored", MIRRORED, {{0.5, 0, 3}, {0, 0, -1}}, 2, {{2, MIN_Z}, {2.5, SIDE}}},

    {"paraboloid beside its axis", PARABOLOID, {{0.5, 0, -1}, {0, 0, 1}}, 2, {{1.25, SIDE}, {2, MAX_Z}}},
    {"paraboloid across", PARABOLOID, {{-1, 0, 0.25}, {1, 0, 0}}, 2, {{0.5, SIDE}, {1.5, SIDE}}},
    {"paraboloid, at its vertex", PARABOLOID, {{-1, 0, 0}, {1, 0, 0}}, MISS},

    {"box along x", CUBE, {{-3, 0, 0}, {1, 0, 0}}, 2, {{2.5, MIN_X}, {3.5, MAX_X}}},
    {"box along -y", CUBE, {{0, 3, 0}, {0, -1, 0}}, 2, {{2.5, SHAPE_CUT_MAX_Y}, {3.5, SHAPE_CUT_MIN_Y}}},
    {"box, in a face", CUBE, {{-3, 0.5, 0}, {1, 0, 0}}, MISS},
    {"box, at an edge only", CUBE, {{-1, 0, 0}, {1, 1, 0}}, MISS},
    {"box, NaN origin", CUBE, {{-3, NAN, 0}, {1, 0, 0}}, MISS},
    {"box, zero direction inside", CUBE, {{0, 0, 0}, {0, 0, 0}}, MISS},

    {"hyperboloid along its axis", HYPERBOLOID, {{0, 0, -2}, {0, 0, 1}}, 2, {{1, MIN_Z}, {3, MAX_Z}}},
    {"hyperboloid, two stretches", HYPERBOLOID, {{1.25, 0, -2}, {0, 0, 1}}, 4, {{1, MIN_Z}, {1.25, SIDE},
     {2.75, SIDE}, {3, MAX_Z}}},
    {"two sheets, along their axis", SHEETS, {{0, 0, -2}, {0, 0, 1}}, 4, {{1, MIN_Z}, {1.5, SIDE},
     {2.5, SIDE}, {3, MAX_Z}}},
    {"saddle", SADDLE, {{0, 0, 3}, {0, 0, -1}}, 2, {{2, MAX_Z}, {3, SIDE}}},

    {"tube across", TUBE, {{-3, 0, 0}, {1, 0, 0}}, 2, {{2, SIDE}, {4, SIDE}}},
    {"tube along its axis", TUBE, {{0, 0, -3}, {0, 0, 1}}, MISS},
    {"tube, in by the open end", TUBE, {{0, 0, -1}, {1, 0, 1}}, 1, {{1, SIDE}}},
    {"open cone from below", OPEN_CONE, {{0.5, 0, -3}, {0, 0, 1}}, 1, {{2.5, SIDE}}},

    {"open plane", OPEN_PLANE, {{0, 0, 3}, {0, 0, -1}}, 1, {{3, SIDE}}},
    {"open plane, at an edge of its box", OPEN_PLANE, {{-0.5, 0, 3}, {0, 0, -1}}, MISS},
    {"open plane, only an edge of its box", OPEN_PLANE, {{-1.5, -0.5, -1}, {1, 1, 1}}, MISS},
    {"half a cube upwards", HALF_CUBE, {{-1, -1, -1}, {1, 1, 1}}, 2, {{0.5, MIN_Z}, {1, SIDE}}},
    {"half a cube downwards", HALF_CUBE, {{1, 1, 1}, {-1, -1, -1}}, 2, {{1, SIDE}, {1.5, MIN_Z}}},

    {"all of space has no surface", SPACE, {{0, 0, 0}, {1, 0, 0}}, MISS},
    {"an end at infinity is no crossing", QUARTER, {{0.5, 0.5, 3}, {0, 0, -1}}, 1, {{2, MAX_Z}}},
    {"sides with one end each", QUARTER, {{-1, 0.5, 0}, {1, 0, 0}}, 2, {{1, MIN_X},
     {1.8660254037844386, SIDE}}},
};
/* clang-format on */

static void check_crossings(void **state) {
    const struct crossing_row *row = *state;
    struct alone a;
    make(&a, row->shape);
    struct crossing got[SHAPE_MAX_CROSSINGS];
    const int count = shape_crossings(&a.p, a.ref, row->r, got);
    assert_int_equal(count, row->count);
    for (int i = 0; i < count; i++) {
        assert_int_equal(got[i].part, row->want[i].part);
        assert_near(got[i].t, row->want[i].t, 4e-16 * fabs(row->want[i].t), "t");
    }
    for (int i = 0; i <= count; i++) { /* each is the first behind the one before */
        const double after = i == 0 ? -INFINITY : got[i - 1].t;
        struct crossing first = {-77, SHAPE_SIDE};
        assert_int_equal(shape_first_crossing(&a.p, a.ref, row->r, after, INFINITY, &first), i < count);
        assert_true(i < count ? first.t == got[i].t && first.part == got[i].part : first.t == -77);
        if (i < count) assert_true(shape_first_crossing(&a.p, a.ref, row->r, after, got[i].t, &first));
    }
}

/* ---- Where parts meet ---- */

/* The crossings of a ray and of the ray that comes the other way are the same: an edge belongs to the same part from
 * either side. All numbers are exact, so that the parts do meet in one t. */
static int check_both_ways(int shape, vec3 edge, vec3 d) {
    struct alone a;
    struct crossing there[SHAPE_MAX_CROSSINGS], back[SHAPE_MAX_CROSSINGS];
    make(&a, shape);
    const int count = shape_crossings(&a.p, a.ref, (ray){vec3_madd(edge, -4, d), d}, there);
    assert_int_equal(shape_crossings(&a.p, a.ref, (ray){vec3_madd(edge, 4, d), vec3_neg(d)}, back), count);
    int met = 0;
    for (int i = 0; i < count; i++) {
        const struct crossing *other = &back[count - 1 - i];
        assert_true(there[i].t == 8 - other->t);
        assert_int_equal(there[i].part, other->part);
        met += there[i].t == 4;
    }
    return met;
}

static void check_edges(void **state) {
    (void)state;
    static const double steps[] = {-2, -1, -0.5, 0, 0.5, 1, 2};
    int met = 0;
    for (int i = 0; i < 27; i++) { /* corners, edges, faces */
        const vec3 edge = {0.5 * (i % 3 - 1), 0.5 * (i / 3 % 3 - 1), 0.5 * (i / 9 - 1)};
        for (int k = 1; k < 7 * 7 * 7; k++)
            met += check_both_ways(CUBE, edge, (vec3){steps[k % 7], steps[k / 7 % 7], steps[k / 49]});
    }
    assert_true(met > 1000);
    met = 0;
    for (int i = 0; i < 16; i++) {
        const double out = i & 1 ? 1 : -1, z = i & 2 ? 1 : -1, in = i & 4 ? out : -out;
        const vec3 way = {in, 0, i & 8 ? z : -z};
        met += check_both_ways(CYLINDER, (vec3){out, 0, 0.5 * z}, way);
        met += check_both_ways(CYLINDER, (vec3){0, out, 0.5 * z}, (vec3){0, way.x, way.z});
        met += check_both_ways(PARABOLOID, (vec3){out, 0, 1}, way);
        met += check_both_ways(TUBE, (vec3){0, out, 0.5 * z}, (vec3){0, way.x, way.z});
    }
    assert_true(met > 20);
}

/* A ray in any face of a box misses it, and is not inside; one within, as close as can be told, meets it. */
static void check_faces(void **state) {
    (void)state;
    struct crossing c[SHAPE_MAX_CROSSINGS];
    struct alone a;
    make(&a, CUBE);
    for (int i = 0; i < 12; i++) {
        const int axis = i % 3, along = (axis + 1 + i / 6) % 3;
        const double side = i / 3 % 2 ? 0.5 : -0.5;
        double org[] = {0, 0, 0}, dir[] = {0, 0, 0};
        org[along] = -3, dir[along] = 1;
        for (int k = 0; k < 3; k++) {
            org[axis] = k == 0 ? nextafter(side, 0) : k == 1 ? side : nextafter(side, 2 * side);
            const ray r = {{org[0], org[1], org[2]}, {dir[0], dir[1], dir[2]}};
            assert_int_equal(shape_crossings(&a.p, a.ref, r, c), k == 0 ? 2 : 0);
            assert_int_equal(shape_contains(&a.p, a.ref, ray_at(r, 3)), k == 0);
        }
    }
}

/* ---- The edge of a square ---- */

static vec3 turned(vec3 v, bool turn) { return turn ? (vec3){v.y, v.x, v.z} : v; }

static bool meets(const struct alone *a, ray r, double t) {
    struct crossing c[SHAPE_MAX_CROSSINGS];
    if (shape_crossings(&a->p, a->ref, r, c) == 0) return false;
    assert_true(c[0].t == t);
    return true;
}

/* A ray from org_z to z = height, which it crosses at (x, 0), or (0, x), at t. On the way it goes across by `across`. */
static bool meets_slanted(double height, double x, double org_z, double across, double t, bool turn) {
    struct alone a;
    const vec3 d = {across / t, 0, (height - org_z) / t};
    alone_flat(&a, FLAT_SQUARE,
               affine_compose(affine_translate((vec3){0, 0, height}), affine_scale((vec3){1, 1, 4})));
    return meets(&a, (ray){turned((vec3){x - across, 0, org_z}, turn), turned(d, turn)}, t);
}

/* A ray straight down to a square at `at`, at x of its own. */
static bool meets_below(double at, double x, bool turn) {
    struct alone a;
    alone_flat(&a, FLAT_SQUARE, affine_translate(turned((vec3){at, 0, 0}, turn)));
    return meets(&a, (ray){turned((vec3){at + x, 0, 3}, turn), {0, 0, -1}}, 3);
}

/* It goes as far as rounding may: by 16 units of all numbers that x is made from, and of those that t is, as often as
 * the ray runs across; but by no more than a hundredth. */
static void check_edge_of_square(void **state) {
    (void)state;
    const double unit = 16 * 0x1p-52, across = 0x1p38;
    for (int i = 0; i < 32; i++) {
        const double to = i & 1 ? across : -across, side = i & 2 ? 1 : -1, t = i & 4 ? 2 : -2,
                     z = i & 8 ? 1 : -1;
        const bool turn = i & 16;
        const double past = unit * (across + across) + unit * (3 + 2 + 1) * (across / 2), last = 0x1p-13;
        assert_true(meets_slanted(z, side * (0.5 + past - last), 3 * z, to, t, turn));
        assert_false(meets_slanted(z, side * (0.5 + past + last), 3 * z, to, t, turn));
        assert_true(meets_slanted(z, side * (0.5 + 10 * 0x1p-10), 3 * z, 8 * to, t, turn));
        assert_false(meets_slanted(z, side * (0.5 + 11 * 0x1p-10), 3 * z, 8 * to, t, turn));
        /* to the last unit: |at + x| + |at| is 2^20 */
        const double just = unit * 0x1p20, at = 0x1p19 - side * (0.25 + 0.5 * just);
        assert_true(meets_below(at, side * (0.5 + just), turn));
        assert_false(meets_below(at, side * (0.5 + just + 0x1p-33), turn));
    }
}

static struct first_row {
    const char *name;
    int shape;
    ray r;
    double t_min, t_max;
    bool hit;
    double t;
} first_rows[] = {
    {"sphere from afar", SPHERE, {{0, 0, -3}, {0, 0, 1}}, 0, INFINITY, true, 2},
    {"sphere from inside", SPHERE, {{0, 0, 0}, {0, 0, 1}}, 0, INFINITY, true, 1},
    {"sphere behind", SPHERE, {{0, 0, 3}, {0, 0, 1}}, 0, INFINITY, false, 0},
    {"t_min is left out", SPHERE, {{0, 0, -3}, {0, 0, 1}}, 2, INFINITY, true, 4},
    {"t_max belongs to the window", SPHERE, {{0, 0, -3}, {0, 0, 1}}, 0, 2, true, 2},
    {"before the window's end", SPHERE, {{0, 0, -3}, {0, 0, 1}}, 0, 1.999, false, 0},
    {"t_min at its exit", SPHERE, {{0, 0, -3}, {0, 0, 1}}, 4, INFINITY, false, 0},
    {"t_min before its exit", SPHERE, {{0, 0, -3}, {0, 0, 1}}, 3.999, 4, true, 4},
    {"window within the sphere", SPHERE, {{0, 0, -3}, {0, 0, 1}}, 2.5, 3.5, false, 0},
    {"square", SQUARE, {{0, 0, -3}, {0, 0, 1}}, 0, 3, true, 3},
    {"square before t_min", SQUARE, {{0, 0, -3}, {0, 0, 1}}, 3, INFINITY, false, 0},
    {"square behind", SQUARE, {{0, 0, 3}, {0, 0, 1}}, 0, INFINITY, false, 0},
    {"square past t_max", SQUARE, {{0, 0, -3}, {0, 0, 1}}, 0, 2.999, false, 0},
    {"plane at infinity", PLANE, {{0, 0, 1}, {1, 0, 0}}, 0, INFINITY, false, 0},
    {"cylinder", CYLINDER, {{-3, 0, 0}, {1, 0, 0}}, 0, INFINITY, true, 2},
    {"cylinder, t_min at its entry", CYLINDER, {{-3, 0, 0}, {1, 0, 0}}, 2, INFINITY, true, 4},
    {"cylinder, t_min at its exit", CYLINDER, {{-3, 0, 0}, {1, 0, 0}}, 4, INFINITY, false, 0},
    {"cylinder, t_max at its entry", CYLINDER, {{-3, 0, 0}, {1, 0, 0}}, 0, 2, true, 2},
    {"box, t_max at its entry", CUBE, {{-3, 0, 0}, {1, 0, 0}}, 0, 2.5, true, 2.5},
    {"box, t_min at its exit", CUBE, {{-3, 0, 0}, {1, 0, 0}}, 3.5, 9, false, 0},
    {"cylinder past t_max", CYLINDER, {{-3, 0, 0}, {1, 0, 0}}, 0, 1.999, false, 0},
    {"cylinder, window within", CYLINDER, {{-3, 0, 0}, {1, 0, 0}}, 2, 3.999, false, 0},
    {"cylinder behind", CYLINDER, {{3, 0, 0}, {1, 0, 0}}, 0, INFINITY, false, 0},
    {"box behind", CUBE, {{3, 0, 0}, {1, 0, 0}}, 0, INFINITY, false, 0},
    {"hyperboloid, the second stretch", HYPERBOLOID, {{1.25, 0, -2}, {0, 0, 1}}, 1.25, INFINITY, true, 2.75},
    {"hyperboloid, between the stretches", HYPERBOLOID, {{1.25, 0, -2}, {0, 0, 1}}, 1.25, 2.7, false, 0},
    {"no crossing at infinity", QUARTER, {{0.5, 0.5, 0}, {0, 0, -1}}, 0, INFINITY, false, 0},
    {"tube from inside", TUBE, {{0, 0, 0}, {0, 0.5, 0}}, 0, INFINITY, true, 2},
};

static void check_first(void **state) {
    const struct first_row *row = *state;
    struct alone a;
    make(&a, row->shape);
    struct crossing got = {-77, SHAPE_SIDE};
    assert_int_equal(shape_first_crossing(&a.p, a.ref, row->r, row->t_min, row->t_max, &got), row->hit);
    assert_near(got.t, row->hit ? row->t : -77, 0, "t");
}

#define R2  0.70710678118654752
#define R15 0.83205029433784372 /* 1.5 : 1, at length one */
#define R04 0.55470019622522915

/* The surface at the first crossing in front of the ray. */
static struct surface_row {
    const char *name;
    int shape;
    ray r;
    vec3 point, normal;
} surface_rows[] = {
    {"sphere", BALL_2, {{1, 2, -9}, {0, 0, 1}}, {1, 2, 1}, {0, 0, -1}},
    {"sphere from inside", BALL_2, {{1, 2, 3}, {0, 3, 0}}, {1, 4, 3}, {0, 1, 0}},
    {"square from above", SQUARE, {{0.25, 0, 3}, {0, 0, -1}}, {0.25, 0, 0}, {0, 0, 1}},
    {"square from below", SQUARE, {{0.25, 0, -3}, {0, 0, 1}}, {0.25, 0, 0}, {0, 0, 1}},
    {"square turned, its +z", SLANTED, {{0.25, 3, 0}, {0, -1, 0}}, {0.25, 0, 0}, {0, -1, 0}},
    {"ellipsoid at its long end", STRETCHED, {{0, 0, -9}, {0, 0, 1}}, {0, 0, -3}, {0, 0, -1}},
    {"ellipsoid, by the inverse transpose",
     STRETCHED,
     {{0.6, 9, 0}, {0, -1, 0}},
     {0.6, 1.6, 0},
     {R15, R04, 0}},
    {"cylinder, its side", CYLINDER, {{0.6, 9, 0.25}, {0, -1, 0}}, {0.6, 0.8, 0.25}, {0.6, 0.8, 0}},
    {"cylinder, upper cap", CYLINDER, {{0.5, 0, 9}, {0, 0, -1}}, {0.5, 0, 0.5}, {0, 0, 1}},
    {"cylinder, lower cap", CYLINDER, {{0.5, 0, -9}, {0, 0, 1}}, {0.5, 0, -0.5}, {0, 0, -1}},
    {"cone, its normal has a z", CONE, {{9, 0, -0.5}, {-1, 0, 0}}, {0.5, 0, -0.5}, {R2, 0, R2}},
    {"cone, its base", CONE, {{0.5, 0, -9}, {0, 0, 1}}, {0.5, 0, -1}, {0, 0, -1}},
    {"cone, its apex from above", CONE, {{0, 0, 9}, {0, 0, -1}}, {0, 0, 0}, {0, 0, 1}},
    {"cone mirrored", MIRRORED, {{9, 0, 0.5}, {-1, 0, 0}}, {0.5, 0, 0.5}, {R2, 0, -R2}},
    {"paraboloid", PARABOLOID, {{0.5, 0, -9}, {0, 0, 1}}, {0.5, 0, 0.25}, {R2, 0, -R2}},
    {"box, -x", CUBE, {{-9, 0.1, 0.2}, {1, 0, 0}}, {-0.5, 0.1, 0.2}, {-1, 0, 0}},
    {"box, +y", CUBE, {{0.1, 9, 0.2}, {0, -1, 0}}, {0.1, 0.5, 0.2}, {0, 1, 0}},
    {"hyperboloid", HYPERBOLOID, {{9, 0, 0}, {-1, 0, 0}}, {1, 0, 0}, {1, 0, 0}},
    {"tube from inside, still outwards", TUBE, {{0, 0, 0}, {0, 1, 0}}, {0, 1, 0}, {0, 1, 0}},
};

static void check_surface(void **state) {
    const struct surface_row *row = *state;
    struct alone a;
    make(&a, row->shape);
    struct crossing crossing;
    assert_true(shape_first_crossing(&a.p, a.ref, row->r, 0, INFINITY, &crossing));
    const struct surface got = shape_surface(&a.p, a.ref, row->r, crossing);
    assert_vec3_near(got.point, row->point, 1e-15, "point");
    assert_vec3_near(got.normal, row->normal, 1e-15, "normal");
    assert_true(got.error >= 0 && got.error <= 1e-13);
}

/* On the apex itself, where there is no normal, any will do that is one. */
static void check_apex(void **state) {
    (void)state;
    const ray rays[] = {
        {{-3, 0, -1e-9}, {1, 0, 0}}, {{-9, 3, -1e-300}, {3, -1, 0}}, {{1, 2, 3}, {-1, -2, -3}}};
    struct alone a;
    make(&a, CONE);
    for (size_t i = 0; i < COUNT(rays); i++) {
        struct crossing crossing = {i == 2 ? 1 : 3, SHAPE_SIDE};
        const struct surface got = shape_surface(&a.p, a.ref, rays[i], crossing);
        assert_near(vec3_length(got.normal), 1, 1e-15, "length of the normal");
        assert_vec3_near(got.point, (vec3){0, 0, 0}, 2e-9, "point");
        assert_true(got.error > 0 && got.error < 1e-7);
        if (i == 2)
            assert_true(vec3_dot(got.normal, rays[i].dir) < 0); /* at the apex itself it faces the ray */
    }
}

/* Of a sphere so small that the ray meets its centre there is no normal either. */
static void check_small_sphere(void **state) {
    (void)state;
    struct alone a;
    alone_sphere(&a, (vec3){1e6, 0, 0}, 1e-15);
    const ray r = {{1e6 - 3, 0, 0}, {2, 0, 0}};
    const struct surface got = shape_surface(&a.p, a.ref, r, (struct crossing){1.5, SHAPE_SIDE});
    assert_vec3_near(got.normal, (vec3){-1, 0, 0}, 0, "normal");
    assert_vec3_near(got.point, (vec3){1e6, 0, 0}, 0, "point");
    assert_near(got.error, 16 * 0x1p-52 * 1e6, 1e-15, "error");
}

static struct contains_row {
    const char *name;
    int shape;
    vec3 point;
    bool solid, inside;
} contains_rows[] = {
    {"sphere", SPHERE, {0.5, 0.5, 0.5}, true, true},
    {"on a sphere", SPHERE, {1, 0, 0}, true, false},
    {"outside a sphere", BALL_2, {0, 0, 0}, true, false},
    {"square", SQUARE, {0, 0, 0}, false, false},
    {"plane", PLANE, {0, 0, -1}, false, false},
    {"cylinder", CYLINDER, {0.9, 0, 0.4}, true, true},
    {"on a cylinder", CYLINDER, {0, 1, 0}, true, false},
    {"on its cap", CYLINDER, {0, 0, 0.5}, true, false},
    {"above its cap", CYLINDER, {0, 0, 0.6}, true, false},
    {"cone", CONE, {0.4, 0, -0.5}, true, true},
    {"the cone's other nappe", CONE, {0.4, 0, 0.5}, true, false},
    {"box", CUBE, {0.49, -0.49, 0.49}, true, true},
    {"beside a box", CUBE, {0.51, 0, 0}, true, false},
    {"stretched", STRETCHED, {0, 0, 2.9}, true, true},
    {"tube", TUBE, {0, 0, 0}, false, false},
    {"NaN", CYLINDER, {NAN, 0, 0}, true, false},
};

static void check_contains(void **state) {
    const struct contains_row *row = *state;
    struct alone a;
    make(&a, row->shape);
    assert_int_equal(shape_is_solid(&a.p, a.ref), row->solid);
    assert_int_equal(shape_contains(&a.p, a.ref, row->point), row->inside);
}

static struct bounds_row {
    const char *name;
    int shape;
    box3 want;
} bounds_rows[] = {
    {"sphere", BALL_2, BOX(-1, 0, 1, 3, 4, 5)},
    {"square", SQUARE, BOX(-0.5, -0.5, 0, 0.5, 0.5, 0)},
    {"square, turned", SLANTED, BOX(-0.5, 0, -0.5, 0.5, 0, 0.5)},
    {"disc", DISC, BOX(-1, -1, 0, 1, 1, 0)},
    {"plane", PLANE, BOX(-INFINITY, -INFINITY, -INFINITY, INFINITY, INFINITY, INFINITY)},
    {"ellipsoid", STRETCHED, BOX(-1, -2, -3, 1, 2, 3)},
    {"cylinder", CYLINDER, BOX(-1, -1, -0.5, 1, 1, 0.5)},
    {"cone", CONE, BOX(-1, -1, -1, 1, 1, 0)},
    {"cone mirrored", MIRRORED, BOX(-1, -1, 0, 1, 1, 1)},
    {"paraboloid", PARABOLOID, BOX(-1, -1, 0, 1, 1, 1)},
    {"box", CUBE, BOX(-0.5, -0.5, -0.5, 0.5, 0.5, 0.5)},
    {"hyperboloid, tighter than its extent", HYPERBOLOID,
     BOX(-1.4142135623730951, -1.4142135623730951, -1, 1.4142135623730951, 1.4142135623730951, 1)},
    {"a term in x: its extent", LEANING, BOX(-3, -2, -1, 3, 2, 1)},
    {"a term in y", LEANING + 1, BOX(-2, -3, -1, 2, 3, 1)},
    {"a term in x y", LEANING + 2, BOX(-1.25, -1.25, -1, 1.25, 1.25, 1)},
    {"a term in y z", LEANING + 3, BOX(-1.25, -1.75, -1, 1.25, 1.75, 1)},
    {"a term in z x", LEANING + 4, BOX(-1.75, -1.25, -1, 1.75, 1.25, 1)},
    {"no end", SPACE, BOX(-INFINITY, -INFINITY, -INFINITY, INFINITY, INFINITY, INFINITY)},
};

static void check_bounds(void **state) {
    const struct bounds_row *row = *state;
    struct alone a;
    make(&a, row->shape);
    const box3 got = shape_bounds(&a.p, a.ref), want = row->want;
    if (!box3_is_bounded(want)) {
        assert_memory_equal(&got, &want, sizeof want);
        return;
    }
    assert_vec3_near(got.min, want.min, 1e-13, "min");
    assert_vec3_near(got.max, want.max, 1e-13, "max");
    assert_true(got.min.x <= want.min.x && got.min.y <= want.min.y && got.min.z <= want.min.z);
    assert_true(got.max.x >= want.max.x && got.max.y >= want.max.y && got.max.z >= want.max.z);
}

/* The two maps are each other's inverse only to rounding. Here they differ by more: what is hit, by
 * object_from_world, must be in the bounds all the same. */
static void check_bounds_of_hits(void **state) {
    (void)state;
    const vec3 gap = {1e-9, -1e-9, 1e-9};
    for (int i = 0; i < 18; i++) {
        const double side = i % 2 ? 1 : -1, size = i < 6 ? 1 : i < 12 ? 1e3 : 1e-3;
        const int axis = i / 2 % 3;
        const vec3 d = {axis == 0 ? side : 0, axis == 1 ? side : 0, axis == 2 ? side : 0};
        struct alone a;
        alone_quadric(&a, &forms[ELLIPSOID], affine_scale(vec3_all(size)));
        a.quadric.object_from_world =
            affine_compose(a.quadric.object_from_world, affine_translate(vec3_neg(gap)));
        const struct instance placed = {a.quadric.object_from_world, a.quadric.world_from_object, 0, 0};
        const vec3 hit = vec3_madd(gap, size, d);
        const box3 both[] = {shape_bounds(&a.p, a.ref),
                             shape_placed_bounds(&placed, (box3)BOX(-1, -1, -1, 1, 1, 1))};
        for (int k = 0; k < 2; k++) {
            const box3 got = both[k];
            assert_true(got.min.x <= hit.x && got.min.y <= hit.y && got.min.z <= hit.z);
            assert_true(got.max.x >= hit.x && got.max.y >= hit.y && got.max.z >= hit.z);
            assert_vec3_near(got.max, vec3_all(size), 4e-9, "max");
            assert_vec3_near(got.min, vec3_all(-size), 4e-9, "min");
        }
    }
}

/* The same where they differ in scale: by most far from the origin, on whichever side of it. */
static void check_bounds_of_scaled_hits(void **state) {
    (void)state;
    for (int i = 0; i < 4; i++) {
        const double scale = i & 1 ? 1 + 1e-9 : 1 - 1e-9;
        const vec3 center = vec3_scale((vec3){2, 3, 4}, i & 2 ? 1 : -1);
        struct alone a;
        alone_quadric(&a, &forms[CUBE], affine_translate(center));
        a.quadric.object_from_world =
            affine_compose(a.quadric.object_from_world, affine_scale(vec3_all(1 / scale)));
        const vec3 min = vec3_scale(vec3_sub(center, vec3_all(0.5)), scale),
                   max = vec3_scale(vec3_add(center, vec3_all(0.5)), scale);
        const box3 got = shape_bounds(&a.p, a.ref);
        assert_true(got.min.x <= min.x && got.min.y <= min.y && got.min.z <= min.z);
        assert_true(got.max.x >= max.x && got.max.y >= max.y && got.max.z >= max.z);
        assert_vec3_near(got.min, min, 2e-8, "min");
        assert_vec3_near(got.max, max, 2e-8, "max");
    }
}

/* ---- Room for rounding ---- */

/* A map of whole numbers with an inverse of whole numbers, and powers of two: nothing here is rounded. */
static affine exact_map(struct random *r, affine *inverse) {
    affine map = affine_scale((vec3){1, -2, 0.25});
    *inverse = affine_scale((vec3){1, -0.5, 4});
    for (int i = 0; i < 4; i++) {
        const unsigned to = random_below(r, 3), from = (to + 1 + random_below(r, 2)) % 3;
        affine step = AFFINE_IDENTITY, back = AFFINE_IDENTITY;
        step.m[to][from] = random_below(r, 5) - 2.0;
        back.m[to][from] = -step.m[to][from];
        map = affine_compose(step, map);
        *inverse = affine_compose(*inverse, back);
    }
    const vec3 by = {random_below(r, 9) - 4.0, random_below(r, 9) - 4.0, random_below(r, 9) - 4.0};
    *inverse = affine_compose(*inverse, affine_translate(vec3_neg(by)));
    return affine_compose(affine_translate(by), map);
}

static box3 corners_of(box3 box, const affine *map) {
    box3 all = BOX3_EMPTY;
    for (int i = 0; i < 8; i++)
        all = box3_add_point(
            all, affine_point(map, (vec3){i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y,
                                          i & 4 ? box.max.z : box.min.z}));
    return all;
}

/* That `got` is larger on each side by 16 units of all numbers that bring a point to object space and back. */
static void check_room(box3 got, box3 exact, const affine *map, const affine *inverse) {
    const double *low[] = {&exact.min.x, &exact.min.y, &exact.min.z},
                 *high[] = {&exact.max.x, &exact.max.y, &exact.max.z};
    const double *min[] = {&got.min.x, &got.min.y, &got.min.z}, *max[] = {&got.max.x, &got.max.y, &got.max.z};
    double there[3];
    for (int i = 0; i < 3; i++) {
        there[i] = fabs(inverse->m[i][3]);
        for (int j = 0; j < 3; j++) there[i] += fabs(inverse->m[i][j]) * fmax(fabs(*low[j]), fabs(*high[j]));
    }
    for (int i = 0; i < 3; i++) {
        double terms = fabs(map->m[i][3]);
        for (int j = 0; j < 3; j++) terms += fabs(map->m[i][j]) * there[j];
        const double want = 16 * 0x1p-52 * terms, last = 0x1p-52 * fmax(fabs(*low[i]), fabs(*high[i]));
        assert_near(*low[i] - *min[i], want, last, "room below");
        assert_near(*max[i] - *high[i], want, last, "room above");
    }
}

static void check_room_for_rounding(void **state) {
    (void)state;
    struct random r = random_begin();
    for (int i = 0; i < 1000; i++) {
        struct alone a;
        affine inverse;
        const affine map = exact_map(&r, &inverse);
        a = (struct alone){.ref = primitive_ref_make(PRIMITIVE_QUADRIC, 0),
                           .quadric = {inverse, map, &forms[CUBE]}};
        a.p.quadrics = &a.quadric;
        check_room(shape_bounds(&a.p, a.ref), corners_of(forms[CUBE].extent, &map), &map, &inverse);
        a = (struct alone){.ref = primitive_ref_make(PRIMITIVE_FLAT, 0), .flat = {inverse, map, FLAT_SQUARE}};
        a.p.flats = &a.flat;
        check_room(shape_bounds(&a.p, a.ref), corners_of((box3)BOX(-0.5, -0.5, 0, 0.5, 0.5, 0), &map), &map,
                   &inverse);
        const vec3 from = {random_below(&r, 9) - 6.0, random_below(&r, 9) - 6.0, random_below(&r, 9) - 6.0};
        const box3 box = {from, vec3_add(from, (vec3){1, random_below(&r, 3), 4})};
        const struct instance placed = {inverse, map, NULL, 0};
        check_room(shape_placed_bounds(&placed, box), corners_of(box, &map), &map, &inverse);
        const box3 none = shape_placed_bounds(&placed, BOX3_EMPTY);
        assert_memory_equal(&none, &BOX3_EMPTY, sizeof none);
        /* of a sphere in the world, of its own numbers alone */
        const double radius = 1 + random_below(&r, 4),
                     far = fmax(fabs(from.x), fmax(fabs(from.y), fabs(from.z)));
        alone_sphere(&a, from, radius);
        const box3 got = shape_bounds(&a.p, a.ref);
        const vec3 room = vec3_all(radius + 16 * 0x1p-52 * (far + radius));
        assert_vec3_near(got.min, vec3_sub(from, room), 0x1p-52 * (far + radius), "sphere, min");
        assert_vec3_near(got.max, vec3_add(from, room), 0x1p-52 * (far + radius), "sphere, max");
    }
}

/* What has no end reaches endlessly, along an axis too. */
static void check_endless_support(void **state) {
    (void)state;
    const int shapes[] = {SPACE, QUARTER, PLANE};
    for (size_t i = 0; i < COUNT(shapes); i++)
        for (int k = 1; k < 27; k++) {
            struct alone a;
            make(&a, shapes[i]);
            const vec3 d = {k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1};
            if (vec3_max_abs(d) > 0.0) assert_true(shape_support(&a.p, a.ref, d) == INFINITY);
        }
}

/* As far as the shape goes a ray may run by it; what has no end adds nothing, and no infinity. */
static void check_endless(void **state) {
    (void)state;
    struct random r = random_begin();
    for (unsigned i = 0; i < 100 * COUNT(endless) * 6; i++) {
        const struct quadric_form *form = &endless[i % COUNT(endless)];
        const int face = (int)(i / COUNT(endless) % 6), axis = face / 2;
        const vec3 width = vec3_sub(form->extent.max, form->extent.min);
        const double widths[] = {width.x, width.y, width.z}, side = face % 2 ? 1 : -1;
        if (isinf(widths[axis])) continue;
        struct alone a = {.ref = primitive_ref_make(PRIMITIVE_QUADRIC, 0), .quadric = {.form = form}};
        a.p.quadrics = &a.quadric;
        const affine map = a.quadric.world_from_object = exact_map(&r, &a.quadric.object_from_world);
        const double *row = a.quadric.object_from_world.m[axis];
        const vec3 out = vec3_scale((vec3){axis == 0, axis == 1, axis == 2}, side),
                   point = affine_point(&map, out);
        const ray to = {affine_point(&map, vec3_scale(out, 9)), affine_direction(&map, vec3_neg(out))};
        const struct surface got =
            shape_surface(&a.p, a.ref, to, (struct crossing){8, (enum shape_part)(SHAPE_CUT_MIN_X + face)});
        const double world[] = {point.x, point.y, point.z};
        double size = fabs(row[3]), slope2 = 0;
        for (int j = 0; j < 3; j++) {
            double far = fabs(world[j]);
            for (int k = 0; k < 3; k++) far += isinf(widths[k]) ? 0 : fabs(map.m[j][k]) * widths[k];
            size += fabs(row[j]) * far;
            slope2 += row[j] * row[j];
        }
        const double want = 16 * 0x1p-52 * (size + 1 + 1) / sqrt(slope2);
        assert_vec3_near(got.point, point, 0, "point");
        assert_vec3_near(got.normal, vec3_scale((vec3){row[0], row[1], row[2]}, side / sqrt(slope2)), 1e-15,
                         "normal");
        assert_near(got.error, want, 1e-9 * want, "error");
    }
}

/* Of what has no sections about z, no more is known than its extent: its corners reach farthest. */
static void check_extents(void **state) {
    (void)state;
    struct random r = random_begin();
    for (unsigned i = 0; i < 1000; i++) {
        struct quadric_form form = leaning[i % COUNT(leaning)];
        const vec3 from = {random_below(&r, 9) - 6.0, random_below(&r, 9) - 6.0, random_below(&r, 9) - 6.0};
        form.extent = (box3){from, vec3_add(from, (vec3){1, 1 + random_below(&r, 3), 4})};
        struct alone a = {.ref = primitive_ref_make(PRIMITIVE_QUADRIC, 0), .quadric = {.form = &form}};
        a.p.quadrics = &a.quadric;
        a.quadric.world_from_object = exact_map(&r, &a.quadric.object_from_world);
        vec3 d = random_vec3(&r, -1, 1);
        if (i % 4 == 0) d = vec3_mul(d, (vec3){i % 3 == 0, i % 3 == 1, i % 3 == 2});
        const affine along =
            affine_compose((affine){{{d.x, d.y, d.z, 0}, {0}, {0}}}, a.quadric.world_from_object);
        assert_near(shape_support(&a.p, a.ref, d), corners_of(form.extent, &along).max.x, 1e-12, "reach");
        check_room(shape_bounds(&a.p, a.ref), corners_of(form.extent, &a.quadric.world_from_object),
                   &a.quadric.world_from_object, &a.quadric.object_from_world);
    }
}

/* An instance is no shape: what it places is met elsewhere. */
static void check_instance(void **state) {
    (void)state;
    struct instance placed = {AFFINE_IDENTITY, AFFINE_IDENTITY, NULL, 0};
    const struct primitives p = {.instances = &placed, .instance_count = 1};
    const primitive_ref ref = primitive_ref_make(PRIMITIVE_INSTANCE, 0);
    const ray r = {{0, 0, 3}, {0, 0, -2}};
    struct crossing c[SHAPE_MAX_CROSSINGS], first = {7, SHAPE_SIDE};
    assert_int_equal(shape_crossings(&p, ref, r, c), 0);
    assert_false(shape_first_crossing(&p, ref, r, -INFINITY, INFINITY, &first));
    assert_true(first.t == 7);
    assert_false(shape_is_solid(&p, ref));
    assert_false(shape_contains(&p, ref, (vec3){0, 0, 0}));
    assert_true(shape_support(&p, ref, (vec3){0, 1, 0}) == INFINITY);
    assert_memory_equal(&(box3[]){shape_bounds(&p, ref)}, &(box3[]){BOX3_ALL}, sizeof(box3));
    const struct surface at = shape_surface(&p, ref, r, (struct crossing){1, SHAPE_SIDE});
    assert_vec3_near(at.point, (vec3){0, 0, 1}, 0, "point");
    assert_vec3_near(at.normal, (vec3){0, 0, 1}, 0, "normal");
    assert_true(at.error == 0);
}

int main(void) {
    struct CMUnitTest tests[COUNT(crossing_rows) + COUNT(first_rows) + COUNT(surface_rows) +
                            COUNT(contains_rows) + COUNT(bounds_rows) + 12];
    size_t n = 0;
    for (size_t i = 0; i < COUNT(crossing_rows); i++)
        tests[n++] =
            (struct CMUnitTest){crossing_rows[i].name, check_crossings, NULL, NULL, &crossing_rows[i]};
    for (size_t i = 0; i < COUNT(first_rows); i++)
        tests[n++] = (struct CMUnitTest){first_rows[i].name, check_first, NULL, NULL, &first_rows[i]};
    for (size_t i = 0; i < COUNT(surface_rows); i++)
        tests[n++] = (struct CMUnitTest){surface_rows[i].name, check_surface, NULL, NULL, &surface_rows[i]};
    tests[n++] = (struct CMUnitTest){"edges, from either side", check_edges, NULL, NULL, NULL};
    tests[n++] = (struct CMUnitTest){"the edge of a square", check_edge_of_square, NULL, NULL, NULL};
    tests[n++] = (struct CMUnitTest){"the faces of a box", check_faces, NULL, NULL, NULL};
    tests[n++] = (struct CMUnitTest){"a sphere like a point", check_small_sphere, NULL, NULL, NULL};
    tests[n++] = (struct CMUnitTest){"room for rounding", check_room_for_rounding, NULL, NULL, NULL};
    tests[n++] = (struct CMUnitTest){"extents", check_extents, NULL, NULL, NULL};
    tests[n++] = (struct CMUnitTest){"no end, along any direction", check_endless_support, NULL, NULL, NULL};
    tests[n++] = (struct CMUnitTest){"an instance", check_instance, NULL, NULL, NULL};
    tests[n++] = (struct CMUnitTest){"the apex of a cone has a normal", check_apex, NULL, NULL, NULL};
    tests[n++] = (struct CMUnitTest){"errors without infinity", check_endless, NULL, NULL, NULL};
    for (size_t i = 0; i < COUNT(contains_rows); i++)
        tests[n++] =
            (struct CMUnitTest){contains_rows[i].name, check_contains, NULL, NULL, &contains_rows[i]};
    for (size_t i = 0; i < COUNT(bounds_rows); i++)
        tests[n++] = (struct CMUnitTest){bounds_rows[i].name, check_bounds, NULL, NULL, &bounds_rows[i]};
    tests[n++] =
        (struct CMUnitTest){"bounds follow object_from_world", check_bounds_of_hits, NULL, NULL, NULL};
    tests[n++] =
        (struct CMUnitTest){"bounds follow its scale", check_bounds_of_scaled_hits, NULL, NULL, NULL};
    return cmocka_run_group_tests_name("shape", tests, NULL, NULL);
}
