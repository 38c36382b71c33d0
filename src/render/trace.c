#include "render/trace.h"

#include "base/elementary.h"

/* A path whose light would be scaled by less than this is followed no further: it cannot change a
 * channel of 16 bits, and it bounds the tree of rays. */
static const double least_weight = 1e-5;

/* One path through the tree of rays. */
struct path {
    const struct tracer *tracer;
    struct tracing *tracing;
    const struct media *media; /* at the origin of its ray */
    unsigned depth;            /* generation of its ray, from 1 */
    vec3 weight;               /* by which its light reaches the pixel */
};

static vec3 follow(struct path *path, ray r);

static vec3 background_color(const struct background *background, vec3 unit_dir) {
    const double up = 0.5 * (1.0 + unit_dir.y);
    return vec3_madd(vec3_scale(background->bottom, 1.0 - up), up, background->top);
}

/* The part of each channel that reaches `to` from `from` through what stands between: 0 behind
 * anything opaque, times the `refraction` of every surface passed. Both points are left out. */
static vec3 transmittance(const struct path *path, vec3 from, vec3 to) {
    const struct tracer *tracer = path->tracer;
    const struct scene *scene = tracer->scene;
    const ray r = {from, vec3_sub(to, from)};
    const double before_one = 1.0 - 0x1p-53;
    path->tracing->rays[MONGE_RAY_SHADOW]++;
    if (accel_any(tracer->accel, &path->tracing->watch, r, 0.0, 1.0)) return vec3_all(0.0);
    vec3 through = vec3_all(1.0);
    struct hit hit;
    hit.crossing.t = 0.0;
    while (accel_nearest_clear(tracer->accel, &path->tracing->watch, r, hit.crossing.t, before_one, &hit)) {
        through = vec3_mul(through, scene->materials[hit.material].refraction);
        if (vec3_max_abs(through) < least_weight) return vec3_all(0.0);
    }
    return through;
}

/* Where a ray met a surface, and what the shading needs of it. Directions are unit. */
struct meeting {
    struct surface surface;
    const struct material *material;
    vec3 dir;     /* of the ray that came */
    bool outside; /* it came from the side that the normal points to */
};

/* The surface's point, moved by its error to the side that `normal` points to. */
static vec3 leave_point(const struct meeting *m, vec3 normal) {
    return vec3_madd(m->surface.point, m->surface.error, normal);
}

/* The normal, turned to the viewer where both sides are shaded alike. */
static vec3 shaded_normal(const struct tracer *tracer, const struct meeting *m) {
    return !m->outside && tracer->scene->two_sided ? vec3_neg(m->surface.normal) : m->surface.normal;
}

/* The part of a light that reaches the surface; `to_light` is of any length. */
static vec3 light_reaching(const struct path *path, const struct meeting *m, vec3 to_light,
                           const struct light *light) {
    const double side = vec3_dot(m->surface.normal, to_light) > 0.0 ? 1.0 : -1.0;
    return transmittance(path, leave_point(m, vec3_scale(m->surface.normal, side)), light->at);
}

/* cosine to the power of the exponent, for a cosine of 0..1. Nothing where that is less than
 * exp(-40), by cosine^n <= exp(-n (1 - cosine)): most of a surface is far from its highlight. */
static double highlight_power(double cosine, double exponent) {
    return exponent * (1.0 - cosine) < 40.0 ? elementary_pow(cosine, exponent) : 0.0;
}

/* The light that one point light adds at a meeting. */
static vec3 shade_light(const struct path *path, const struct meeting *m, vec3 normal,
                        const struct light *light) {
    const struct tracer *tracer = path->tracer;
    const vec3 to_light = vec3_normalize(vec3_sub(light->at, m->surface.point));
    const double cosine = vec3_dot(normal, to_light);
    vec3 color = vec3_scale(m->material->diffuse, cosine > 0.0 ? cosine : 0.0);
    if (tracer->settings.shading == MONGE_SHADING_PHONG &&
        (cosine > 0.0 || tracer->scene->highlight_always)) {
        const vec3 mirrored = vec3_sub(vec3_scale(normal, 2.0 * cosine), to_light);
        const double highlight = -vec3_dot(mirrored, m->dir);
        if (highlight > 0.0)
            color =
                vec3_madd(color, highlight_power(highlight, m->material->shininess), m->material->specular);
    }
    if (!(vec3_max_abs(color) > 0.0)) return color;
    color = vec3_mul(color, light->color);
    const double shadow = tracer->settings.shadow;
    if (shadow >= 1.0) return color;
    const vec3 lit = light_reaching(path, m, to_light, light);
    return vec3_mul(color, vec3_madd(vec3_all(shadow), 1.0 - shadow, lit));
}

static vec3 shade_local(const struct path *path, const struct meeting *m) {
    const vec3 normal = shaded_normal(path->tracer, m);
    vec3 color = vec3_mul(m->material->ambient, path->tracer->ambient);
    for (uint32_t i = 0; i < path->tracer->light_count; i++)
        color = vec3_add(color, shade_light(path, m, normal, &path->tracer->lights[i]));
    return color;
}

/* What a secondary ray brings, times `factor`. `media` is at the ray's origin. */
static vec3 follow_secondary(const struct path *from, ray r, vec3 factor, const struct media *media,
                             enum monge_ray kind) {
    struct path path = {from->tracer, from->tracing, media, from->depth + 1, vec3_mul(from->weight, factor)};
    if (vec3_max_abs(path.weight) < least_weight) return vec3_all(0.0);
    path.tracing->rays[kind]++;
    return vec3_mul(factor, follow(&path, r));
}

/* Snell's law: the unit direction of the ray that goes on through a surface from index n1 to n2.
 * `toward` is the unit normal on the side the ray came from. False at total internal reflection. */
static bool refract(vec3 dir, vec3 toward, double n1, double n2, vec3 *out) {
    const double ratio = n1 / n2, cosine = -vec3_dot(dir, toward);
    const double rest = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
    if (!(rest >= 0.0)) return false;
    *out = vec3_madd(vec3_scale(dir, ratio), ratio * cosine - sqrt(rest), toward);
    return true;
}

/* Reflected and refracted light. Total internal reflection mirrors what would have been refracted. */
static vec3 shade_secondary(const struct path *path, const struct meeting *m, const struct hit *hit) {
    const struct material *material = m->material;
    const vec3 toward = m->outside ? m->surface.normal : vec3_neg(m->surface.normal);
    vec3 mirrored = material->reflection, color = vec3_all(0.0);
    if (vec3_max_abs(material->refraction) > 0.0) {
        bool was_inside = true;
        const struct media beyond = m->outside ? media_enter(path->tracer->scene, path->media, hit)
                                               : media_leave(path->media, hit, &was_inside);
        const double n1 = m->outside || was_inside ? media_index(path->media) : material->index;
        const double n2 = m->outside ? material->index : media_index(&beyond);
        vec3 dir;
        if (refract(m->dir, toward, n1, n2, &dir)) {
            const ray r = {leave_point(m, vec3_neg(toward)), dir};
            color = follow_secondary(path, r, material->refraction, &beyond, MONGE_RAY_REFRACTION);
        } else {
            mirrored = vec3_add(mirrored, material->refraction);
        }
    }
    if (!(vec3_max_abs(mirrored) > 0.0)) return color;
    const vec3 dir = vec3_madd(m->dir, -2.0 * vec3_dot(m->dir, toward), toward);
    const ray r = {leave_point(m, toward), dir};
    return vec3_add(color, follow_secondary(path, r, mirrored, path->media, MONGE_RAY_REFLECTION));
}

static vec3 follow(struct path *path, ray r) {
    const struct tracer *tracer = path->tracer;
    const struct scene *scene = tracer->scene;
    struct hit hit;
    if (!accel_nearest(tracer->accel, &path->tracing->watch, r, 0.0, INFINITY, &hit))
        return background_color(&scene->background, vec3_normalize(r.dir));
    struct meeting m = {.surface = accel_surface(tracer->accel, r, &hit),
                        .material = &scene->materials[hit.material],
                        .dir = vec3_normalize(r.dir)};
    if (tracer->settings.shading == MONGE_SHADING_SIGNATURE) return m.material->diffuse;
    m.outside = vec3_dot(m.dir, m.surface.normal) < 0.0;
    const vec3 local = shade_local(path, &m);
    if (tracer->settings.shading != MONGE_SHADING_PHONG || path->depth >= tracer->settings.depth)
        return local;
    return vec3_add(local, shade_secondary(path, &m, &hit));
}

vec3 trace_ray(const struct tracer *tracer, ray r, const struct media *media, struct tracing *tracing) {
    struct path path = {tracer, tracing, media, 1, vec3_all(1.0)};
    tracing->rays[MONGE_RAY_CAMERA]++;
    return follow(&path, r);
}

bool trace_sight(const struct tracer *tracer, ray r, struct tracing *tracing, struct sight *out) {
    struct sight sight;
    if (!accel_nearest(tracer->accel, &tracing->watch, r, 0.0, INFINITY, &sight.hit)) return false;
    sight.surface = accel_surface(tracer->accel, r, &sight.hit);
    const struct meeting m = {.surface = sight.surface,
                              .outside = vec3_dot(r.dir, sight.surface.normal) < 0.0};
    sight.normal = shaded_normal(tracer, &m);
    *out = sight;
    return true;
}

uint64_t trace_lights(const struct tracer *tracer, const struct sight *sight, uint32_t count,
                      struct tracing *tracing) {
    const struct path path = {.tracer = tracer, .tracing = tracing};
    const struct meeting m = {.surface = sight->surface};
    uint64_t reaching = 0;
    for (uint32_t i = 0; i < count && i < tracer->light_count; i++) {
        const struct light *light = &tracer->lights[i];
        const vec3 to_light = vec3_sub(light->at, sight->surface.point);
        if (!(vec3_dot(sight->normal, to_light) > 0.0)) continue;
        if (vec3_max_abs(light_reaching(&path, &m, to_light, light)) > 0.0) reaching |= (uint64_t)1 << i;
    }
    return reaching;
}
