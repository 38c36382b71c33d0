/* However little memory a load may take, it ends with a scene or with the limit's name, and leaves nothing
 * open; so it does where the system has none. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <fcntl.h>
#include <unistd.h>

#include "monge.h"

static const char text[] =
    "params: {n: 3}\n"
    "tolerance: {max: 0.1, reason: it is a test}\n"
    "define: {flake: {params: {d: 0}, objects: [{sphere: {}}, {when: d > 0, for: {i: 5}, use: flake, with: "
    "{d: d - 1},\n"
    "  transform: [{scale: 1 / 3}, {translate: [i, 0, 0]}]}]}}\n"
    "scene:\n"
    "  - {use: flake, with: {d: n}, material: {preset: chrome}}\n"
    "  - {for: {i: 300}, group: [{sphere: {radius: 0.1}, transform: [{translate: [i, 0, 0]}]}]}\n";

static void within_any_memory(void **state) {
    const struct monge_define define = {"n", "[2, 3]"}, number = {"n", "2"};
    unsigned full = 0, good = 0;
    (void)state;
    for (size_t bytes = 1000; bytes < 3000000; bytes += bytes / 50) {
        struct monge_diagnostics *diag = monge_diagnostics_new();
        const struct monge_load_options options = {
            .limits.memory_bytes = bytes, .defines = bytes % 2 ? &define : &number, .define_count = 1};
        struct monge_scene *scene = monge_load_memory("small.yaml", text, strlen(text), &options, diag);
        full += monge_diagnostics_failures(diag) > 0;
        good += scene != NULL;
        assert_true(scene || monge_diagnostics_failures(diag) + monge_diagnostics_errors(diag) > 0);
        monge_scene_free(scene);
        monge_diagnostics_free(diag);
    }
    assert_true(full > 0 && good > 0);
}

static int next_descriptor(void) {
    const int fd = open("/dev/null", O_RDONLY);
    close(fd);
    return fd;
}

static void files_are_closed(void **state) {
    char path[] = "/tmp/monge-memory-XXXXXX";
    const int fd = mkstemp(path);
    (void)state;
    assert_true(write(fd, text, strlen(text)) == (ssize_t)strlen(text));
    close(fd);
    const int before = next_descriptor();
    struct monge_diagnostics *diag = monge_diagnostics_new();
    const struct monge_load_options options = {.limits.memory_bytes = 300};
    assert_null(monge_load_file(path, &options, diag));
    assert_int_equal(monge_diagnostics_failures(diag), 1);
    assert_int_equal(next_descriptor(), before);
    monge_diagnostics_free(diag);
    unlink(path);
}

/* ---- A system that has no memory once: the library's comes from here, and libyaml's too ---- */

static atomic_uint requests, refused; /* a long text has a thread of its own */

static bool has_memory(void) { return ++requests != refused; }

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *memory, size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *memory, size_t size);
void *yaml_malloc(size_t size);
void *yaml_realloc(void *memory, size_t size);

void *__wrap_malloc(size_t size) { return has_memory() ? __real_malloc(size) : NULL; }
void *__wrap_calloc(size_t count, size_t size) { return has_memory() ? __real_calloc(count, size) : NULL; }
void *__wrap_realloc(void *memory, size_t size) { return has_memory() ? __real_realloc(memory, size) : NULL; }
void *yaml_malloc(size_t size) { return __wrap_malloc(size ? size : 1); }
void *yaml_realloc(void *memory, size_t size) { return __wrap_realloc(memory, size ? size : 1); }

static bool load(struct monge_diagnostics *diag) {
    const struct monge_load_options options = {.limits.memory_bytes = 1 << 30};
    struct monge_scene *scene = monge_load_memory("small.yaml", text, strlen(text), &options, diag);
    monge_scene_free(scene);
    return scene != NULL;
}

static bool format(struct monge_diagnostics *diag) {
    const struct monge_limits limits = {.memory_bytes = 1 << 30};
    const struct monge_text given = {(char *)text, strlen(text)};
    struct monge_text formatted;
    const bool done = monge_format("small.yaml", &given, &limits, &formatted, diag);
    monge_text_free(&formatted);
    return done;
}

static struct task {
    const char *name;
    bool (*run)(struct monge_diagnostics *diag);
} tasks[] = {{"a load without memory", load}, {"a format without memory", format}};

/* Refuses each request for memory in its turn: by the library's arenas, by others of it, by libyaml. */
static void check_refusals(void **state) {
    static const char none[] = "monge: error[out-of-memory]: small.yaml: out of memory\n";
    static const char none_for_presets[] = "monge: error[out-of-memory]: presets.yaml: out of memory\n";
    static const char full[] =
        "monge: error[limit-memory]: small.yaml: takes more memory than there is, or than "
        "1073741824 bytes (the limit `memory_bytes`)\n";
    const struct task *task = *state;
    unsigned told[2] = {0, 0};
    for (unsigned request = 1;; request++) {
        char said[400] = "";
        struct monge_diagnostics *diag = monge_diagnostics_new();
        requests = 0;
        refused = request;
        const bool good = task->run(diag);
        refused = 0;
        FILE *out = fmemopen(said, sizeof said, "w");
        monge_diagnostics_write(diag, MONGE_FORMAT_TEXT, out);
        fclose(out);
        monge_diagnostics_free(diag);
        if (requests < request) {
            assert_true(good);
            break;
        }
#ifdef MONGE_HOSTILE
        if (good) continue; /* without the memory for a thread it goes on without one */
#endif
        assert_false(good);
        const bool short_of = strcmp(said, none) == 0 || strcmp(said, none_for_presets) == 0;
        if (!short_of) assert_string_equal(said, full);
        told[short_of]++;
    }
    assert_true(told[0] > 0 && told[1] > 0);
}

/* The first request of each is refused. */
static void other_readers_say_so(void **state) {
    (void)state;
    static const char none[] = "monge: error[out-of-memory]: small.yaml: out of memory\n";
    char folder[] = "/tmp/monge-memory-XXXXXX";
    assert_true(mkdtemp(folder) && chdir(folder) == 0);
    FILE *file = fopen("small.yaml", "w");
    fputs(text, file);
    fclose(file);
    for (int reader = 0; reader < 2; reader++) {
        char said[400] = "", hash[MONGE_HASH_SIZE];
        struct monge_diagnostics *diag = monge_diagnostics_new();
        requests = 0;
        refused = 1;
        if (reader == 0)
            assert_null(monge_picture_read("small.yaml", diag));
        else
            assert_false(monge_files_hash("small.yaml", "", NULL, diag, hash));
        refused = 0;
        FILE *out = fmemopen(said, sizeof said, "w");
        monge_diagnostics_write(diag, MONGE_FORMAT_TEXT, out);
        fclose(out);
        monge_diagnostics_free(diag);
        assert_string_equal(said, none);
    }
    assert_true(unlink("small.yaml") == 0 && chdir("/") == 0 && rmdir(folder) == 0);
}

/* Refuses each request of a rendering in its turn, and of the layers': there is no picture then. */
static void renderings_say_so(void **state) {
    (void)state;
    for (int layers = 0; layers < 2; layers++)
        for (unsigned request = 1;; request++) {
            struct monge_diagnostics *diag = monge_diagnostics_new();
            struct monge_scene *scene = monge_load_memory("small.yaml", text, strlen(text), NULL, diag);
            assert_non_null(scene);
            struct monge_settings settings = monge_scene_settings(scene);
            settings.width = settings.height = 2;
            const struct monge_job job = {.threads = 1};
            requests = 0;
            refused = request;
            struct monge_film *film = layers ? NULL : monge_render(scene, &settings, NULL, &job, NULL);
            struct monge_layers *seen =
                layers ? monge_render_layers(scene, &settings, NULL, MONGE_LAYERS_ALL, &job) : NULL;
            refused = 0;
            const bool good = film || seen;
            monge_film_free(film);
            monge_layers_free(seen);
            monge_scene_free(scene);
            monge_diagnostics_free(diag);
            assert_int_equal(good, requests < request);
            if (good) break;
        }
}

int main(void) {
    struct CMUnitTest tests[4 + sizeof tasks / sizeof *tasks] = {
        cmocka_unit_test(within_any_memory), cmocka_unit_test(files_are_closed),
        cmocka_unit_test(other_readers_say_so), cmocka_unit_test(renderings_say_so)};
    for (size_t i = 0; i < sizeof tasks / sizeof *tasks; i++)
        tests[4 + i] = (struct CMUnitTest){tasks[i].name, check_refusals, NULL, NULL, &tasks[i]};
    return cmocka_run_group_tests_name("memory", tests, NULL, NULL);
}
