/* A fuzz target: whatever the bytes are, loading ends with a scene or with messages, within its limits.
 *
 *     clang -fsanitize=fuzzer,address,undefined ... tests/fuzz/load.c    libFuzzer: run it on a folder of seeds
 *     gcc -fsanitize=address,undefined -DMONGE_FUZZ_STDIN ...            one input, from standard input or files
 *
 * tests/fuzz/run.sh does either. Aborts where a promise of monge.h is broken. */
#include <stdlib.h>
#include <string.h>

#include "monge.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size);

/* The messages must be UTF-8 without control characters but line feeds, and not many. */
static void check_messages(const struct monge_diagnostics *diag) {
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (!out) abort();
    monge_diagnostics_print(diag, out);
    fclose(out);
    if (size > 100000 || strlen(text) != size) abort();
    for (size_t i = 0; i < size; i++) {
        const unsigned char c = (unsigned char)text[i];
        if ((c < 0x20 && c != '\n') || c == 0x7f || c >= 0xf5) abort();
    }
    free(text);
}

static void load(const uint8_t *bytes, size_t size, const struct monge_limits *limits) {
    struct monge_diagnostics *diag = monge_diagnostics_new();
    if (!diag) return;
    const struct monge_load_options options = {.limits = *limits, .untrusted = true};
    struct monge_scene *scene = monge_load_memory("fuzz/scene", (const char *)bytes, size, &options, diag);
    const bool wrong = monge_diagnostics_errors(diag) + monge_diagnostics_failures(diag) > 0;
    if (!scene != wrong) abort(); /* a scene, or a reason */
    if (scene) {
        const struct monge_settings settings = monge_scene_settings(scene);
        if (monge_settings_check(&settings)) abort();
    }
    check_messages(diag);
    monge_scene_free(scene);
    monge_diagnostics_free(diag);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size) {
    load(bytes, size, &(struct monge_limits){.memory_bytes = 64 << 20, .values = 200000, .nesting = 50, .recursion = 50, .steps = 20000, .objects = 5000});
    load(bytes, size, &(struct monge_limits){.memory_bytes = 300000, .values = 300, .nesting = 6, .recursion = 4, .steps = 30, .objects = 10});
    return 0;
}

#ifdef MONGE_FUZZ_STDIN
static void load_stream(FILE *in) {
    size_t size = 0, room = 1 << 16;
    uint8_t *bytes = malloc(room);
    while (bytes && (size += fread(bytes + size, 1, room - size, in)) == room) bytes = realloc(bytes, room *= 2);
    if (!bytes) abort();
    uint8_t *exact = malloc(size ? size : 1); /* so that a sanitizer sees the end */
    if (!exact) abort();
    memcpy(exact, bytes, size);
    LLVMFuzzerTestOneInput(exact, size);
    free(exact);
    free(bytes);
}

int main(int argc, char **argv) {
    if (argc < 2) load_stream(stdin);
    for (int i = 1; i < argc; i++) {
        FILE *in = fopen(argv[i], "rb");
        if (!in) {
            perror(argv[i]);
            return 2;
        }
        load_stream(in);
        fclose(in);
    }
    return 0;
}
#endif
