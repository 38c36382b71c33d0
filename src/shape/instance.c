/* From the space of a geometry to that around its instance. */
#include "shape/numeric.h"
#include "shape/shape.h"

static vec3 box_size(box3 box) { return box3_is_bounded(box) ? vec3_sub(box.max, box.min) : (vec3){0, 0, 0}; }

/* The next ray goes to object space by object_from_world. Where that takes the point is seen; with its
 * rounding, all along the ray, it is counted along the object's normal, and divided by how fast a step
 * along the world's normal moves there: |normal| before it is unit. */
struct surface shape_placed_surface(const struct instance *instance, const struct surface *surface,
                                    box3 extent) {
    const affine *object_from_world = &instance->object_from_world;
    const vec3 point = affine_point(&instance->world_from_object, surface->point);
    const vec3 normal = affine_normal(object_from_world, surface->normal);
    const vec3 off = vec3_sub(affine_point(object_from_world, point), surface->point);
    const vec3 far = vec3_add(vec3_abs(point), map_size(&instance->world_from_object, box_size(extent)));
    const vec3 rounding = affine_magnitude(object_from_world, far);
    const double noise =
        fabs(vec3_dot(surface->normal, off)) + ROUNDING * vec3_dot(vec3_abs(surface->normal), rounding);
    return (struct surface){point, vec3_normalize(normal), (surface->error + noise) / vec3_length(normal)};
}
