#include "render/info.h"

/* ---- Counting ---- */

static uint64_t plus(uint64_t a, uint64_t b) { return a > UINT64_MAX - b ? UINT64_MAX : a + b; }
static uint64_t times(uint64_t a, uint64_t b) { return b && a > UINT64_MAX / b ? UINT64_MAX : a * b; }

static void count(struct info_count *c, uint64_t placed) {
    c->stored++;
    c->placed = plus(c->placed, placed);
}

static uint64_t bytes_of(primitive_ref ref) {
    const uint64_t common = sizeof(struct primitive_info) + sizeof(uint32_t);
    switch (primitive_ref_kind(ref)) {
    case PRIMITIVE_SPHERE: return common + sizeof(struct sphere);
    case PRIMITIVE_FLAT: return common + sizeof(struct flat);
    case PRIMITIVE_QUADRIC: return common + sizeof(struct quadric);
    case PRIMITIVE_INSTANCE: break;
    }
    return common + sizeof(struct instance);
}

/* How often each geometry is placed. An instance within a geometry places earlier ones alone. */
static uint64_t *placings(const struct scene *scene, struct arena *arena) {
    uint64_t *often = arena_array(arena, scene->geometry_count + 1, sizeof *often);
    const struct primitives *p = &scene->primitives;
    for (uint32_t i = 0; i < p->instance_count; i++) often[p->instances[i].geometry]++;
    for (uint32_t g = scene->geometry_count; g-- > 0;) {
        p = &scene->geometries[g];
        for (uint32_t i = 0; i < p->instance_count; i++)
            often[p->instances[i].geometry] = plus(often[p->instances[i].geometry], often[g]);
    }
    return often;
}

/* Primitives of each geometry that take the material of the instance, nested ones too. */
static uint64_t *inheriting(const struct scene *scene, struct arena *arena) {
    uint64_t *many = arena_array(arena, scene->geometry_count + 1, sizeof *many);
    for (uint32_t g = 0; g < scene->geometry_count; g++) {
        const struct primitives *p = &scene->geometries[g];
        for (uint32_t i = 0; i < p->count; i++) {
            const struct primitive_info *at = &p->info[i];
            const struct instance *instance = primitive_ref_kind(at->ref) == PRIMITIVE_INSTANCE
                                                  ? &p->instances[primitive_ref_index(at->ref)]
                                                  : NULL;
            if (!instance && at->material == MATERIAL_INHERITED) many[g] = plus(many[g], 1);
            if (instance && instance->material == MATERIAL_INHERITED)
                many[g] = plus(many[g], many[instance->geometry]);
        }
    }
    return many;
}

/* The primitives of one set, that is placed `often`. */
static void count_set(struct info *info, const struct scene *scene, const struct primitives *p,
                      uint64_t often, const uint64_t *inherits) {
    for (uint32_t i = 0; i < p->use_count; i++)
        info->templates[p->uses[i]].uses = plus(info->templates[p->uses[i]].uses, often);
    for (uint32_t i = 0; i < p->count; i++) {
        const struct primitive_info *at = &p->info[i];
        const struct origin *origin = &scene->origins.list[at->origin];
        const bool is_instance = primitive_ref_kind(at->ref) == PRIMITIVE_INSTANCE;
        const struct instance *instance = is_instance ? &p->instances[primitive_ref_index(at->ref)] : NULL;
        struct info_template *template =
            origin->template == ORIGIN_NO_TEMPLATE ? NULL : &info->templates[origin->template];
        if (template) template->bytes += bytes_of(at->ref);
        count(is_instance ? &info->instances : &info->all, often);
        if (!is_instance) count(&info->kinds[origin->kind], often);
        if (!is_instance && template) count(&template->primitives, often);
        const uint32_t material = instance ? instance->material : at->material;
        if (material == MATERIAL_INHERITED) continue;
        struct info_count *uses = &info->materials[material];
        uses->stored++;
        uses->placed = plus(uses->placed, instance ? times(often, inherits[instance->geometry]) : often);
    }
}

struct info info_count(const struct scene *scene, struct arena *arena) {
    struct info info = {.template_count = scene->template_count};
    const uint64_t *often = placings(scene, arena), *inherits = inheriting(scene, arena);
    info.materials = arena_array(arena, scene->material_count + 1, sizeof *info.materials);
    info.templates = arena_array(arena, scene->template_count + 1, sizeof *info.templates);
    for (uint32_t i = 0; i < scene->template_count; i++) info.templates[i].name = scene->templates[i];
    count_set(&info, scene, &scene->primitives, 1, inherits);
    for (uint32_t g = 0; g < scene->geometry_count; g++)
        count_set(&info, scene, &scene->geometries[g], often[g], inherits);
    return info;
}
