/* Whether two pictures are seen by one camera, and what else has changed if not. */
#ifndef MONGE_IMAGE_CAMERA_CHANGE_H
#define MONGE_IMAGE_CAMERA_CHANGE_H

#include "render/layers.h"

/* For pictures of one size. False: both cameras have the same rays, or one of them is not known. */
bool camera_change(const struct layer_camera *older, const struct layer_camera *newer,
                   enum monge_change_kind *kind);

/* Whether more has changed than the camera, and lights and settings where both tell theirs. */
bool camera_others_changed(const struct monge_layers *older, const struct monge_layers *newer);

#endif
