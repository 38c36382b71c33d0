/* Objects go to the sink while the file is read: the order of the file's keys must not matter. */
#include "reading.h"

static struct random dice;

static void shuffle(const char **parts, size_t count) {
    for (size_t i = count - 1; i > 0; i--) {
        const size_t j = random_below(&dice, (unsigned)i + 1);
        const char *part = parts[i];
        parts[i] = parts[j];
        parts[j] = part;
    }
}

/* The parts, in many orders, are read as the same objects and become the same scene. */
static void assert_same_in_every_order(const char **parts, size_t count, int tries) {
    char text[8000], first[8000];
    struct reading r, want;
    struct hash wanted;
    for (int i = 0; i <= tries; i++) {
        text[0] = '\0';
        for (size_t k = 0; k < count; k++) strcat(strcat(text, parts[k]), "\n");
        read_with(&r, text, NULL, NULL);
        const struct hash hash = r.diag.errors == 0 ? load_hash(text) : (struct hash){0};
        if (i == 0) {
            want = r;
            wanted = hash;
            strcpy(first, text);
            shuffle(parts, count);
            continue;
        }
        if (want.diag.errors == 0) assert_read(&r, text, want.text);
        assert_int_equal(r.diag.errors, want.diag.errors);
        assert_int_equal(r.diag.warnings, want.diag.warnings);
        if (memcmp(&hash, &wanted, sizeof hash) != 0) fail_msg("not the same scene:\n%s\n%s", first, text);
        reading_free(&r);
        shuffle(parts, count);
    }
    reading_free(&want);
}

/* ---- Scenes ---- */

static struct order_row {
    const char *name, *parts[8];
} order_rows[] = {
    {"a parameter", {"scene: [{box: {}}, {sphere: {radius: r}}, {cone: {}}]", "params: {r: 2}"}},
    {"a material",
     {"scene: [{box: {}}, {sphere: {}, material: wet}, {cone: {}}]", "materials: {wet: {shininess: 3}}"}},
    {"a template", {"scene: [{box: {}}, {use: u}, {cone: {}}]", "define: {u: {objects: [{sphere: {}}]}}"}},
    {"an animation", {"scene: [{box: {}}, {sphere: {radius: t + 1}}]", "animation: {frames: 24}"}},
    {"keyframes",
     {"scene: [{box: {}}, {sphere: {radius: {keys: {1: 2, 5: 3}}}}]", "animation: {frames: 24}"}},
    {"a group that is half placed",
     {"scene: [{box: {}}, {group: [{cone: {}}, {group: [{disc: {}}, {sphere: {radius: r}}]}, {plane: {}}]}, "
      "{cone: {}}]",
      "params: {r: 2}"}},
    {"a use that is half placed",
     {"scene: [{use: u}, {group: [{use: u}]}]",
      "define: {u: {objects: [{box: {}}, {sphere: {radius: r}}, {sphere: {}, material: wet}]}}",
      "params: {r: 2, k: 3}", "materials: {wet: {extends: dry}, dry: {index: k}}"}},
    {"a loop in the middle of its turns",
     {"scene: [{for: {i: 3}, group: [{box: {}}, {when: i == 2, sphere: {radius: r}}]}]", "params: {r: 2}"}},
    {"a range",
     {"scene: [{for: {i: n, j: {to: n, step: 0.5}}, sphere: {center: [i, j, 0]}}]", "params: {n: 2}"}},
    {"a condition", {"scene: [{when: yes_or_no, sphere: {}}, {box: {}}]", "params: {yes_or_no: false}"}},
    {"a choice", {"scene: [{cone: {open: hollow}}, {box: {}}]", "params: {hollow: true}"}},
    {"an object", {"scene: [{box: {}}, thing, {group: [thing]}]", "params: {thing: {sphere: {}}}"}},
    {"a colour that is a parameter",
     {"scene: [{sphere: {}, material: {diffuse: tint}}]", "params: {tint: other, other: red}"}},
    {"parameters, a template, materials",
     {"params: {n: 2, tint: red}", "materials: {wet: {diffuse: tint}}",
      "define: {u: {params: {m: wet, k: n}, objects: [{for: {i: k}, sphere: {center: [i, 0, 0]}, material: "
      "m}]}}",
      "lights: [{for: {i: n}, point: {at: [i, 2, 3]}}]", "camera: {eye: [n, n, 9]}",
      "scene: [{box: {}, material: wet}, {use: u}, {use: u, with: {k: 3, m: {diffuse: tint}}}]"}},
    {"mistakes",
     {"params: {n: -2}", "materials: {wet: {diffus: red}}",
      "scene: [{sphere: {radius: n}}, {box: {}, material: wet}, {sphere: {raduis: 1}}, {cone: {}, material: "
      "dry}]"}},
    {"a warning", {"params: {n: 2}", "materials: {wet: {}}", "scene: [{sphere: {}}]"}},
};

static void check_order(void **state) {
    const struct order_row *row = *state;
    const char *parts[8];
    size_t count = 0;
    for (; count < COUNT(parts) && row->parts[count]; count++) parts[count] = row->parts[count];
    assert_same_in_every_order(parts, count, count < 3 ? 6 : 20);
}

/* ---- Random scenes ---- */

static const char *number(char text[40], bool positive) {
    static const char *const numbers[] = {
        "1", "2", "a", "b", "a + b", "a * 2", "b / 4", "max(a, b)", "a > b ? 1 : 3"};
    snprintf(text, 40, "'%s%s'", positive ? "" : "3 - ",
             numbers[random_below(&dice, (unsigned)COUNT(numbers))]);
    return text;
}

static void random_object(FILE *out, int depth) {
    static const char *const materials[] = {"wet", "dry", "{diffuse: tint}", "{extends: wet, shininess: 4}",
                                            "{preset: gold}"};
    char one[40], two[40];
    fputc('{', out);
    if (random_below(&dice, 4) == 0)
        fprintf(out, "for: {k%d: %s}, ", depth, random_below(&dice, 2) ? "2" : "[a, b, 7]");
    if (random_below(&dice, 5) == 0) fprintf(out, "when: %s, ", random_below(&dice, 2) ? "a > b" : "b >= a");
    if (random_below(&dice, 3) == 0)
        fprintf(out, "material: %s, ", materials[random_below(&dice, (unsigned)COUNT(materials))]);
    if (random_below(&dice, 3) == 0)
        fprintf(out, "transform: {translate: [%s, 0, %s]}, ", number(one, false), number(two, false));
    const unsigned kind = random_below(&dice, depth > 0 ? 5 : 3);
    if (kind == 0)
        fprintf(out, "sphere: {radius: %s}", number(one, true));
    else if (kind == 1)
        fprintf(out, "box: {}");
    else if (kind == 2)
        fprintf(out, "cone: {to: [0, %s, 5]}", number(one, false));
    else if (kind == 3)
        fprintf(out, "use: %s, with: {r: %s}", random_below(&dice, 2) ? "u" : "v", number(one, true));
    else {
        fputs("group: [", out);
        for (unsigned i = 1 + random_below(&dice, 3); i > 0; i--) {
            random_object(out, depth - 1);
            if (i > 1) fputs(", ", out);
        }
        fputc(']', out);
    }
    fputc('}', out);
}

static void random_scenes(void **state) {
    (void)state;
    for (int i = 0; i < 60; i++) {
        char *scene = NULL;
        size_t size = 0;
        FILE *out = open_memstream(&scene, &size);
        fputs("scene: [{sphere: {}, material: wet}, {box: {}, material: dry}, {use: u}, {use: v}", out);
        for (unsigned k = 1 + random_below(&dice, 5); k > 0; k--) {
            fputs(", ", out);
            random_object(out, 3);
        }
        fputs("]", out);
        fclose(out);
        const char *parts[] = {
            scene,
            "params: {a: b - 1, b: 3, tint: hsv(a * 40, 1, 1)}",
            "materials: {wet: {diffuse: tint, shininess: a}, dry: {extends: wet, index: 1 + b / 10}}",
            "define: {u: {params: {r: a}, objects: [{sphere: {radius: r}}, {when: r > 0.5, use: v, with: {r: "
            "r / 2}, transform: {translate: [r, 0, 0]}}]},\n"
            "         v: {params: {r: b, s: r * 2}, objects: [{box: {max: [r, s, 1]}}, {for: {q: 20}, "
            "sphere: {center: [q, r, s], radius: b}}]}}",
            "camera: {eye: [a, b, 20]}",
            "lights: [{point: {at: [a, 5, b]}}]"};
        assert_same_in_every_order(parts, COUNT(parts), 6);
        free(scene);
    }
}

/* ---- Anchors in items that are gone ---- */

static void anchors_outlive_their_items(void **state) {
    (void)state;
    static const struct {
        const char *text, *want;
    } texts[] = {
        {"scene:\n- sphere: &s {radius: 2}\n- box: {}\n- sphere: *s\n",
         "sphere{radius:2} box{} sphere{radius:2}"},
        {"scene:\n- &a {sphere: {radius: 1 + 1}}\n- box: {}\n- {cone: {}}\n- *a\n- group: [*a]\n",
         "sphere{radius:2} box{} cone{} sphere{radius:2} group( sphere{radius:2} )"},
        {"scene:\n- sphere: {}\n  material: &m {diffuse: red}\n- box: {}\n- disc: {}\n  material: "
         "*m\nmaterials: {red_one: *m}\n",
         "material:{diffuse:[1,0,0]} sphere{} box{} material:{diffuse:[1,0,0]} disc{}"},
        {"scene:\n- {sphere: {}, transform: &t [{scale: 2}, {rotate: {x: 45 * 2}}]}\n- box: {}\n- {cone: {}, "
         "transform: *t}\n",
         "transform:{scale:[2,2,2]}{rotate:{x:90}} sphere{} box{} transform:{scale:[2,2,2]}{rotate:{x:90}} "
         "cone{}"},
        {"scene:\n- {when: &w 1 > 2, sphere: {}}\n- box: {}\n- {when: *w, cone: {}}\n- {when: \"1 < 2\", "
         "disc: {}}\n",
         "box{} disc{}"},
        {"define: {u: {params: {m: 0}, objects: [{sphere: {}}]}}\nscene:\n- {use: u, with: {m: &m "
         "{shininess: 1 + 2}}}\n- {box: {}, material: *m}\n"
         "- {cone: {from: [1, 2, 3 * 4], to: [5 + 6 + 7, 8 * 9, 10]}}\n- {disc: {}, material: *m}\n",
         "use( sphere{} ) material:{shininess:3} box{} cone{from:[1,2,12],to:[18,72,10]} "
         "material:{shininess:3} disc{}"},
        {"scene:\n- &a {sphere: {radius: r}}\n- box: {}\n- *a\nparams: {r: 3}\n",
         "sphere{radius:3} box{} sphere{radius:3}"},
    };
    for (size_t i = 0; i < COUNT(texts); i++) {
        struct reading r;
        read_with(&r, texts[i].text, NULL, NULL);
        assert_read(&r, texts[i].text, texts[i].want);
        reading_free(&r);
    }
}

static void forget(void *context, const struct object_value *object) {
    (void)context;
    (void)object;
}

/* A long list need not be in memory as a whole. */
static void items_that_are_placed_leave_nothing(void **state) {
    (void)state;
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    fputs("params: {r: 2}\nmaterials: {wet: {}}\nscene:\n", out);
    for (int i = 0; i < 20000; i++)
        fprintf(out, "- {sphere: {radius: r * %d, center: [1, 2, r]}, material: wet}\n", i + 1);
    fclose(out);
    struct lang_memory memory = {0};
    struct diagnostics diag = {0};
    struct collected none = {0};
    struct lang_sink sink = collecting_sink(&none);
    sink.shape = forget;
    const struct lang_input input = loading_input(&memory, text, &sink);
    const size_t before = memory.nodes.total;
    assert_non_null(lang_read(&memory, &diag, &input).file);
    assert_int_equal(diag.errors, 0);
    assert_true(memory.nodes.total - before < 600000);
    lang_memory_free(&memory);
    diag_free(&diag);
    free(text);
}

int main(void) {
    struct CMUnitTest tests[COUNT(order_rows)];
    for (size_t i = 0; i < COUNT(order_rows); i++)
        tests[i] = (struct CMUnitTest){order_rows[i].name, check_order, NULL, NULL, &order_rows[i]};
    const struct CMUnitTest others[] = {
        cmocka_unit_test(random_scenes),
        cmocka_unit_test(anchors_outlive_their_items),
        cmocka_unit_test(items_that_are_placed_leave_nothing),
    };
    dice = random_begin();
    return cmocka_run_group_tests_name("orders", tests, NULL, NULL) +
           cmocka_run_group_tests_name("streaming", others, NULL, NULL);
}
