/* Whether a pixel has another material in two pictures of one size. */
#ifndef MONGE_IMAGE_MATERIAL_CHANGE_H
#define MONGE_IMAGE_MATERIAL_CHANGE_H

#include "render/layers.h"

enum material_change { SAME_MATERIAL, OTHER_MATERIAL, SAME_NAME /* of values that are not known */ };

/* By what they are; where older programs have written the layers by their names, and those without one are told apart
 * by nothing. Of pixel i, both layers having objects. */
enum material_change material_change(const struct monge_layers *older, const struct monge_layers *newer,
                                     size_t i);

#endif
