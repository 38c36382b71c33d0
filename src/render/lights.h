/* The lights of a picture, with the default ones where the scene names none. */
#ifndef MONGE_RENDER_LIGHTS_H
#define MONGE_RENDER_LIGHTS_H

#include "render/camera.h"
#include "render/trace.h"

/* Sets the point lights, which live in the arena, and the ambient light of the tracer. Its scene is set. */
void lights_set(struct tracer *tracer, struct arena *arena, const struct view *view);

#endif
