/* What a scene has become, in numbers. */
#ifndef MONGE_RENDER_INFO_H
#define MONGE_RENDER_INFO_H

#include "accel/accel.h"
#include "scene/outline.h"
#include "scene/scene.h"

/* How often something is in the scene. */
struct info_count {
    uint64_t stored; /* as it is kept: what is in a geometry once */
    uint64_t placed; /* with all instances carried out; UINT64_MAX: that or more */
};

/* What a template costs: without the templates that it uses, so that the parts add up. */
struct info_template {
    const char *name;
    uint64_t uses; /* with all instances carried out */
    struct info_count primitives;
    uint64_t bytes; /* of the primitives, without their hierarchy */
};

enum { INFO_KINDS = 256 };

struct info {
    struct info_count all, kinds[INFO_KINDS]; /* primitives; by kind of the grammar */
    struct info_count instances;
    struct info_count *materials;    /* of each; slots as the instances have them */
    struct info_template *templates; /* of each of the scene's that is used */
    uint32_t template_count;
    uint64_t scene_bytes, accel_bytes;
};

/* Counts; the arrays live in the arena. */
struct info info_count(const struct scene *scene, struct arena *arena);

/* For people, and as a JSON object. `outline` may be NULL. */
void info_print(const struct info *info, const struct scene *scene, const struct accel *accel,
                const struct outline *outline, FILE *out);
void info_write_json(const struct info *info, const struct scene *scene, const struct accel *accel,
                     const struct outline *outline, FILE *out);

#endif
