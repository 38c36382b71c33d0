#include "cli/stats.h"

#include <errno.h>
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

static void print_all(FILE *out, const struct picture *pictures, size_t count) {
    fputs("{\n  \"version\": ", out);
    monge_write_json_string(monge_version(), out);
    fputs(",\n  \"pictures\": [\n", out);
    for (size_t i = 0; i < count; i++) {
        fputs("    ", out);
        picture_write_json(&pictures[i], out);
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
