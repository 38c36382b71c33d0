/* What changed of the lights and settings that two pictures are rendered under. */
#ifndef MONGE_IMAGE_CONDITIONS_CHANGE_H
#define MONGE_IMAGE_CONDITIONS_CHANGE_H

#include "render/layers.h"

struct conditions_change {
    struct monge_change *list; /* lights in the order of the newer scene, those that are gone, settings */
    uint32_t count;
    unsigned follow; /* a bit 1 << kind for each kind of change that all objects may show by that */
};

/* Nothing has changed of what one of them does not tell. The list is in the arena. */
struct conditions_change conditions_change(const struct layer_conditions *older,
                                           const struct layer_conditions *newer, struct arena *arena);

#endif
