/* The entries of a layer as JSON, and back:
 *
 *     [
 *       {"id": 3, "name": "lid", "kind": "sphere", "file": "scene.yaml", "line": 41, "column": 5},
 *       ...
 *     ]
 *
 * What there is not is null, or 0 of line and column. */
#ifndef MONGE_IMAGE_LAYER_TABLE_H
#define MONGE_IMAGE_LAYER_TABLE_H

#include "render/layers.h"

/* To be freed; NULL: no memory. */
char *layer_table_text(const struct layer_entries *entries);

/* Reads what layer_table_text has written; members that it does not know are passed over. The list lives in the
 * arena. False where the text is anything else, or its ids do not rise from 1. */
bool layer_table_read(const char *text, struct arena *arena, struct layer_entries *entries);

#endif
