#include "render/media.h"

#include <string.h>

double media_index(const struct media *media) {
    return media->count ? media->inside[media->count - 1].index : 1.0;
}

static const struct flat *as_plane(const struct primitives *p, primitive_ref ref) {
    if (primitive_ref_kind(ref) != PRIMITIVE_FLAT) return NULL;
    const struct flat *flat = &p->flats[primitive_ref_index(ref)];
    return flat->outline == FLAT_PLANE ? flat : NULL;
}

static bool divides_space(const struct primitives *p, primitive_ref ref) {
    return as_plane(p, ref) || shape_is_solid(p, ref);
}

struct media media_enter(const struct scene *scene, const struct media *media, const struct hit *hit) {
    struct media after = *media;
    if (after.count == MEDIA_MAX || !divides_space(hit->set, hit->ref)) return after;
    after.inside[after.count].which = &hit->which;
    after.inside[after.count++].index = scene->materials[hit->material].index;
    return after;
}

struct media media_leave(const struct media *media, const struct hit *hit, bool *was_inside) {
    struct media after = {0};
    int last = media->count - 1;
    while (last >= 0 && !occurrence_equal(media->inside[last].which, &hit->which)) last--;
    for (int i = 0; i < media->count; i++)
        if (i != last) after.inside[after.count++] = media->inside[i];
    *was_inside = last >= 0;
    return after;
}

/* ---- Where a path begins ---- */

/* The bodies around the origin of a ray so far, outermost first. */
struct nesting {
    int count;
    struct body {
        double end; /* how far along the ray it ends */
        struct occurrence which;
        double index;
    } bodies[MEDIA_MAX + 1]; /* one more, until the outermost is forgotten */
    const struct scene *scene;
};

/* How far along the ray the body ends; 0 when its origin is not inside of it. */
static double exit_distance(const struct primitives *p, primitive_ref ref, ray r) {
    const struct flat *plane = as_plane(p, ref);
    const bool inside =
        plane ? affine_point(&plane->object_from_world, r.org).z < 0.0 : shape_contains(p, ref, r.org);
    struct crossing out;
    if (!inside) return 0.0;
    return shape_first_crossing(p, ref, r, 0.0, INFINITY, &out) ? out.t : INFINITY;
}

/* Of two that are not the same: they differ before either ends, as an instance and a body have not one number. */
static bool occurrence_before(const struct occurrence *a, const struct occurrence *b) {
    uint32_t i = 0;
    while (a->number[i] == b->number[i]) i++;
    return a->number[i] < b->number[i];
}

static bool is_inside_of(const struct body *a, double end, const struct occurrence *which) {
    return a->end < end || (a->end == end && occurrence_before(which, &a->which));
}

static void add_body(void *context, const struct hit *hit, ray in_set) {
    struct nesting *n = context;
    const double end = exit_distance(hit->set, hit->ref, in_set);
    if (end == 0.0) return;
    int at = n->count++;
    for (; at > 0 && is_inside_of(&n->bodies[at - 1], end, &hit->which); at--)
        n->bodies[at] = n->bodies[at - 1];
    n->bodies[at] = (struct body){end, hit->which, n->scene->materials[hit->material].index};
    if (n->count <= MEDIA_MAX) return;
    n->count = MEDIA_MAX; /* the outermost gives way */
    memmove(n->bodies, n->bodies + 1, MEDIA_MAX * sizeof *n->bodies);
}

void media_at(const struct scene *scene, const struct accel *accel, struct accel_watch *watch, ray r,
              struct media_origin *out) {
    struct nesting nesting;
    nesting.count = 0;
    nesting.scene = scene;
    accel_around(accel, watch, r, add_body, &nesting);
    out->media.count = nesting.count;
    for (int i = 0; i < nesting.count; i++) {
        out->occurrences[i] = nesting.bodies[i].which;
        out->media.inside[i].which = &out->occurrences[i];
        out->media.inside[i].index = nesting.bodies[i].index;
    }
}
