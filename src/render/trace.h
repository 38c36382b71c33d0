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

/* What a camera ray meets first. */
struct sight {
    struct hit hit;
    struct surface surface;
    vec3 normal; /* world space, unit, on the side that is shaded */
};

/* False, with *out untouched, where the ray meets nothing. Its direction need not be unit. */
bool trace_sight(const struct tracer *tracer, ray r, struct tracing *tracing, struct sight *out);

/* Which of the first `count` lights, at most 64, reach it from the side that is shaded, in full or in part: a bit
 * 1 << i for light i. Whatever the settings are. */
uint64_t trace_lights(const struct tracer *tracer, const struct sight *sight, uint32_t count,
                      struct tracing *tracing);

#endif
