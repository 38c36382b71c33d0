/* The shapes that the tables of the tests of shape/ name: the canonical one of each kind, and some that are special. */
#ifndef MONGE_TESTS_SHAPE_NAMED_H
#define MONGE_TESTS_SHAPE_NAMED_H

#include "shape_forms.h"

enum { SPHERE = FORM_COUNT, SQUARE, DISC, PLANE, BALL_2, SLANTED, MIRRORED, STRETCHED };

static const struct quadric_form space = {.constant = -1, .clip = BOX3_ALL, .extent = BOX3_ALL};
static const struct quadric_form quarter = {.xx = 1,
                                            .yy = 1,
                                            .constant = -1,
                                            .clip = BOX(0, 0, -INFINITY, INFINITY, INFINITY, 1),
                                            .extent = BOX3_ALL};
/* Planes: one that is open, in a box; and half of a cube below one, with all squares and products -0. */
static const struct quadric_form open_plane = {.z = 1,
                                               .clip = BOX(-0.5, -0.5, -0.5, 0.5, 0.5, 0.5),
                                               .extent = BOX(-0.5, -0.5, 0, 0.5, 0.5, 0),
                                               .open = true};
static const struct quadric_form half_cube = {.xx = -0.0,
                                              .yy = -0.0,
                                              .zz = -0.0,
                                              .xy = -0.0,
                                              .yz = -0.0,
                                              .zx = -0.0,
                                              .z = 1,
                                              .clip = BOX(-0.5, -0.5, -0.5, 0.5, 0.5, 0.5),
                                              .extent = BOX(-0.5, -0.5, -0.5, 0.5, 0.5, 0)};
enum { SPACE = STRETCHED + 1, QUARTER, OPEN_PLANE, HALF_CUBE, LEANING };

/* With one term more than ellipses about z have, each keeps the extent that it is given. */
#define EXTENT(x, y) .clip = SLAB(-1, 1), .extent = BOX(-(x), -(y), -1, x, y, 1)
static const struct quadric_form leaning[] = {
    {.xx = 1, .yy = 1, .x = -2, .constant = -1, EXTENT(3, 2)},
    {.xx = 1, .yy = 1, .y = 2, .constant = -1, EXTENT(2, 3)},
    {.xx = 1, .yy = 1, .xy = 1, .constant = -1, EXTENT(1.25, 1.25)},
    {.xx = 1, .yy = 1, .yz = 1, .constant = -1, EXTENT(1.25, 1.75)},
    {.xx = 1, .yy = 1, .zx = 1, .constant = -1, EXTENT(1.75, 1.25)},
};

static inline void make(struct alone *a, int shape) {
    switch (shape) {
    case SPHERE: alone_sphere(a, (vec3){0, 0, 0}, 1); return;
    case BALL_2: alone_sphere(a, (vec3){1, 2, 3}, 2); return;
    case SQUARE: alone_flat(a, FLAT_SQUARE, AFFINE_IDENTITY); return;
    case DISC: alone_flat(a, FLAT_DISC, AFFINE_IDENTITY); return;
    case PLANE: alone_flat(a, FLAT_PLANE, AFFINE_IDENTITY); return;
    case SLANTED: alone_flat(a, FLAT_SQUARE, affine_rotate((vec3){1, 0, 0}, 90)); return;
    case MIRRORED: alone_quadric(a, &forms[CONE], affine_scale((vec3){1, 1, -1})); return;
    case STRETCHED: alone_quadric(a, &forms[ELLIPSOID], affine_scale((vec3){1, 2, 3})); return;
    case SPACE: alone_quadric(a, &space, AFFINE_IDENTITY); return;
    case QUARTER: alone_quadric(a, &quarter, AFFINE_IDENTITY); return;
    case OPEN_PLANE: alone_quadric(a, &open_plane, AFFINE_IDENTITY); return;
    case HALF_CUBE: alone_quadric(a, &half_cube, AFFINE_IDENTITY); return;
    case LEANING:
    case LEANING + 1:
    case LEANING + 2:
    case LEANING + 3:
    case LEANING + 4: alone_quadric(a, &leaning[shape - LEANING], AFFINE_IDENTITY); return;
    default: alone_quadric(a, &forms[shape], AFFINE_IDENTITY); return;
    }
}

#endif
