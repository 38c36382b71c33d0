/* What the scene makes of instances: its fingerprint, and the warning of darkness. */
#include "instance_pair.h"
#include "loading.h"
#include "scene/builder.h"

static struct hash hash_of(const struct scene *scene) {
    struct hash hash;
    hash_begin(&hash);
    scene_hash(scene, &hash);
    return hash;
}

static void fingerprints(void **state) {
    (void)state;
    struct random r = random_begin();
    struct pair *s = random_pair(&r, 1.0);
    for (int i = 0; i < 3; i++) s->geometries[i].slots = SLOTS; /* even where chance has used none */
    const struct hash before = hash_of(&s->instanced);
    struct instance *placed = s->instanced.primitives.instances, *inner = s->geometries[2].instances;
    const struct instance keep = *placed, keep_inner = *inner;
    placed->world_from_object.m[1][3] += 1e-9;
    assert_memory_not_equal(&before, &(struct hash[]){hash_of(&s->instanced)}, sizeof before);
    *placed = keep;
    placed->materials = material_pair((keep.materials[0] + 1) % MATERIALS, keep.materials[1]);
    assert_memory_not_equal(&before, &(struct hash[]){hash_of(&s->instanced)}, sizeof before);
    *placed = keep;
    placed->materials = material_pair(keep.materials[0], (keep.materials[1] + 1) % MATERIALS);
    assert_memory_not_equal(&before, &(struct hash[]){hash_of(&s->instanced)}, sizeof before);
    *placed = keep;
    placed->geometry = 3;
    assert_memory_not_equal(&before, &(struct hash[]){hash_of(&s->instanced)}, sizeof before);
    *placed = keep;
    inner->materials =
        material_pair(keep_inner.materials[0] == FIRST ? SECOND : FIRST, keep_inner.materials[1]);
    assert_memory_not_equal(&before, &(struct hash[]){hash_of(&s->instanced)}, sizeof before);
    *inner = keep_inner;
    s->instanced.primitives.info[0].material = MIRROR; /* of an instance: not used */
    assert_memory_equal(&before, &(struct hash[]){hash_of(&s->instanced)}, sizeof before);
    s->geometries[0].info[0].material = s->geometries[0].info[0].material == CLAY ? MIRROR : CLAY;
    assert_memory_not_equal(&before, &(struct hash[]){hash_of(&s->instanced)}, sizeof before);
    pair_end(s);
}

/* Under a white point light: whether what instances place is lit depends on the material that it gets. */
static void dark_scenes(void **state) {
    (void)state;
    static struct material two[] = {{.index = 1}, {.diffuse = {1, 1, 1}, .index = 1}};
    enum { BLACK, WHITE };
    static const struct {
        uint32_t own, inner, outer;
        unsigned warnings;
    } rows[] = {
        {FIRST, FIRST, BLACK, 1}, {FIRST, FIRST, WHITE, 0}, {FIRST, BLACK, WHITE, 1},
        {FIRST, WHITE, BLACK, 0}, {BLACK, WHITE, WHITE, 1}, {WHITE, BLACK, BLACK, 0},
    };
    for (size_t i = 0; i < COUNT(rows); i++) {
        struct loaded l;
        load_good(&l, "lights: [{point: {at: [0, 5, 0]}}]\nscene: [{sphere: {}}]\n");
        struct pair *s = pair_begin();
        add_sphere(add_geometry(s, 1), (vec3){0, 0, 0}, 1, rows[i].own);
        add_instance(add_geometry(s, 1), 0, AFFINE_IDENTITY, rows[i].inner);
        add_instance(&s->instanced.primitives, 1, AFFINE_IDENTITY, rows[i].outer);
        s->instanced.materials = two;
        s->instanced.material_count = COUNT(two);
        s->instanced.default_lights = false;
        s->instanced.lights = l.scene.lights;
        s->instanced.light_count = l.scene.light_count;
        count_slots(s);
        struct builder b = {.arena = &s->arena, .diag = &l.diag, .scene = &s->instanced};
        lights_check(&b, l.result.file);
        if (l.diag.warnings != rows[i].warnings) fail_msg("row %zu: %u warnings", i, l.diag.warnings);
        pair_end(s);
        unload(&l);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fingerprints),
        cmocka_unit_test(dark_scenes),
    };
    return cmocka_run_group_tests_name("scenes of instances", tests, NULL, NULL);
}
