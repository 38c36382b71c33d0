/* How far off the surface of an instance a ray must begin, that it does not find it again. */
#include "instance_pair.h"

/* A ball, a cylinder, a cube and a square in an instance of an instance: anywhere up to `far`, then up to other lengths
 * away, and at last as large as *size. */
static struct pair *random_bodies(struct random *r, double far, double *size) {
    static const double lengths[] = {1, 1e3, 1e6};
    struct pair *s = pair_begin();
    struct primitives *leaf = add_geometry(s, 9);
    add_sphere(leaf, random_vec3(r, -far, far), 1, CLAY);
    add_quadric(leaf, &forms[CYLINDER], random_map(r, 5), CLAY);
    add_quadric(leaf, &forms[CUBE], random_map(r, 5), CLAY);
    add_flat(leaf, FLAT_SQUARE, random_map(r, 5), CLAY);
    *size = lengths[random_below(r, 3)];
    add_instance(add_geometry(s, 9), 0, random_map(r, lengths[random_below(r, 3)]), CLAY);
    add_instance(&s->instanced.primitives, 1,
                 affine_compose(affine_scale(vec3_all(*size)), random_map(r, lengths[random_below(r, 3)])),
                 CLAY);
    pair_build(s);
    return s;
}

/* Towards one of them. */
static ray ray_to_body(struct random *r, const struct pair *s, double size) {
    const struct primitives *flat = &s->flat.primitives;
    const vec3 center = box3_center(shape_bounds(flat, flat->info[random_below(r, flat->count)].ref));
    const vec3 from = vec3_madd(center, size, random_vec3(r, -20, 20));
    return (ray){from, vec3_sub(vec3_madd(center, size, random_vec3(r, -0.3, 0.3)), from)};
}

/* A ray from where `one` meets a body, by the error off it, to the side that it came from: anywhere there, or along the
 * surface. False where it came from within, or by chance the new one would go there. */
static bool leave_body(struct random *r, ray one, const struct hit *hit, const struct surface *surface,
                       bool along, ray *leaving) {
    vec3 out = surface->normal;
    if (vec3_dot(one.dir, out) > 0.0) {
        if (shape_is_solid(hit->set, hit->ref)) return false;
        out = vec3_neg(out);
    }
    vec3 dir = random_vec3(r, -1, 1);
    const double up = vec3_dot(dir, out);
    dir = vec3_madd(dir, -up + (along ? 1e-14 : fabs(up)), out);
    *leaving = (ray){vec3_madd(surface->point, surface->error, out), dir};
    return vec3_dot(dir, out) > 0.0;
}

/* A ray that leaves a flat or convex body from beyond the error does not find it again. */
static void errors_hold(void **state) {
    (void)state;
    static const double far[] = {1, 1e3, 1e6};
    struct random r = random_begin();
    int tried = 0;
    for (int round = 0; round < 30; round++) {
        double size;
        struct pair *s = random_bodies(&r, far[round % 3], &size);
        for (int i = 0; i < 2000; i++) {
            const ray one = ray_to_body(&r, s, size);
            struct hit hit, again;
            ray leaving;
            if (!accel_nearest(s->accel, NULL, one, 0.0, INFINITY, &hit)) continue;
            const struct surface surface = accel_surface(s->accel, one, &hit);
            if (!leave_body(&r, one, &hit, &surface, i % 2 == 0, &leaving)) continue;
            tried++;
            if (accel_nearest(s->accel, NULL, leaving, 0.0, INFINITY, &again) &&
                occurrence_equal(&again.which, &hit.which))
                fail_msg("round %d: a ray at %g off the surface hits it again after %g", round, surface.error,
                         again.crossing.t);
        }
        pair_end(s);
    }
    assert_true(tried > 10000);
}

/* The same, by half of the error, on what is far larger than its distance to the origin: along the surface the ray runs
 * to where its own rounding is of that size. */
static void errors_hold_on_what_is_large(void **state) {
    (void)state;
    struct random r = random_begin();
    int tried = 0, bad = 0;
    for (int round = 0; round < 300; round++) {
        struct pair *s = pair_begin();
        struct primitives *leaf = add_geometry(s, 1), *around = add_geometry(s, 1);
        const double size = round % 3 ? 1e5 : 1e3;
        const affine large = affine_scale(vec3_all(size)); /* its own map rounds nothing */
        if (round % 2)
            add_flat(leaf, FLAT_SQUARE, large, CLAY);
        else
            add_quadric(leaf, &forms[CUBE], affine_compose(large, affine_translate((vec3){0, 0, -0.5})),
                        CLAY);
        add_instance(around, 0, random_map(&r, 1), CLAY);
        add_instance(&s->instanced.primitives, 1, random_map(&r, 1), CLAY);
        pair_build(s);
        const affine top = affine_compose(s->instanced.primitives.instances[0].world_from_object,
                                          affine_compose(around->instances[0].world_from_object, large));
        const vec3 up = affine_direction(&top, (vec3){0, 0, 1 / size});
        for (int i = 0; i < 40; i++) {
            const vec3 target = affine_point(&top, vec3_scale(random_vec3(&r, -1, 1), 1 / size));
            const ray one = {vec3_madd(target, 20, up), vec3_neg(up)};
            struct hit hit, again;
            if (!accel_nearest(s->accel, NULL, one, 0.0, INFINITY, &hit)) continue;
            const struct surface surface = accel_surface(s->accel, one, &hit);
            const double side = vec3_dot(surface.normal, up) > 0.0 ? 1.0 : -1.0;
            const vec3 out = vec3_scale(surface.normal, side), any = random_vec3(&r, -1, 1);
            const vec3 along = vec3_madd(any, -vec3_dot(any, out), out);
            const vec3 dir = vec3_madd(along, pow(10, random_between(&r, -18, -10)), out);
            if (!(vec3_dot(dir, out) > 0.0)) continue;
            const ray leaving = {vec3_madd(surface.point, 0.5 * surface.error, out), dir};
            bad += accel_nearest(s->accel, NULL, leaving, 0.0, INFINITY, &again);
            tried++;
        }
        pair_end(s);
    }
    if (bad) fail_msg("%d of %d rays find again what they left", bad, tried);
    assert_true(tried > 5000);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(errors_hold),
        cmocka_unit_test(errors_hold_on_what_is_large),
    };
    return cmocka_run_group_tests_name("errors of instances", tests, NULL, NULL);
}
