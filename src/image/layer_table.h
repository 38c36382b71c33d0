/* The entries of a layer as JSON, its camera, lights and settings, and back:
 *
 *     [
 *       {"id": 3, "name": "lid", "kind": "sphere", "file": "scene.yaml", "line": 41, "column": 5},
 *       ...
 *     ]
 *
 *
 *     {
 *       "projection": "perspective",
 *       "eye": [0, 3, 8], "forward": [0, -0.29, -0.96], "right": [0.55, 0, 0], "up": [0, 0.4, -0.12],
 *       "given": "b2c3...", "others": "08f1...", "objects": "77ab...",
 *       "file": "scene.yaml", "line": 3, "column": 9
 *     }
 *
 *
 *     [
 *       {"kind": "point light", "at": [2, 4, 5], "color": [1, 1, 1], "file": "scene.yaml", "line": 7, "column": 5},
 *       ...
 *     ]
 *
 *
 *     {"samples": "4", "bits": "8", ...}
 *
 * What there is not is null, or 0 of line and column. Numbers of a camera or a light are written so that they come back exactly. */
#ifndef MONGE_IMAGE_LAYER_TABLE_H
#define MONGE_IMAGE_LAYER_TABLE_H

#include "render/layers.h"

/* To be freed; NULL: no memory. */
char *layer_table_text(const struct layer_entries *entries);

/* Reads what layer_table_text has written; members that it does not know are passed over. The list lives in the
 * arena. False where the text is anything else, or its ids do not rise from 1. */
bool layer_table_read(const char *text, struct arena *arena, struct layer_entries *entries);

/* The same for a camera that is known. False where the text is anything else, or not whole: then the camera is not
 * known. */
char *layer_camera_text(const struct layer_camera *camera);
bool layer_camera_read(const char *text, struct arena *arena, struct layer_camera *camera);

/* The same for lights and settings that are known. False where the text is anything else, or they are more than the
 * most that there may be: then they are not known. */
char *layer_lights_text(const struct layer_conditions *conditions);
bool layer_lights_read(const char *text, struct arena *arena, struct layer_conditions *conditions);
char *layer_settings_text(const struct layer_conditions *conditions);
bool layer_settings_read(const char *text, struct arena *arena, struct layer_conditions *conditions);

#endif
