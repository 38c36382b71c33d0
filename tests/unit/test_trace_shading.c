/* What a ray sees of a surface that is lit, and of the background. */
#include "probe.h"

/* ---- Phong, each term alone ---- */

/* Light and eye on the axis, so N.L = R.V = 1 at the nearest point. */
static struct probe phong[] = {
    {"ambient",
     DOWN_Z "lights: [{ambient: {color: [0.5, 1, 2]}}]\nscene: [{sphere: {}, material: {ambient: [0.2, 0.4, "
            "0.1], diffuse: white}}]",
     {0.1, 0.4, 0.2},
     0},
    {"two ambient lights add up",
     DOWN_Z
     "lights: [{ambient: {}}, {ambient: {}}]\nscene: [{sphere: {}, material: {ambient: [0.2, 0.4, 0.1]}}]",
     {0.4, 0.8, 0.2},
     0},
    {"diffuse",
     DOWN_Z WHITE_LIGHT "scene: [{sphere: {}, material: {diffuse: [0.1, 0.2, 0.3]}}]",
     {0.1, 0.2, 0.3},
     0},
    {"specular",
     DOWN_Z WHITE_LIGHT "scene: [{sphere: {}, material: {diffuse: black, specular: [0.1, 0.2, 0.3]}}]",
     {0.1, 0.2, 0.3},
     0},
    {"Lambert's cosine at 60 degrees",
     DOWN_Z "lights: [{point: {at: [1.7320508075688772, 0, 1]}}]\nscene: [{plane: {}, material: {diffuse: "
            "[1, 0.5, 0]}}]",
     {0.5, 0.25, 0},
     0},
    {"highlight to a power: cos(60)^3",
     DOWN_Z "lights: [{point: {at: [1.7320508075688772, 0, 1]}}]\nscene: [{plane: {}, material: {diffuse: "
            "black, specular: [1, 1, 1], shininess: 3}}]",
     {0.125, 0.125, 0.125},
     0},
    {"highlight with exponent 0 is flat",
     DOWN_Z "lights: [{point: {at: [1.7320508075688772, 0, 1]}}]\nscene: [{plane: {}, material: {diffuse: "
            "black, specular: [1, 1, 1], shininess: 0}}]",
     {1, 1, 1},
     0},
    {"a highlight of next to exp(-40) is there: 1e24 / 2^79.8",
     DOWN_Z
     "lights: [{point: {at: [1.7320508075688772, 0, 1], color: [1e24, 1e24, 1e24]}}]\nscene: [{plane: {}, "
     "material: {diffuse: black, specular: [1, 1, 1], shininess: 79.8}}]",
     {0.95018, 0.95018, 0.95018},
     1e-5},
    {"beyond that it is none",
     DOWN_Z
     "lights: [{point: {at: [1.7320508075688772, 0, 1], color: [1e24, 1e24, 1e24]}}]\nscene: [{plane: {}, "
     "material: {diffuse: black, specular: [1, 1, 1], shininess: 80.2}}]",
     {0, 0, 0},
     0},
    {"nor just there: 100 * (1 - 0.6)",
     DOWN_Z
     "lights: [{point: {at: [0.8, 0, 0.6], color: [1e24, 1e24, 1e24]}}]\nscene: [{plane: {}, material: "
     "{diffuse: black, specular: [1, 1, 1], shininess: 100}}]",
     {0, 0, 0},
     0},
    {"no highlight at a right angle to the mirrored light",
     DARK "camera: {eye: [-5, 0, 5], direction: [1, 0, -1]}\nlights: [{point: {at: [-3, 0, 3]}}]\nscene: "
          "[{plane: {}, material: {diffuse: black, specular: white, shininess: 0}}]",
     {0, 0, 0},
     0},
    {"no highlight by a light in the plane of the surface",
     DARK
     "camera: {eye: [-5, 0, 5], direction: [1, 0, -1]}\nrender: {shadow: 1}\nlights: [{point: {at: [3, 0, "
     "0]}}]\nscene: [{plane: {}, material: {diffuse: black, specular: white, shininess: 2}}]",
     {0, 0, 0},
     0},
    {"two lights add up",
     DOWN_Z "lights: [{point: {at: [0, 0, 10]}}, {point: {at: [0, 0, 20], color: [0.5, 0, 0]}}]\nscene: "
            "[{plane: {}, material: {diffuse: [0.2, 0.2, 0.2]}}]",
     {0.3, 0.2, 0.2},
     0},
    {"a light over 1",
     DOWN_Z "lights: [{point: {at: [0, 0, 10], color: [5, 0, 0]}}]\nscene: [{plane: {}, material: {diffuse: "
            "[0.5, 0.5, 0.5]}}]",
     {2.5, 0, 0},
     0},
    {"diffuse shading has no highlight",
     DOWN_Z WHITE_LIGHT "render: {shading: diffuse}\nscene: [{sphere: {}, material: {diffuse: [0.1, 0.2, "
                        "0.3], specular: white}}]",
     {0.1, 0.2, 0.3},
     0},
    {"signature is the diffuse colour, unlit",
     DOWN_Z "lights: []\nrender: {shading: signature}\nscene: [{sphere: {}, material: {diffuse: [0.1, 0.2, "
            "0.3], specular: white, reflection: 0.5}}]",
     {0.1, 0.2, 0.3},
     0},
};

/* ---- The side that is lit ---- */

static struct probe sides[] = {
    {"a flat is lit from behind when seen from behind",
     DOWN_Z WHITE_LIGHT "scene: [{plane: {normal: [0, 0, -1]}, material: {diffuse: [1, 1, 1]}}]",
     {1, 1, 1},
     0},
    {"not when it has one side",
     DOWN_Z WHITE_LIGHT
     "render: {two_sided: false}\nscene: [{plane: {normal: [0, 0, -1]}, material: {diffuse: [1, 1, 1]}}]",
     {0, 0, 0},
     0},
    {"no light through a sheet",
     DOWN_Z "lights: [{point: {at: [0, 0, -10]}}]\nscene: [{plane: {}, material: {diffuse: [1, 1, 1], "
            "specular: white}}]",
     {0, 0, 0},
     0},
    {"no highlight behind the light",
     DOWN_Z "render: {shadow: 1}\nlights: [{point: {at: [1, 0, -0.0001]}}]\nscene: [{plane: {}, material: "
            "{diffuse: black, specular: [1, 1, 1], shininess: 0}}]",
     {0, 0, 0},
     0},
    {"unless it always shows: the mirrored light is seen at 45 degrees",
     DARK "camera: {eye: [-5, 0, 5], direction: [1, 0, -1]}\nrender: {shadow: 1, highlight: always}\nlights: "
          "[{point: {at: [1, 0, -0.0001]}}]\nscene: [{plane: {}, material: {diffuse: black, specular: [1, 1, "
          "1], shininess: 2}}]",
     {0.5, 0.5, 0.5},
     1e-3},
    {"the inside of a ball, two-sided",
     DARK "camera: {eye: [0, 0, 0], direction: [0, 0, -1]}\nlights: [{point: {at: [0, 0, 0.5]}}]\nscene: "
          "[{sphere: {}, material: {diffuse: [0.3, 0.6, 0.9]}}]",
     {0.3, 0.6, 0.9},
     0},
};

/* ---- Where there is nothing ---- */

static struct probe backgrounds[] = {
    {"the background is flat when it has one colour",
     "image: {size: [1, 1], samples: 1, background: [0.1, 0.2, 0.3]}\ncamera: {eye: [0, 0, 5], direction: "
     "[0, 0.3, 1]}\nscene: [{sphere: {}}]",
     {0.1, 0.2, 0.3},
     0},
    {"the background straight up",
     "image: {size: [1, 1], samples: 1, background: {bottom: black, top: [0.4, 0.2, 0.1]}}\ncamera: {eye: "
     "[0, 5, 0], direction: [0, 1, 0]}\nscene: [{sphere: {}}]",
     {0.4, 0.2, 0.1},
     0},
    {"the background ahead",
     "image: {size: [1, 1], samples: 1, background: {bottom: black, top: [0.4, 0.2, 0.1]}}\ncamera: {eye: "
     "[0, 5, 0], direction: [0, 0, 1]}\nscene: [{sphere: {}}]",
     {0.2, 0.1, 0.05},
     0},
};

int main(void) {
    struct CMUnitTest tests[COUNT(phong) + COUNT(sides) + COUNT(backgrounds)];
    size_t n = 0;
    for (size_t i = 0; i < COUNT(phong); i++)
        tests[n++] = (struct CMUnitTest){phong[i].name, check_probe, NULL, NULL, &phong[i]};
    for (size_t i = 0; i < COUNT(sides); i++)
        tests[n++] = (struct CMUnitTest){sides[i].name, check_probe, NULL, NULL, &sides[i]};
    for (size_t i = 0; i < COUNT(backgrounds); i++)
        tests[n++] = (struct CMUnitTest){backgrounds[i].name, check_probe, NULL, NULL, &backgrounds[i]};
    return cmocka_run_group_tests_name("shading", tests, NULL, NULL);
}
