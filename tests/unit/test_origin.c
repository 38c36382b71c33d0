/* Origins are shared where they can be, outlive the sources, and change nothing of a picture. */
#include <string.h>

#include "monge.h"
#include "near.h"
#include "render/film.h"
#include "scene/origin.h"

static const struct source file = {"a.yaml", "scene:\n  - sphere: {}\n", 21};

static struct span at(uint32_t line, uint32_t column) { return (struct span){&file, line, column, 0}; }

static void check_sharing(void **state) {
    (void)state;
    struct arena arena = {0};
    struct origins origins = {0};
    const struct origin ball = {.name = "ball", .kind = 3, .template = ORIGIN_NO_TEMPLATE},
                        box = {.kind = 4, .template = 0};
    const uint32_t first = origins_add(&origins, &arena, at(1, 4), ball),
                   second = origins_add(&origins, &arena, at(9, 4), box);
    assert_int_not_equal(first, second);
    for (int i = 0; i < 1000; i++) { /* as in a loop of two */
        char name[] = "ball";
        struct origin again = ball;
        again.name = name;
        assert_int_equal(origins_add(&origins, &arena, at(1, 4), again), first);
        assert_int_equal(origins_add(&origins, &arena, at(9, 4), box), second);
    }
    struct origin other = ball;
    other.name = "cube";
    assert_int_not_equal(origins_add(&origins, &arena, at(1, 4), other), first);
    other = ball;
    other.template = 7;
    assert_int_not_equal(origins_add(&origins, &arena, at(1, 4), other), first);
    arena_free(&arena);
}

static void check_kept(void **state) {
    (void)state;
    struct arena arena = {0};
    struct origins origins = {0};
    static char name[] = "b.yaml", text[] = "one\ntwo\n";
    struct source source = {name, text, 8}, large = {"large", text, (size_t)1 << 30};
    origins_add(&origins, &arena, (struct span){&source, 1, 0, 3}, (struct origin){.kind = 1});
    origins_add(&origins, &arena, (struct span){&large, 5, 2, 3}, (struct origin){.kind = 1});
    origins_keep(&origins, &arena);
    memset(name, 'x', 3);
    memset(text, 'x', 8);
    source = (struct source){NULL, NULL, 0};
    const struct span span = origins_span(&origins, 0), far = origins_span(&origins, 1);
    assert_string_equal(span.source->name, "b.yaml");
    assert_string_equal(span.source->text, "one\ntwo\n");
    assert_int_equal(span.line, 1);
    assert_string_equal(far.source->name, "large");
    assert_int_equal(far.source->size, 0);
    assert_int_equal(far.column, 2);
    arena_free(&arena);
}

static struct hash fingerprint(const char *text) {
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_scene *scene = monge_load_memory("scene", text, strlen(text), NULL, diag);
    assert_non_null(scene);
    struct monge_settings settings = monge_scene_settings(scene);
    settings.width = settings.height = 2;
    struct monge_film *film = monge_render(scene, &settings, NULL, NULL, NULL);
    const struct hash hash = film->scene;
    monge_film_free(film);
    monge_scene_free(scene);
    monge_diagnostics_free(diag);
    return hash;
}

static void check_fingerprint(void **state) {
    (void)state;
    const struct hash plain = fingerprint("scene: [{sphere: {}}, {box: {min: [1, 1, 1], max: [2, 2, 2]}}]");
    const struct hash named = fingerprint("scene:\n\n  - group: [{sphere: {}, name: ball}]\n    name: all\n  "
                                          "- box: {min: [1, 1, 1], max: [2, 2, 2]}\n");
    const struct hash other = fingerprint("scene: [{sphere: {}}, {box: {min: [1, 1, 1], max: [2, 2, 3]}}]");
    assert_true(plain.high == named.high && plain.low == named.low);
    assert_false(plain.high == other.high && plain.low == other.low);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(check_sharing),
        cmocka_unit_test(check_kept),
        cmocka_unit_test(check_fingerprint),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
