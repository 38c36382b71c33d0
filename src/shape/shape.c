#include "shape/shape.h"

#include "shape/flat.h"
#include "shape/quadric.h"
#include "shape/sphere.h"

int shape_crossings(const struct primitives *p, primitive_ref ref, ray r,
                    struct crossing out[SHAPE_MAX_CROSSINGS]) {
    const uint32_t index = primitive_ref_index(ref);
    switch (primitive_ref_kind(ref)) {
    case PRIMITIVE_SPHERE: return sphere_crossings(&p->spheres[index], r, out);
    case PRIMITIVE_FLAT: return flat_first_crossing(&p->flats[index], r, -INFINITY, INFINITY, out) ? 1 : 0;
    case PRIMITIVE_INSTANCE: return 0;
    case PRIMITIVE_QUADRIC: break;
    }
    return quadric_crossings(&p->quadrics[index], r, out);
}

bool shape_first_crossing(const struct primitives *p, primitive_ref ref, ray r, double t_min, double t_max,
                          struct crossing *out) {
    const uint32_t index = primitive_ref_index(ref);
    switch (primitive_ref_kind(ref)) {
    case PRIMITIVE_SPHERE: return sphere_first_crossing(&p->spheres[index], r, t_min, t_max, out);
    case PRIMITIVE_FLAT: return flat_first_crossing(&p->flats[index], r, t_min, t_max, out);
    case PRIMITIVE_INSTANCE: return false;
    case PRIMITIVE_QUADRIC: break;
    }
    return quadric_first_crossing(&p->quadrics[index], r, t_min, t_max, out);
}

struct surface shape_surface(const struct primitives *p, primitive_ref ref, ray r, struct crossing crossing) {
    const uint32_t index = primitive_ref_index(ref);
    switch (primitive_ref_kind(ref)) {
    case PRIMITIVE_SPHERE: return sphere_surface(&p->spheres[index], r, crossing.t);
    case PRIMITIVE_FLAT: return flat_surface(&p->flats[index], r, crossing.t);
    case PRIMITIVE_INSTANCE:
        return (struct surface){ray_at(r, crossing.t), vec3_neg(vec3_normalize(r.dir)), 0.0};
    case PRIMITIVE_QUADRIC: break;
    }
    return quadric_surface(&p->quadrics[index], r, crossing);
}

bool shape_is_solid(const struct primitives *p, primitive_ref ref) {
    switch (primitive_ref_kind(ref)) {
    case PRIMITIVE_SPHERE: return true;
    case PRIMITIVE_FLAT: return false;
    case PRIMITIVE_INSTANCE: return false;
    case PRIMITIVE_QUADRIC: break;
    }
    return !p->quadrics[primitive_ref_index(ref)].form->open;
}

bool shape_contains(const struct primitives *p, primitive_ref ref, vec3 point) {
    const uint32_t index = primitive_ref_index(ref);
    switch (primitive_ref_kind(ref)) {
    case PRIMITIVE_SPHERE: return sphere_contains(&p->spheres[index], point);
    case PRIMITIVE_FLAT: return false;
    case PRIMITIVE_INSTANCE: return false;
    case PRIMITIVE_QUADRIC: break;
    }
    return quadric_contains(&p->quadrics[index], point);
}
