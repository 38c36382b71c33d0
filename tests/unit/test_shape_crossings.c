/* Where rays cross shapes, at places where the answer is known in closed form. */
#include "near.h"
#include "shape_named.h"

/* ---- All crossings ---- */

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

/* ---- The first one within a window ---- */

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

int main(void) {
    struct CMUnitTest tests[COUNT(crossing_rows) + COUNT(first_rows) + 2];
    size_t n = 0;
    for (size_t i = 0; i < COUNT(crossing_rows); i++)
        tests[n++] =
            (struct CMUnitTest){crossing_rows[i].name, check_crossings, NULL, NULL, &crossing_rows[i]};
    for (size_t i = 0; i < COUNT(first_rows); i++)
        tests[n++] = (struct CMUnitTest){first_rows[i].name, check_first, NULL, NULL, &first_rows[i]};
    tests[n++] = (struct CMUnitTest){"edges, from either side", check_edges, NULL, NULL, NULL};
    tests[n++] = (struct CMUnitTest){"the faces of a box", check_faces, NULL, NULL, NULL};
    return cmocka_run_group_tests_name("crossings", tests, NULL, NULL);
}
