/* What is proven of quadrics: by hand, and never against what points show. */
#include "near.h"
#include "shape/range.h"

#define EVERYWHERE BOX3_ALL
#define UNIT_BALL  .xx = 1, .yy = 1, .zz = 1, .constant = -1

static struct row {
    const char *name;
    struct quadric_form form;
    bool empty;
} rows[] = {
    {"a ball", {UNIT_BALL, .clip = EVERYWHERE}, false},
    {"x^2 + y^2 + z^2 = -1", {.xx = 1, .yy = 1, .zz = 1, .constant = 1, .clip = EVERYWHERE}, true},
    {"x^2 = -1", {.xx = 1, .constant = 1, .clip = EVERYWHERE}, true},
    {"x^2 + y = -1", {.xx = 1, .y = 1, .constant = 1, .clip = EVERYWHERE}, false},
    {"(x + y)^2 = -1", {.xx = 1, .yy = 1, .xy = 2, .constant = 1, .clip = EVERYWHERE}, true},
    {"(x + y)^2 = 1", {.xx = 1, .yy = 1, .xy = 2, .constant = -1, .clip = EVERYWHERE}, false},
    {"x^2 + y^2 + 3 x y = -1", {.xx = 1, .yy = 1, .xy = 3, .constant = 1, .clip = EVERYWHERE}, false},
    {"all of space has no surface", {.xx = -1, .yy = -1, .zz = -1, .constant = -1, .clip = EVERYWHERE}, true},
    {"all of a box has one", {.xx = -1, .constant = -1, .clip = {{0, 0, 0}, {1, 1, 1}}}, false},
    {"but none if it is open",
     {.xx = -1, .constant = -1, .clip = {{0, 0, 0}, {1, 1, 1}}, .open = true},
     true},
    {"a box beside the ball", {UNIT_BALL, .clip = {{0.6, 0.6, 0.6}, {1, 1, 1}}}, true},
    {"a box at its edge", {UNIT_BALL, .clip = {{0.57, 0.57, 0.57}, {1, 1, 1}}}, false},
    {"a box within it, open", {UNIT_BALL, .clip = {{0, 0, 0}, {0.5, 0.5, 0.5}}, .open = true}, true},
    {"half of space beside the ball",
     {UNIT_BALL, .clip = {{1.1, -INFINITY, -INFINITY}, {INFINITY, INFINITY, INFINITY}}},
     true},
    {"a plane in half of space",
     {.x = 1, .clip = {{-1, -INFINITY, -INFINITY}, {INFINITY, INFINITY, INFINITY}}},
     false},
};

static void check_row(void **state) {
    const struct row *row = *state;
    assert_int_equal(form_is_empty(&row->form), row->empty);
}

static double value_at(const struct quadric_form *f, vec3 p) {
    return f->xx * p.x * p.x + f->yy * p.y * p.y + f->zz * p.z * p.z + f->xy * p.x * p.y + f->yz * p.y * p.z +
           f->zx * p.z * p.x + f->x * p.x + f->y * p.y + f->z * p.z + f->constant;
}

static vec3 point_in(struct random *r, box3 box) {
    return (vec3){random_between(r, box.min.x, box.max.x), random_between(r, box.min.y, box.max.y),
                  random_between(r, box.min.z, box.max.z)};
}

/* Whatever points of both signs show has a surface, and no point of a box that is held is outside. */
static void check_random(void **state) {
    (void)state;
    struct random r = random_begin();
    int empty = 0, held = 0;
    for (int i = 0; i < 20000; i++) {
        struct quadric_form f = {.clip = {{-1, -1, -1}, {1, 1, 1}}, .open = random_below(&r, 2)};
        double *const terms[] = {&f.xx, &f.yy, &f.zz, &f.xy, &f.yz, &f.zx, &f.x, &f.y, &f.z, &f.constant};
        for (size_t k = 0; k < COUNT(terms); k++)
            *terms[k] = random_below(&r, 3) ? random_between(&r, -1, 1) : 0.0;
        const vec3 corner = random_vec3(&r, -1.1, 0.9);
        const box3 box = {corner, vec3_add(corner, vec3_all(random_between(&r, 0.01, 0.4)))};
        const bool is_empty = form_is_empty(&f), holds = form_holds_box(&f, box);
        bool in = false, out = false;
        for (int k = 0; k < 50; k++) {
            const double value = value_at(&f, point_in(&r, f.clip));
            in |= value < 0.0;
            out |= value > 0.0;
            if (holds) assert_true(value_at(&f, point_in(&r, box)) < 0.0);
        }
        if (is_empty) assert_false(in && (out || !f.open));
        empty += is_empty;
        held += holds;
    }
    printf("# %d empty, %d held\n", empty, held);
    assert_true(empty > 100 && held > 100);
}

int main(void) {
    struct CMUnitTest tests[COUNT(rows) + 1];
    for (size_t i = 0; i < COUNT(rows); i++)
        tests[i] = (struct CMUnitTest){rows[i].name, check_row, NULL, NULL, &rows[i]};
    tests[COUNT(rows)] = (struct CMUnitTest){"random forms", check_random, NULL, NULL, NULL};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
