/* How much of a light arrives. */
#include "probe.h"

static struct probe shadows[] = {
    {"in shadow, the physical answer",
     DOWN_Z "lights: [{ambient: {}}, {point: {at: [4, 0, 4]}}]\nscene:\n  - {plane: {}, material: {ambient: "
            "[0.1, 0.1, 0.1], diffuse: [0.5, 0.5, 0.5]}}\n  - sphere: {center: [2, 0, 2], radius: 0.5}",
     {0.1, 0.1, 0.1},
     0},
    {"half a shadow: 0.1 + 0.5 * 0.5 cos(45)",
     DOWN_Z "render: {shadow: 0.5}\nlights: [{ambient: {}}, {point: {at: [4, 0, 4]}}]\nscene:\n  - {plane: "
            "{}, material: {ambient: [0.1, 0.1, 0.1], diffuse: [0.5, 0.5, 0.5]}}\n  - sphere: {center: [2, "
            "0, 2], radius: 0.5}",
     {0.27677669529663687, 0.27677669529663687, 0.27677669529663687},
     0},
    {"no shadows",
     DOWN_Z "render: {shadow: 1}\nlights: [{point: {at: [4, 0, 4]}}]\nscene:\n  - {plane: {}, material: "
            "{diffuse: [0.5, 0.5, 0.5]}}\n  - sphere: {center: [2, 0, 2], radius: 0.5}",
     {0.35355339059327373, 0.35355339059327373, 0.35355339059327373},
     0},
    {"a body behind the light throws no shadow",
     DOWN_Z "lights: [{point: {at: [1, 0, 1]}}]\nscene:\n  - {plane: {}, material: {diffuse: [0.5, 0.5, "
            "0.5]}}\n  - sphere: {center: [2, 0, 2], radius: 0.5}",
     {0.35355339059327373, 0.35355339059327373, 0.35355339059327373},
     0},
    {"a sheet at the light throws none",
     DOWN_Z "lights: [{point: {at: [4, 0, 4]}}]\nscene:\n  - {plane: {}, material: {diffuse: [0.5, 0.5, "
            "0.5]}}\n  - disc: {center: [4, 0, 4], normal: [1, 0, 1]}",
     {0.35355339059327373, 0.35355339059327373, 0.35355339059327373},
     0},
    {"a sheet of glass at the light dims nothing",
     DOWN_Z "lights: [{point: {at: [4, 0, 4]}}]\nscene:\n  - {plane: {}, material: {diffuse: [0.5, 0.5, "
            "0.5]}}\n  - {disc: {center: [4, 0, 4], normal: [1, 0, 0]}, material: {diffuse: black, "
            "refraction: 0.5}}",
     {0.35355339059327373, 0.35355339059327373, 0.35355339059327373},
     0},
    {"two glass sheets let 0.5 * 0.8 of the light through",
     DOWN_Z "lights: [{point: {at: [4, 0, 4]}}]\nscene:\n  - {plane: {}, material: {diffuse: [1, 1, 1]}}\n  "
            "- {disc: {center: [2, 0, 2], normal: [1, 0, 1], radius: 0.5}, material: {diffuse: black, "
            "refraction: 0.5}}\n  - {disc: {center: [3, 0, 3], normal: [1, 0, 1], radius: 0.5}, material: "
            "{diffuse: black, refraction: [0.8, 0.8, 0]}}",
     {0.28284271247461906, 0.28284271247461906, 0},
     0},
    {"lights however far away: no surface is in its own shadow",
     DARK
     "camera: {eye: [4, 2, 7], direction: [-4, -2, -7]}\nlights: [{point: {at: [4e6, 2e6, 7e6]}}, {point: "
     "{at: [4e9, 2e9, 7e9]}}, {point: {at: [4e12, 2e12, 7e12]}}, {point: {at: [4e15, 2e15, 7e15]}}]\nscene: "
     "[{sphere: {radius: 1.1}, transform: {scale: [1, 1.3, 0.7]}, material: {diffuse: black, "
     "specular: [0.1, 0.1, 0.1], shininess: 0}}]",
     {0.4, 0.4, 0.4},
     0},
};

int main(void) {
    struct CMUnitTest tests[COUNT(shadows)];
    size_t n = 0;
    for (size_t i = 0; i < COUNT(shadows); i++)
        tests[n++] = (struct CMUnitTest){shadows[i].name, check_probe, NULL, NULL, &shadows[i]};
    return cmocka_run_group_tests_name("shadows", tests, NULL, NULL);
}
