/* From a text to flat arrays: places, materials, defaults and the hash. */
#include "base/elementary.h"
#include "loading.h"
#include "scene/builder.h"

/* ---- Two texts that must become the same primitives, to rounding ---- */

static const double tolerance = 1e-14;

static void assert_affine_near(const affine *a, const affine *b, const char *what) {
    double most = 0;
    for (int i = 0; i < 12; i++) most = fmax(most, fabs(b->m[i / 4][i % 4]));
    for (int i = 0; i < 12; i++) assert_near(a->m[i / 4][i % 4], b->m[i / 4][i % 4], tolerance * most, what);
}

static void assert_same_form(const struct quadric_form *a, const struct quadric_form *b) {
    const double ta[] = {a->xx, a->yy, a->zz, a->xy, a->yz, a->zx, a->x, a->y, a->z, a->constant};
    const double tb[] = {b->xx, b->yy, b->zz, b->xy, b->yz, b->zx, b->x, b->y, b->z, b->constant};
    assert_memory_equal(ta, tb, sizeof ta);
    assert_memory_equal(&a->clip, &b->clip, sizeof a->clip);
    assert_int_equal(a->open, b->open);
}

static void assert_same_primitive(const struct primitives *a, const struct primitives *b, uint32_t i) {
    const primitive_ref ref = a->info[i].ref;
    const uint32_t index = primitive_ref_index(ref);
    assert_int_equal(ref, b->info[i].ref);
    switch (primitive_ref_kind(ref)) {
    case PRIMITIVE_SPHERE:
        assert_vec3_near(a->spheres[index].center, b->spheres[index].center,
                         tolerance * (1 + vec3_max_abs(b->spheres[index].center)), "center");
        assert_near(a->spheres[index].radius, b->spheres[index].radius, tolerance * b->spheres[index].radius,
                    "radius");
        return;
    case PRIMITIVE_FLAT:
        assert_affine_near(&a->flats[index].world_from_object, &b->flats[index].world_from_object,
                           "flat to world");
        assert_affine_near(&a->flats[index].object_from_world, &b->flats[index].object_from_world,
                           "world to flat");
        assert_int_equal(a->flats[index].outline, b->flats[index].outline);
        return;
    case PRIMITIVE_INSTANCE: fail();
    case PRIMITIVE_QUADRIC: break;
    }
    assert_affine_near(&a->quadrics[index].world_from_object, &b->quadrics[index].world_from_object,
                       "quadric to world");
    assert_affine_near(&a->quadrics[index].object_from_world, &b->quadrics[index].object_from_world,
                       "world to quadric");
    assert_same_form(a->quadrics[index].form, b->quadrics[index].form);
}

static struct pair {
    const char *name, *a, *b;
} pairs[] = {
    {"sphere: centre and radius", "scene: [{sphere: {center: [1, 2, 3], radius: 2}}]",
     "scene: [{sphere: {}, transform: [{scale: 2}, {translate: [1, 2, 3]}]}]"},
    {"sphere: its parameters come before the node's transform",
     "scene: [{sphere: {center: [1, 0, 0], radius: 2}, transform: {scale: 3}}]",
     "scene: [{sphere: {center: [3, 0, 0], radius: 6}}]"},
    {"sphere: stretched, by centre and radius",
     "scene: [{sphere: {center: [1, 2, 3], radius: 2}, transform: {scale: [1, 2, 1]}}]",
     "scene: [{sphere: {}, transform: [{scale: 2}, {translate: [1, 2, 3]}, {scale: [1, 2, 1]}]}]"},
    {"plane: point and normal z", "scene: [{plane: {point: [1, 2, 3], normal: [0, 0, 5]}}]",
     "scene: [{plane: {}, transform: {translate: [1, 2, 3]}}]"},
    {"plane: no normal", "scene: [{plane: {point: [0, 0, -7]}}]",
     "scene: [{plane: {normal: [0, 0, 1]}, transform: {translate: [0, 0, -7]}}]"},
    {"square: centre and size", "scene: [{square: {center: [1, 2, 3], size: 4}}]",
     "scene: [{square: {}, transform: [{scale: 4}, {translate: [1, 2, 3]}]}]"},
    {"disc: centre and radius", "scene: [{disc: {center: [1, 2, 3], radius: 4}}]",
     "scene: [{disc: {}, transform: [{scale: [4, 4, 1]}, {translate: [1, 2, 3]}]}]"},
    {"box: corners", "scene: [{box: {min: [1, 2, 3], max: [2, 4, 6]}}]",
     "scene: [{box: {}, transform: [{scale: [1, 2, 3]}, {translate: [1.5, 3, 4.5]}]}]"},
    {"box: one corner", "scene: [{box: {max: [1.5, 0.5, 0.5]}}]",
     "scene: [{box: {}, transform: [{scale: [2, 1, 1]}, {translate: [0.5, 0, 0]}]}]"},
    {"cylinder: along z", "scene: [{cylinder: {from: [1, 2, 3], to: [1, 2, 7], radius: 0.5}}]",
     "scene: [{cylinder: {}, transform: [{scale: [0.5, 0.5, 4]}, {translate: [1, 2, 5]}]}]"},
    {"cone: along z", "scene: [{cone: {from: [1, 2, 3], to: [1, 2, 7], radius: 0.5}}]",
     "scene: [{cone: {}, transform: [{scale: [0.5, 0.5, 4]}, {translate: [1, 2, 7]}]}]"},
    {"paraboloid: along z", "scene: [{paraboloid: {from: [1, 2, 3], to: [1, 2, 7], radius: 0.5}}]",
     "scene: [{paraboloid: {}, transform: [{scale: [0.5, 0.5, 4]}, {translate: [1, 2, 3]}]}]"},
    {"hyperboloid: along z", "scene: [{hyperboloid: {from: [1, 2, 3], to: [1, 2, 7], radius: 0.5}}]",
     "scene: [{hyperboloid: {}, transform: [{scale: [0.5, 0.5, 2]}, {translate: [1, 2, 5]}]}]"},
    {"cylinder: the defaults are the canonical form",
     "scene: [{cylinder: {from: [0, 0, -0.5], to: [0, 0, 0.5], radius: 1, open: false}}]",
     "scene: [{cylinder: {}}]"},
    {"steps: the first acts first", "scene: [{box: {}, transform: [{scale: 2}, {translate: [1, 0, 0]}]}]",
     "scene: [{box: {}, transform: {matrix: [[2, 0, 0, 1], [0, 2, 0, 0], [0, 0, 2, 0]]}}]"},
    {"steps: and the other way", "scene: [{box: {}, transform: [{translate: [1, 0, 0]}, {scale: 2}]}]",
     "scene: [{box: {}, transform: {matrix: [[2, 0, 0, 2], [0, 2, 0, 0], [0, 0, 2, 0]]}}]"},
    {"steps: a rotation", "scene: [{box: {}, transform: {rotate: {z: 90}}}]",
     "scene: [{box: {}, transform: {matrix: [[0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 1, 0]]}}]"},
    {"steps: a rotation about an axis", "scene: [{box: {}, transform: {rotate: {y: 30}}}]",
     "scene: [{box: {}, transform: {rotate: {axis: [0, 7, 0], angle: 30}}}]"},
    {"steps: turns add up", "scene: [{box: {}, transform: [{rotate: {x: 20}}, {rotate: {x: 25}}]}]",
     "scene: [{box: {}, transform: {rotate: {x: 45}}}]"},
    {"steps: a shear", "scene: [{box: {}, transform: {shear: {xy: 1, xz: 2, yx: 3, yz: 4, zx: 5, zy: 6}}}]",
     "scene: [{box: {}, transform: {matrix: [[1, 1, 2, 0], [3, 1, 4, 0], [5, 6, 1, 0]]}}]"},
    {"steps: a matrix of four rows",
     "scene: [{box: {}, transform: {matrix: [[1, 0, 0, 5], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]}}]",
     "scene: [{box: {}, transform: {translate: [5, 0, 0]}}]"},
    {"steps: one without its list", "scene: [{box: {}, transform: {scale: 2}}]",
     "scene: [{box: {}, transform: [{scale: 2}]}]"},
    {"steps: none", "scene: [{box: {}, transform: []}]", "scene: [{box: {}}]"},
    {"groups: the transform carries the members",
     "scene: [{group: [{sphere: {}}, {box: {}}], transform: {translate: [1, 2, 3]}}]",
     "scene: [{sphere: {}, transform: {translate: [1, 2, 3]}}, {box: {}, transform: {translate: [1, 2, "
     "3]}}]"},
    {"groups: the member's own transform comes first",
     "scene: [{group: [{box: {}, transform: {rotate: {z: 30}}}], transform: [{scale: [1, 2, 1]}, {translate: "
     "[1, 0, 0]}]}]",
     "scene: [{box: {}, transform: [{rotate: {z: 30}}, {scale: [1, 2, 1]}, {translate: [1, 0, 0]}]}]"},
    {"groups: nested",
     "scene: [{group: [{group: [{box: {}, transform: {shear: {xy: 1}}}], transform: {rotate: {y: 20}}}], "
     "transform: {scale: -2}}]",
     "scene: [{box: {}, transform: [{shear: {xy: 1}}, {rotate: {y: 20}}, {scale: -2}]}]"},
    {"groups: the order of the file stays",
     "scene: [{sphere: {}}, {group: [{box: {}}, {group: [{disc: {}}]}, {sphere: {radius: 2}}]}, {cone: {}}]",
     "scene: [{sphere: {}}, {box: {}}, {disc: {}}, {sphere: {radius: 2}}, {cone: {}}]"},
    {"groups: an empty one is nothing", "scene: [{group: []}, {box: {}}]", "scene: [{box: {}}]"},
    {"mirrored: a sphere stays a sphere",
     "scene: [{sphere: {center: [1, 2, 3], radius: 2}, transform: {scale: [-1, 1, 1]}}]",
     "scene: [{sphere: {center: [-1, 2, 3], radius: 2}}]"},
    {"mirrored: inside out", "scene: [{sphere: {radius: 2}, transform: {scale: -3}}]",
     "scene: [{sphere: {radius: 6}}]"},
    {"similar: turned, moved and scaled spheres are spheres",
     "scene: [{sphere: {}, transform: [{rotate: {axis: [1, 2, 3], angle: 40}}, {scale: 2}, {rotate: {y: "
     "70}}, {translate: [4, 5, 6]}]}]",
     "scene: [{sphere: {center: [4, 5, 6], radius: 2}}]"},
    {"similar: a stretch that is undone",
     "scene: [{group: [{sphere: {}, transform: {scale: [1, 2, 4]}}], transform: {scale: [4, 2, 1]}}]",
     "scene: [{sphere: {radius: 4}}]"},
    {"quadric: its bounds move with it",
     "scene: [{quadric: {xx: 1, constant: -1}, bounds: {min: [0, 0, 0], max: [1, 1, 1]}, transform: {scale: "
     "2}}]",
     "scene: [{group: [{quadric: {xx: 1, constant: -1}, bounds: {min: [0, 0, 0], max: [1, 1, 1]}}], "
     "transform: {scale: 2}}]"},
    {"YAML: an alias is a copy",
     "scene: [{sphere: &s {radius: 2}, transform: &t [{scale: 3}]}, {sphere: *s, transform: *t}]",
     "scene: [{sphere: {radius: 2}, transform: [{scale: 3}]}, {sphere: {radius: 2}, transform: [{scale: "
     "3}]}]"},
    {"YAML: an aliased object", "scene: [&a {sphere: {}, transform: {scale: 2}}, {group: [*a, *a]}]",
     "scene: [{sphere: {radius: 2}}, {sphere: {radius: 2}}, {sphere: {radius: 2}}]"},
    {"YAML: an alias in another role",
     "scene: [{sphere: &s {radius: 2, center: [1, 2, 3]}}, {disc: *s}, {sphere: *s}, {disc: *s}]",
     "scene: [{sphere: {radius: 2, center: [1, 2, 3]}}, {disc: {radius: 2, center: [1, 2, 3]}}, {sphere: "
     "{radius: 2, center: [1, 2, 3]}}, {disc: {radius: 2, center: [1, 2, 3]}}]"},
    {"YAML: one alias as a step and as a list",
     "scene: [{box: {}, transform: &t {scale: 2}}, {box: {}, transform: [*t, *t]}, {box: {}, transform: *t}]",
     "scene: [{box: {}, transform: {scale: 2}}, {box: {}, transform: {scale: 4}}, {box: {}, transform: "
     "{scale: 2}}]"},
    {"YAML: merge keys",
     "scene: [{sphere: &s {radius: 2, center: [1, 1, 1]}}, {sphere: {<<: *s, radius: 3}}]",
     "scene: [{sphere: {radius: 2, center: [1, 1, 1]}}, {sphere: {radius: 3, center: [1, 1, 1]}}]"},
    {"YAML: a merged object",
     "scene:\n- &a\n  sphere: {radius: 2}\n  transform: {scale: 2}\n- <<: *a\n  transform: {translate: [1, "
     "0, 0]}\n",
     "scene: [{sphere: {radius: 4}}, {sphere: {radius: 2, center: [1, 0, 0]}}]"},
    {"YAML: JSON", "{\"scene\": [{\"sphere\": {\"radius\": 2.0, \"center\": [1, 2e0, 3]}}]}",
     "scene:\n  - sphere:\n      radius: 2\n      center:\n        - 1\n        - 2\n        - 3\n"},
};

static void check_pair(void **state) {
    const struct pair *row = *state;
    struct loaded a, b;
    load_good(&a, row->a);
    load_good(&b, row->b);
    assert_int_equal(a.scene.primitives.count, b.scene.primitives.count);
    for (uint32_t i = 0; i < a.scene.primitives.count; i++)
        assert_same_primitive(&a.scene.primitives, &b.scene.primitives, i);
    unload(&a);
    unload(&b);
}

/* ---- from and to in any direction ---- */

static struct revolution {
    const char *name;
    double z_from, z_to;
} revolutions[] = {{"cylinder", -0.5, 0.5}, {"cone", -1, 0}, {"paraboloid", 0, 1}, {"hyperboloid", -1, 1}};

/* The heights of the canonical form come to from and to, and its circles stay circles of the radius across. */
static void check_revolution(void **state) {
    const struct revolution *row = *state;
    struct random r = random_begin();
    for (int i = 0; i < 300; i++) {
        const vec3 from = random_vec3(&r, -5, 5),
                   to = i % 10 ? random_vec3(&r, -5, 5) : (vec3){from.x, from.y, from.z + (i % 20 ? 1 : -2)};
        const double radius = random_between(&r, 0.1, 3);
        char text[400];
        snprintf(text, sizeof text,
                 "scene: [{%s: {from: [%.17g, %.17g, %.17g], to: [%.17g, %.17g, %.17g], radius: %.17g}}]",
                 row->name, from.x, from.y, from.z, to.x, to.y, to.z, radius);
        struct loaded l;
        load_good(&l, text);
        const affine map = l.scene.primitives.quadrics[0].world_from_object;
        assert_vec3_near(affine_point(&map, (vec3){0, 0, row->z_from}), from, 1e-13, "from");
        assert_vec3_near(affine_point(&map, (vec3){0, 0, row->z_to}), to, 1e-13, "to");
        const vec3 x = affine_column(map, 0), y = affine_column(map, 1),
                   axis = vec3_normalize(vec3_sub(to, from));
        assert_near(vec3_length(x), radius, 1e-14 * radius, "radius along x");
        assert_near(vec3_length(y), radius, 1e-14 * radius, "radius along y");
        assert_near(vec3_dot(x, y), 0, 1e-14, "x across y");
        assert_near(vec3_dot(x, axis), 0, 1e-14, "x across the axis");
        assert_near(vec3_dot(y, axis), 0, 1e-14, "y across the axis");
        assert_true(vec3_dot(vec3_cross(x, y), axis) > 0);
        unload(&l);
    }
}

static void planes_and_discs_face_along_their_normal(void **state) {
    (void)state;
    const char *const forms[] = {"plane: {point: [1, 2, 3], normal: [%.17g, %.17g, %.17g]}",
                                 "disc: {center: [1, 2, 3], radius: 2, normal: [%.17g, %.17g, %.17g]}"};
    struct random r = random_begin();
    for (int i = 0; i < 400; i++) {
        const vec3 n = i == 0   ? (vec3){0, 0, -1}
                       : i == 2 ? (vec3){0, 1e-200, 0}
                                : vec3_scale(random_vec3(&r, -1, 1), 5);
        char shape[200], text[300];
        snprintf(shape, sizeof shape, forms[i % 2], n.x, n.y, n.z);
        snprintf(text, sizeof text, "scene: [{%s}]", shape);
        struct loaded l;
        load_good(&l, text);
        const struct flat *flat = &l.scene.primitives.flats[0];
        assert_vec3_near(vec3_normalize(affine_normal(&flat->object_from_world, (vec3){0, 0, 1})),
                         vec3_normalize(n), 1e-14, "normal");
        assert_vec3_near(affine_point(&flat->world_from_object, (vec3){0, 0, 0}), (vec3){1, 2, 3}, 0,
                         "point");
        assert_near(vec3_length(affine_column(flat->world_from_object, 0)), i % 2 ? 2 : 1, 1e-14, "size");
        unload(&l);
    }
}

/* ---- Kinds of primitives ---- */

static struct kind {
    const char *name, *shape;
    enum primitive_kind want;
} kinds[] = {
    {"a sphere", "sphere: {}", PRIMITIVE_SPHERE},
    {"a scaled sphere", "sphere: {}, transform: {scale: 1e-60}", PRIMITIVE_SPHERE},
    {"an ellipsoid", "sphere: {}, transform: {scale: [1, 1, 1.0001]}", PRIMITIVE_QUADRIC},
    {"a sheared sphere", "sphere: {}, transform: {shear: {xy: 0.001}}", PRIMITIVE_QUADRIC},
    {"a quadric that is a sphere", "quadric: {xx: 1, yy: 1, zz: 1, constant: -1}", PRIMITIVE_QUADRIC},
    {"a plane", "plane: {}", PRIMITIVE_FLAT},
    {"a square", "square: {}", PRIMITIVE_FLAT},
    {"a disc", "disc: {}", PRIMITIVE_FLAT},
    {"a box", "box: {}", PRIMITIVE_QUADRIC},
    {"a cylinder", "cylinder: {}", PRIMITIVE_QUADRIC},
    {"an open cone", "cone: {open: true}", PRIMITIVE_QUADRIC},
};

static void check_kind(void **state) {
    const struct kind *row = *state;
    char text[200];
    snprintf(text, sizeof text, "scene: [{%s}]", row->shape);
    struct loaded l;
    load_good(&l, text);
    assert_int_equal(l.scene.primitives.count, 1);
    assert_int_equal(primitive_ref_kind(l.scene.primitives.info[0].ref), row->want);
    unload(&l);
}

static void numbers_follow_the_file_through_the_kinds(void **state) {
    (void)state;
    char text[20000] = "scene:\n";
    const char *const shapes[] = {"sphere: {}", "disc: {}", "box: {}"};
    struct random r = random_begin();
    unsigned kind[400];
    for (int i = 0; i < 400; i++) {
        kind[i] = random_below(&r, 3);
        sprintf(text + strlen(text), "- {%s}\n", shapes[kind[i]]);
    }
    struct loaded l;
    load_good(&l, text);
    const struct primitives *p = &l.scene.primitives;
    assert_int_equal(p->count, 400);
    for (uint32_t i = 0; i < 400; i++) {
        assert_int_equal(primitive_ref_kind(p->info[i].ref), kind[i]);
        assert_int_equal(primitives_number(p, p->info[i].ref), i);
    }
    unload(&l);
}

static void a_quadric_takes_its_coefficients(void **state) {
    (void)state;
    struct loaded l;
    load_good(&l, "scene: [{quadric: {xx: 1, yy: 2, zz: 3, xy: 4, yz: 5, xz: 6, x: 7, y: 8, z: 9, constant: "
                  "10, open: true},\n"
                  "         bounds: {min: [-1, -2, -3], max: [1, 2, 3]}}, {quadric: {z: 1}}]");
    const struct quadric_form *f = l.scene.primitives.quadrics[0].form,
                              *g = l.scene.primitives.quadrics[1].form;
    const double got[] = {f->xx, f->yy, f->zz, f->xy, f->yz, f->zx, f->x, f->y, f->z, f->constant};
    for (int i = 0; i < 10; i++) assert_true(8.0 * got[i] == i + 1);
    assert_true(f->open);
    assert_vec3_near(f->clip.min, (vec3){-1, -2, -3}, 0, "least corner");
    assert_vec3_near(f->extent.max, (vec3){1, 2, 3}, 0, "greatest corner");
    assert_false(g->open);
    assert_true(isinf(g->clip.min.x) && isinf(g->extent.max.z));
    unload(&l);
}

/* The box of what is left of each form, open or closed. */
static void forms_reach_as_far_as_they_do(void **state) {
    (void)state;
    static const struct {
        const char *shape;
        double across, bottom, top;
        bool may_open;
    } want[] = {{"sphere", 1, -1, 1, false},      {"box", 0.5, -0.5, 0.5, false},
                {"cylinder", 1, -0.5, 0.5, true}, {"cone", 1, -1, 0, true},
                {"paraboloid", 1, 0, 1, true},    {"hyperboloid", 1.4142135623730951, -1, 1, true}};
    for (size_t i = 0; i < COUNT(want); i++)
        for (int open = 0; open <= want[i].may_open; open++) {
            char text[200];
            struct loaded l;
            snprintf(text, sizeof text, "scene: [{%s: {%s}, transform: {scale: [1, 2, 1]}}]", want[i].shape,
                     open ? "open: true" : "");
            load_good(&l, text);
            const box3 extent = l.scene.primitives.quadrics[0].form->extent;
            const double a = want[i].across;
            assert_vec3_near(extent.min, (vec3){-a, -a, want[i].bottom}, 3e-16, want[i].shape);
            assert_vec3_near(extent.max, (vec3){a, a, want[i].top}, 3e-16, want[i].shape);
            unload(&l);
        }
}

/* Whichever is the largest, of whichever sign and size: it comes to 1.5, as the others do beside it. */
static void a_quadric_is_scaled_by_a_power_of_two(void **state) {
    (void)state;
    static const char *const keys[] = {"xx", "yy", "zz", "xy", "yz", "xz", "x", "y", "z", "constant"};
    static const double sizes[] = {0x1p-600, -0x1p-40, -1, 0x1p600};
    for (size_t k = 0; k < COUNT(keys); k++)
        for (size_t i = 0; i < COUNT(sizes); i++) {
            char text[200];
            struct loaded l;
            snprintf(text, sizeof text, "scene: [{quadric: {%s: %.17g, %s: %.17g}}]", keys[k], 1.5 * sizes[i],
                     keys[(k + 1) % COUNT(keys)], 0.25 * sizes[i]);
            load_good(&l, text);
            const struct quadric_form *f = l.scene.primitives.quadrics[0].form;
            const double got[] = {f->xx, f->yy, f->zz, f->xy, f->yz, f->zx, f->x, f->y, f->z, f->constant};
            assert_true(got[k] == copysign(1.5, sizes[i]));
            assert_true(got[(k + 1) % COUNT(keys)] == copysign(0.25, sizes[i]));
            unload(&l);
        }
}

static void balls_of_any_size_are_spheres(void **state) {
    (void)state;
    struct loaded l;
    load_good(&l, "scene: [{sphere: {radius: 1.1e-100}}, {sphere: {radius: 0.9e100}}]");
    assert_int_equal(l.scene.primitives.sphere_count, 2);
    unload(&l);
}

/* A hundred thousand spheres in seven lines: the description stays as small as the text. */
static void aliases_take_memory_once(void **state) {
    (void)state;
    char text[3000] = "scene:\n- group: &a0 [{sphere: {}}]\n";
    for (int i = 1; i <= 5; i++) {
        sprintf(text + strlen(text), "- group: &a%d [", i);
        for (int j = 0; j < 10; j++)
            sprintf(text + strlen(text), "{group: *a%d}%s", i - 1, j < 9 ? ", " : "]\n");
    }
    struct loaded l;
    load_good(&l, text);
    assert_int_equal(l.scene.primitives.count, 111111);
    assert_true(l.memory.nodes.total < 500000);
    unload(&l);
}

/* ---- Materials ---- */

static vec3 diffuse_of(const struct loaded *l, uint32_t primitive) {
    return l->scene.materials[l->scene.primitives.info[primitive].material].diffuse;
}

static struct material_row {
    const char *name, *scene; /* with materials red and blue, named and used elsewhere */
    vec3 want;                /* diffuse of the first primitive */
} material_rows[] = {
    {"its own, by name", "[{sphere: {}, material: red}]", {1, 0, 0}},
    {"its own, written out", "[{sphere: {}, material: {diffuse: lime}}]", {0, 1, 0}},
    {"the group's", "[{group: [{sphere: {}}], material: red}]", {1, 0, 0}},
    {"the group's, written out",
     "[{group: [{sphere: {}}, {box: {}}], material: {diffuse: lime}}]",
     {0, 1, 0}},
    {"its own before the group's", "[{group: [{sphere: {}, material: blue}], material: red}]", {0, 0, 1}},
    {"the inner group's", "[{group: [{group: [{sphere: {}}], material: blue}], material: red}]", {0, 0, 1}},
    {"the outer group's", "[{group: [{group: [{sphere: {}}]}], material: red}]", {1, 0, 0}},
    {"by an alias", "[{sphere: {}, material: *blue}]", {0, 0, 1}},
    {"merged and overridden", "[{sphere: {}, material: {<<: *blue, diffuse: white}}]", {1, 1, 1}},
};

static void check_material(void **state) {
    const struct material_row *row = *state;
    char text[500];
    snprintf(text, sizeof text,
             "materials: {red: {diffuse: red}, blue: &blue {diffuse: blue, index: 2}}\nscene: %s\n",
             row->scene);
    struct loaded l;
    load_good(&l, text);
    assert_vec3_near(diffuse_of(&l, 0), row->want, 0, "diffuse");
    unload(&l);
}

static struct diffuse_row {
    const char *name, *material;
    vec3 want;
} diffuse_rows[] = {
    {"diffuse: 0.8", "{}", {0.8, 0.8, 0.8}},
    {"diffuse: less what is reflected", "{reflection: 0.25}", {0.6, 0.6, 0.6}},
    {"diffuse: less both", "{reflection: 0.25, refraction: [0.75, 0.5, 0.25]}", {0, 0.2, 0.4}},
    {"diffuse: nothing left", "{reflection: 1}", {0, 0, 0}},
    {"diffuse: what is given stays", "{reflection: 1, diffuse: [0.5, 0.5, 0.5]}", {0.5, 0.5, 0.5}},
};

static void check_diffuse(void **state) {
    const struct diffuse_row *row = *state;
    char text[200];
    snprintf(text, sizeof text, "scene: [{sphere: {}, material: %s}]", row->material);
    struct loaded l;
    load_good(&l, text);
    assert_vec3_near(diffuse_of(&l, 0), row->want, 1e-15, "diffuse");
    unload(&l);
}

static void one_default_material_serves_all(void **state) {
    (void)state;
    struct loaded l, alone;
    load_good(&alone, "scene: [{sphere: {}}]");
    load_good(&l, "materials: {red: {diffuse: red}}\nscene: [{box: {}, material: red}, {sphere: {}}, {group: "
                  "[{cone: {}}]}]");
    for (uint32_t i = 1; i < 3; i++) assert_vec3_near(diffuse_of(&l, i), diffuse_of(&alone, 0), 0, "default");
    unload(&l);
    unload(&alone);
    load_good(&l, "scene: [{sphere: {}}, {box: {}}, {sphere: {}, material: {}}, {box: {}}]");
    const struct primitive_info *info = l.scene.primitives.info;
    assert_int_equal(l.scene.material_count, 2);
    assert_int_equal(info[0].material, info[1].material);
    assert_int_equal(info[0].material, info[3].material);
    assert_int_not_equal(info[0].material, info[2].material);
    unload(&l);
}

static void an_alias_of_a_named_material_is_like_it(void **state) {
    (void)state;
    struct loaded l;
    load_good(&l,
              "materials: {red: &r {diffuse: red}, also: *r}\n"
              "scene: [{sphere: {}, material: *r}, {box: {}, material: red}, {cone: {}, material: also}]");
    const struct primitive_info *info = l.scene.primitives.info;
    assert_int_not_equal(info[1].material, info[2].material);
    for (uint32_t i = 0; i < 3; i++) assert_vec3_near(diffuse_of(&l, i), (vec3){1, 0, 0}, 0, "diffuse");
    unload(&l);
}

static void materials_have_all_their_values(void **state) {
    (void)state;
    struct loaded l;
    load_good(&l, "scene: [{sphere: {}, material: {ambient: [0.1, 0, 0], diffuse: [0, 0.2, 0], specular: [0, "
                  "0, 0.3], shininess: 7, "
                  "reflection: [0.4, 0, 0], refraction: 0.5, index: 1.5}}]");
    const struct material *m = &l.scene.materials[0];
    assert_vec3_near(m->ambient, (vec3){0.1, 0, 0}, 0, "ambient");
    assert_vec3_near(m->diffuse, (vec3){0, 0.2, 0}, 0, "diffuse");
    assert_vec3_near(m->specular, (vec3){0, 0, 0.3}, 0, "specular");
    assert_vec3_near(m->reflection, (vec3){0.4, 0, 0}, 0, "reflection");
    assert_vec3_near(m->refraction, vec3_all(0.5), 0, "refraction");
    assert_true(m->shininess == 7 && m->index == 1.5);
    unload(&l);
}

/* ---- Settings ---- */

static void settings_are_as_written(void **state) {
    (void)state;
    struct loaded l;
    load_good(
        &l,
        "image: {size: [7, 9], samples: 3, bits: 16, encoding: linear, background: [0.1, 0.2, 0.3]}\n"
        "render: {shading: signature, depth: 6, shadow: 0.5, two_sided: false, highlight: always}\n"
        "camera: {eye: [1, 2, 3], look_at: [4, 5, 6], up: [0, 0, 1], projection: orthographic, height: 8}\n"
        "lights: [{point: {at: [1, 2, 3], color: [4, 5, 6]}}, {ambient: {color: gray}}]\nscene: [{sphere: "
        "{}}]\n");
    const struct monge_settings *s = &l.scene.settings;
    const struct camera *c = &l.scene.camera;
    assert_int_equal(s->width, 7);
    assert_int_equal(s->height, 9);
    assert_int_equal(s->samples, 3);
    assert_int_equal(s->bits, 16);
    assert_int_equal(s->encoding, MONGE_ENCODING_LINEAR);
    assert_int_equal(s->shading, MONGE_SHADING_SIGNATURE);
    assert_int_equal(s->depth, 6);
    assert_true(s->shadow == 0.5 && !l.scene.two_sided && l.scene.highlight_always);
    assert_vec3_near(l.scene.background.top, (vec3){0.1, 0.2, 0.3}, 0, "background");
    assert_vec3_near(l.scene.background.bottom, (vec3){0.1, 0.2, 0.3}, 0, "background");
    assert_true(c->has_eye && c->has_look_at && c->has_up && c->has_height && !c->has_direction);
    assert_int_equal(c->projection, CAMERA_ORTHOGRAPHIC);
    assert_vec3_near(c->eye, (vec3){1, 2, 3}, 0, "eye");
    assert_vec3_near(c->look_at, (vec3){4, 5, 6}, 0, "look_at");
    assert_vec3_near(c->up, (vec3){0, 0, 1}, 0, "up");
    assert_true(c->height == 8);
    assert_int_equal(l.scene.light_count, 2);
    assert_false(l.scene.default_lights);
    assert_int_equal(l.scene.lights[0].kind, LIGHT_POINT);
    assert_vec3_near(l.scene.lights[0].at, (vec3){1, 2, 3}, 0, "at");
    assert_vec3_near(l.scene.lights[0].color, (vec3){4, 5, 6}, 0, "colour");
    assert_int_equal(l.scene.lights[1].kind, LIGHT_AMBIENT);
    assert_vec3_near(l.scene.lights[1].color, vec3_all(0.21586050011389926), 1e-15, "grey");
    unload(&l);
}

static void a_background_of_two_colours(void **state) {
    (void)state;
    struct loaded l;
    load_good(&l, "image: {background: {bottom: red, top: blue}}\nscene: [{sphere: {}}]\n");
    assert_vec3_near(l.scene.background.bottom, (vec3){1, 0, 0}, 0, "bottom");
    assert_vec3_near(l.scene.background.top, (vec3){0, 0, 1}, 0, "top");
    unload(&l);
}

/* What grammar/language.yaml says is the default, read by itself. */
static const char *grammar_default(const struct node *root, const char *kind, const char *key) {
    const char *const path[] = {"kinds", kind, "keys", key, "default"};
    for (size_t i = 0; i < COUNT(path); i++) {
        const struct node *child = root->first;
        while (child && strcmp(child->text, path[i]) != 0) child = child->next->next;
        if (!child) fail_msg("grammar/language.yaml has no %s of %s of %s", path[i], key, kind);
        root = child->next;
    }
    return root->kind == NODE_SEQUENCE ? root->first->text : root->text;
}

static void defaults_are_those_of_the_grammar(void **state) {
    (void)state;
    struct loaded l;
    struct arena arena = {0};
    struct diagnostics diag = {0};
    struct node_problem problem = {0};
    const struct node_limits limits = {50, 100000};
    const struct source *source = file_read(&arena, &diag, "grammar/language.yaml", 1000000);
    assert_non_null(source);
    const struct node *root = node_parse(&arena, &diag, source, &limits, NULL, &problem);
    load_good(&l, "scene: [{sphere: {}, material: {}}]");
    const struct monge_settings *s = &l.scene.settings;
    const struct material *m = &l.scene.materials[0];
    const struct number_row {
        const char *kind, *key;
        double got;
    } numbers[] = {
        {"image", "size", s->width},
        {"image", "samples", s->samples},
        {"image", "bits", s->bits},
        {"render", "depth", s->depth},
        {"render", "shadow", s->shadow},
        {"camera", "fov", l.scene.camera.fov_deg},
        {"material", "ambient", m->ambient.x},
        {"material", "specular", m->specular.y},
        {"material", "shininess", m->shininess},
        {"material", "reflection", m->reflection.z},
        {"material", "refraction", m->refraction.x},
        {"material", "index", m->index},
        {"sphere", "radius", l.scene.primitives.spheres[0].radius},
        {"sphere", "center", l.scene.primitives.spheres[0].center.x},
    };
    for (size_t i = 0; i < COUNT(numbers); i++)
        assert_near(numbers[i].got, strtod(grammar_default(root, numbers[i].kind, numbers[i].key), NULL), 0,
                    numbers[i].key);
    const struct word_row {
        const char *kind, *key, *got;
    } words[] = {
        {"image", "encoding", s->encoding == MONGE_ENCODING_SRGB ? "srgb" : "linear"},
        {"render", "shading",
         s->shading == MONGE_SHADING_PHONG     ? "phong"
         : s->shading == MONGE_SHADING_DIFFUSE ? "diffuse"
                                               : "signature"},
        {"render", "two_sided", l.scene.two_sided ? "true" : "false"},
        {"render", "highlight", l.scene.highlight_always ? "always" : "lit"},
        {"camera", "projection",
         l.scene.camera.projection == CAMERA_PERSPECTIVE ? "perspective" : "orthographic"},
    };
    for (size_t i = 0; i < COUNT(words); i++)
        assert_string_equal(words[i].got, grammar_default(root, words[i].kind, words[i].key));
    assert_true(l.scene.default_lights && l.scene.light_count == 0);
    assert_false(l.scene.camera.has_eye || l.scene.camera.has_look_at || l.scene.camera.has_up ||
                 l.scene.camera.has_height);
    assert_vec3_near(l.scene.camera.up, (vec3){0, 1, 0}, 0, "up");

    unload(&l);
    arena_free(&arena);
    diag_free(&diag);
}

static void empty_mappings_change_nothing(void **state) {
    (void)state;
    struct loaded a, b;
    load_good(&a, "scene: [{sphere: {}, material: {}}]");
    load_good(&b, "image: {}\nrender: {}\ncamera: {}\nmaterials: {}\nscene: [{sphere: {}, material: {}, "
                  "transform: []}]");
    const struct monge_settings *s = &a.scene.settings, *t = &b.scene.settings;
    const double x[] = {s->width,    s->height,  s->samples, s->bits,
                        s->encoding, s->shading, s->depth,   s->shadow};
    const double y[] = {t->width,    t->height,  t->samples, t->bits,
                        t->encoding, t->shading, t->depth,   t->shadow};
    assert_memory_equal(x, y, sizeof x);
    struct hash ha, hb;
    hash_begin(&ha);
    hash_begin(&hb);
    scene_hash(&a.scene, &ha);
    scene_hash(&b.scene, &hb);
    assert_memory_equal(&ha, &hb, sizeof ha);
    unload(&a);
    unload(&b);
}

/* ---- What is wrong with a scene, and what is odd ---- */

static struct verdict {
    const char *name, *text;
    unsigned errors, warnings;
} verdicts[] = {
    {"verdict: a flat scale", "scene: [{sphere: {}, transform: {scale: [1, 0, 1]}}]", 1, 0},
    {"verdict: a flat step and a flat group",
     "scene: [{group: [{sphere: {}, transform: {scale: 0}}], transform: [{scale: 0}, {shear: {xy: 1, yx: "
     "1}}]}]",
     3, 0},
    {"verdict: flat only together",
     "scene: [{group: [{sphere: {}, transform: {scale: 1e-60}}], transform: {scale: 1e-60}}]", 1, 0},
    {"verdict: out of all bounds together",
     "scene: [{group: [{group: [{sphere: {}, transform: {scale: 1e90}}], transform: {scale: 1e90}}, {sphere: "
     "{}, transform: {translate: [1e90, 0, 0]}}], transform: {scale: 1e90}}]",
     2, 0},
    {"verdict: infinite times zero",
     "scene: [{group: [{group: [{group: [{group: [{sphere: {}, transform: {translate: [1e90, 0, 0]}}], "
     "transform: {scale: [1e90, 1, 1]}}], transform: {scale: [1e90, 1, 1]}}], transform: {scale: [1e90, 1, "
     "1]}}], transform: {rotate: {z: 90}}}]",
     1, 0},
    {"verdict: look_at is eye", "camera: {eye: [1, 2, 3], look_at: [1, 2, 3]}\nscene: [{sphere: {}}]", 1, 0},
    {"verdict: up along the view",
     "camera: {eye: [0, 0, 5], look_at: [0, 0, 0], up: [0, 0, 2]}\nscene: [{sphere: {}}]", 1, 0},
    {"verdict: up against the view", "camera: {direction: [0, 0, -1], up: [0, 0, 2]}\nscene: [{sphere: {}}]",
     1, 0},
    {"verdict: a view straight down needs no up", "camera: {direction: [0, -1, 0]}\nscene: [{sphere: {}}]", 0,
     0},
    {"verdict: height in perspective", "camera: {height: 3}\nscene: [{sphere: {}}]", 1, 0},
    {"verdict: fov in an orthographic view",
     "camera: {projection: orthographic, fov: 30}\nscene: [{sphere: {}}]", 1, 0},
    {"verdict: too many pixels", "image: {size: [65535, 65535]}\nscene: [{sphere: {}}]", 1, 0},
    {"verdict: reflection and refraction over 1",
     "scene: [{sphere: {}, material: {reflection: 0.6, refraction: 0.6}}]", 1, 0},
    {"verdict: in a named material",
     "materials: {m: {reflection: 0.6, refraction: [0, 0, 0.6]}}\nscene: [{sphere: {}, material: m}]", 1, 0},
    {"verdict: together 1", "scene: [{sphere: {}, material: {reflection: 0.9, refraction: 0.1}}]", 0, 0},
    {"verdict: a box without an inside", "scene: [{box: {min: [0, 0, 0], max: [1, 1, 0]}}]", 1, 0},
    {"verdict: bounds without an inside",
     "scene: [{quadric: {xx: 1}, bounds: {min: [1, 0, 0], max: [0, 1, 1]}}]", 1, 0},
    {"verdict: bounds of a sphere", "scene: [{sphere: {}, bounds: {min: [-1, -1, -1], max: [1, 1, 1]}}]", 1,
     0},
    {"verdict: bounds of a group",
     "scene: [{group: [{sphere: {}}], bounds: {min: [-1, -1, -1], max: [1, 1, 1]}}]", 1, 0},
    {"verdict: a cylinder without a length", "scene: [{cylinder: {from: [1, 1, 1], to: [1, 1, 1]}}]", 1, 0},
    {"verdict: an empty quadric", "scene: [{quadric: {constant: 1}}]", 1, 0},
    {"verdict: radians",
     "scene: [{sphere: {}, transform: [{rotate: {x: 1.5708}}, {rotate: {axis: [1, 0, 0], angle: -3.1416}}]}]",
     0, 2},
    {"verdict: degrees",
     "scene: [{sphere: {}, transform: [{rotate: {x: 1.5}}, {rotate: {x: 3}}, {rotate: {x: 90}}]}]", 0, 0},
    {"verdict: no objects", "scene: []", 0, 1},
    {"verdict: no objects but groups", "scene: [{group: []}]", 0, 1},
    {"verdict: no light", "lights: []\nscene: [{sphere: {}}]", 0, 1},
    {"verdict: no light, unlit", "lights: []\nrender: {shading: signature}\nscene: [{sphere: {}}]", 0, 0},
    {"verdict: no light but mirrors", "lights: []\nscene: [{sphere: {}, material: {reflection: 1}}]", 0, 0},
    {"verdict: black lights",
     "lights: [{point: {at: [0, 5, 0], color: black}}, {ambient: {color: black}}]\nscene: [{sphere: {}}]", 0,
     1},
    {"verdict: ambient light that nothing gives back",
     "lights: [{ambient: {}}]\nscene: [{sphere: {}, material: {diffuse: red}}]", 0, 1},
    {"verdict: ambient light that something gives back",
     "lights: [{ambient: {}}]\nscene: [{sphere: {}, material: {diffuse: red}}, {box: {}, material: {ambient: "
     "red}}]",
     0, 0},
    {"verdict: no warning beside an error", "lights: []\nscene: [{sphere: {r: 1}}]", 1, 0},
    {"verdict: errors of lang and of scene in one run",
     "scene: [{sphere: {radius: x}}, {box: {}, transform: {scale: 0}}]", 2, 0},
};

static void check_verdict(void **state) {
    const struct verdict *row = *state;
    struct loaded l;
    load_text(&l, row->text);
    if (l.diag.errors != row->errors || l.diag.warnings != row->warnings) {
        diag_print(&l.diag, stdout);
        fail_msg("%u errors and %u warnings", l.diag.errors, l.diag.warnings);
    }
    assert_int_equal(l.ok, row->errors == 0);
    unload(&l);
}

static void errors_of_an_earlier_scene_do_not_stop_this_one(void **state) {
    (void)state;
    struct loaded l = {0};
    diag_error(&l.diag, (struct span){0}, "code", "of another file");
    load_after(&l, "scene: [{sphere: {}}]");
    assert_true(l.ok);
    unload(&l);
}

/* As if a scene had as many of each kind as there may be already. */
static void one_more_than_may_be_of_a_kind(void **state) {
    (void)state;
    static const char text[] = "define: {row: {objects: [{for: {i: 20}, sphere: {center: [i, 0, 0]}}]}}\n"
                               "scene: [{sphere: {}}, {square: {}}, {cone: {}}, {use: row}]";
    struct loaded l = {0};
    struct lang_sink sink;
    struct builder *builder = scene_begin(&l.arena, &l.diag, &l.scene, &sink);
    struct primitives *p = &builder->set->primitives;
    p->sphere_count = p->flat_count = p->quadric_count = p->instance_count = PRIMITIVE_MAX - 1;
    const struct lang_input input = loading_input(&l.memory, text, &sink);
    assert_non_null(lang_read(&l.memory, &l.diag, &input).file);
    assert_int_equal(l.diag.errors, 4);
    for (const struct diagnostic *d = l.diag.first; d; d = d->next) {
        assert_string_equal(d->code, "limit-objects");
        assert_string_equal(d->message, "more than 1073741823 primitives of one kind");
        assert_int_equal(d->place.line, 2);
    }
    assert_int_equal(p->count, 0);
    assert_true(p->sphere_count == PRIMITIVE_MAX - 1 && p->flat_count == PRIMITIVE_MAX - 1 &&
                p->quadric_count == PRIMITIVE_MAX - 1 && p->instance_count == PRIMITIVE_MAX - 1);
    unload(&l);
}

/* ---- The hash ---- */

static const char *const hash_base =
    "image: {background: {bottom: '#111', top: '#222'}}\n"
    "camera: {eye: [0, 0, 5], look_at: [0, 0, 1], up: [0, 1, 0], fov: 40}\n"
    "render: {two_sided: true, highlight: lit}\n"
    "lights: [{ambient: {color: '#333'}}, {point: {at: [1, 2, 3], color: '#444'}}]\n"
    "materials:\n"
    "  gold: {ambient: '#111', diffuse: gold, specular: '#eee', shininess: 8, reflection: 0.2, refraction: "
    "0.1, index: 1.5}\n"
    "  jade: {diffuse: green}\n"
    "scene:\n"
    "  - {sphere: {center: [1, 2, 3], radius: 0.5}, material: gold}\n"
    "  - {disc: {center: [1, 2, 4], radius: 0.25}, material: jade}\n"
    "  - {cylinder: {from: [3, 3, 3], to: [4, 4, 4], open: false}, material: gold, transform: {scale: [1, 2, "
    "3]}}\n"
    "  - {quadric: {xx: 1, constant: -1}, bounds: {min: [-1, -1, -1], max: [1, 1, 1]}, material: jade}\n";

/* One replacement in the text above. */
static struct change {
    const char *from, *to;
    bool same;
} changes[] = {
    {"bottom: '#111'", "bottom: '#112'", false},
    {"top: '#222'", "top: '#223'", false},
    {"eye: [0, 0, 5]", "eye: [0, 0, 6]", false},
    {"look_at: [0, 0, 1]", "look_at: [0, 1, 1]", false},
    {"look_at: [0, 0, 1]", "direction: [0, 0, -1]", false},
    {"up: [0, 1, 0]", "up: [1, 1, 0]", false},
    {"fov: 40", "fov: 41", false},
    {"fov: 40", "projection: orthographic", false},
    {"two_sided: true", "two_sided: false", false},
    {"highlight: lit", "highlight: always", false},
    {"color: '#333'", "color: '#334'", false},
    {"at: [1, 2, 3]", "at: [1, 2, 4]", false},
    {"color: '#444'", "color: '#443'", false},
    {"lights: [{ambient: {color: '#333'}}, {point: {at: [1, 2, 3], color: '#444'}}]", "lights: []", false},
    {"lights: [{ambient: {color: '#333'}}, {point: {at: [1, 2, 3], color: '#444'}}]", "", false},
    {"lights: [", "lights: [{ambient: {color: black}}, ", false},
    {"ambient: '#111'", "ambient: '#112'", false},
    {"diffuse: gold", "diffuse: yellow", false},
    {"specular: '#eee'", "specular: '#eef'", false},
    {"shininess: 8", "shininess: 9", false},
    {"reflection: 0.2", "reflection: 0.25", false},
    {"refraction: 0.1", "refraction: 0.2", false},
    {"index: 1.5", "index: 1.4", false},
    {"center: [1, 2, 3]", "center: [1, 2, 3.5]", false},
    {"radius: 0.5", "radius: 0.75", false},
    {"radius: 0.25", "radius: 0.5", false},
    {"disc:", "sphere:", false},
    {"disc: {center: [1, 2, 4], radius: 0.25}", "square: {center: [1, 2, 4]}", false},
    {"from: [3, 3, 3]", "from: [3, 3, 2]", false},
    {"open: false", "open: true", false},
    {"scale: [1, 2, 3]", "scale: [1, 3, 2]", false},
    {"xx: 1", "yy: 1", false},
    {"constant: -1", "constant: -2", false},
    {"min: [-1, -1, -1]", "min: [-2, -1, -1]", false},
    {"max: [1, 1, 1]", "max: [1, 2, 1]", false},
    {"bounds: {min: [-1, -1, -1], max: [1, 1, 1]}, ", "", false},
    {"radius: 0.5}, material: gold", "radius: 0.5}, material: jade", false},
    {"radius: 0.5}, material: gold", "radius: 0.5}", false},
    {"constant: -1}", "constant: -1, open: true}", false},
    {"- {sphere: {center: [1, 2, 3], radius: 0.5}, material: gold}", "", false},

    {"render:", "# a comment\nrender:", true},
    {"fov: 40", "fov:   40.0", true},
    {"fov: 40", "fov: 4e1", true},
    {"eye: [0, 0, 5]", "eye: [-0, 0.0, 5]", true},
    {"two_sided: true, highlight: lit", "highlight: lit, two_sided: true", true},
    {"two_sided: true, highlight: lit", "", true},
    {"render: {two_sided: true, highlight: lit}\n", "", true},
    {"diffuse: gold", "diffuse: '#ffd700'", true},
    {"diffuse: green", "diffuse: '#008000'", true},
    {"radius: 0.5}, material: gold", "radius: 0.5}, name: ball, material: gold", true},
    {"materials:\n", "materials:\n  unused: {diffuse: red}\n", true},
    {"  jade: {diffuse: green}\n", "", true /* defined below, see check_change */},
    {"center: [1, 2, 3], radius: 0.5", "radius: 0.5, center: [1, 2, 3]", true},
    {"scene:\n", "scene:\n  - {group: []}\n", true},
    {"  - {sphere: {center: [1, 2, 3], radius: 0.5}, material: gold}\n",
     "  - group: [{sphere: {center: [1, 2, 3], radius: 0.5}}]\n    material: gold\n", true},
    {"camera:", "camera: &c", true},
    {"center: [1, 2, 3]", "center: &x [1, 2, 3]", true},
    {"open: false", "radius: 1", true},
    {"  jade: {diffuse: green}\n", "  jade: {<<: {diffuse: green}}\n", true},
    {"scale: [1, 2, 3]", "matrix: [[1, 0, 0, 0], [0, 2, 0, 0], [0, 0, 3, 0]]", true},
};

static void check_change(void **state) {
    const struct change *row = *state;
    char text[3000];
    const char *at = strstr(hash_base, row->from);
    assert_non_null(at);
    snprintf(text, sizeof text, "%.*s%s%s", (int)(at - hash_base), hash_base, row->to,
             at + strlen(row->from));
    if (strstr(row->from, "jade") && !*row->to) { /* the other order of the materials */
        char *gold = strstr(text, "  gold:");
        memmove(gold + strlen(row->from), gold, strlen(gold) + 1);
        memcpy(gold, row->from, strlen(row->from));
    }
    const struct hash base = load_hash(hash_base), changed = load_hash(text);
    assert_int_equal(memcmp(&base, &changed, sizeof base) == 0, row->same);
}

static struct equal_hash {
    const char *name, *a, *b;
} equal_hashes[] = {
    {"equal hash: an alias and a copy",
     "scene: [{sphere: &s {radius: 2}, material: &m {diffuse: red}}, {sphere: *s, material: *m}]",
     "scene: [{sphere: {radius: 2}, material: {diffuse: red}}, {sphere: {radius: 2}, material: {diffuse: "
     "red}}]"},
    {"equal hash: a name and what it stands for",
     "materials: {red: {diffuse: red}}\nscene: [{sphere: {}, material: red}, {box: {}, material: red}]",
     "scene: [{sphere: {}, material: {diffuse: red}}, {box: {}, material: {diffuse: red}}]"},
    {"equal hash: block and flow", "scene:\n  - sphere:\n      radius: 2\n",
     "{\"scene\": [{\"sphere\": {\"radius\": 2}}]}"},
    {"equal hash: the default written out", "scene: [{sphere: {}}]",
     "scene: [{sphere: {radius: 1, center: [0, 0, 0]}}]"},
};

static void check_equal_hash(void **state) {
    const struct equal_hash *row = *state;
    const struct hash a = load_hash(row->a), b = load_hash(row->b);
    assert_memory_equal(&a, &b, sizeof a);
}

/* ---- Mistakes ---- */

static void what_is_wrong_adds_nothing(void **state) {
    (void)state;
    static const struct {
        const char *object, *code;
    } wrong[] = {
        {"{cylinder: {from: [1, 2, 3], to: [1, 2, 3]}}", "no-length"},
        {"{cone: {from: [1, 2, 3], to: [1, 2, 3]}}", "no-length"},
        {"{paraboloid: {from: [1, 2, 3], to: [1, 2, 3]}}", "no-length"},
        {"{hyperboloid: {from: [1, 2, 3], to: [1, 2, 3]}}", "no-length"},
        {"{box: {min: [0, 0, 0], max: [1, 1, 0]}}", "min-over-max"},
        {"{quadric: {constant: 1}}", "no-surface"},
        {"{quadric: {xx: 1}, bounds: {min: [0, 0, 0], max: [0, 1, 1]}}", "min-over-max"},
        {"{sphere: {}, bounds: {min: [0, 0, 0], max: [1, 1, 1]}}", "bounds-of-no-quadric"},
        {"{sphere: {radius: 1e99}, transform: {scale: 1e99}}", "flat-transform"},
        {"{square: {}, transform: [{scale: 1e99}, {scale: 1e99}]}", "flat-transform"},
        {"{box: {}, transform: [{scale: 1e-99}, {scale: 1e-99}]}", "flat-transform"},
    };
    for (size_t i = 0; i < COUNT(wrong); i++) {
        struct loaded l = {0};
        struct lang_sink sink;
        struct builder *b = scene_begin(&l.arena, &l.diag, &l.scene, &sink);
        char text[200];
        snprintf(text, sizeof text, "scene: [%s]\n", wrong[i].object);
        const struct lang_input input = loading_input(&l.memory, text, &sink);
        lang_read(&l.memory, &l.diag, &input);
        if (l.diag.errors != 1 || strcmp(l.diag.first->code, wrong[i].code) != 0) {
            diag_print(&l.diag, stdout);
            fail_msg("%s: want one error, %s", wrong[i].object, wrong[i].code);
        }
        assert_int_equal(b->set->primitives.count, 0);
        unload(&l);
    }
}

#define ROWS(table, check)                                                                                   \
    for (size_t i = 0; i < COUNT(table); i++) tests[n++] = (struct CMUnitTest) {                             \
            table[i].name, check, NULL, NULL, &table[i]                                                      \
        }

int main(void) {
    struct CMUnitTest tests[COUNT(pairs) + COUNT(revolutions) + COUNT(kinds) + COUNT(material_rows) +
                            COUNT(diffuse_rows) + COUNT(verdicts) + COUNT(changes) + COUNT(equal_hashes)];
    char names[COUNT(changes)][100];
    size_t n = 0;
    ROWS(pairs, check_pair);
    ROWS(revolutions, check_revolution);
    ROWS(kinds, check_kind);
    ROWS(material_rows, check_material);
    ROWS(diffuse_rows, check_diffuse);
    ROWS(verdicts, check_verdict);
    ROWS(equal_hashes, check_equal_hash);
    for (size_t i = 0; i < COUNT(changes); i++) {
        snprintf(names[i], sizeof names[i], "hash: %.30s -> %.30s", changes[i].from, changes[i].to);
        for (char *c = names[i]; *c; c++)
            if (*c == '\n' || *c == '#') *c = ' ';
        tests[n++] = (struct CMUnitTest){names[i], check_change, NULL, NULL, &changes[i]};
    }
    const struct CMUnitTest others[] = {
        cmocka_unit_test(planes_and_discs_face_along_their_normal),
        cmocka_unit_test(numbers_follow_the_file_through_the_kinds),
        cmocka_unit_test(a_quadric_takes_its_coefficients),
        cmocka_unit_test(forms_reach_as_far_as_they_do),
        cmocka_unit_test(a_quadric_is_scaled_by_a_power_of_two),
        cmocka_unit_test(balls_of_any_size_are_spheres),
        cmocka_unit_test(aliases_take_memory_once),
        cmocka_unit_test(one_default_material_serves_all),
        cmocka_unit_test(an_alias_of_a_named_material_is_like_it),
        cmocka_unit_test(materials_have_all_their_values),
        cmocka_unit_test(settings_are_as_written),
        cmocka_unit_test(a_background_of_two_colours),
        cmocka_unit_test(defaults_are_those_of_the_grammar),
        cmocka_unit_test(empty_mappings_change_nothing),
        cmocka_unit_test(errors_of_an_earlier_scene_do_not_stop_this_one),
        cmocka_unit_test(one_more_than_may_be_of_a_kind),
        cmocka_unit_test(what_is_wrong_adds_nothing),
    };
    return cmocka_run_group_tests_name("rows", tests, NULL, NULL) +
           cmocka_run_group_tests_name("scene", others, NULL, NULL);
}
