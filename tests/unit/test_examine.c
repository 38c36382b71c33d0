/* What monge_scene_examine tells of scenes whose answer is known: the codes it gives, in order. */
#include <string.h>

#include "monge.h"
#include "near.h"

static struct row {
    const char *name, *scene, *codes;
} rows[] = {
/* fov 90, square picture: the view from (0, 0, 5) is |x| < d and |y| < d at the distance d. */
#define VIEW "image: {size: [64, 64]}\ncamera: {eye: [0, 0, 5], direction: [0, 0, -1], fov: 90}\n"
    {"in the middle", VIEW "scene: [{sphere: {}}]", ""},
    {"just within the right edge", VIEW "scene: [{box: {min: [4.9, -1, -1], max: [7, 1, 0]}}]", ""},
    {"just beyond the right edge", VIEW "scene: [{box: {min: [6.1, -1, -1], max: [7, 1, 0]}}]",
     "nothing-in-view "},
    {"just beyond the lower edge", VIEW "scene: [{box: {min: [-1, -9, -1], max: [1, -6.1, 0]}}]",
     "nothing-in-view "},
    {"a sphere whose box would be in view", VIEW "scene: [{sphere: {center: [6.5, 0, 0]}}]",
     "nothing-in-view "},
    {"just behind", VIEW "scene: [{sphere: {center: [0, 0, 6.1]}}]", "nothing-in-view "},
    {"about the eye's plane", VIEW "scene: [{sphere: {center: [3, 0, 5.9], radius: 1.2}}]",
     "nothing-in-view "},
    {"one of two", VIEW "scene: [{sphere: {center: [0, 0, 9]}}, {sphere: {center: [0, 0, -9]}}]", ""},
    {"a floor below the view", VIEW "scene: [{plane: {normal: [0, 1, 0], point: [0, -99, 0]}}]", ""},
    {"a wall behind", VIEW "scene: [{plane: {point: [0, 0, 6]}}]", "nothing-in-view "},
    {"a wall in front", VIEW "scene: [{plane: {point: [0, 0, 4]}}]", ""},
#define FLAT_VIEW                                                                                            \
    "image: {size: [64, 64]}\ncamera: {projection: orthographic, eye: [0, 0, 5], direction: [0, 0, -1], "    \
    "height: 2}\n"
    {"orthographic, within the edge", FLAT_VIEW "scene: [{sphere: {center: [1.9, 0, 0]}}]", ""},
    {"orthographic, beyond the edge", FLAT_VIEW "scene: [{sphere: {center: [2.1, 0, 0]}}]",
     "nothing-in-view "},
    {"orthographic, a floor below", FLAT_VIEW "scene: [{plane: {normal: [0, 1, 0], point: [0, -2, 0]}}]",
     "nothing-in-view "},
    {"orthographic, a floor that crosses the view", FLAT_VIEW "scene: [{plane: {normal: [0, 1, 0.1]}}]", ""},
    {"the camera frames by itself", "scene: [{sphere: {center: [0, 0, 99]}}]", ""},

    {"the eye in a sphere", VIEW "scene: [{sphere: {center: [0, 0, 5]}}]", "camera-inside "},
    {"the eye on a sphere", VIEW "scene: [{sphere: {center: [0, 0, 4]}}]", ""},
    {"in clear glass", VIEW "scene: [{sphere: {center: [0, 0, 5]}, material: {refraction: 0.5}}]", ""},
    {"in an open cylinder", VIEW "scene: [{cylinder: {from: [0, 0, 9], to: [0, 0, 0], open: true}}]", ""},
    {"in a closed one", VIEW "scene: [{cylinder: {from: [0, 0, 9], to: [0, 0, 0]}}]", "camera-inside "},
    {"in a box that is mirrored and turned",
     VIEW
     "scene: [{box: {}, transform: [{scale: [-1, 3, 1]}, {rotate: {x: 90}}, {translate: [0.4, 0, 6.4]}]}]",
     "camera-inside "},
    {"beside it",
     VIEW
     "scene: [{box: {}, transform: [{scale: [-1, 3, 1]}, {rotate: {x: 90}}, {translate: [0.6, 0, 6.4]}]}]",
     ""},
    {"in an instance",
     VIEW "define: {row: {objects: [{for: {i: 20}, sphere: {center: [3 * i, 0, 0]}}]}}\n"
          "scene: [{use: row, transform: [{scale: [-1, 1, 1]}, {translate: [30.5, 0, 5]}]}]",
     "camera-inside "},
    {"between the parts of an instance",
     VIEW "define: {row: {objects: [{for: {i: 20}, sphere: {center: [3 * i, 0, 0]}}]}}\n"
          "scene: [{use: row, transform: [{scale: [-1, 1, 1]}, {translate: [31.5, 0, 5]}]}]",
     ""},
    {"a room with furniture", VIEW "scene: [{box: {min: [-9, -9, -9], max: [9, 9, 9]}}, {sphere: {}}]", ""},
    {"a room with a lamp",
     VIEW "lights: [{point: {at: [0, 8, 0]}}]\nscene: [{box: {min: [-9, -9, -9], max: [9, 9, 9]}}]", ""},

    {"a ball in a ball", "scene: [{sphere: {}}, {sphere: {radius: 0.5}}]", "no-effect "},
    {"a ball that looks out", "scene: [{sphere: {}}, {sphere: {radius: 0.5, center: [0.6, 0, 0]}}]", ""},
    {"a ball in glass", "scene: [{sphere: {}, material: {refraction: 0.5}}, {sphere: {radius: 0.5}}]", ""},
    {"a ball in a cone",
     "scene: [{cone: {from: [0, 0, -9], to: [0, 0, 0], radius: 9}}, {sphere: {center: [0, 0, -7]}}]",
     "no-effect "},
    {"a ball at the apex of a cone",
     "scene: [{cone: {from: [0, 0, -9], to: [0, 0, 0], radius: 9}}, {sphere: {center: [0, 0, -1]}}]", ""},
    {"balls of a loop", "scene: [{sphere: {}}, {for: {i: 2}, sphere: {radius: 0.1 * (i + 1)}}]", ""},
    {"twins", "scene: [{box: {}}, {box: {}}]", "no-effect "},
    {"twins of a loop", "scene: [{for: {i: 2}, box: {}}]", ""},
    {"twins of glass", "scene: [{box: {}, material: {refraction: 0.5}}, {box: {}}]", ""},
    {"in another frame it may be seen",
     "animation: {frames: 2}\nscene: [{sphere: {}}, {sphere: {radius: 0.5 + t}}]", ""},
    {"a lamp in its bulb", "lights: [{point: {at: [0, 0, 0]}}]\nscene: [{sphere: {}}]", "no-effect "},
    {"a lamp in glass",
     "lights: [{point: {at: [0, 0, 0]}}]\nscene: [{sphere: {}, material: {refraction: 0.5}}]", ""},
    {"shadows let light through",
     "render: {shadow: 0.5}\nlights: [{point: {at: [0, 0, 0]}}]\nscene: [{sphere: {}}]", ""},
};

/* The codes of the document, each with a space behind; "error" where the scene is wrong. */
static const char *codes_of(const char *text) {
    static char codes[400], document[1 << 16];
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_scene *scene = monge_load_memory("scene", text, strlen(text), NULL, diag);
    if (scene) monge_scene_examine(scene, diag);
    FILE *out = fmemopen(document, sizeof document, "w");
    monge_diagnostics_write(diag, MONGE_FORMAT_JSON, out);
    fclose(out);
    codes[0] = '\0';
    for (const char *at = document; (at = strstr(at, "\"code\": \""));) {
        at += strlen("\"code\": \"");
        strncat(codes, at, strcspn(at, "\""));
        strcat(codes, " ");
    }
    if (!scene) strcpy(codes, "error");
    monge_scene_free(scene);
    monge_diagnostics_free(diag);
    return codes;
}

static void check_row(void **state) {
    const struct row *row = *state;
    assert_string_equal(codes_of(row->scene), row->codes);
}

int main(void) {
    struct CMUnitTest tests[COUNT(rows)];
    for (size_t i = 0; i < COUNT(rows); i++)
        tests[i] = (struct CMUnitTest){rows[i].name, check_row, NULL, NULL, &rows[i]};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
