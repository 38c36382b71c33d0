#include "scene/scene.h"

static void hash_affine(struct hash *hash, const affine *map) {
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 4; column++) hash_double(hash, map->m[row][column]);
}

static void hash_box(struct hash *hash, box3 box) {
    hash_vec3(hash, box.min);
    hash_vec3(hash, box.max);
}

static void hash_form(struct hash *hash, const struct quadric_form *form) {
    const double terms[] = {form->xx, form->yy, form->zz, form->xy, form->yz,
                            form->zx, form->x,  form->y,  form->z,  form->constant};
    for (size_t i = 0; i < sizeof terms / sizeof *terms; i++) hash_double(hash, terms[i]);
    hash_box(hash, form->clip);
    hash_integer(hash, form->open);
}

void camera_hash(const struct camera *camera, struct hash *hash) {
    const bool given[] = {camera->has_eye, camera->has_look_at, camera->has_direction, camera->has_up,
                          camera->has_height};
    for (size_t i = 0; i < sizeof given / sizeof *given; i++) hash_integer(hash, given[i]);
    hash_integer(hash, camera->projection);
    hash_vec3(hash, camera->eye);
    hash_vec3(hash, camera->look_at);
    hash_vec3(hash, camera->direction);
    hash_vec3(hash, camera->up);
    hash_double(hash, camera->fov_deg);
    hash_double(hash, camera->height);
}

void material_hash(const struct material *m, struct hash *hash) {
    const vec3 colors[] = {m->ambient, m->diffuse, m->specular, m->reflection, m->refraction};
    for (size_t i = 0; i < sizeof colors / sizeof *colors; i++) hash_vec3(hash, colors[i]);
    hash_double(hash, m->shininess);
    hash_double(hash, m->index);
}

void shape_hash(const struct primitives *p, primitive_ref ref, struct hash *hash) {
    const uint32_t index = primitive_ref_index(ref);
    switch (primitive_ref_kind(ref)) {
    case PRIMITIVE_SPHERE:
        hash_vec3(hash, p->spheres[index].center);
        hash_double(hash, p->spheres[index].radius);
        return;
    case PRIMITIVE_FLAT:
        hash_affine(hash, &p->flats[index].world_from_object);
        hash_integer(hash, p->flats[index].outline);
        return;
    case PRIMITIVE_INSTANCE:
        hash_affine(hash, &p->instances[index].world_from_object);
        hash_integer(hash, p->instances[index].geometry);
        return;
    case PRIMITIVE_QUADRIC: break;
    }
    hash_affine(hash, &p->quadrics[index].world_from_object);
    hash_form(hash, p->quadrics[index].form);
}

/* A material by its values, a slot by its number; the last one is remembered. */
struct material_hash {
    struct hash hash;
    uint32_t material; /* UINT32_MAX: none yet */
};

static void add_material(struct hash *hash, const struct scene *scene, uint32_t material,
                         struct material_hash *last) {
    if (material != last->material) {
        hash_begin(&last->hash);
        if (material & MATERIAL_SLOT)
            hash_integer(&last->hash, material);
        else
            material_hash(&scene->materials[material], &last->hash);
        last->material = material;
    }
    hash_integer(hash, last->hash.high);
    hash_integer(hash, last->hash.low);
}

/* Materials at each primitive that has them: not by name or number, nor unused ones. */
static void hash_primitives(struct hash *hash, const struct scene *scene, const struct primitives *p) {
    struct material_hash last = {.material = UINT32_MAX};
    hash_integer(hash, p->count);
    for (uint32_t i = 0; i < p->count; i++) {
        const primitive_ref ref = p->info[i].ref;
        uint32_t count;
        const uint32_t *materials = primitives_materials(p, scene->geometries, i, &count);
        for (uint32_t k = 0; k < count; k++) add_material(hash, scene, materials[k], &last);
        hash_integer(hash, ref);
        shape_hash(p, ref, hash);
    }
}

void primitives_hash(const struct primitives *p, const struct primitives *geometries, struct hash *hash) {
    hash_integer(hash, p->count);
    for (uint32_t i = 0; i < p->count; i++) {
        uint32_t count;
        const uint32_t *materials = primitives_materials(p, geometries, i, &count);
        for (uint32_t k = 0; k < count; k++) hash_integer(hash, materials[k]);
        hash_integer(hash, p->info[i].ref);
        shape_hash(p, p->info[i].ref, hash);
    }
}

void scene_hash(const struct scene *scene, struct hash *hash) {
    hash_integer(hash, scene->two_sided);
    hash_integer(hash, scene->highlight_always);
    hash_vec3(hash, scene->background.bottom);
    hash_vec3(hash, scene->background.top);
    camera_hash(&scene->camera, hash);
    hash_integer(hash, scene->default_lights);
    hash_integer(hash, scene->light_count);
    for (uint32_t i = 0; i < scene->light_count; i++) {
        hash_integer(hash, scene->lights[i].kind);
        hash_vec3(hash, scene->lights[i].at);
        hash_vec3(hash, scene->lights[i].color);
    }
    hash_primitives(hash, scene, &scene->primitives);
    for (uint32_t i = 0; i < scene->geometry_count; i++) hash_primitives(hash, scene, &scene->geometries[i]);
}
