/* What values a quadric takes, for telling what can be seen of it before anything is rendered. Everything
 * here is on the safe side: "true" is proven with room for rounding, "false" may mean that it is not known. */
#ifndef MONGE_SHAPE_RANGE_H
#define MONGE_SHAPE_RANGE_H

#include "scene/primitive.h"

/* Whether the form has no surface at all: no real point, or its box misses it. */
bool form_is_empty(const struct quadric_form *form);

/* Whether the box, in object space, lies inside the closed form, its surface left out. */
bool form_holds_box(const struct quadric_form *form, box3 box);

#endif
