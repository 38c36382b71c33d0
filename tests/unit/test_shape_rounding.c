/* The room that shapes leave for rounding, to the unit: of maps and rays that are not rounded themselves. */
#include "near.h"
#include "shape_named.h"

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

/* ---- The room around bounds ---- */

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

/* ---- The error of a surface ---- */

/* Boxes without an end along one axis, and along the two others. */
#define WITHOUT_END(x, y, z)                                                                                 \
    { .constant = -1, .clip = BOX(-(x), -(y), -(z), x, y, z), .extent = BOX(-(x), -(y), -(z), x, y, z) }
static const struct quadric_form endless[] = {
    WITHOUT_END(INFINITY, 1, 1),        WITHOUT_END(1, INFINITY, 1),
    WITHOUT_END(1, 1, INFINITY),        WITHOUT_END(1, INFINITY, INFINITY),
    WITHOUT_END(INFINITY, 1, INFINITY), WITHOUT_END(INFINITY, INFINITY, 1),
};

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

int main(void) {
    const struct CMUnitTest tests[] = {
        {"the edge of a square", check_edge_of_square, NULL, NULL, NULL},
        {"room for rounding", check_room_for_rounding, NULL, NULL, NULL},
        {"extents", check_extents, NULL, NULL, NULL},
        {"errors without infinity", check_endless, NULL, NULL, NULL},
    };
    return cmocka_run_group_tests_name("rounding", tests, NULL, NULL);
}
