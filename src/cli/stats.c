#include "cli/stats.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/say.h"

uint64_t stats_peak_memory(void) {
    struct rusage usage;
    return getrusage(RUSAGE_SELF, &usage) == 0 ? (uint64_t)usage.ru_maxrss * 1024 : 0; /* Linux counts KiB */
}

/* ---- JSON ---- */

static void print_rays(FILE *out, const uint64_t rays[MONGE_RAY_KINDS]) {
    static const char *const names[MONGE_RAY_KINDS] = {
        [MONGE_RAY_CAMERA] = "camera",
        [MONGE_RAY_SHADOW] = "shadow",
        [MONGE_RAY_REFLECTION] = "reflection",
        [MONGE_RAY_REFRACTION] = "refraction",
    };
    uint64_t total = 0;
    fputs(", \"rays\": {", out);
    for (int kind = 0; kind < MONGE_RAY_KINDS; kind++) {
        fprintf(out, "\"%s\": %" PRIu64 ", ", names[kind], rays[kind]);
        total += rays[kind];
    }
    fprintf(out, "\"total\": %" PRIu64 "}", total);
}

static void print_params(FILE *out, const struct picture *p) {
    fputs(", \"params\": {", out);
    for (size_t i = 0; i < p->define_count; i++) {
        fputs(i > 0 ? ", " : "", out);
        monge_write_json_string(p->defines[i].name, out);
        fputs(": ", out);
        monge_write_json_string(p->defines[i].value, out);
    }
    fputs("}", out);
}

static void print_picture(FILE *out, const struct picture *p) {
    fputs("    {\"scene\": ", out);
    monge_write_json_string(p->scene, out);
    fputs(", \"output\": ", out);
    monge_write_json_string(p->output, out);
    if (p->frame) fprintf(out, ", \"frame\": %u", p->frame);
    if (p->define_count > 0) print_params(out, p);
    if (!p->done) {
        fputs(", \"error\": true}", out);
        return;
    }
    fprintf(out, ", \"width\": %u, \"height\": %u, \"samples\": %u, \"threads\": %u, \"primitives\": %zu",
            p->region.width, p->region.height, p->settings.samples, p->stats.threads, p->primitives);
    fprintf(out, ", \"seconds\": {\"load\": %.6f, \"build\": %.6f, \"render\": %.6f, \"write\": %.6f}",
            p->load_seconds, p->stats.build_seconds, p->stats.render_seconds, p->write_seconds);
    print_rays(out, p->stats.rays);
    fprintf(out, ", \"peak_memory_bytes\": %" PRIu64 "}", p->peak_memory_bytes);
}

static void print_all(FILE *out, const struct picture *pictures, size_t count) {
    fputs("{\n  \"version\": ", out);
    monge_write_json_string(monge_version(), out);
    fputs(",\n  \"pictures\": [\n", out);
    for (size_t i = 0; i < count; i++) {
        print_picture(out, &pictures[i]);
        fputs(i + 1 < count ? ",\n" : "\n", out);
    }
    fputs("  ]\n}\n", out);
}

/* ---- Files ---- */

static bool write_and_close(FILE *file, const struct picture *pictures, size_t count) {
    print_all(file, pictures, count);
    const bool good = !ferror(file) && fflush(file) == 0;
    return fclose(file) == 0 && good;
}

/* Gives the temporary file the permissions of the one it replaces, or of a new one. */
static bool set_permissions(int fd, const char *target) {
    struct stat old;
    if (stat(target, &old) == 0) return fchmod(fd, old.st_mode & 0777) == 0;
    const mode_t mask = umask(0);
    umask(mask);
    return fchmod(fd, 0666 & ~mask) == 0;
}

static bool replace_file(const char *target, const struct picture *pictures, size_t count) {
    char *temporary = say_text("%s.XXXXXX.tmp", target);
    const int fd = mkstemps(temporary, 4);
    FILE *file = fd >= 0 && set_permissions(fd, target) ? fdopen(fd, "w") : NULL;
    bool good = file && write_and_close(file, pictures, count);
    good = good && rename(temporary, target) == 0;
    const int reason = errno;
    if (!file && fd >= 0) close(fd);
    if (!good && fd >= 0) unlink(temporary);
    free(temporary);
    errno = reason;
    return good;
}

/* A link is followed, and what is there but is no file (a pipe, a device) is written as it is. */
static bool write_file(const char *path, const struct picture *pictures, size_t count) {
    struct stat there;
    if (stat(path, &there) != 0) return replace_file(path, pictures, count);
    if (!S_ISREG(there.st_mode)) {
        FILE *file = fopen(path, "w");
        return file && write_and_close(file, pictures, count);
    }
    char *target = realpath(path, NULL);
    const bool good = target && replace_file(target, pictures, count);
    free(target);
    return good;
}

bool stats_write(const char *path, const struct picture *pictures, size_t count) {
    if (strcmp(path, "-") == 0) {
        print_all(stdout, pictures, count); /* streams_close looks after it */
        return true;
    }
    if (write_file(path, pictures, count)) return true;
    say_error("cannot write %s: %s", path, strerror(errno));
    return false;
}
