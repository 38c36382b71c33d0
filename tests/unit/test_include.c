/* Files that a scene includes, in a folder of their own. */
#include <errno.h>
#include <sys/stat.h>
#include <unistd.h>

#include "reading.h"

struct folder {
    char path[64];
    const char *untrusted; /* NULL: not */
};

static void write_file(const struct folder *folder, const char *name, const char *text) {
    char path[200];
    snprintf(path, sizeof path, "%s/%s", folder->path, name);
    FILE *out = fopen(path, "w");
    assert_non_null(out);
    fputs(text, out);
    fclose(out);
}

static int set_up(void **state) {
    static struct folder folder;
    strcpy(folder.path, "/tmp/monge-include-XXXXXX");
    if (!mkdtemp(folder.path)) return -1;
    char path[200];
    snprintf(path, sizeof path, "%s/scenes", folder.path);
    mkdir(path, 0700);
    snprintf(path, sizeof path, "%s/scenes/parts", folder.path);
    mkdir(path, 0700);
    *state = &folder;
    return 0;
}

static int tear_down(void **state) {
    char command[200];
    snprintf(command, sizeof command, "rm -rf '%s'", ((struct folder *)*state)->path);
    return system(command);
}

static void place_in_folder(struct lang_input *input, const void *context) {
    const struct folder *folder = context;
    static char path[200];
    snprintf(path, sizeof path, "%s/scenes/scene.yaml", folder->path);
    input->path = path;
    input->untrusted = folder->untrusted != NULL;
}

static void read_in(struct reading *r, const struct folder *folder, const char *text) {
    read_with(r, text, place_in_folder, folder);
}

static void paths_are_relative_to_the_file_that_names_them(void **state) {
    const struct folder *folder = *state;
    struct reading r;
    const char *text = "include: [parts/one.yaml, ../outer.yaml]\nscene: [{sphere: {radius: a}}, {sphere: "
                       "{radius: b}}, {use: u}]";
    write_file(folder, "scenes/parts/one.yaml", "include: two.yaml\nparams: {a: b + 1}\n");
    write_file(folder, "scenes/parts/two.yaml", "params: {b: 2}\n");
    write_file(folder, "outer.yaml",
               "define: {u: {objects: [{box: {}, material: wet}]}}\nmaterials: {wet: {shininess: 3}}\n");
    read_in(&r, folder, text);
    assert_read(&r, text, "sphere{radius:3} sphere{radius:2} use( material:wet box{} )");
    reading_free(&r);
}

static void a_path_may_begin_with_a_slash(void **state) {
    const struct folder *folder = *state;
    struct reading r;
    char text[200];
    write_file(folder, "outer.yaml", "params: {b: 2}\n");
    snprintf(text, sizeof text, "include: %s/outer.yaml\nscene: [{sphere: {radius: b}}]", folder->path);
    read_in(&r, folder, text);
    assert_read(&r, text, "sphere{radius:2}");
    reading_free(&r);
}

static void the_same_file_is_read_once(void **state) {
    const struct folder *folder = *state;
    struct reading r;
    const char *text =
        "include: [left.yaml, right.yaml, base.yaml, parts/../base.yaml]\nscene: [{sphere: {radius: l + r}}]";
    write_file(folder, "scenes/base.yaml", "params: {b: 2}\n");
    write_file(folder, "scenes/left.yaml", "include: base.yaml\nparams: {l: b}\n");
    write_file(folder, "scenes/right.yaml", "include: [base.yaml]\nparams: {r: b * 2}\n");
    read_in(&r, folder, text);
    assert_read(&r, text, "sphere{radius:6}");
    reading_free(&r);
}

static void an_include_may_come_after_the_scene(void **state) {
    const struct folder *folder = *state;
    struct reading r;
    const char *text = "scene: [{box: {}}, {sphere: {radius: b}}]\ninclude: base.yaml\n";
    write_file(folder, "scenes/base.yaml", "params: {b: 2}\n");
    read_in(&r, folder, text);
    assert_read(&r, text, "box{} sphere{radius:2}");
    reading_free(&r);
}

static void the_scene_of_an_included_file_is_not_placed(void **state) {
    const struct folder *folder = *state;
    struct reading r;
    const char *text = "include: base.yaml\nscene: [{sphere: {radius: b}}]\n";
    write_file(folder, "scenes/base.yaml",
               "params: {b: 2}\nscene: [{box: {}}, {sphere: {radius: 1 / (b - 2)}}]\nanimation: {frames: "
               "3}\nimage: {samples: 3}\n");
    read_in(&r, folder, text);
    assert_read(&r, text, "sphere{radius:2}");
    assert_int_equal(r.result.frames, 0);
    assert_false(object_has(r.result.file, KEY_FILE_IMAGE));
    reading_free(&r);
}

static void what_an_included_file_does_not_use_is_no_warning(void **state) {
    const struct folder *folder = *state;
    struct reading r;
    write_file(folder, "scenes/base.yaml",
               "params: {b: 2, c: 3}\nmaterials: {wet: {}}\ndefine: {u: {objects: []}}\n");
    read_in(&r, folder, "include: base.yaml\nscene: [{sphere: {radius: b}}]\n");
    assert_int_equal(r.diag.errors + r.diag.warnings, 0);
    reading_free(&r);
}

static void a_define_sets_an_included_parameter(void **state) {
    const struct folder *folder = *state;
    struct lang_memory memory = {0};
    struct diagnostics diag = {0};
    struct collected objects = {0};
    const struct lang_sink sink = collecting_sink(&objects);
    const struct lang_define define = {"b", "7"};
    write_file(folder, "scenes/base.yaml", "params: {b: 2}\n");
    struct lang_input input =
        loading_input(&memory, "include: base.yaml\nscene: [{sphere: {radius: b}}]\n", &sink);
    place_in_folder(&input, folder);
    input.defines = &define;
    input.define_count = 1;
    lang_read(&memory, &diag, &input);
    assert_int_equal(diag.errors, 0);
    assert_true(object_number(object_object(objects.items[0], KEY_OBJECT_SPHERE), KEY_SPHERE_RADIUS) == 7.0);
    lang_memory_free(&memory);
    arena_free(&objects.arena);
    diag_free(&diag);
}

static void untrusted_scenes_stay_in_their_folder(void **state) {
    struct folder folder = *(struct folder *)*state;
    struct reading r;
    char absolute[300], link[200], outside[200];
    folder.untrusted = "yes";
    write_file(&folder, "outer.yaml", "params: {b: 2}\n");
    write_file(&folder, "scenes/parts/inner.yaml", "params: {b: 3}\n");
    snprintf(outside, sizeof outside, "%s/outer.yaml", folder.path);
    snprintf(link, sizeof link, "%s/scenes/link.yaml", folder.path);
    assert_int_equal(symlink(outside, link), 0);
    snprintf(absolute, sizeof absolute, "include: %s\nscene: [{sphere: {radius: b}}]", outside);
    const char *const wrong[] = {"include: ../outer.yaml\nscene: [{sphere: {}}]",
                                 "include: parts/../../outer.yaml\nscene: [{sphere: {}}]",
                                 "include: link.yaml\nscene: [{sphere: {}}]",
                                 "include: /etc/passwd\nscene: [{sphere: {}}]", absolute};
    for (size_t i = 0; i < COUNT(wrong); i++) {
        read_in(&r, &folder, wrong[i]);
        assert_error(&r, "include-outside", "is not in the folder of the scene");
        reading_free(&r);
    }
    const char *text = "include: [parts/inner.yaml]\nscene: [{sphere: {radius: b}}]";
    read_in(&r, &folder, text);
    assert_read(&r, text, "sphere{radius:3}");
    reading_free(&r);
    folder.untrusted = NULL;
    read_in(&r, &folder, absolute);
    assert_read(&r, absolute, "sphere{radius:2}");
    reading_free(&r);
    unlink(link);
}

static void what_cannot_be_read_says_nothing_of_its_names(void **state) {
    const struct folder *folder = *state;
    struct reading r;
    read_in(&r, folder, "include: nowhere.yaml\nscene: [{sphere: {radius: b * 2}, material: wet}, {use: u}]");
    assert_error(&r, "include-missing", "nowhere.yaml");
    assert_int_equal(r.diag.errors, 1);
    reading_free(&r);
}

static void a_chain_of_includes_has_an_end(void **state) {
    const struct folder *folder = *state;
    struct reading r;
    char name[40], text[80];
    for (int i = 0; i < 120; i++) {
        snprintf(name, sizeof name, "scenes/parts/c%d.yaml", i);
        snprintf(text, sizeof text, "include: c%d.yaml\n", i + 1);
        write_file(folder, name, i < 119 ? text : "params: {b: 2}\n");
    }
    read_in(&r, folder, "include: parts/c0.yaml\nscene: [{sphere: {}}]");
    assert_error(&r, "limit-recursion", "recursion");
    assert_int_equal(r.diag.errors, 1);
    reading_free(&r);
    read_in(&r, folder, "include: parts/c60.yaml\nscene: [{sphere: {radius: b}}]");
    assert_read(&r, "60 files", "sphere{radius:2}");
    reading_free(&r);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(paths_are_relative_to_the_file_that_names_them),
        cmocka_unit_test(a_path_may_begin_with_a_slash),
        cmocka_unit_test(the_same_file_is_read_once),
        cmocka_unit_test(an_include_may_come_after_the_scene),
        cmocka_unit_test(the_scene_of_an_included_file_is_not_placed),
        cmocka_unit_test(what_an_included_file_does_not_use_is_no_warning),
        cmocka_unit_test(a_define_sets_an_included_parameter),
        cmocka_unit_test(untrusted_scenes_stay_in_their_folder),
        cmocka_unit_test(what_cannot_be_read_says_nothing_of_its_names),
        cmocka_unit_test(a_chain_of_includes_has_an_end),
    };
    return cmocka_run_group_tests_name("include", tests, set_up, tear_down);
}
