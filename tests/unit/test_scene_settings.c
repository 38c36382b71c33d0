/* The settings of the picture, the camera and the lights: as written, and their defaults. */
#include "loading.h"

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

static void check_default_numbers(const struct node *root, const struct scene *scene) {
    const struct monge_settings *s = &scene->settings;
    const struct material *m = &scene->materials[0];
    const struct {
        const char *kind, *key;
        double got;
    } numbers[] = {
        {"image", "size", s->width},
        {"image", "samples", s->samples},
        {"image", "bits", s->bits},
        {"render", "depth", s->depth},
        {"render", "shadow", s->shadow},
        {"camera", "fov", scene->camera.fov_deg},
        {"material", "ambient", m->ambient.x},
        {"material", "specular", m->specular.y},
        {"material", "shininess", m->shininess},
        {"material", "reflection", m->reflection.z},
        {"material", "refraction", m->refraction.x},
        {"material", "index", m->index},
        {"sphere", "radius", scene->primitives.spheres[0].radius},
        {"sphere", "center", scene->primitives.spheres[0].center.x},
    };
    for (size_t i = 0; i < COUNT(numbers); i++)
        assert_near(numbers[i].got, strtod(grammar_default(root, numbers[i].kind, numbers[i].key), NULL), 0,
                    numbers[i].key);
}

static void check_default_words(const struct node *root, const struct scene *scene) {
    static const char *const shadings[] = {[MONGE_SHADING_PHONG] = "phong",
                                           [MONGE_SHADING_DIFFUSE] = "diffuse",
                                           [MONGE_SHADING_SIGNATURE] = "signature"};
    const struct monge_settings *s = &scene->settings;
    const struct {
        const char *kind, *key, *got;
    } words[] = {
        {"image", "encoding", s->encoding == MONGE_ENCODING_SRGB ? "srgb" : "linear"},
        {"render", "shading", shadings[s->shading]},
        {"render", "two_sided", scene->two_sided ? "true" : "false"},
        {"render", "highlight", scene->highlight_always ? "always" : "lit"},
        {"camera", "projection",
         scene->camera.projection == CAMERA_PERSPECTIVE ? "perspective" : "orthographic"},
    };
    for (size_t i = 0; i < COUNT(words); i++)
        assert_string_equal(words[i].got, grammar_default(root, words[i].kind, words[i].key));
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
    check_default_numbers(root, &l.scene);
    check_default_words(root, &l.scene);
    const struct camera *c = &l.scene.camera;
    assert_true(l.scene.default_lights && l.scene.light_count == 0);
    assert_false(c->has_eye || c->has_look_at || c->has_up || c->has_height);
    assert_vec3_near(c->up, (vec3){0, 1, 0}, 0, "up");
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

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(settings_are_as_written),
        cmocka_unit_test(a_background_of_two_colours),
        cmocka_unit_test(defaults_are_those_of_the_grammar),
        cmocka_unit_test(empty_mappings_change_nothing),
    };
    return cmocka_run_group_tests_name("settings of scenes", tests, NULL, NULL);
}
