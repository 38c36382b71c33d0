/* What becomes of a text that its formatted form would not say: nothing. No text is known that does this, so
 * the comparison is told to fail. */
#include <string.h>

#include "lang/layout.h"
#include "monge.h"
#include "near.h"

static bool is_same;

bool __wrap_layout_same_events(struct arena *arena, const struct source *a, const struct source *b);
bool __wrap_layout_same_events(struct arena *arena, const struct source *a, const struct source *b) {
    assert_true(arena->on_full && a->size > 0 && b->size > 0);
    return is_same;
}

static void check_mistake(void **state) {
    (void)state;
    static char text[] = "scene: [{sphere:   {}}]\n";
    const struct monge_text given = {text, strlen(text)};
    for (int same = 0; same < 2; same++) {
        char said[400] = "";
        struct monge_text formatted;
        struct monge_diagnostics *diag = monge_diagnostics_new();
        is_same = same;
        assert_int_equal(monge_format("a.yaml", &given, NULL, &formatted, diag), same);
        FILE *out = fmemopen(said, sizeof said, "w");
        monge_diagnostics_write(diag, MONGE_FORMAT_TEXT, out);
        fclose(out);
        assert_string_equal(
            said, same ? ""
                       : "monge: error[format-differs]: a.yaml: a mistake in Monge: the formatted text "
                         "would not say the same; it is left as it is\n");
        assert_true(same ? strcmp(formatted.bytes, "scene: [{sphere: {}}]\n") == 0 : !formatted.bytes);
        monge_text_free(&formatted);
        monge_diagnostics_free(diag);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(check_mistake)};
    return cmocka_run_group_tests_name("format", tests, NULL, NULL);
}
