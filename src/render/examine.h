/* What would render wrong, told without rendering. */
#ifndef MONGE_RENDER_EXAMINE_H
#define MONGE_RENDER_EXAMINE_H

#include "accel/accel.h"
#include "scene/scene.h"

/* Warns in `diag` of what is surely not meant: nothing in view, the camera inside of a solid, objects and
 * lights without effect. What cannot be proven is passed over in silence. `moves`: the scene is a frame of an animation, of
 * which other frames may show what this one hides. `arena` is for scratch, and left larger. */
void examine_scene(const struct scene *scene, const struct accel *accel, bool moves, struct arena *arena,
                   struct diagnostics *diag);

#endif
