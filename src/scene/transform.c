#include "scene/builder.h"

/* Angles that people mean when they write radians; what is computed may come to anything. */
static void warn_radians(struct builder *b, const struct object_value *rotate, int key) {
    if (!rotate->fields[key] || rotate->fields[key]->computed) return;
    static const struct {
        double radians;
        const char *name, *deg;
    } angles[] = {{3.14159265358979, "pi", "180"},    {1.57079632679490, "pi/2", "90"},
                  {0.785398163397448, "pi/4", "45"},  {1.04719755119660, "pi/3", "60"},
                  {0.523598775598299, "pi/6", "30"},  {6.28318530717959, "2 pi", "360"},
                  {4.71238898038469, "3/2 pi", "270"}};
    const double value = fabs(object_number(rotate, key));
    for (size_t i = 0; i < sizeof angles / sizeof *angles; i++)
        if (fabs(value - angles[i].radians) < 0.002) {
            struct diagnostic *d = diag_warning(b->diag, object_span(rotate, key), "looks-like-radians",
                                                "an angle of %g degrees looks like %s in radians",
                                                object_number(rotate, key), angles[i].name);
            diag_help(b->diag, d, "angles are in degrees: did you mean %s%s?",
                      object_number(rotate, key) < 0 ? "-" : "", angles[i].deg);
        }
}

static affine rotate_build(struct builder *b, const struct object_value *rotate) {
    const int key = object_alternative(rotate);
    static const vec3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    if (key < 0) return AFFINE_IDENTITY;
    const int angle = key == KEY_ROTATE_AXIS ? KEY_ROTATE_ANGLE : key;
    warn_radians(b, rotate, angle);
    const vec3 axis = key == KEY_ROTATE_AXIS ? object_vec3(rotate, key) : axes[key - KEY_ROTATE_X];
    return affine_rotate(axis, object_number(rotate, angle));
}

static affine shear_build(const struct object_value *shear) {
    return (affine){{{1, object_number(shear, KEY_SHEAR_XY), object_number(shear, KEY_SHEAR_XZ), 0},
                     {object_number(shear, KEY_SHEAR_YX), 1, object_number(shear, KEY_SHEAR_YZ), 0},
                     {object_number(shear, KEY_SHEAR_ZX), object_number(shear, KEY_SHEAR_ZY), 1, 0}}};
}

static affine step_build(struct builder *b, const struct object_value *step, int key) {
    switch (key) {
    case KEY_STEP_TRANSLATE: return affine_translate(object_vec3(step, key));
    case KEY_STEP_SCALE: return affine_scale(object_vec3(step, key));
    case KEY_STEP_ROTATE: return rotate_build(b, object_object(step, key));
    case KEY_STEP_SHEAR: return shear_build(object_object(step, key));
    default: return *object_matrix(step, key);
    }
}

static void report_singular(struct builder *b, const struct object_value *step, int key, affine map) {
    const char *name = step->kind->keys[key].name;
    const vec3 v = key == KEY_STEP_SCALE ? object_vec3(step, key) : vec3_all(1);
    const bool flat = v.x == 0 || v.y == 0 || v.z == 0;
    if (!flat && (key == KEY_STEP_SCALE || !(vec3_max_abs(affine_column(map, 3)) < 1e100))) {
        struct diagnostic *d =
            diag_error(b->diag, object_span(step, key), "flat-transform", "this `%s` is out of range", name);
        diag_help(b->diag, d, "its numbers must lie within 1e-100 to 1e100");
        return;
    }
    struct diagnostic *d =
        diag_error(b->diag, object_span(step, key), "flat-transform", "this `%s` has no inverse", name);
    diag_help(b->diag, d,
              flat ? "a factor of 0 flattens the object; for something flat use `square` or `disc`"
                   : "it flattens the object, or its numbers are out of range");
}

affine transform_build(struct builder *b, struct object_list steps) {
    affine all = AFFINE_IDENTITY, inverse;
    for (uint32_t i = 0; i < steps.count; i++) {
        const struct object_value *step = steps.items[i];
        const int key = object_alternative(step);
        if (key < 0 || step->failed) continue;
        const affine one = step_build(b, step, key);
        if (affine_invert(one, &inverse))
            all = affine_compose(one, all);
        else
            report_singular(b, step, key, one);
    }
    return all;
}
