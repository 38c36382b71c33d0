/* Which texts are scenes, and which are definitions for scenes. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "monge.h"

static struct row {
    const char *name, *text;
    enum monge_text_kind want;
} rows[] = {
    {"a scene", "camera: {fov: 40}\nscene: [{sphere: {}}]\n", MONGE_TEXT_SCENE},
    {"a scene that is wrong", "scne: 1\nscene: 1\n", MONGE_TEXT_SCENE},
    {"a scene as JSON", "{\"params\": {}, \"scene\": [{\"sphere\": {}}]}", MONGE_TEXT_SCENE},
    {"a long list", "scene:\n  - sphere: {}\n  - {box: {}}\nparams: {a: 1}\n", MONGE_TEXT_SCENE},
    {"definitions", "params: {a: 1}\ndefine: {b: {objects: []}}\nmaterials: {}\n", MONGE_TEXT_DEFINITIONS},
    {"an include", "include: [a.yaml]\n", MONGE_TEXT_DEFINITIONS},
    {"a key of no scene", "params: {a: 1}\nmaterial: {}\n", MONGE_TEXT_SCENE},
    {"many scenes", "scenes: [{sphere: {}}]\n", MONGE_TEXT_SCENE},
    {"a capital", "Scene: [{sphere: {}}]\n", MONGE_TEXT_SCENE},
    {"the last letter", "camera: {fov: 40}\nscen: [{sphere: {}}]\n", MONGE_TEXT_SCENE},
    {"letters exchanged", "secne: [{sphere: {}}]\n", MONGE_TEXT_SCENE},
    {"another file", "jobs: {build: {scene: 1}}\nname: test\n", MONGE_TEXT_OTHER},
    {"settings of goldens", "root: ../scenes\nkind: hash\nrules: []\n", MONGE_TEXT_OTHER},
    {"no mapping", "- scene\n", MONGE_TEXT_OTHER},
    {"an empty mapping", "{}\n", MONGE_TEXT_OTHER},
    {"a key that is no text", "? [scene]\n: 1\n", MONGE_TEXT_OTHER},
    {"nothing", "", MONGE_TEXT_EMPTY},
    {"comments alone", "# a scene\n\n  # to be\n", MONGE_TEXT_EMPTY},
    {"no YAML", "scene: [\n", MONGE_TEXT_SCENE},
};

static void check_row(void **state) {
    const struct row *row = *state;
    char text[200];
    strcpy(text, row->text);
    assert_int_equal(monge_text_kind(&(struct monge_text){text, strlen(text)}, NULL), row->want);
}

static void a_limit_leaves_it_to_the_reading(void **state) {
    (void)state;
    char text[] = "jobs: [[[1]]]\n";
    const struct monge_limits limits = {.nesting = 2};
    assert_int_equal(monge_text_kind(&(struct monge_text){text, strlen(text)}, &limits), MONGE_TEXT_SCENE);
}

int main(void) {
    enum { ROWS = sizeof rows / sizeof *rows };
    struct CMUnitTest tests[ROWS + 1];
    for (int i = 0; i < ROWS; i++)
        tests[i] = (struct CMUnitTest){rows[i].name, check_row, NULL, NULL, &rows[i]};
    tests[ROWS] = (struct CMUnitTest)cmocka_unit_test(a_limit_leaves_it_to_the_reading);
    return cmocka_run_group_tests_name("kind", tests, NULL, NULL);
}
