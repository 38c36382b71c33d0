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

/* The length of the UTF-8 character at `s`, 0 where it is none (Unicode 15, table 3-7). */
static size_t utf8_length(const unsigned char *s) {
    if (s[0] < 0x80) return 1;
    const size_t length = s[0] < 0xc2 ? 0 : s[0] < 0xe0 ? 2 : s[0] < 0xf0 ? 3 : s[0] < 0xf5 ? 4 : 0;
    const unsigned char low = s[0] == 0xe0 ? 0xa0 : s[0] == 0xf0 ? 0x90 : 0x80;
    const unsigned char high = s[0] == 0xed ? 0x9f : s[0] == 0xf4 ? 0x8f : 0xbf;
    if (length && (s[1] < low || s[1] > high)) return 0;
    for (size_t i = 2; i < length; i++)
        if ((s[i] & 0xc0) != 0x80) return 0;
    return length;
}

/* File names may hold any bytes: what is no UTF-8 becomes U+FFFD. */
static void print_string(FILE *out, const char *text) {
    const unsigned char *s = (const unsigned char *)text;
    fputc('"', out);
    while (*s) {
        const size_t length = utf8_length(s);
        if (length == 0)
            fputs("\\ufffd", out);
        else if (*s == '"' || *s == '\\')
            fprintf(out, "\\%c", *s);
        else if (*s < 0x20 || *s == 0x7f)
            fprintf(out, "\\u%04x", *s);
        else
            fwrite(s, 1, length, out);
        s += length ? length : 1;
    }
    fputc('"', out);
}

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

static void print_picture(FILE *out, const struct picture *p) {
    fputs("    {\"scene\": ", out);
    print_string(out, p->scene);
    fputs(", \"output\": ", out);
    print_string(out, p->output);
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
    print_string(out, monge_version());
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
