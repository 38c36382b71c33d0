/* What changed between two pictures, object by object. Each pixel gets a cause: the object that moved there or away,
 * or the object that is there as before and looks different. A pixel at an edge mixes what is on both sides of it, so
 * its colour alone does not accuse an object: it goes with what is found in the inside of those around. */
#ifndef MONGE_IMAGE_CHANGES_H
#define MONGE_IMAGE_CHANGES_H

#include "render/layers.h"

/* The whole of monge_changes: `differs` has a byte for each pixel, not 0 where the pictures differ in colour; NULL:
 * nobody knows where, and only what the layers say by themselves is told, geometry and materials. False where the layers do not fit each other, an object is not in their tables, or there is no memory. */
bool changes_find(const struct monge_layers *older, const struct monge_layers *newer, const uint8_t *differs,
                  struct monge_change *changes, size_t room, size_t *count);

#endif
