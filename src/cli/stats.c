#include "cli/stats.h"

#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

#include "cli/say.h"

uint64_t stats_peak_memory(void) {
    struct rusage usage;
    return getrusage(RUSAGE_SELF, &usage) == 0 ? (uint64_t)usage.ru_maxrss * 1024 : 0; /* Linux counts KiB */
}

/* ---- JSON ---- */

static void print_all(FILE *out, const struct picture *pictures, size_t count) {
    fputs("{\n  \"version\": ", out);
    monge_write_json_string(monge_version(), out);
    fputs(",\n  \"pictures\": [\n", out);
    for (size_t i = 0; i < count; i++) {
        fputs("    ", out);
        picture_write_json(&pictures[i], NULL, out);
        fputs(i + 1 < count ? ",\n" : "\n", out);
    }
    fputs("  ]\n}\n", out);
}

/* ---- Files ---- */

static bool write_file(const char *path, const struct monge_text *text, const struct report *report) {
    struct monge_diagnostics *diag = report_open(report);
    const bool written = diag && monge_text_write(path, text, diag);
    if (diag) report_close(report, diag, true);
    return written;
}

bool stats_write(const char *path, const struct picture *pictures, size_t count,
                 const struct report *report) {
    if (strcmp(path, "-") == 0) {
        print_all(stdout, pictures, count); /* streams_close looks after it */
        return true;
    }
    struct monge_text text = {NULL, 0};
    FILE *out = open_memstream(&text.bytes, &text.size);
    if (out) print_all(out, pictures, count);
    const bool made = out && !ferror(out) && fclose(out) == 0;
    if (!made) report_failure(report, "out-of-memory", "%s: out of memory", path);
    const bool written = made && write_file(path, &text, report);
    free(text.bytes);
    return written;
}
