#include "render/media.h"

#include "shape/shape.h"

double media_index(const struct media *media) { return media->count ? media->inside[media->count - 1].index : 1.0; }

static const struct flat *as_plane(const struct primitives *p, primitive_ref ref) {
    if (primitive_ref_kind(ref) != PRIMITIVE_FLAT) return NULL;
    const struct flat *flat = &p->flats[primitive_ref_index(ref)];
    return flat->outline == FLAT_PLANE ? flat : NULL;
}

static bool divides_space(const struct primitives *p, primitive_ref ref) {
    return as_plane(p, ref) || shape_is_solid(p, ref);
}

static double index_of(const struct scene *scene, uint32_t number) {
    return scene->materials[scene->primitives.info[number].material].index;
}

struct media media_enter(const struct scene *scene, const struct media *media, uint32_t number) {
    struct media after = *media;
    if (after.count == MEDIA_MAX || !divides_space(&scene->primitives, scene->primitives.info[number].ref)) return after;
    after.inside[after.count].number = number;
    after.inside[after.count++].index = index_of(scene, number);
    return after;
}

struct media media_leave(const struct media *media, uint32_t number, bool *was_inside) {
    struct media after = {0};
    int last = media->count - 1;
    while (last >= 0 && media->inside[last].number != number) last--;
    for (int i = 0; i < media->count; i++)
        if (i != last) after.inside[after.count++] = media->inside[i];
    *was_inside = last >= 0;
    return after;
}

uint32_t *media_candidates(struct arena *arena, const struct scene *scene, uint32_t *count) {
    const struct primitives *p = &scene->primitives;
    uint32_t *numbers = NULL;
    *count = 0;
    for (int pass = 0; pass < 2; pass++) {
        if (pass) numbers = arena_array(arena, *count ? *count : 1, sizeof *numbers);
        uint32_t found = 0;
        for (uint32_t i = 0; i < p->count; i++) {
            if (!(vec3_max_abs(scene->materials[p->info[i].material].refraction) > 0.0)) continue;
            if (!divides_space(p, p->info[i].ref)) continue;
            if (pass) numbers[found] = i;
            found++;
        }
        *count = found;
    }
    return numbers;
}

/* How far along the ray the body ends; negative when its origin is not inside of it. */
static double exit_distance(const struct primitives *p, primitive_ref ref, ray r) {
    const struct flat *plane = as_plane(p, ref);
    const bool inside = plane ? affine_point(&plane->object_from_world, r.org).z < 0.0 : shape_contains(p, ref, r.org);
    struct crossing out;
    if (!inside) return -1.0;
    return shape_first_crossing(p, ref, r, 0.0, INFINITY, &out) ? out.t : INFINITY;
}

struct media media_at(const struct scene *scene, const uint32_t *candidates, uint32_t count, ray r) {
    struct media media = {0};
    double end[MEDIA_MAX]; /* of each in the list, falling */
    for (uint32_t i = 0; i < count; i++) {
        const double distance = exit_distance(&scene->primitives, scene->primitives.info[candidates[i]].ref, r);
        if (distance < 0.0) continue;
        int at = media.count;
        while (at > 0 && end[at - 1] < distance) at--;
        if (media.count == MEDIA_MAX && at == 0) continue;
        const int first = media.count == MEDIA_MAX ? (at--, 0) : -1; /* full: the outermost gives way */
        if (first == 0)
            for (int j = 0; j < at; j++) media.inside[j] = media.inside[j + 1], end[j] = end[j + 1];
        else
            for (int j = media.count++; j > at; j--) media.inside[j] = media.inside[j - 1], end[j] = end[j - 1];
        media.inside[at].number = candidates[i];
        media.inside[at].index = index_of(scene, candidates[i]);
        end[at] = distance;
    }
    return media;
}
