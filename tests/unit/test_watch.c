/* What ends a question to the hierarchy, and a rendering, early: too many instances on the way of a ray, and
 * whoever does not want to wait. */
#include <pthread.h>
#include <string.h>
#include <unistd.h>

#include "accel/accel.h"
#include "loading.h"
#include "monge.h"

/* ---- Questions ---- */

#define CLAY  "{}"
#define GLASS "{diffuse: black, refraction: 0.9}"

/* Balls at one place, 2^levels times within each other; beside it one alone, which comes first in the file. */
#define NEST(levels, balls, material)                                                                        \
    "image: {size: [4, 3], samples: 1}\n"                                                                    \
    "camera: {eye: [0, 0, 20], look_at: [0, 0, 0]}\n"                                                        \
    "define:\n"                                                                                              \
    "  nest:\n"                                                                                              \
    "    params: {levels: 0}\n"                                                                              \
    "    objects:\n"                                                                                         \
    "      - {when: levels == 0, for: {i: " balls "}, sphere: {radius: 3}}\n"                                \
    "      - {when: levels > 0, for: {i: 2}, use: nest, with: {levels: levels - 1}}\n"                       \
    "scene:\n"                                                                                               \
    "  - {sphere: {center: [50, 0, 0]}, material: {}}\n"                                                     \
    "  - {use: nest, with: {levels: " levels "}, material: " material "}\n"

struct nest {
    struct loaded l;
    struct arena arena;
    const struct accel *accel;
};

static void nest_begin(struct nest *n, const char *text, bool clear) {
    *n = (struct nest){0};
    load_good(&n->l, text);
    const struct scene *s = &n->l.scene;
    bool *is_clear = arena_array(&n->arena, s->material_count, sizeof *is_clear);
    for (uint32_t i = 0; i < s->material_count; i++) is_clear[i] = clear;
    n->accel = accel_build(&n->arena, &s->primitives, s->geometries, s->geometry_count, is_clear);
}

static void nest_end(struct nest *n) {
    arena_free(&n->arena);
    unload(&n->l);
}

static const ray at_nest = {{0, 0, 20}, {0, 0, -1}}, at_ball = {{50, 0, 20}, {0, 0, -1}};

/* 19 levels are 2^20 - 1 entries, and some for the first ones to be placed. */
static void as_many_entries_as_may_be(void **state) {
    (void)state;
    struct nest n;
    struct hit hit;
    struct accel_watch watch = {0};
    nest_begin(&n, NEST("19", "16", CLAY), false);
    assert_true(accel_nearest(n.accel, &watch, at_nest, 0, INFINITY, &hit));
    assert_true(watch.stop == ACCEL_GOES_ON);
    assert_near(hit.crossing.t, 17, 1e-12, "t");
    nest_end(&n);
}

static void visit_nothing(void *context, const struct hit *hit, ray in_set) {
    (void)context;
    (void)hit;
    (void)in_set;
}

/* An opaque any hit ends at the first. */
static void too_many_entries(void **state) {
    (void)state;
    for (int clear = 0; clear < 2; clear++) {
        struct nest n;
        struct hit hit;
        nest_begin(&n, NEST("28", "16", CLAY), clear);
        for (int question = 0; question < 3; question++) {
            struct accel_watch watch = {0};
            switch (question) {
            case 0: assert_false(accel_nearest(n.accel, &watch, at_nest, 0, INFINITY, &hit)); break;
            case 1: assert_false(accel_nearest_clear(n.accel, &watch, at_nest, 0, INFINITY, &hit)); break;
            case 2:
                (clear ? accel_around : accel_around_opaque)(n.accel, &watch, (ray){{0, 0, 0}, {0, 0, 1}},
                                                             visit_nothing, NULL);
                break;
            }
            if (question == 1 && !clear) continue;
            assert_true(watch.stop == ACCEL_TOO_MANY_ENTRIES);
            assert_int_equal(watch.number, 1);
        }
        nest_end(&n);
    }
}

static void any_hit_counts_too(void **state) {
    (void)state;
    struct nest n;
    struct accel_watch watch = {0};
    nest_begin(&n, NEST("28", "16", CLAY), false);
    accel_any(n.accel, &watch, (ray){{3.01, 0, 20}, {0, 0, -1}}, 0,
              INFINITY); /* beside the balls, within their box */
    assert_true(watch.stop == ACCEL_GOES_ON);
    accel_any(n.accel, &watch, (ray){{2.99, 2.99, 20}, {0, 0, -1}}, 0, INFINITY);
    assert_true(watch.stop == ACCEL_TOO_MANY_ENTRIES);
    assert_int_equal(watch.number, 1);
    nest_end(&n);
}

/* Other rays have as many again; once the watch has stopped, none has any. */
static void entries_are_of_one_question(void **state) {
    (void)state;
    struct nest n;
    struct hit hit;
    struct accel_watch watch = {0};
    nest_begin(&n, NEST("18", "16", CLAY), false);
    for (int i = 0; i < 4; i++) assert_true(accel_nearest(n.accel, &watch, at_nest, 0, INFINITY, &hit));
    assert_true(watch.stop == ACCEL_GOES_ON);
    watch.stop = ACCEL_TOO_MANY_ENTRIES;
    assert_false(accel_nearest(n.accel, &watch, at_ball, 0, INFINITY, &hit));
    assert_true(accel_any(n.accel, &watch, (ray){{60, 0, 20}, {0, 0, -1}}, 0, INFINITY));
    assert_true(accel_nearest(n.accel, NULL, at_ball, 0, INFINITY, &hit));
    nest_end(&n);
    nest_begin(&n, NEST("3", "16", CLAY), true);
    assert_false(accel_nearest_clear(n.accel, &watch, at_ball, 0, INFINITY, &hit));
    assert_true(accel_nearest_clear(n.accel, NULL, at_ball, 0, INFINITY, &hit));
    nest_end(&n);
}

struct visits {
    atomic_bool cancel;
    int count;
};

static void cancel_at_visit(void *context, const struct hit *hit, ray in_set) {
    struct visits *visits = context;
    visit_nothing(NULL, hit, in_set);
    visits->count++;
    atomic_store(&visits->cancel, true);
}

static void cancelled_on_the_way(void **state) {
    (void)state;
    struct nest n;
    struct hit hit;
    struct visits visits = {.count = 0};
    struct accel_watch watch = {.cancel = &visits.cancel};
    nest_begin(&n, NEST("10", "16", CLAY), false);
    accel_around_opaque(n.accel, &watch, (ray){{0, 0, 0}, {0, 0, 1}}, cancel_at_visit, &visits);
    assert_int_equal(visits.count, 16); /* of the first set: between sets it is seen */
    assert_true(watch.stop == ACCEL_CANCELLED);
    watch.stop = ACCEL_GOES_ON;
    assert_false(accel_nearest(n.accel, &watch, at_ball, 0, INFINITY, &hit));
    assert_true(watch.stop == ACCEL_CANCELLED);
    nest_end(&n);
}

/* ---- Renderings ---- */

static struct monge_film *render(const char *text, const atomic_bool *cancel, unsigned threads,
                                 struct monge_diagnostics *diag) {
    struct monge_scene *scene = monge_load_memory("t", text, strlen(text), NULL, diag);
    assert_non_null(scene);
    const struct monge_settings settings = monge_scene_settings(scene);
    const struct monge_job job = {.threads = threads, .cancel = cancel, .diag = diag};
    struct monge_film *film = monge_render(scene, &settings, NULL, &job, NULL);
    monge_scene_free(scene);
    return film;
}

/* That it begins so. */
static void assert_told(struct monge_diagnostics *diag, const char *want) {
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    monge_diagnostics_print(diag, out);
    fclose(out);
    if (strncmp(text, want, strlen(want)) != 0) fail_msg("%s", text);
    free(text);
}

/* From before the nest, and from within it where it is of glass: there the rays have not even begun. */
static void a_rendering_says_why_it_ends(void **state) {
    (void)state;
    static const char *const scenes[] = {NEST("28", "16", CLAY), NEST("28", "16", GLASS)};
    for (size_t i = 0; i < COUNT(scenes); i++)
        for (unsigned threads = 1; threads <= 2; threads++) {
            char *text = strdup(scenes[i]);
            if (i == 1) memcpy(strstr(text, "[0, 0, 20]"), "[0, 0, .2]", 10);
            struct monge_diagnostics *diag = monge_diagnostics_new();
            assert_null(render(text, NULL, threads, diag));
            assert_int_equal(monge_diagnostics_errors(diag), 1);
            assert_told(diag,
                        "t:11:5: error[limit-instances]: a ray comes into more than 1048576 instances of "
                        "templates here\n");
            monge_diagnostics_free(diag);
            free(text);
        }
}

static void a_rendering_within_the_limit(void **state) {
    (void)state;
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_film *film = render(NEST("12", "16", GLASS), NULL, 2, diag);
    assert_non_null(film);
    assert_int_equal(monge_diagnostics_errors(diag), 0);
    monge_film_free(film);
    monge_diagnostics_free(diag);
}

static void *set_soon(void *flag) {
    usleep(100000);
    atomic_store((atomic_bool *)flag, true);
    return NULL;
}

/* 2^18 times a hundred thousand balls: without a look at the flag a single ray takes hours. */
static void a_rendering_is_cancelled_within_a_ray(void **state) {
    (void)state;
    atomic_bool cancel = false;
    pthread_t thread;
    struct monge_diagnostics *diag = monge_diagnostics_new();
    assert_int_equal(pthread_create(&thread, NULL, set_soon, &cancel), 0);
    assert_null(render(NEST("18", "100000", CLAY), &cancel, 1, diag));
    pthread_join(thread, NULL);
    assert_int_equal(monge_diagnostics_errors(diag), 0);
    monge_diagnostics_free(diag);
}

int main(void) {
    alarm(300); /* what is not ended early may take hours */
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(as_many_entries_as_may_be),
        cmocka_unit_test(too_many_entries),
        cmocka_unit_test(any_hit_counts_too),
        cmocka_unit_test(entries_are_of_one_question),
        cmocka_unit_test(cancelled_on_the_way),
        cmocka_unit_test(a_rendering_says_why_it_ends),
        cmocka_unit_test(a_rendering_within_the_limit),
        cmocka_unit_test(a_rendering_is_cancelled_within_a_ray),
    };
    return cmocka_run_group_tests_name("watch", tests, NULL, NULL);
}
