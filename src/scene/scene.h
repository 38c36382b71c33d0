/* A scene, ready to be rendered: settings, camera, lights, materials and flat arrays of primitives.
 * Everything is in world space and belongs to the arena of the load. */
#ifndef MONGE_SCENE_SCENE_H
#define MONGE_SCENE_SCENE_H

#include "base/diag.h"
#include "base/hash.h"
#include "lang/lang.h"
#include "monge.h"
#include "scene/origin.h"
#include "scene/primitive.h"

/* What the file says of the camera; what it leaves open, render/ decides from the scene's bounds. */
struct camera {
    enum camera_projection { CAMERA_PERSPECTIVE, CAMERA_ORTHOGRAPHIC } projection;
    bool has_eye, has_look_at, has_direction, has_up, has_height;
    vec3 eye, look_at; /* world-space points */
    vec3 direction;    /* world space, any length but zero */
    vec3 up;           /* world space, any length but zero */
    double fov_deg;    /* vertical, 0 < fov < 180; perspective */
    double height;     /* of the view in world units, > 0; orthographic */
};

/* What a ray sees that hits nothing: `bottom` straight down to `top` straight up; equal for a flat one. */
struct background {
    vec3 bottom, top; /* linear colour */
};

struct light {
    enum light_kind { LIGHT_AMBIENT, LIGHT_POINT } kind;
    vec3 at;    /* world space; point */
    vec3 color; /* linear, >= 0 */
};

/* Phong's model. Colours are linear and >= 0. */
struct material {
    vec3 ambient, diffuse, specular;
    double shininess;            /* the highlight's exponent, >= 0 */
    vec3 reflection, refraction; /* factors of the secondary rays, sum of each channel <= 1 */
    double index;                /* of refraction, relative to vacuum, > 0 */
};

/* A material as its author knows it. */
struct material_info {
    const char *name; /* NULL: written where it is used, or the default one */
    struct span span; /* source NULL: the default one */
    bool given;       /* an object has it, its own or from around; not just another material */
    struct span held; /* a group that has it and members; source NULL: none */
};

struct scene {
    struct monge_settings settings; /* as the file has them */
    bool two_sided;                 /* normals are turned towards the viewer before shading */
    bool highlight_always;          /* the highlight is not gated by N.L > 0 */
    struct background background;
    struct camera camera;
    bool default_lights; /* the file names none: render/ adds a key and a fill light */
    struct light *lights;
    uint32_t light_count;
    struct material *materials;
    uint32_t material_count;
    struct primitives primitives;
    struct primitives *geometries; /* what instances place; each holds instances of earlier ones alone */
    uint32_t geometry_count;
    struct origins origins;              /* of primitives, and the files of all places below */
    struct material_info *material_info; /* of each material */
    struct span camera_place;            /* of all of the camera; source NULL: the file has none */
    struct span camera_span;   /* of what says where it looks; else of the camera, or of the scene */
    struct span eye_span;      /* of the camera's eye where it has one */
    struct span *light_places; /* of all of each light */
    struct span *light_spans;  /* of each light's place or colour */
    const char **templates;    /* names, by number; NULL where not used */
    uint32_t template_count;
};

/* Building a scene: *sink takes its objects while they are read (lang_read), scene_end the rest. Shapes
 * are in the order of the file; groups and transforms are flattened. scene_end: false when something is
 * wrong: reported to `diag`, nothing usable in *scene. All of *scene lives in `arena`. */
struct builder *scene_begin(struct arena *arena, struct diagnostics *diag, struct scene *scene,
                            struct lang_sink *sink);
bool scene_end(struct builder *builder, const struct lang_result *description);

/* Another frame of a scene whose objects and materials stay: makes its settings, camera and lights anew, the
 * lights in `arena`. False: reported, and *scene is as it was. */
bool scene_view(struct arena *arena, struct diagnostics *diag, const struct object_value *file,
                struct scene *scene);

/* Whether the hierarchies of one serve the other: the same primitives, bit by bit, and materials of which
 * the same are clear. */
bool scene_same_shapes(const struct scene *a, const struct scene *b);

/* Adds the shapes of a set to the hash, and their materials by number. */
void primitives_hash(const struct primitives *p, const struct primitives *geometries, struct hash *hash);

/* Adds what the file says of the camera to the hash. */
void camera_hash(const struct camera *camera, struct hash *hash);

/* Adds what a material is to the hash. */
void material_hash(const struct material *material, struct hash *hash);

/* Adds what a primitive is, in its place, to the hash: equal for two that meet every ray alike. */
void shape_hash(const struct primitives *p, primitive_ref ref, struct hash *hash);

/* "a sphere": what a kind of an origin is called. */
const char *scene_kind_title(uint32_t kind);

/* The same as a word of the language: "sphere". */
const char *scene_kind_name(uint32_t kind);

/* Adds everything of the scene that can change a pixel, except the settings, to the hash. */
void scene_hash(const struct scene *scene, struct hash *hash);

#endif
