/* However little memory a load may take, it ends with a scene or with the limit's name, and leaves nothing open. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <fcntl.h>
#include <unistd.h>

#include "monge.h"

static const char text[] =
    "params: {n: 3}\n"
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

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(within_any_memory),
                                       cmocka_unit_test(files_are_closed)};
    return cmocka_run_group_tests_name("memory", tests, NULL, NULL);
}
