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

static void check_define(void **state) {
    (void)state;
    static const struct monge_define width = {"widht", "2"};
    static const char text[] = "params: {width: 1}\nscene: [{sphere: {radius: width}}]";
    struct monge_diagnostics *diag = monge_diagnostics_new();
    assert_null(monge_load_memory("a", text, strlen(text),
                                  &(struct monge_load_options){.defines = &width, .define_count = 1}, diag));
    const char *json = document(diag, MONGE_FORMAT_JSON);
    assert_non_null(strstr(json, CODE("unknown-parameter")));
    assert_non_null(strstr(json, "did you mean `width`?"));
    assert_non_null(strstr(json, "\"severity\": \"error\""));
    monge_diagnostics_free(diag);
}

static void check_untrusted(void **state) {
    (void)state;
    static const char text[] = "include: ../../dev/null\nscene: [{sphere: {}}]";
    struct monge_diagnostics *diag = monge_diagnostics_new();
    assert_null(monge_load_memory("/usr/bin/a.yaml", text, strlen(text),
                                  &(struct monge_load_options){.untrusted = true}, diag));
    assert_non_null(strstr(document(diag, MONGE_FORMAT_JSON), CODE("include-outside")));
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

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(check_memory_limit), cmocka_unit_test(check_file_limit),
        cmocka_unit_test(check_define),       cmocka_unit_test(check_untrusted),
        cmocka_unit_test(check_loads),        cmocka_unit_test(check_text),
        cmocka_unit_test(check_codes),        cmocka_unit_test(check_explain),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
