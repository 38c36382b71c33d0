/* What the layers tell of a picture's lights and settings. */
#ifndef MONGE_RENDER_CONDITIONS_H
#define MONGE_RENDER_CONDITIONS_H

#include "render/layers.h"

/* An entry of that kind, which is static, and of no name; its file is copied. Of a span without a source it has none. */
struct monge_entry conditions_entry(const struct span *place, const char *kind, struct arena *arena);

struct layer_conditions conditions_of(const struct scene *scene, const struct monge_settings *settings,
                                      struct arena *arena);

#endif
