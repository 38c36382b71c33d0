/* Follows rays and shades what they hit: Whitted's recursion with Phong's model. */
#ifndef MONGE_RENDER_TRACE_H
#define MONGE_RENDER_TRACE_H

#include "accel/accel.h"
#include "render/media.h"

/* What all rays of a picture share. Constant while it is rendered. */
struct tracer {
    const struct scene *scene;
    const struct accel *accel;
    struct monge_settings settings;
    const struct light *lights; /* point lights alone */
    uint32_t light_count;
    vec3 ambient; /* the sum of the ambient lights */
};

/* What a thread has of its own. */
struct tracing {
    uint64_t rays[MONGE_RAY_KINDS]; /* counts */
    struct accel_watch watch;
};

/* The linear colour seen along the ray, whose direction need not be unit; of no meaning once the watch has
 * stopped. `media` is what its origin is inside of. */
vec3 trace_ray(const struct tracer *tracer, ray r, const struct media *media, struct tracing *tracing);

#endif
