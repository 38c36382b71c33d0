/* golden.yaml, the tolerance of a scene, and documents as they stand. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "monge.h"
#include "near.h"

static char path[] = "/tmp/monge-goldens.XXXXXX";

static int make_file(void **state) {
    (void)state;
    const int fd = mkstemp(path);
    return fd >= 0 ? close(fd) : -1;
}

static int remove_file(void **state) {
    (void)state;
    return unlink(path);
}

static void write_text(const char *text) {
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

/* NULL: it is wrong, with one error of that code and words. */
static struct monge_goldens *read_goldens(const char *text, const char *code, const char *words) {
    struct monge_diagnostics *diag = monge_diagnostics_new();
    write_text(text);
    struct monge_goldens *goldens = monge_goldens_read(path, NULL, diag);
    char *said = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&said, &size);
    monge_diagnostics_print(diag, out);
    fclose(out);
    if (!code != !!goldens || (code && (!strstr(said, code) || !strstr(said, words)))) fail_msg("%s", said);
    assert_int_equal(monge_diagnostics_errors(diag), code ? 1 : 0);
    free(said);
    monge_diagnostics_free(diag);
    return goldens;
}

static void all_of_a_file(void **state) {
    (void)state;
    struct monge_goldens *g = read_goldens("root: ../s\nkind: both\nrules:\n"
                                           "  - {scenes: a, options: --size 3x3, aov: true, kind: hash}\n"
                                           "  - scenes: [b*, c]\n"
                                           "    tolerance: {pixels: 0.5%, flip: 1/4, reason: because}\n"
                                           "  - {scenes: d, tolerance: {pixels: 12, max: 0.1, reason: r}}\n",
                                           NULL, NULL);
    assert_string_equal(g->root, "../s");
    assert_int_equal(g->kind, MONGE_GOLDEN_BOTH);
    assert_int_equal(g->count, 3);
    assert_string_equal(g->rules[0].scenes[0], "a");
    assert_null(g->rules[0].scenes[1]);
    assert_string_equal(g->rules[0].options, "--size 3x3");
    assert_true(g->rules[0].aov);
    assert_int_equal(g->rules[0].kind, MONGE_GOLDEN_HASH);
    assert_int_equal(g->rules[1].kind, MONGE_GOLDEN_BOTH);
    assert_null(g->rules[0].tolerance);
    assert_int_equal(g->rules[0].line, 4);
    assert_string_equal(g->rules[1].scenes[1], "c");
    assert_string_equal(g->rules[1].options, "");
    const struct monge_tolerance *t = g->rules[1].tolerance;
    assert_string_equal(t->reason, "because");
    assert_true(t->percent);
    assert_near(t->pixels, 0.5, 1e-12, "a bound");
    assert_near(t->flip, 0.25, 0, "a bound");
    assert_near(t->max, 0, 0, "a bound");
    assert_true(isnan(t->ssim) && isnan(t->mae) && isnan(t->rmse) && isnan(t->psnr));
    t = g->rules[2].tolerance;
    assert_true(!t->percent && t->pixels == 12 && t->max == 0.1);
    monge_goldens_free(g);
}

static void what_is_left_out(void **state) {
    (void)state;
    struct monge_goldens *g = read_goldens("rules: {scenes: '*'}\n", NULL, NULL);
    assert_null(g->root);
    assert_int_equal(g->kind, MONGE_GOLDEN_PNG);
    assert_int_equal(g->count, 1);
    assert_false(g->rules[0].aov);
    monge_goldens_free(g);
}

static void one_that_is_empty(void **state) {
    (void)state;
    static const char *const texts[] = {"",    "\n",         "# kind: hash", " \t# a\r\n\n# b\n",
                                        "---", "---\n# a\n", "# a\n---\n"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        struct monge_goldens *g = read_goldens(texts[i], NULL, NULL);
        assert_null(g->root);
        assert_int_equal(g->kind, MONGE_GOLDEN_PNG);
        assert_int_equal(g->count, 0);
        monge_goldens_free(g);
    }
}

static void mistakes(void **state) {
    (void)state;
    static const char *const rows[][3] = {
        {"kidn: png\n", "unknown-key", "did you mean `kind`?"},
        {"kidn: png\n", "unknown-key", "the file golden.yaml has no key `kidn`"},
        {"kind: jpg\n", "not-a-choice", "png, hash or both"},
        {"rules: [{options: --samples 1}]\n", "missing-key", "a rule needs the key `scenes`"},
        {"rules: [{scenes: {a: 1}}]\n", "not-a-text",
         "`scenes`: expected the name of a scene, or a list of names"},
        {"rules: [{scenes: [a, [b]]}]\n", "not-a-text", "expected the name of a scene"},
        {"rules: [{scenes: a, tolerance: {max: 0.1}}]\n", "missing-key", "needs the key `reason`"},
        {"rules: [{scenes: a, tolerance: {reason: r}}]\n", "missing-key", "at least one bound"},
        {"rules: [{scenes: a, tolerance: {max: 2, reason: r}}]\n", "out-of-range", "0 to 1"},
        {"rules: [{scenes: a, tolerance: {pixels: 0.5, reason: r}}]\n", "not-a-number", "found `0.5`"},
        {"rules: [{scenes: a, tolerance: {pixels: 101%, reason: r}}]\n", "out-of-range",
         "must be 100% or less, found `101%`"},
        {"rules: [{scenes: a, tolerance: {pixels: -1, reason: r}}]\n", "not-a-number", "found `-1`"},
        {"- a\n", "not-a-mapping", "the file golden.yaml"},
        {"rules: [\n", "not-yaml", "a value is missing"},
        {"- a\n", "not-a-mapping", "expected"},
        {"--- a\n", "not-a-mapping", "expected"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        assert_null(read_goldens(rows[i][0], rows[i][1], rows[i][2]));
}

static void a_scene_has_a_tolerance(void **state) {
    (void)state;
    struct monge_diagnostics *diag = monge_diagnostics_new();
    static const char text[] = "tolerance: {ssim: 0.9, reason: 'it is so'}\nscene: [{sphere: {}}]\n";
    struct monge_scene *scene = monge_load_memory("a", text, sizeof text - 1, NULL, diag);
    assert_non_null(scene);
    assert_string_equal(monge_scene_tolerance(scene)->reason, "it is so");
    assert_near(monge_scene_tolerance(scene)->ssim, 0.9, 0, "a bound");
    assert_true(isnan(monge_scene_tolerance(scene)->max));
    monge_scene_free(scene);
    scene = monge_load_memory("a", strchr(text, '\n'), sizeof text - 1 - (size_t)(strchr(text, '\n') - text),
                              NULL, diag);
    assert_non_null(scene);
    assert_null(monge_scene_tolerance(scene));
    monge_scene_free(scene);
    monge_diagnostics_free(diag);
}

static void a_document(void **state) {
    (void)state;
    struct monge_diagnostics *diag = monge_diagnostics_new();
    write_text("{\"a\": [\"x\\ny\", {\"b\": null}, []], \"c\": \"null\",\n \"d\": 1.5e3, \"e\": \"\"}\n");
    struct monge_document *document = monge_document_read(path, NULL, diag);
    assert_non_null(document);
    const struct monge_value *root = monge_document_root(document), *a = monge_value_get(root, "a");
    const struct monge_value *item = monge_value_first(a);
    assert_string_equal(monge_value_text(item), "x\ny");
    item = monge_value_next(item);
    assert_null(monge_value_text(item));
    assert_non_null(monge_value_get(item, "b"));
    assert_null(monge_value_text(monge_value_get(item, "b")));
    assert_null(monge_value_get(item, "x"));
    item = monge_value_next(item);
    assert_null(monge_value_first(item));
    assert_null(monge_value_next(item));
    assert_string_equal(monge_value_text(monge_value_get(root, "c")), "null");
    assert_string_equal(monge_value_text(monge_value_get(root, "d")), "1.5e3");
    assert_string_equal(monge_value_text(monge_value_get(root, "e")), "");
    assert_null(monge_value_text(monge_value_get(NULL, "d")));
    assert_null(monge_value_first(root));
    monge_document_free(document);
    write_text("{\"a\": [1, }");
    assert_null(monge_document_read(path, NULL, diag));
    assert_int_equal(monge_diagnostics_errors(diag), 1);
    assert_null(monge_document_read("/tmp/monge-goldens.none", NULL, diag));
    assert_int_equal(monge_diagnostics_failures(diag), 1);
    monge_diagnostics_free(diag);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_of_a_file),           cmocka_unit_test(what_is_left_out),
        cmocka_unit_test(one_that_is_empty),       cmocka_unit_test(mistakes),
        cmocka_unit_test(a_scene_has_a_tolerance), cmocka_unit_test(a_document),
    };
    return cmocka_run_group_tests(tests, make_file, remove_file);
}
