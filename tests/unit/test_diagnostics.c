/* What the library tells programs of a load: several loads in one document, limits, the stories of codes. */
#include <stdlib.h>
#include <string.h>

#include "monge.h"
#include "near.h"

#define CODE(code) "\"code\": \"" code "\""

static const struct monge_load_options small = {.limits = {.file_bytes = 10000, .memory_bytes = 800000}};

/* Valid until the next call. */
static const char *document(const struct monge_diagnostics *diag, enum monge_format format) {
    static char text[1 << 16];
    FILE *out = fmemopen(text, sizeof text, "w");
    monge_diagnostics_write(diag, format, out);
    fclose(out);
    return text;
}

static unsigned occurrences(const char *text, const char *word) {
    unsigned count = 0;
    for (const char *at = strstr(text, word); at; at = strstr(at + 1, word)) count++;
    return count;
}

static struct monge_scene *load(const char *name, const char *text, struct monge_diagnostics *diag) {
    return monge_load_memory(name, text, strlen(text), &small, diag);
}

/* ---- Limits are failures with a code ---- */

static void check_memory_limit(void **state) {
    (void)state;
    enum { OBJECTS = 14000 };
    static const char start[] = "scene:\n", object[] = "- sphere: {}\n";
    char text[OBJECTS * sizeof object + sizeof start], *at = stpcpy(text, start);
    for (int i = 0; i < OBJECTS; i++) at = stpcpy(at, object);
    struct monge_diagnostics *diag = monge_diagnostics_new();
    assert_null(load("big", text, diag));
    const char *json = document(diag, MONGE_FORMAT_JSON);
    assert_non_null(strstr(json, "\"severity\": \"failure\""));
    assert_non_null(strstr(json, CODE("limit-memory")));
    monge_diagnostics_free(diag);
}

static void check_file_limit(void **state) {
    (void)state;
    struct monge_diagnostics *diag = monge_diagnostics_new();
    assert_null(monge_load_file("/dev/zero", &small, diag));
    assert_non_null(strstr(document(diag, MONGE_FORMAT_JSON), CODE("limit-file-bytes")));
    monge_diagnostics_free(diag);
}

/* ---- What no scene by itself gives ---- */

static const struct monge_define width = {"widht", "2"};

static struct row {
    const char *name, *text;
    struct monge_load_options options;
    const char *said;
} rows[] = {
    {"a parameter from outside",
     "params: {width: 1}\nscene: [{sphere: {radius: width}}]",
     {.defines = &width, .define_count = 1},
     "/usr/bin/a.yaml:1:1: error[unknown-parameter]: the scene has no parameter `widht` to set by -D\n"
     "    1 | params: {width: 1}\n"
     "      | ^ did you mean `width`?\n"
     "      = its parameters: width\n"},
    {"a parameter of none",
     "scene: [{sphere: {}}]",
     {.defines = &width, .define_count = 1},
     "/usr/bin/a.yaml:1:1: error[unknown-parameter]: the scene has no parameter `widht` to set by -D\n"
     "    1 | scene: [{sphere: {}}]\n"
     "      | ^\n"
     "      = it has none: `params: {widht: 1}` makes one\n"},
    {"a file outside of the folder",
     "include: ../../dev/null\nscene: [{sphere: {}}]",
     {.untrusted = true},
     "/usr/bin/a.yaml:1:10: error[include-outside]: `../../dev/null` is not in the folder of the scene\n"
     "    1 | include: ../../dev/null\n"
     "      |          ^~~~~~~~~~~~~~ without `--untrusted` it may be included\n"},
    {"too many turns of loops",
     "scene:\n  - for: {i: 3, j: 3}\n    sphere: {}\n",
     {.limits.steps = 5},
     "/usr/bin/a.yaml:2:5: error[limit-steps]: more than 5 objects and turns of loops (the limit `steps`)\n"
     "    2 |   - for: {i: 3, j: 3}\n"
     "      |     ^ `--limit steps=N` allows more\n"
     "/usr/bin/a.yaml:2:10: note: in the turn i = 1, j = 0\n"
     "    2 |   - for: {i: 3, j: 3}\n"
     "      |          ^\n"},
    {"too many shapes",
     "scene:\n  - sphere: {}\n  - box: {}\n",
     {.limits.objects = 1},
     "/usr/bin/a.yaml:3:5: error[limit-objects]: more than 1 shapes (the limit `objects`)\n"
     "    3 |   - box: {}\n"
     "      |     ^ `--limit objects=N` allows more\n"},
};

static void check_row(void **state) {
    const struct row *row = *state;
    struct monge_diagnostics *diag = monge_diagnostics_new();
    assert_null(monge_load_memory("/usr/bin/a.yaml", row->text, strlen(row->text), &row->options, diag));
    assert_string_equal(document(diag, MONGE_FORMAT_TEXT), row->said);
    assert_int_equal(monge_diagnostics_errors(diag), 1);
    monge_diagnostics_free(diag);
}

/* ---- Several loads ---- */

static void check_loads(void **state) {
    (void)state;
    const char *wrong = "scene: [{sphere: {raduis: 1}}]";
    struct monge_diagnostics *diag = monge_diagnostics_new();
    assert_null(load("a", wrong, diag));
    assert_null(load("b", wrong, diag));
    assert_null(load("a", wrong, diag)); /* as wrong as the first time */
    struct monge_scene *scene = load("c", "scene: [{sphere: {}}]", diag);
    assert_non_null(scene);
    assert_int_equal(monge_diagnostics_errors(diag), 3);
    assert_int_equal(occurrences(document(diag, MONGE_FORMAT_JSON), CODE("unknown-key")), 3);
    const char *sarif = document(diag, MONGE_FORMAT_SARIF);
    assert_int_equal(occurrences(sarif, "\"ruleId\": \"unknown-key\""), 3);
    assert_int_equal(occurrences(sarif, "\"id\": \"unknown-key\""), 1);
    monge_scene_free(scene);
    monge_diagnostics_free(diag);
}

static void check_text(void **state) {
    (void)state;
    struct monge_diagnostics *diag = monge_diagnostics_new();
    assert_null(load("a", "scene: [{sphere: {raduis: 1}}]", diag));
    assert_int_equal(strncmp(document(diag, MONGE_FORMAT_TEXT), "a:1:19: error[unknown-key]: ", 28), 0);
    monge_diagnostics_free(diag);
}

/* ---- Stories ---- */

static void check_codes(void **state) {
    (void)state;
    size_t count = 0;
    for (; monge_code(count); count++) {
        assert_non_null(monge_code_summary(count));
        if (count > 0) assert_true(strcmp(monge_code(count - 1), monge_code(count)) < 0);
    }
    assert_true(count > 50);
    assert_null(monge_code_summary(count));
}

static void check_explain(void **state) {
    (void)state;
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    assert_false(monge_explain("unknown", out));
    fflush(out);
    assert_int_equal(size, 0);
    assert_true(monge_explain("second-document", out));
    fclose(out);
    assert_int_equal(
        strncmp(text, "second-document (error)\n\nThere is a second document in the file.\n\n", 66), 0);
    assert_non_null(strstr(text, "\nwrong:\n\n    scene: [{sphere: {}}]\n    ---\n    scene: [{cylinder: "
                                 "{}}]\n\nright:\n\n    scene: "));
    for (const char *line = text; line; line = strchr(line, '\n') ? strchr(line, '\n') + 1 : NULL)
        assert_true(strcspn(line, "\n") <= 80);
    free(text);
}

/* ---- What a program adds, and what went wrong first ---- */

static void check_added(void **state) {
    (void)state;
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_problem first;
    monge_diagnostics_warn(diag, "cannot-write", "no room for notes");
    assert_false(monge_diagnostics_take(diag, &first)); /* a warning is no problem */
    monge_diagnostics_fail(diag, "no-match", "x*.yaml: no file matches");
    monge_diagnostics_fail(diag, "cannot-write", "cannot write x.png");
    assert_string_equal(document(diag, MONGE_FORMAT_TEXT),
                        "monge: warning[cannot-write]: no room for notes\n"
                        "monge: error[no-match]: x*.yaml: no file matches\n"
                        "monge: error[cannot-write]: cannot write x.png\n");
    assert_int_equal(monge_diagnostics_failures(diag), 2);
    assert_true(monge_diagnostics_take(diag, &first));
    assert_string_equal(first.code, "no-match");
    assert_string_equal(first.message, "x*.yaml: no file matches");
    assert_null(first.file);
    assert_false(monge_diagnostics_take(diag, &first)); /* nothing new */
    monge_diagnostics_free(diag);
}

/* Of a scene that is loaded again with other values, what is told again is kept once; but it has gone wrong again. */
static void check_again(void **state) {
    (void)state;
    static const char wrong[] = "params: {a: 1}\nscene: [{sphere: {raduis: a}}]";
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_problem first;
    for (int i = 0; i < 3; i++) {
        const struct monge_load_options options = {.again = i == 1};
        assert_null(monge_load_memory("a.yaml", wrong, sizeof wrong - 1, &options, diag));
        assert_int_equal(monge_diagnostics_errors(diag), i + 1);
        assert_true(monge_diagnostics_take(diag, &first));
        assert_string_equal(first.code, "unknown-key");
        assert_string_equal(first.file, "a.yaml");
        assert_int_equal(first.line, 2);
        assert_int_equal(first.column, 19);
    }
    assert_int_equal(occurrences(document(diag, MONGE_FORMAT_JSON), CODE("unknown-key")), 2);
    monge_diagnostics_free(diag);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(check_memory_limit), cmocka_unit_test(check_file_limit),
        cmocka_unit_test(check_loads),        cmocka_unit_test(check_text),
        cmocka_unit_test(check_codes),        cmocka_unit_test(check_explain),
        cmocka_unit_test(check_added),        cmocka_unit_test(check_again),
    };
    struct CMUnitTest texts[COUNT(rows)];
    for (size_t i = 0; i < COUNT(rows); i++)
        texts[i] = (struct CMUnitTest){rows[i].name, check_row, NULL, NULL, &rows[i]};
    return cmocka_run_group_tests_name("library", tests, NULL, NULL) +
           cmocka_run_group_tests_name("texts", texts, NULL, NULL);
}
