/* Whatever a scene asks for, reading it ends: with an error that names the limit. */
#include "reading.h"

static const struct lang_limits small = {
    .file_bytes = 1 << 20, .nesting = 20, .values = 1000, .recursion = 10, .steps = 1000, .objects = 50};

static void set_small(struct lang_input *input, const void *context) {
    (void)context;
    input->limits = small;
}

static struct row {
    const char *name, *text, *limit; /* NULL: just within */
} rows[] = {
    {"a template without end", "define: {u: {objects: [{use: u}]}}\nscene: [{use: u}]", "recursion"},
    {"a template without end, in a group",
     "define: {u: {objects: [{group: [{sphere: {}}, {use: u}]}]}}\nscene: [{use: u}]", "recursion"},
    {"two templates without end",
     "define: {u: {objects: [{use: v}]}, v: {objects: [{use: u}]}}\nscene: [{use: u}]", "recursion"},
    {"a template without end, many times",
     "define: {u: {params: {n: 0}, objects: [{for: {i: 9}, use: u, with: {n: n + i}}]}}\nscene: [{use: u}]",
     "recursion"},
    {"the last use that may be",
     "define: {u: {params: {n: 1}, objects: [{sphere: {}}, {when: n < 10, use: u, with: {n: n + "
     "1}}]}}\nscene: [{use: u}]",
     NULL},
    {"one more",
     "define: {u: {params: {n: 1}, objects: [{sphere: {}}, {when: n < 11, use: u, with: {n: n + "
     "1}}]}}\nscene: [{use: u}]",
     "recursion"},
    {"an object that holds itself", "params: {a: [a], b: {group: b}}\nscene: [a, b]", "recursion"},
    {"parameters after parameters",
     "params: {a: b, b: c, c: d, d: e, e: f, f: g, g: h, h: i, i: j, j: k, k: l, l: 1}\nscene: [{sphere: "
     "{radius: a}}]",
     "recursion"},
    {"materials after materials",
     "materials: {a: {extends: b}, b: {extends: c}, c: {extends: d}, d: {extends: e}, e: {extends: f}, f: "
     "{extends: g}, g: {extends: h},\n"
     " h: {extends: i}, i: {extends: j}, j: {extends: k}, k: {extends: l}, l: {}}\nscene: [{sphere: {}, "
     "material: a}]",
     "recursion"},
    {"a long loop", "scene: [{for: {i: 1001}, when: 0, sphere: {}}]", "steps"},
    {"the longest loop", "scene: [{for: {i: 998}, when: 0, sphere: {}}]", NULL},
    {"a loop of 1e300 turns", "scene: [{for: {i: 1e300}, sphere: {}}]", "steps"},
    {"loops within loops", "scene: [{for: {i: 100, j: 100, k: 100}, when: 0, sphere: {}}]", "steps"},
    {"empty loops within loops", "scene: [{for: {i: 900, j: 900, k: 0}, sphere: {}}]", "steps"},
    {"loops of groups", "scene: [{for: {i: 100}, group: [{for: {i: 100}, when: 0, sphere: {}}]}]", "steps"},
    {"a loop of lights", "lights: [{for: {i: 1001}, ambient: {}}]\nscene: []", "steps"},
    {"loops of lights", "lights: [{for: {i: 100, j: 100}, ambient: {}}]\nscene: []", "steps"},
    {"many objects", "scene: [{for: {i: 51}, sphere: {}}]", "objects"},
    {"as many objects as may be", "scene: [{for: {i: 50}, sphere: {}}]", NULL},
    {"objects that were taken back do not count",
     "scene: [{group: [{for: {i: 30}, sphere: {}}, {sphere: {radius: r}}]}]\nparams: {r: 1}", NULL},
    {"nor do their steps",
     "scene: [{group: [{for: {i: 600}, when: 0, sphere: {}}, {sphere: {radius: r}}]}]\nparams: {r: 1}", NULL},
    {"laughs by templates",
     "define:\n  a: {objects: [{sphere: {}}]}\n  b: {objects: [{use: a}, {use: a}, {use: a}, {use: a}]}\n  "
     "c: {objects: [{use: b}, {use: b}, {use: b}, {use: b}]}\n"
     "  d: {objects: [{use: c}, {use: c}, {use: c}, {use: c}]}\nscene: [{use: d}]",
     "objects"},
    {"empty laughs by templates",
     "define:\n  a: {objects: []}\n  b: {objects: [{for: {i: 20}, use: a}]}\n  c: {objects: [{for: {i: 20}, "
     "use: b}]}\n  d: {objects: [{for: {i: 20}, use: c}]}\nscene: [{use: d}]",
     "steps"},
    {"laughs by objects",
     "params: {a: [{sphere: {}}, {sphere: {}}], b: [{group: a}, {group: a}], c: [{group: b}, {group: b}], d: "
     "[{group: c}, {group: c}], e: [{group: d}, {group: d}], f: [{group: e}, {group: e}]}\nscene: [{group: "
     "f}]",
     "objects"},
    {"laughs by aliases",
     "a: &a [1, 1, 1, 1, 1]\nb: &b [*a, *a, *a, *a, *a]\nc: &c [*b, *b, *b, *b, *b]\nd: &d [*c, *c, *c, *c, "
     "*c]\nscene: []",
     "values"},
    {"laughs by groups and aliases",
     "scene:\n- group: &a [{sphere: {}}, {sphere: {}}, {sphere: {}}, {sphere: {}}]\n- group: &b [{group: "
     "*a}, {group: *a}, {group: *a}, {group: *a}]\n- group: [{group: *b}, {group: *b}, {group: *b}]",
     "objects"},
    {"many values", NULL, "values"},
    {"deep groups", NULL, "nesting"},
};

static char *text_of(const struct row *row) {
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (row->text)
        fputs(row->text, out);
    else if (strcmp(row->limit, "values") == 0)
        for (int i = 0; i < 1001; i++)
            fprintf(out, "%s%s", i ? "- {when: false, sphere: {}}" : "scene:", "\n");
    else
        for (int i = 0; i < 30; i++) fprintf(out, "%s{group: [", i ? "" : "scene: [");
    fclose(out);
    return text;
}

static void check_row(void **state) {
    const struct row *row = *state;
    struct reading r;
    char *text = text_of(row), code[40], words[40];
    read_with(&r, text, set_small, NULL);
    if (row->limit) {
        snprintf(code, sizeof code, "limit-%s", row->limit);
        snprintf(words, sizeof words, "(the limit `%s`)", row->limit);
        assert_error(&r, code, words);
        assert_int_equal(r.diag.errors, 1);
        assert_true(r.memory.nodes.total < 4 << 20);
    } else if (r.diag.errors) {
        diag_print(&r.diag, stdout);
        fail_msg("%u errors", r.diag.errors);
    }
    reading_free(&r);
    free(text);
}

int main(void) {
    struct CMUnitTest tests[COUNT(rows)];
    for (size_t i = 0; i < COUNT(rows); i++)
        tests[i] = (struct CMUnitTest){rows[i].name, check_row, NULL, NULL, &rows[i]};
    return cmocka_run_group_tests_name("limits", tests, NULL, NULL);
}
