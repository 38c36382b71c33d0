/* What the files that build a scene share; for scene/ alone. */
#ifndef MONGE_SCENE_BUILDER_H
#define MONGE_SCENE_BUILDER_H

#include "base/table.h"
#include "scene/scene.h"

/* A group or template that is open: where its members stand, and their material if they have none. */
struct level {
    affine world_from_node; /* world: of the set that is filled */
    const struct object_value *material;
    const struct object_value *use; /* that placed the level; NULL: a group */
    struct placed *placed;          /* of a use whose objects are gathered; else NULL */
    const char *name;               /* the innermost around; NULL: none */
    uint32_t template;              /* the innermost around, or ORIGIN_NO_TEMPLATE */
    uint32_t object;                /* that its members belong to, or ORIGIN_NO_OBJECT */
    bool named_in_list;             /* `object` has a name outside of all templates: it stays */
    const struct object_value *own; /* material that was given here; NULL: none */
    struct span own_span;
    uint32_t count; /* of primitives in the set before it was opened */
    struct level *outer;
};

/* A set of primitives that is being filled: the scene's, or a geometry's. */
struct set {
    struct primitives primitives;
    uint32_t info_room, sphere_room, flat_room, quadric_room, instance_room, use_room; /* of the arrays */
    struct set *outer;
};

struct builder {
    struct arena *arena; /* of the scene */
    struct diagnostics *diag;
    struct scene *scene;
    struct set *set, *free_sets;
    struct level *level, *free_levels;
    struct table placed, geometries, inline_materials; /* by their contents */
    uint32_t *named_materials, named_room;             /* index into the scene's materials by definition */
    uint32_t material_room, material_info_room, geometry_room, template_room;
    uint32_t origin, object;   /* of what is placed now */
    uint32_t default_material; /* its index once it is needed; else NO_MATERIAL */
    uint32_t *geometry_height, *geometry_weight, height_room,
        weight_room;   /* of each geometry, see instances.c */
    struct set marked; /* at the mark: its counts */
    uint32_t marked_geometries;
};

#define NO_MATERIAL (UINT32_MAX - 1)

/* While a set is gathered: the material that the instance will have where it stands. */
#define MATERIAL_INHERITED UINT32_MAX

/* Room for one more in an array of `count` in the scene's arena, twice as much when it is full. */
void *builder_grow(struct builder *b, void *array, uint32_t count, uint32_t *room, size_t size);

/* The transform that a list of steps makes, the first step applied first. Singular ones are reported and left out. */
affine transform_build(struct builder *b, struct object_list steps);

/* Settings, camera and lights of the file; mistakes are reported. */
void settings_build(struct builder *b, const struct object_value *file);
void camera_build(struct builder *b, const struct object_value *file);
void lights_build(struct builder *b, const struct object_value *file);

/* Warns where no light reaches any object; after all of them are built. */
void lights_check(struct builder *b, const struct object_value *file);

/* The index of the material that an object is given, or that it has by default (NULL). */
uint32_t material_index(struct builder *b, const struct object_value *material);

/* Adds a material that has a name, whether or not an object has it, so that its mistakes are reported. */
void material_add_named(struct builder *b, const struct object_value *material);

/* Remembers that a group with members has the material. */
void material_hold(struct builder *b, const struct object_value *material, struct span span);

/* Warns of materials of groups that none of the members takes; after all objects are built. */
void materials_check(struct builder *b);

/* Adds the primitive of a shape (`shape`: a mapping of kind sphere, box, ...), with
 * world_from_node the transform of the node that has it. `bounds`: the node's, or NULL. */
void shape_build(struct builder *b, const struct object_value *shape, const struct object_value *bounds,
                 affine world_from_node, uint32_t material);

/* Adds an instance of a geometry of the scene, whose slots get the materials. */
void instance_add(struct builder *b, struct span span, affine world_from_object, uint32_t geometry,
                  const uint32_t *materials);

/* ---- places.c: where things were written ---- */

/* What is placed from now on comes from this object: a shape within the level, or the use that has opened it. */
void place_origin(struct builder *b, const struct object_value *object);

/* The index of the object that this one within the level is, or belongs to. */
uint32_t place_object(struct builder *b, const struct object_value *object);

/* The index of the template that is used, with its name in the scene. */
uint32_t place_template(struct builder *b, const struct object_value *use);

/* Makes all places of the scene outlive the load. */
void places_keep(struct builder *b);

/* ---- instances.c: what becomes of a template in use ---- */

enum lang_use instances_open(struct builder *b, const struct object_value *object,
                             const struct hash *contents, bool exact);
bool instances_close(struct builder *b);

/* Forgets what was gathered since there were `geometries` of them. */
void instances_take_back(struct builder *b, uint32_t geometries);

/* Opens a level for the members of a group or of a use. */
void level_open(struct builder *b, const struct object_value *object, struct placed *placed);

/* Opens this level, of which `outer` is set here. */
void level_push(struct builder *b, struct level level);
void level_close(struct builder *b);

#endif
