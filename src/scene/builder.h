/* What the files that build a scene share; for scene/ alone. */
#ifndef MONGE_SCENE_BUILDER_H
#define MONGE_SCENE_BUILDER_H

#include "scene/scene.h"

struct builder {
    struct arena *arena;
    struct diagnostics *diag;
    struct scene *scene;
    uint32_t material_room, info_room, sphere_room, flat_room, quadric_room; /* of the arrays */
    uint32_t default_material; /* its index once it is needed; else NO_MATERIAL */
};

enum { NO_MATERIAL = UINT32_MAX };

/* Room for one more in an array of `count`: doubles it in the arena when full. */
void *builder_grow(struct builder *b, void *array, uint32_t count, uint32_t *room, size_t size);

/* The transform that a list of steps makes, the first step applied first. Singular ones are reported:
 * false, and *out is untouched. */
bool transform_build(struct builder *b, struct object_list steps, affine *out);

/* Settings, camera and lights of the file; mistakes are reported. */
void settings_build(struct builder *b, const struct object_value *file);
void camera_build(struct builder *b, const struct object_value *file);
void lights_build(struct builder *b, const struct object_value *file);

/* Warns where no light reaches any object; after all of them are built. */
void lights_check(struct builder *b, const struct object_value *file);

/* All named materials of the file, in its order: the index of each is its `definition`. */
void materials_build(struct builder *b, const struct object_value *file);

/* The index of the material that an object is given, or that it has by default (NULL). */
uint32_t material_index(struct builder *b, const struct object_value *material);

/* Adds the primitive of a shape (`shape`: a mapping of kind sphere, box, ...), with
 * world_from_node the transform of the node that has it. `bounds`: the node's, or NULL. */
void shape_build(struct builder *b, const struct object_value *shape, const struct object_value *bounds,
                 affine world_from_node, uint32_t material);

#endif
