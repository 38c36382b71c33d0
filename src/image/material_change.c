#include "image/material_change.h"

#include <string.h>

#include "base/same.h"

static const struct monge_entry *material_at(const struct monge_layers *layers, size_t i) {
    static const struct monge_entry unknown = {.kind = "material"};
    const uint32_t *ids = layers->ids[MONGE_LAYER_MATERIAL];
    const struct monge_entry *entry = ids ? monge_layers_entry(layers, MONGE_LAYER_MATERIAL, ids[i]) : NULL;
    return entry ? entry : &unknown;
}

enum material_change material_change(const struct monge_layers *older, const struct monge_layers *newer,
                                     size_t i) {
    const struct monge_entry *a = material_at(older, i), *b = material_at(newer, i);
    const bool both = older->ids[MONGE_LAYER_MATERIAL] && newer->ids[MONGE_LAYER_MATERIAL];
    if (!older->ids[MONGE_LAYER_OBJECT][i]) return SAME_MATERIAL; /* the background */
    if (!both) return SAME_NAME;
    if (a->hash && b->hash) return strcmp(a->hash, b->hash) == 0 ? SAME_MATERIAL : OTHER_MATERIAL;
    return same_text(a->name, b->name) ? SAME_NAME : OTHER_MATERIAL;
}
