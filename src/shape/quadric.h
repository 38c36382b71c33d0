/* Quadrics, cut to a box, in object space. Private to shape/; for the arguments see shape.h. */
#ifndef MONGE_SHAPE_QUADRIC_H
#define MONGE_SHAPE_QUADRIC_H

#include "shape/shape.h"

int quadric_crossings(const struct quadric *q, ray r, struct crossing out[SHAPE_MAX_CROSSINGS]);
bool quadric_first_crossing(const struct quadric *q, ray r, double t_min, double t_max, struct crossing *out);
struct surface quadric_surface(const struct quadric *q, ray r, struct crossing crossing);
bool quadric_contains(const struct quadric *q, vec3 point);

#endif
