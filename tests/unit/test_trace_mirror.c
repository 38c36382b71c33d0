/* What is seen in mirrors, and how far rays are followed: by depth, and by the weight of what they bring. */
#include "probe.h"

/* ---- A glowing wall, seen in mirrors ---- */

static struct probe mirrors[] = {
    {"a mirror",
     DOWN_Z GLOW_LIGHT "scene:\n  - {plane: {}, material: {diffuse: black, reflection: [1, 0.5, 0]}}\n  - "
                       "{plane: {point: [0, 0, 9], normal: [0, 0, -1]}, material: " GLOW(0.2, 0.4, 0.6) "}",
     {0.2, 0.2, 0},
     0},
    {"a mirror adds to the surface's own colour",
     DOWN_Z GLOW_LIGHT "scene:\n  - {plane: {}, material: {ambient: [0.1, 0.1, 0.1], reflection: 0.5}}\n  - "
                       "{plane: {point: [0, 0, 9], normal: [0, 0, -1]}, material: " GLOW(0.2, 0.4, 0.6) "}",
     {0.2, 0.3, 0.4},
     0},
    {"depth 1 has no reflection",
     DOWN_Z GLOW_LIGHT
     "render: {depth: 1}\nscene:\n  - {plane: {}, material: {ambient: [0.1, 0.1, 0.1], reflection: 0.5}}\n  "
     "- {plane: {point: [0, 0, 9], normal: [0, 0, -1]}, material: " GLOW(0.2, 0.4, 0.6) "}",
     {0.1, 0.1, 0.1},
     0},
    {"two mirrors of a half, three generations",
     DOWN_Z GLOW_LIGHT
     "render: {depth: 3}\nscene:\n  - {plane: {}, material: {ambient: [1, 1, 1], reflection: 0.5}}\n  - "
     "{plane: {point: [0, 0, 9], normal: [0, 0, -1]}, material: {ambient: [1, 1, 1], reflection: 0.5}}",
     {1.75, 1.75, 1.75},
     0},
    {"a mirror at 45 degrees",
     DOWN_Z GLOW_LIGHT
     "scene:\n  - {square: {}, transform: [{rotate: {y: 45}}], material: {diffuse: black, reflection: 1}}\n  "
     "- {plane: {point: [9, 0, 0], normal: [-1, 0, 0]}, material: " GLOW(0.2, 0.4, 0.6) "}",
     {0.2, 0.4, 0.6},
     0},
};

/* ---- What weighs too little ---- */

static struct probe weights[] = {
    {"what weighs less than 1e-5 is not followed",
     DOWN_Z
     "lights: [{ambient: {color: [1e5, 1e5, 1e5]}}]\nscene:\n  - {plane: {}, material: {diffuse: black, "
     "reflection: 0.9e-5}}\n  - {plane: {point: [0, 0, 9], normal: [0, 0, -1]}, material: " GLOW(0.2, 0.4,
                                                                                                 0.6) "}",
     {0, 0, 0},
     0},
    {"what weighs a little more is",
     DOWN_Z
     "lights: [{ambient: {color: [1e5, 1e5, 1e5]}}]\nscene:\n  - {plane: {}, material: {diffuse: black, "
     "reflection: 1.1e-5}}\n  - {plane: {point: [0, 0, 9], normal: [0, 0, -1]}, material: " GLOW(0.2, 0.4,
                                                                                                 0.6) "}",
     {0.22, 0.44, 0.66},
     0},
    {"nor does light count through glass as dark as that",
     DOWN_Z "lights: [{point: {at: [4, 0, 4], color: [1e5, 1e5, 1e5]}}]\nscene:\n  - {plane: {}, material: "
            "{diffuse: [1, 1, 1]}}\n  - {disc: {center: [2, 0, 2], normal: [1, 0, 1], radius: 0.5}, "
            "material: {diffuse: black, refraction: 0.9e-5}}",
     {0, 0, 0},
     0},
    {"through glass a little clearer it does: 1.1 cos(45)",
     DOWN_Z "lights: [{point: {at: [4, 0, 4], color: [1e5, 1e5, 1e5]}}]\nscene:\n  - {plane: {}, material: "
            "{diffuse: [1, 1, 1]}}\n  - {disc: {center: [2, 0, 2], normal: [1, 0, 1], radius: 0.5}, "
            "material: {diffuse: black, refraction: 1.1e-5}}",
     {0.77781745930520227, 0.77781745930520227, 0.77781745930520227},
     0},
    {"what weighs just that is followed",
     DOWN_Z
     "lights: [{ambient: {color: [1e5, 1e5, 1e5]}}]\nscene:\n  - {plane: {}, material: {diffuse: black, "
     "reflection: 1e-5}}\n  - {plane: {point: [0, 0, 9], normal: [0, 0, -1]}, material: " GLOW(0.2, 0.4,
                                                                                               0.6) "}",
     {0.2, 0.4, 0.6},
     0},
    {"through glass of just that light counts: cos(45)",
     DOWN_Z "lights: [{point: {at: [4, 0, 4], color: [1e5, 1e5, 1e5]}}]\nscene:\n  - {plane: {}, material: "
            "{diffuse: [1, 1, 1]}}\n  - {disc: {center: [2, 0, 2], normal: [1, 0, 1], radius: 0.5}, "
            "material: {diffuse: black, refraction: 1e-5}}",
     {0.70710678118654757, 0.70710678118654757, 0.70710678118654757},
     0},
};

int main(void) {
    struct CMUnitTest tests[COUNT(mirrors) + COUNT(weights)];
    size_t n = 0;
    for (size_t i = 0; i < COUNT(mirrors); i++)
        tests[n++] = (struct CMUnitTest){mirrors[i].name, check_probe, NULL, NULL, &mirrors[i]};
    for (size_t i = 0; i < COUNT(weights); i++)
        tests[n++] = (struct CMUnitTest){weights[i].name, check_probe, NULL, NULL, &weights[i]};
    return cmocka_run_group_tests_name("mirrors", tests, NULL, NULL);
}
