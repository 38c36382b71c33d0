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

/* The counts of what the instance places; NULL: the primitive is none. */
static const uint64_t *slots_of(const struct primitives *p, uint64_t *const *many, uint32_t number) {
    const primitive_ref ref = p->info[number].ref;
    return primitive_ref_kind(ref) == PRIMITIVE_INSTANCE
               ? many[p->instances[primitive_ref_index(ref)].geometry]
               : NULL;
}

/* Primitives of each geometry by their slot, nested ones too. */
static uint64_t **count_slots(const struct scene *scene, struct arena *arena) {
    uint64_t **many = arena_array(arena, scene->geometry_count + 1, sizeof *many);
    for (uint32_t g = 0; g < scene->geometry_count; g++) {
        const struct primitives *p = &scene->geometries[g];
        many[g] = arena_array(arena, p->slots + 1, sizeof *many[g]);
        for (uint32_t i = 0; i < p->count; i++) {
            uint32_t count;
            const uint32_t *materials = primitives_materials(p, scene->geometries, i, &count);
            const uint64_t *inner = slots_of(p, many, i);
            for (uint32_t k = 0; k < count; k++) {
                if (!(materials[k] & MATERIAL_SLOT)) continue;
                uint64_t *slot = &many[g][materials[k] & ~MATERIAL_SLOT];
                *slot = plus(*slot, inner ? inner[k] : 1);
            }
        }
    }
    return many;
}

/* The materials of one primitive. `inner`: how many each of an instance's is for. */
static void count_materials(struct info *info, const struct scene *scene, const struct primitives *p,
                            uint32_t number, uint64_t often, const uint64_t *inner) {
    uint32_t several;
    const uint32_t *materials = primitives_materials(p, scene->geometries, number, &several);
    for (uint32_t k = 0; k < several; k++) {
        if (materials[k] & MATERIAL_SLOT) continue;
        count(&info->materials[materials[k]], inner ? times(often, inner[k]) : often);
    }
}

/* The primitives of one set, that is placed `often`. */
static void count_set(struct info *info, const struct scene *scene, const struct primitives *p,
                      uint64_t often, uint64_t *const *slots) {
    for (uint32_t i = 0; i < p->use_count; i++)
        info->templates[p->uses[i]].uses = plus(info->templates[p->uses[i]].uses, often);
    for (uint32_t i = 0; i < p->count; i++) {
        const struct primitive_info *at = &p->info[i];
        const struct origin *origin = &scene->origins.list[at->origin];
        const bool is_instance = primitive_ref_kind(at->ref) == PRIMITIVE_INSTANCE;
        struct info_template *template =
            origin->template == ORIGIN_NO_TEMPLATE ? NULL : &info->templates[origin->template];
        if (template) template->bytes += bytes_of(at->ref);
        count(is_instance ? &info->instances : &info->all, often);
        if (!is_instance) count(&info->kinds[origin->kind], often);
        if (!is_instance && template) count(&template->primitives, often);
        count_materials(info, scene, p, i, often, slots_of(p, slots, i));
    }
}

struct info info_count(const struct scene *scene, struct arena *arena) {
    struct info info = {.template_count = scene->template_count};
    const uint64_t *often = placings(scene, arena);
    uint64_t *const *slots = count_slots(scene, arena);
    info.materials = arena_array(arena, scene->material_count + 1, sizeof *info.materials);
    info.templates = arena_array(arena, scene->template_count + 1, sizeof *info.templates);
    for (uint32_t i = 0; i < scene->template_count; i++) info.templates[i].name = scene->templates[i];
    count_set(&info, scene, &scene->primitives, 1, slots);
    for (uint32_t g = 0; g < scene->geometry_count; g++)
        count_set(&info, scene, &scene->geometries[g], often[g], slots);
    return info;
}
