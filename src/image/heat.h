/* A picture of where two pictures differ. */
#ifndef MONGE_IMAGE_HEAT_H
#define MONGE_IMAGE_HEAT_H

#include "image/compare.h"

/* The whole of monge_heat_map_write. False, with the reason: of the picture *about, or, where that becomes NULL, of
 * writing. */
bool heat_map_write(struct monge_picture *a, struct monge_picture *b, const struct monge_compare *how,
                    const char *path, char reason[PICTURE_REASON_SIZE], const struct monge_picture **about);

#endif
