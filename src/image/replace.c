#include "image/replace.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

enum { MAX_LINKS = 40, MAX_ATTEMPTS = 100, MAX_NAME_KEPT = 200 /* NAME_MAX is 255 */ };

/* Bytes of the path up to its last slash, that included. */
static size_t folder_length(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash ? (size_t)(slash - path) + 1 : 0;
}

/* The file that a chain of symbolic links ends in, which need not exist. To be freed; NULL with errno. */
static char *follow_links(const char *path) {
    char link[PATH_MAX], *at = strdup(path);
    for (int i = 0; at && i < MAX_LINKS; i++) {
        const ssize_t length = readlink(at, link, sizeof link - 1);
        if (length < 0) return at; /* no link, or nothing there */
        link[length] = '\0';
        char *next = NULL;
        const int folder = link[0] == '/' ? 0 : (int)folder_length(at);
        if (asprintf(&next, "%.*s%s", folder, at, link) < 0) next = NULL;
        free(at);
        at = next;
    }
    free(at);
    errno = at ? ELOOP : ENOMEM;
    return NULL;
}

/* Makes a file .NAME.XXXXXX.tmp beside `target` by `make`, which returns a negative number where it cannot; returns
 * what it does. Not by mkstemp, whose files miss the permissions that the umask would give, and to ask for the umask
 * means to change it for all threads. */
static int make_beside(const char *target, int (*make)(const char *path, int fd), int from,
                       char **temporary) {
    static const char digits[] = "0123456789abcdefghijklmnopqrstuvwxyz";
    const size_t folder = folder_length(target);
    struct timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    uint64_t seed = (uint64_t)now.tv_nsec ^ (uint64_t)now.tv_sec << 30 ^ (uint64_t)getpid() << 40;
    for (int attempt = 0; attempt < MAX_ATTEMPTS; attempt++) {
        char random[7] = "";
        seed = seed * 6364136223846793005u + 1442695040888963407u; /* Knuth's MMIX */
        for (int i = 0; i < 6; i++) random[i] = digits[(seed >> (16 + 8 * i)) % 36];
        if (asprintf(temporary, "%.*s.%.*s.%s.tmp", (int)folder, target, MAX_NAME_KEPT, target + folder,
                     random) < 0)
            break;
        const int made = make(*temporary, from);
        if (made >= 0) return made;
        free(*temporary);
        if (errno != EEXIST) break;
    }
    *temporary = NULL;
    return -1;
}

static int create_file(const char *path, int fd) {
    (void)fd;
    return open(path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
}

/* Gives the file without a name that `fd` is one. */
static int link_file(const char *path, int fd) {
    char file[32];
    snprintf(file, sizeof file, "/proc/self/fd/%d", fd);
    return linkat(AT_FDCWD, file, AT_FDCWD, path, AT_SYMLINK_FOLLOW);
}

/* A file without a name in the folder of `target`; negative where there is no such thing. */
static int create_nameless(const char *target) {
    const size_t length = folder_length(target);
    char *folder = length ? strndup(target, length) : strdup(".");
    const bool linkable = folder && access("/proc/self/fd", X_OK) == 0;
    const int fd = linkable ? open(folder, O_WRONLY | O_TMPFILE | O_CLOEXEC, 0666) : -1;
    free(folder);
    return fd;
}

static int open_new(struct replacement *file) {
    const int fd = create_nameless(file->target);
    return fd >= 0 ? fd : make_beside(file->target, create_file, -1, &file->temporary);
}

/* NULL, with errno, for a negative fd. */
static FILE *stream_from(int fd) {
    if (fd < 0) return NULL;
    FILE *stream = fdopen(fd, "wb");
    if (!stream) close(fd);
    return stream;
}

/* Keeps errno. */
static void abandon(struct replacement *file) {
    const int reason = errno;
    if (file->stream && file->stream != stdout) fclose(file->stream);
    if (file->temporary) unlink(file->temporary);
    free(file->temporary);
    free(file->target);
    errno = reason;
}

/* `old` is what is there now, NULL if nothing is. */
static bool open_beside(struct replacement *file, const char *path, const struct stat *old) {
    if (old && access(path, W_OK) != 0) return false; /* its owner does not want it changed */
    file->target = follow_links(path);
    if (file->target) file->stream = stream_from(open_new(file));
    if (file->stream && (!old || fchmod(fileno(file->stream), old->st_mode & 0777) == 0)) return true;
    abandon(file);
    return false;
}

bool replace_begin(struct replacement *file, const char *path) {
    *file = (struct replacement){NULL, NULL, NULL};
    struct stat there;
    if (strcmp(path, "-") == 0) return (file->stream = stdout) != NULL;
    if (stat(path, &there) != 0) return errno == ENOENT && open_beside(file, path, NULL);
    if (S_ISREG(there.st_mode)) return open_beside(file, path, &there);
    return (file->stream = stream_from(open(path, O_WRONLY | O_CLOEXEC))) != NULL;
}

/* Sees to it that every byte has been taken. */
static bool flush_stream(FILE *stream, bool sync) {
    if (fflush(stream) != 0) return false;
    if (ferror(stream)) errno = EIO; /* the first cause is lost */
    return !ferror(stream) && (!sync || fsync(fileno(stream)) == 0);
}

/* The file without a name gets that of the target, or where another has it, a temporary one. */
static bool name_file(struct replacement *file) {
    const int fd = fileno(file->stream);
    if (file->temporary || link_file(file->target, fd) == 0) return true;
    return errno == EEXIST && make_beside(file->target, link_file, fd, &file->temporary) == 0;
}

static bool put_in_place(struct replacement *file) {
    if (!file->temporary) return true;
    if (rename(file->temporary, file->target) != 0) return false;
    free(file->temporary);
    file->temporary = NULL; /* it has gone */
    return true;
}

/* All that is left after is to forget it. */
static bool commit(struct replacement *file) {
    bool good = flush_stream(file->stream, file->target != NULL) && (!file->target || name_file(file));
    if (file->stream != stdout) good = fclose(file->stream) == 0 && good;
    file->stream = NULL;
    return good && put_in_place(file);
}

bool replace_end(struct replacement *file, bool good) {
    good = good && commit(file);
    abandon(file);
    return good;
}
