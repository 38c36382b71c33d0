/* What loops, conditions, variables, templates, presets and keyframes mean, by the objects that come of them. */
#include "reading.h"

#define TEMPLATES                                                                                            \
    "define: {ball: {params: {r: 1, c: [0, 0, 0]}, objects: [{sphere: {radius: r, center: c}}]},\n"          \
    "         both: {params: {a: 1, b: a * 2}, objects: [{sphere: {radius: a}}, {sphere: {radius: b}}]},\n"  \
    "         painted: {params: {m: gold}, objects: [{sphere: {}, material: m}]},\n"                         \
    "         around: {params: {what: []}, objects: [{group: what}]},\n"                                     \
    "         tower: {params: {n: 0}, objects: [{sphere: {radius: n + 1}}, {when: n > 0, use: tower, with: " \
    "{n: n - 1}}]}}\n"

static struct row {
    const char *name, *text, *want;
} rows[] = {
    {"a loop counts from 0", "scene: [{for: {i: 3}, sphere: {radius: i + 1}}]",
     "sphere{radius:1} sphere{radius:2} sphere{radius:3}"},
    {"a loop of no turns", "scene: [{for: {i: 0}, sphere: {radius: i + 1}}, {box: {}}]", "box{}"},
    {"the last of several variables runs fastest",
     "scene: [{for: {i: 2, j: [5, 6]}, sphere: {center: [i, j, 0]}}]",
     "sphere{center:[0,5,0]} sphere{center:[0,6,0]} sphere{center:[1,5,0]} sphere{center:[1,6,0]}"},
    {"a later range sees the variables before it",
     "scene: [{for: {i: 3, j: i}, sphere: {center: [i, j, 0]}}]",
     "sphere{center:[1,0,0]} sphere{center:[2,0,0]} sphere{center:[2,1,0]}"},
    {"a range has both ends", "scene: [{for: {x: {from: 1, to: 3}}, sphere: {radius: x}}]",
     "sphere{radius:1} sphere{radius:2} sphere{radius:3}"},
    {"a range of tenths hits its end",
     "scene: [{for: {x: {from: 0.7, to: 1, step: 0.1}}, sphere: {radius: x}}]",
     "sphere{radius:0.7} sphere{radius:0.8} sphere{radius:0.9} sphere{radius:1}"},
    {"a range of tenths from 0", "scene: [{for: {x: {to: 0.3, step: 0.1}}, sphere: {center: [x, 0, 0]}}]",
     "sphere{center:[0,0,0]} sphere{center:[0.1,0,0]} sphere{center:[0.2,0,0]} sphere{center:[0.3,0,0]}"},
    {"a range that misses its end", "scene: [{for: {x: {from: 1, to: 2, step: 0.4}}, sphere: {radius: x}}]",
     "sphere{radius:1} sphere{radius:1.4} sphere{radius:1.8}"},
    {"a range downwards", "scene: [{for: {x: {from: 3, to: 1, step: -1}}, sphere: {radius: x}}]",
     "sphere{radius:3} sphere{radius:2} sphere{radius:1}"},
    {"a range of one", "scene: [{for: {x: {from: 3, to: 3, step: 9}}, sphere: {radius: x}}]",
     "sphere{radius:3}"},
    {"a range by expressions",
     "params: {n: 2}\nscene: [{for: {x: {from: n - 1, to: n * 2, step: n / 2}}, sphere: {radius: x}}]",
     "sphere{radius:1} sphere{radius:2} sphere{radius:3} sphere{radius:4}"},
    {"a count by an expression", "params: {n: 2}\nscene: [{for: {x: n ^ 2 - 2}, sphere: {radius: x + n}}]",
     "sphere{radius:2} sphere{radius:3}"},
    {"a list of numbers and expressions",
     "params: {n: 2}\nscene: [{for: {x: [1, n, n + 0.5]}, sphere: {radius: x}}]",
     "sphere{radius:1} sphere{radius:2} sphere{radius:2.5}"},
    {"a list of vectors", "scene: [{for: {p: [[1, 2, 3], [4, 5, 6]]}, sphere: {center: p, radius: p.x}}]",
     "sphere{center:[1,2,3],radius:1} sphere{center:[4,5,6],radius:4}"},
    {"a list of colours",
     "scene: [{for: {c: [red, '#00ff00', [0, 0, 1]]}, sphere: {}, material: {diffuse: c}}]",
     "material:{diffuse:[1,0,0]} sphere{} material:{diffuse:[0,1,0]} sphere{} material:{diffuse:[0,0,1]} "
     "sphere{}"},
    {"a list of materials",
     "materials: {wet: {}, dry: {}}\nscene: [{for: {m: [wet, dry, {diffuse: red}]}, sphere: {}, material: "
     "m}]",
     "material:wet sphere{} material:dry sphere{} material:{diffuse:[1,0,0]} sphere{}"},
    {"a list by the name of a parameter",
     "params: {all: [1, 2]}\nscene: [{for: {x: all}, sphere: {radius: x}}]",
     "sphere{radius:1} sphere{radius:2}"},
    {"a list as an argument has the variables of where it is written",
     "define: {row: {params: {all: [9]}, objects: [{for: {x: all}, sphere: {radius: x}}]}}\n"
     "scene: [{for: {k: [2]}, use: row, with: {all: [k, k + 1]}}, {for: {k: [2]}, use: row, with: {all: [1, "
     "2, 3, 4, k * 5]}}, {use: row}]",
     "use( sphere{radius:2} sphere{radius:3} ) use( sphere{radius:1} sphere{radius:2} sphere{radius:3} "
     "sphere{radius:4} sphere{radius:10} ) use( sphere{radius:9} )"},
    {"a list that is computed", "params: {v: '[1, 2, 3] * 2'}\nscene: [{for: {x: v}, sphere: {radius: x}}]",
     "sphere{radius:2} sphere{radius:4} sphere{radius:6}"},
    {"an anchored object is read again with other variables",
     "scene: [{for: {i: [1]}, when: false, sphere: &s {radius: i * 2}}, {for: {i: [2]}, sphere: *s}, {for: "
     "{i: [3]}, sphere: *s}]",
     "sphere{radius:4} sphere{radius:6}"},
    {"a loop in a loop's group",
     "scene: [{for: {i: 2}, group: [{for: {j: i + 1}, sphere: {center: [i, j, 0]}}]}]",
     "group( sphere{center:[0,0,0]} ) group( sphere{center:[1,0,0]} sphere{center:[1,1,0]} )"},
    {"an inner variable hides an outer one",
     "params: {i: 9}\nscene: [{for: {i: 1}, group: [{for: {i: [5]}, sphere: {radius: i}}, {sphere: {radius: "
     "i + 1}}]}, {sphere: {radius: i}}]",
     "group( sphere{radius:5} sphere{radius:1} ) sphere{radius:9}"},

    {"when, in each turn", "scene: [{for: {i: 5}, when: i % 2 == 1, sphere: {radius: i}}]",
     "sphere{radius:1} sphere{radius:3}"},
    {"when, of words",
     "params: {big: false, small: true}\nscene: [{when: big, sphere: {}}, {when: small, box: {}}, {when: "
     "true, disc: {}}, {when: false, plane: {}}]",
     "box{} disc{}"},
    {"when, of a group", "scene: [{when: 0, group: [{sphere: {}}]}, {when: 2, group: [{box: {}}]}]",
     "group( box{} )"},
    {"what does not hold is not evaluated", "scene: [{for: {i: 2}, when: i > 0, sphere: {radius: 1 / i}}]",
     "sphere{radius:1}"},
    {"a light's loop and condition",
     "lights: [{for: {i: 3}, when: i != 1, point: {at: [i, 0, 0]}}]\nscene: []", ""},
    {"a step's expressions",
     "params: {a: 30}\nscene: [{sphere: {}, transform: [{rotate: {z: a}}, {scale: a / 10}, {translate: [a, "
     "-a, 0]}]}]",
     "transform:{rotate:{z:30}}{scale:[3,3,3]}{translate:[30,-30,0]} sphere{}"},

    {"the defaults of a template", TEMPLATES "scene: [{use: ball}]",
     "use( sphere{center:[0,0,0],radius:1} )"},
    {"arguments", TEMPLATES "scene: [{use: ball, with: {r: 2, c: [1, 2, 3]}}]",
     "use( sphere{center:[1,2,3],radius:2} )"},
    {"arguments are evaluated where they are written",
     TEMPLATES "scene: [{for: {r: [3]}, use: ball, with: {r: r * 2}}]",
     "use( sphere{center:[0,0,0],radius:6} )"},
    {"an argument that is a list of expressions",
     TEMPLATES "scene: [{for: {i: [3]}, use: ball, with: {c: [i, i + 1, 0]}}]",
     "use( sphere{center:[3,4,0],radius:1} )"},
    {"a default uses the parameters before it",
     TEMPLATES "scene: [{use: both}, {use: both, with: {a: 5}}, {use: both, with: {b: 7}}]",
     "use( sphere{radius:1} sphere{radius:2} ) use( sphere{radius:5} sphere{radius:10} ) use( "
     "sphere{radius:1} sphere{radius:7} )"},
    {"a default uses the file's parameters",
     "params: {n: 3}\ndefine: {u: {params: {r: n + 1}, objects: [{sphere: {radius: r * n}}]}}\nscene: [{use: "
     "u}]",
     "use( sphere{radius:12} )"},
    {"a template does not see the variables of its caller",
     "params: {n: 3}\ndefine: {u: {objects: [{sphere: {radius: n}}]}}\nscene: [{for: {n: [7]}, use: u}]",
     "use( sphere{radius:3} )"},
    {"a parameter as its own argument's name",
     "params: {r: 3}\n" TEMPLATES "scene: [{use: ball, with: {r: r}}]",
     "use( sphere{center:[0,0,0],radius:3} )"},
    {"a material as an argument",
     "materials: {gold: {}, jade: {}}\n" TEMPLATES
     "scene: [{use: painted}, {use: painted, with: {m: jade}}, {use: painted, with: {m: {diffuse: red}}}]",
     "use( material:gold sphere{} ) use( material:jade sphere{} ) use( material:{diffuse:[1,0,0]} sphere{} "
     ")"},
    {"an object as an argument", TEMPLATES "scene: [{use: around, with: {what: [{box: {}}]}}]",
     "use( group( box{} ) )"},
    {"objects as an argument know the variables of where they are written",
     TEMPLATES "scene: [{for: {n: [4]}, use: around, with: {what: [{sphere: {radius: n}}, {box: {}}]}}]",
     "use( group( sphere{radius:4} box{} ) )"},
    {"an object by the name of a parameter", "params: {thing: {cone: {}}}\nscene: [thing, {group: [thing]}]",
     "cone{} group( cone{} )"},
    {"an argument is handed on",
     TEMPLATES "scene: [{for: {k: [2]}, use: around, with: {what: [{use: ball, with: {r: k}}]}}]",
     "use( group( use( sphere{center:[0,0,0],radius:2} ) ) )"},
    {"a template calls itself under a guard", TEMPLATES "scene: [{use: tower, with: {n: 2}}]",
     "use( sphere{radius:3} use( sphere{radius:2} use( sphere{radius:1} ) ) )"},
    {"a use in a loop with a transform",
     TEMPLATES "scene: [{for: {i: 2}, use: ball, transform: {translate: [i, 0, 0]}}]",
     "transform:{translate:[0,0,0]} use( sphere{center:[0,0,0],radius:1} ) transform:{translate:[1,0,0]} "
     "use( sphere{center:[0,0,0],radius:1} )"},
    {"a parameter with a description",
     "params: {r: {default: 2, min: 1, doc: x}}\nscene: [{sphere: {radius: r}}]", "sphere{radius:2}"},
    {"parameters in any order", "params: {a: b + 1, b: c * 2, c: 3}\nscene: [{sphere: {radius: a}}]",
     "sphere{radius:7}"},
    {"a choice and a boolean by names",
     "params: {hollow: true}\nscene: [{cone: {open: hollow}}, {cone: {open: 1 > 2}}]",
     "cone{open:true} cone{open:false}"},

    {"a preset with keys of its own",
     "scene: [{sphere: {}, material: {preset: matte, shininess: 7, reflection: 0.5}}]", NULL},
    {"extends, over two",
     "materials: {a: {shininess: 1, index: 2}, b: {extends: a, shininess: 3}, c: {extends: b, reflection: "
     "0.5}}\n"
     "scene: [{sphere: {}, material: {extends: c}}, {box: {}, material: {extends: a, index: 3}}]",
     "material:{shininess:3,reflection:[0.5,0.5,0.5],index:2} sphere{} material:{shininess:1,index:3} box{}"},
    {"anchors and merge keys",
     "scene: [{sphere: &s {radius: 2}}, {sphere: *s}, {sphere: {<<: *s, center: [1, 0, 0]}}]",
     "sphere{radius:2} sphere{radius:2} sphere{center:[1,0,0],radius:2}"},
    {"an alias of an expression, in two loops",
     "scene: [{for: {i: [1]}, sphere: &s {radius: i + 1}}, {for: {i: [5]}, sphere: *s}]",
     "sphere{radius:2} sphere{radius:6}"},
};

static void check_row(void **state) {
    const struct row *row = *state;
    struct reading r;
    read_with(&r, row->text, NULL, NULL);
    if (row->want)
        assert_read(&r, row->text, row->want);
    else
        assert_int_equal(r.diag.errors, 0);
    reading_free(&r);
}

static void a_preset_gives_what_is_not_given(void **state) {
    (void)state;
    struct reading own, preset;
    read_with(&preset, "scene: [{sphere: {}, material: {preset: glass}}]", NULL, NULL);
    read_with(&own, "scene: [{sphere: {}, material: {preset: glass, index: 2.25}}]", NULL, NULL);
    assert_int_equal(preset.diag.errors + own.diag.errors, 0);
    assert_non_null(strstr(preset.text, "index:1.5"));
    assert_non_null(strstr(own.text, "index:2.25"));
    const size_t before = (size_t)(strstr(own.text, "index") - own.text);
    assert_memory_equal(preset.text, own.text, before);
    assert_non_null(strstr(own.text, "refraction:"));
    reading_free(&preset);
    reading_free(&own);
}

static void the_parameters_of_a_caller_are_not_those_of_a_template(void **state) {
    (void)state;
    struct reading r;
    read_with(&r, "define: {u: {objects: [{sphere: {radius: i + 1}}]}}\nscene: [{for: {i: 2}, use: u}]", NULL,
              NULL);
    assert_error(&r, "unknown-variable", "`i`");
    assert_int_equal(r.diag.errors, 1);
    reading_free(&r);
}

/* ---- -D ---- */

static struct define_row {
    const char *name, *value, *scene, *want; /* of `-D x=value`; want NULL: an error */
} define_rows[] = {
    {"-D: a number", "2.5", "params: {x: 1}\nscene: [{sphere: {radius: x}}]", "sphere{radius:2.5}"},
    {"-D: a negative one", "-2", "params: {x: 1}\nscene: [{sphere: {center: [x, 0, 0]}}]",
     "sphere{center:[-2,0,0]}"},
    {"-D: an expression", "1 + 2", "params: {x: 1}\nscene: [{sphere: {radius: x}}]", "sphere{radius:3}"},
    {"-D: a vector", "[1, 2, 3]", "params: {x: [0, 0, 0]}\nscene: [{sphere: {center: x}}]",
     "sphere{center:[1,2,3]}"},
    {"-D: a colour", "#ff0000", "params: {x: blue}\nscene: [{sphere: {}, material: {diffuse: x}}]",
     "material:{diffuse:[1,0,0]} sphere{}"},
    {"-D: a colour in quotes", "'#0f0'", "params: {x: blue}\nscene: [{sphere: {}, material: {diffuse: x}}]",
     "material:{diffuse:[0,1,0]} sphere{}"},
    {"-D: a colour by name", "red", "params: {x: blue}\nscene: [{sphere: {}, material: {diffuse: x}}]",
     "material:{diffuse:[1,0,0]} sphere{}"},
    {"-D: a material", "wet",
     "params: {x: dry}\nmaterials: {wet: {}, dry: {}}\nscene: [{sphere: {}, material: x}]",
     "material:wet sphere{}"},
    {"-D: an object", "{box: {}}", "params: {x: {sphere: {}}}\nscene: [x]", "box{}"},
    {"-D: true", "true", "params: {x: false}\nscene: [{when: x, sphere: {}}]", "sphere{}"},
    {"-D: another parameter", "y", "params: {x: 1, y: 5}\nscene: [{sphere: {radius: x}}]",
     "sphere{radius:5}"},
    {"-D: in range", "3", "params: {x: {default: 1, min: 0, max: 3}}\nscene: [{sphere: {radius: x}}]",
     "sphere{radius:3}"},
    {"-D: out of range", "4", "params: {x: {default: 1, min: 0, max: 3}}\nscene: [{sphere: {radius: x}}]",
     NULL},
    {"-D: the default may be out of what is used", "2", "params: {x: 0}\nscene: [{sphere: {radius: x}}]",
     "sphere{radius:2}"},
    {"-D: nothing", "", "params: {x: 1}\nscene: [{sphere: {radius: x}}]", NULL},
    {"-D: no such parameter", "1", "params: {y: 1}\nscene: [{sphere: {radius: y}}]", NULL},
    {"-D: not YAML", "[1", "params: {x: 1}\nscene: [{sphere: {radius: x}}]", NULL},
    {"-D: a template's parameter is another", "5",
     "params: {x: 1}\ndefine: {u: {params: {x: 2}, objects: [{sphere: {radius: x}}]}}\nscene: [{use: u}, "
     "{sphere: {radius: x}}]",
     "use( sphere{radius:2} ) sphere{radius:5}"},
};

static void set_x(struct lang_input *input, const void *context) {
    input->defines = context;
    input->define_count = 2;
}

static void check_define(void **state) {
    const struct define_row *row = *state;
    struct reading r;
    const struct lang_define defines[] = {{"x", "0.001"}, {"x", row->value}}; /* the last counts */
    read_with(&r, row->scene, set_x, defines);
    if (row->want)
        assert_read(&r, row->scene, row->want);
    else
        assert_true(r.diag.errors > 0);
    reading_free(&r);
}

/* ---- Animation ---- */

static struct frame_row {
    const char *name, *value; /* of a radius, in 24 frames of 12 a second */
    unsigned frame;
    const char *want;
    bool still;
} frame_rows[] = {
    {"frame counts from 1", "frame", 7, "7", false},
    {"the first frame is the default", "frame", 0, "1", false},
    {"t is 0 in the first", "t + 1", 1, "1", false},
    {"t in the thirteenth of 24", "t", 13, "0.5", false},
    {"t is under 1 in the last", "24 * t", 24, "23", false},
    {"time is in seconds", "time", 19, "1.5", false},
    {"what does not move", "2", 19, "2", true},
    {"linear, between", "{keys: {4: 1, 12: 3}}", 8, "2", false},
    {"linear, on a frame", "{keys: {4: 1, 12: 3}}", 4, "1", false},
    {"linear, a quarter", "{keys: {4: 1, 12: 3}}", 6, "1.5", false},
    {"before the first", "{keys: {4: 1, 12: 3}}", 2, "1", false},
    {"after the last", "{keys: {4: 1, 12: 3}}", 20, "3", false},
    {"frames in any order", "{keys: {12: 3, 4: 1, 20: 7}}", 16, "5", false},
    {"smooth, a quarter", "{keys: {4: 1, 12: 3}, ease: smooth}", 6, "1.3125", false},
    {"smooth, half", "{keys: {4: 1, 12: 3}, ease: smooth}", 8, "2", false},
    {"step, just before", "{keys: {4: 1, 12: 3}, ease: step}", 11, "1", false},
    {"step, on the frame", "{keys: {4: 1, 12: 3}, ease: step}", 12, "3", false},
    {"one frame alone", "{keys: {4: 1.5}}", 12, "1.5", false},
    {"expressions in keyframes", "{keys: {1: n, n * 10 + 1: n * 4}}", 11, "5", false},
};

static void set_frame(struct lang_input *input, const void *context) {
    input->frame = *(const unsigned *)context;
}

static void check_frame(void **state) {
    const struct frame_row *row = *state;
    struct reading r;
    char text[300], want[60];
    snprintf(text, sizeof text,
             "animation: {frames: 24, fps: 12}\nparams: {n: 2, m: n}\nscene: [{sphere: {radius: %s}}, "
             "{sphere: {radius: m}}]",
             row->value);
    snprintf(want, sizeof want, "sphere{radius:%s} sphere{radius:2}", row->want);
    read_with(&r, text, set_frame, &row->frame);
    assert_read(&r, text, want);
    assert_int_equal(r.result.frames, 24);
    assert_int_equal(r.result.moves, !row->still);
    reading_free(&r);
}

static void vectors_and_colours_move(void **state) {
    (void)state;
    struct reading r;
    const unsigned frame = 3;
    const char *text = "animation: {frames: 4}\nscene: [{sphere: {center: {keys: {1: [0, 0, 0], 5: [4, 8, "
                       "-2]}}}, material: {diffuse: {keys: {1: black, 5: white}}}}]";
    read_with(&r, text, set_frame, &frame);
    assert_read(&r, text, "material:{diffuse:[0.5,0.5,0.5]} sphere{center:[2,4,-1]}");
    reading_free(&r);
}

static void a_camera_that_moves_leaves_the_objects_still(void **state) {
    (void)state;
    struct reading r;
    read_with(&r, "animation: {frames: 4}\ncamera: {eye: [t, 0, 5]}\nscene: [{sphere: {}}]", NULL, NULL);
    assert_int_equal(r.diag.errors, 0);
    assert_false(r.result.moves);
    reading_free(&r);
}

int main(void) {
    struct CMUnitTest tests[COUNT(rows) + COUNT(define_rows) + COUNT(frame_rows)];
    size_t n = 0;
    for (size_t i = 0; i < COUNT(rows); i++)
        tests[n++] = (struct CMUnitTest){rows[i].name, check_row, NULL, NULL, &rows[i]};
    for (size_t i = 0; i < COUNT(define_rows); i++)
        tests[n++] = (struct CMUnitTest){define_rows[i].name, check_define, NULL, NULL, &define_rows[i]};
    for (size_t i = 0; i < COUNT(frame_rows); i++)
        tests[n++] = (struct CMUnitTest){frame_rows[i].name, check_frame, NULL, NULL, &frame_rows[i]};
    const struct CMUnitTest others[] = {
        cmocka_unit_test(a_preset_gives_what_is_not_given),
        cmocka_unit_test(the_parameters_of_a_caller_are_not_those_of_a_template),
        cmocka_unit_test(vectors_and_colours_move),
        cmocka_unit_test(a_camera_that_moves_leaves_the_objects_still),
    };
    return cmocka_run_group_tests_name("rows", tests, NULL, NULL) +
           cmocka_run_group_tests_name("language", others, NULL, NULL);
}
