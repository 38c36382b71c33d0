/* Which bodies a ray is inside of, and in which order: balls, slabs and planes, each with an index of refraction
 * that tells it from the others. */
#include "loading.h"
#include "render/media.h"

struct world {
    struct loaded loaded;
    struct accel *accel;
    bool clear[32]; /* all: bodies of glass */
};

static void world_begin(struct world *w, const char *text) {
    load_good(&w->loaded, text);
    const struct scene *s = &w->loaded.scene;
    assert_true(s->material_count <= COUNT(w->clear));
    memset(w->clear, true, sizeof w->clear);
    w->accel = accel_build(&w->loaded.arena, &s->primitives, s->geometries, s->geometry_count, w->clear);
}

/* The indices at the origin of the ray, outermost first. */
static void assert_around(struct world *w, ray r, int count, const double *index) {
    struct media_origin here;
    media_at(&w->loaded.scene, w->accel, NULL, r, &here);
    assert_int_equal(here.media.count, count);
    for (int i = 0; i < count; i++) {
        assert_near(here.media.inside[i].index, index[i], 1e-12, "index");
        assert_ptr_equal(here.media.inside[i].which, &here.occurrences[i]);
    }
    assert_near(media_index(&here.media), count ? index[count - 1] : 1.0, 1e-12, "index of all");
}

static const ray up = {{0, 0, 0}, {0, 0, 2}};

static void nothing_around(void **state) {
    (void)state;
    struct world w;
    world_begin(&w, "scene: [{sphere: {center: [0, 0, 2]}}, {square: {size: 9}}, {disc: {radius: 9}},\n"
                    "  {cylinder: {radius: 1, open: true}}, {plane: {point: [0, 0, -1]}}]\n");
    assert_around(&w, up, 0, NULL);
    unload(&w.loaded);
}

/* In whichever order they are written, and whichever is hit first: by where the ray leaves them. */
static void by_where_the_ray_leaves(void **state) {
    (void)state;
    struct world w;
    world_begin(&w, "scene:\n"
                    "  - {sphere: {radius: 2}, material: {index: 1.2}}\n"
                    "  - {sphere: {radius: 0.25}, material: {index: 1.4}}\n"
                    "  - {plane: {point: [0, 0, 3]}, material: {index: 1.1}}\n"
                    "  - {box: {}, material: {index: 1.3}}\n");
    assert_around(&w, up, 4, (const double[]){1.1, 1.2, 1.3, 1.4});
    assert_around(&w, (ray){{0, 0, 0}, {1, 0, -1}}, 4, (const double[]){1.1, 1.2, 1.3, 1.4});
    assert_around(&w, (ray){{0, 0, 0.3}, {0, 0, 1}}, 3, (const double[]){1.1, 1.2, 1.3});
    assert_around(&w, (ray){{0, 0, 2.5}, {0, 0, 1}}, 1, (const double[]){1.1});
    assert_around(&w, (ray){{0, 0, 3.5}, {0, 0, -1}}, 0, NULL);
    unload(&w.loaded);
}

/* As a ray from outside enters them. */
static void bodies_of_one_place_by_their_number(void **state) {
    (void)state;
    struct world w;
    world_begin(&w, "scene:\n"
                    "  - {sphere: {}, material: {index: 1.3}}\n"
                    "  - {sphere: {}, material: {index: 1.2}}\n"
                    "  - {sphere: {}, material: {index: 1.4}}\n");
    assert_around(&w, up, 3, (const double[]){1.3, 1.2, 1.4});
    unload(&w.loaded);
}

/* Whatever their kind, and so in whichever order the tree has them. */
static void bodies_that_end_together_by_their_number(void **state) {
    (void)state;
    static const char *const kinds[] = {"sphere: {}", "quadric: {xx: 1, yy: 1, zz: 1, constant: -1}",
                                        "box: {min: [-1, -1, -1], max: [1, 1, 1]}",
                                        "plane: {point: [0, 0, 1]}",
                                        "cylinder: {from: [0, 0, -1], to: [0, 0, 1]}"};
    enum { BODIES = COUNT(kinds) };
    for (int order = 0; order < 120; order++) {
        int turn[BODIES] = {0, 1, 2, 3, 4};
        char text[1000] = "scene:\n";
        double index[BODIES];
        for (int i = 0, left = order; i < BODIES; left /= BODIES - i, i++) {
            const int other = i + left % (BODIES - i), kept = turn[i];
            turn[i] = turn[other];
            turn[other] = kept;
        }
        for (int i = 0; i < BODIES; i++) {
            index[i] = 1.1 + 0.1 * turn[i];
            snprintf(text + strlen(text), sizeof text - strlen(text), "  - {%s, material: {index: %.1f}}\n",
                     kinds[turn[i]], index[i]);
        }
        struct world w;
        world_begin(&w, text);
        assert_around(&w, up, BODIES, index);
        unload(&w.loaded);
    }
}

/* Within an instance they are told apart by their own numbers, beside it by the instance's. */
static void bodies_of_instances_by_the_outermost_number(void **state) {
    (void)state;
    struct world w;
    world_begin(&w,
                "define:\n"
                "  inner:\n"
                "    objects:\n"
                "      - {sphere: {}, material: {index: 1.2}}\n"
                "      - {sphere: {}, material: {index: 1.1}}\n"
                "      - {for: {i: 16}, square: {center: [9 + i, 0, 0]}}\n" /* makes it worth an instance */
                "  outer:\n"
                "    objects:\n"
                "      - {sphere: {}, material: {index: 1.3}}\n"
                "      - use: inner\n"
                "      - {sphere: {}, material: {index: 1.4}}\n"
                "scene:\n"
                "  - {sphere: {}, material: {index: 1.6}}\n"
                "  - use: outer\n"
                "  - {sphere: {}, material: {index: 1.5}}\n"
                "  - use: inner\n");
    assert_around(&w, up, 8, (const double[]){1.6, 1.3, 1.2, 1.1, 1.4, 1.5, 1.2, 1.1});
    unload(&w.loaded);
}

static void on_a_surface_is_outside(void **state) {
    (void)state;
    struct world w;
    world_begin(&w, "scene: [{plane: {}}, {box: {min: [-1, -1, 0], max: [1, 1, 1]}}]\n");
    assert_around(&w, up, 0, NULL);
    assert_around(&w, (ray){{0, 0, 0}, {1, 0, -1}}, 0, NULL);
    unload(&w.loaded);
}

/* Of more than fit the outermost are forgotten. */
static void the_innermost_of_many(void **state) {
    (void)state;
    static const char *const orders[] = {"i", "19 - i", "(7 * i) % 20"};
    double index[MEDIA_MAX];
    for (int i = 0; i < MEDIA_MAX; i++) index[i] = 1 + 0.01 * (MEDIA_MAX - 1 - i);
    for (size_t i = 0; i < COUNT(orders); i++) {
        char text[200];
        struct world w;
        snprintf(
            text, sizeof text,
            "scene: [{for: {i: 20}, sphere: {radius: '1 + %s'}, material: {index: '1 + 0.01 * (%s)'}}]\n",
            orders[i], orders[i]);
        world_begin(&w, text);
        assert_around(&w, up, MEDIA_MAX, index);
        unload(&w.loaded);
    }
}

/* ---- In and out ---- */

static void in_and_out_again(void **state) {
    (void)state;
    struct world w;
    world_begin(&w, "scene:\n"
                    "  - {for: {i: 18}, sphere: {radius: 20 - i}, material: {index: 1 + 0.01 * i}}\n"
                    "  - {square: {size: 0.5}, material: {index: 2}}\n");
    static struct hit hits[19];
    struct media media[19] = {0};
    ray r = {{0.1, 0, 50}, {0, 0, -1}};
    double t = 0;
    for (int i = 0; i < 19; i++) {
        assert_true(accel_nearest(w.accel, NULL, r, t, INFINITY, &hits[i]));
        t = hits[i].crossing.t;
        if (i == 18) break;
        media[i + 1] = media_enter(&w.loaded.scene, &media[i], &hits[i]);
        assert_int_equal(media[i + 1].count, i < MEDIA_MAX ? i + 1 : MEDIA_MAX);
        assert_near(media_index(&media[i + 1]), 1 + 0.01 * (i < MEDIA_MAX ? i : MEDIA_MAX - 1), 1e-12,
                    "index");
    }
    const struct media beyond = media_enter(&w.loaded.scene, &media[3], &hits[18]);
    assert_int_equal(beyond.count, 3); /* a square has no inside */

    bool inside = false;
    const struct media out = media_leave(&media[3], &hits[1], &inside);
    assert_true(inside);
    assert_int_equal(out.count, 2);
    assert_near(out.inside[0].index, 1, 1e-12, "the outermost");
    assert_near(out.inside[1].index, 1.02, 1e-12, "the innermost");
    const struct media other = media_leave(&media[3], &hits[5], &inside);
    assert_false(inside);
    assert_int_equal(other.count, 3);
    assert_near(media_index(&other), 1.02, 1e-12, "nothing was left");
    unload(&w.loaded);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_around),
        cmocka_unit_test(by_where_the_ray_leaves),
        cmocka_unit_test(bodies_of_one_place_by_their_number),
        cmocka_unit_test(bodies_that_end_together_by_their_number),
        cmocka_unit_test(bodies_of_instances_by_the_outermost_number),
        cmocka_unit_test(on_a_surface_is_outside),
        cmocka_unit_test(the_innermost_of_many),
        cmocka_unit_test(in_and_out_again),
    };
    return cmocka_run_group_tests_name("media", tests, NULL, NULL);
}
