/* From a text to primitives: which they are, and texts that must give the same. */
#include "loading.h"

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

int main(void) {
    struct CMUnitTest tests[COUNT(pairs) + COUNT(kinds) + 3];
    size_t n = 0;
    for (size_t i = 0; i < COUNT(pairs); i++)
        tests[n++] = (struct CMUnitTest){pairs[i].name, check_pair, NULL, NULL, &pairs[i]};
    for (size_t i = 0; i < COUNT(kinds); i++)
        tests[n++] = (struct CMUnitTest){kinds[i].name, check_kind, NULL, NULL, &kinds[i]};
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(numbers_follow_the_file_through_the_kinds);
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(balls_of_any_size_are_spheres);
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(aliases_take_memory_once);
    return cmocka_run_group_tests_name("primitives of scenes", tests, NULL, NULL);
}
