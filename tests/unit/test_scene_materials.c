/* The material of each primitive: its own, that of a group around it or the default, and its values. */
#include "loading.h"

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

int main(void) {
    struct CMUnitTest tests[COUNT(material_rows) + COUNT(diffuse_rows) + 3];
    size_t n = 0;
    for (size_t i = 0; i < COUNT(material_rows); i++)
        tests[n++] =
            (struct CMUnitTest){material_rows[i].name, check_material, NULL, NULL, &material_rows[i]};
    for (size_t i = 0; i < COUNT(diffuse_rows); i++)
        tests[n++] = (struct CMUnitTest){diffuse_rows[i].name, check_diffuse, NULL, NULL, &diffuse_rows[i]};
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(one_default_material_serves_all);
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(an_alias_of_a_named_material_is_like_it);
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(materials_have_all_their_values);
    return cmocka_run_group_tests_name("materials of scenes", tests, NULL, NULL);
}
