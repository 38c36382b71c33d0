/* The layers of a picture: what the ray through the centre of each pixel meets first.
 *
 *     ids[OBJECT]   [0][3][3][7] ...      a number for each pixel, the same whatever region is rendered
 *     entries       [3: "lid"][7: box]    what those that are there stand for, by number
 */
#ifndef MONGE_RENDER_LAYERS_H
#define MONGE_RENDER_LAYERS_H

#include "accel/accel.h"
#include "monge.h"
#include "render/camera.h"
#include "scene/scene.h"

struct layer_entries {
    struct monge_entry *list; /* by id, those in the picture alone; in the layers' arena, as their texts */
    uint32_t count;
    uint32_t highest; /* id that any pixel of the whole picture could have */
};

/* Where a picture is seen from, with hashes in text of what made it. */
struct layer_camera {
    struct monge_entry entry;     /* kind NULL: not known; file NULL: the scene gives none */
    struct view view;             /* its distance is not kept in files */
    char given[HASH_TEXT_SIZE];   /* what the scene says of the camera */
    char others[HASH_TEXT_SIZE];  /* the rest of the scene, and the settings */
    char objects[HASH_TEXT_SIZE]; /* of these the shapes with their materials; "": not known */
};

/* A light; the default ones are one, of no place and no colour, as they follow the camera. */
struct layer_light {
    struct monge_entry
        entry;      /* kind "point light", "ambient light" or "default lights"; file NULL: the latter */
    vec3 at, color; /* as the scene has them; at: 0 of an ambient one */
};

/* What the scene or the command line can say of the image or the rendering, but for the size: by the key's name. */
struct layer_setting {
    const char *name, *value;
};

enum { LAYER_LIGHTS_MOST = 500, LAYER_SETTINGS_MOST = 64 };

/* What all objects of a picture are rendered under, beside the camera; in the layers' arena. */
struct layer_conditions {
    struct layer_light
        *lights; /* in the order of the scene; NULL: not known, or more than LAYER_LIGHTS_MOST */
    uint32_t light_count;
    struct layer_setting *settings; /* NULL: not known */
    uint32_t setting_count;
};

struct monge_layers {
    unsigned set;               /* of which the arrays below are there; the others are NULL */
    uint32_t width, height;     /* of the whole picture */
    struct monge_region region; /* the arrays have its pixels, row by row from the top left */
    uint32_t *ids[2];           /* object, material: indexed as enum monge_layer */
    struct layer_entries entries[2];
    float *depth; /* as monge.h has them */
    uint16_t *normals;
    uint64_t *lights;
    uint32_t light_count;       /* point lights of the picture */
    char scene[HASH_TEXT_SIZE]; /* the fingerprint of its picture, in text; "": not known */
    struct layer_camera camera;
    struct layer_conditions conditions;
    struct arena arena;
};

/* Layers with nothing in them; NULL when there is no memory. Freed by monge_layers_free. */
struct monge_layers *layers_new(uint32_t width, uint32_t height, struct monge_region region, unsigned set);

/* Makes room for one more layer, of zeros. False: no memory. */
bool layers_add(struct monge_layers *layers, enum monge_layer layer);

static inline size_t layers_pixels(const struct monge_layers *layers) {
    return (size_t)layers->region.width * layers->region.height;
}

/* Fills the layers. False when job->cancel was set before it was done, memory ran out, or the scene is wrong: diag says
 * why, and may be NULL. */
bool render_layers(const struct scene *scene, const struct accel *accel,
                   const struct monge_settings *settings, const struct monge_job *job,
                   struct monge_layers *layers, struct diagnostics *diag);

#endif
