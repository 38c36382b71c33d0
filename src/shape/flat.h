/* Flats: squares, discs and planes. Private to shape/; for the arguments see shape.h. */
#ifndef MONGE_SHAPE_FLAT_H
#define MONGE_SHAPE_FLAT_H

#include "shape/shape.h"

/* The edge of the outline belongs to the flat: of a square, with the rounding of the crossing too,
 * so that squares side by side leave no crack. A ray in the plane is a miss. */
bool flat_first_crossing(const struct flat *f, ray r, double t_min, double t_max, struct crossing *out);

struct surface flat_surface(const struct flat *f, ray r, double t);

#endif
