#include "cli/log.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/say.h"

/* Behind a line that a full disk has cut off, a new one begins. */
static void end_line(int fd) {
    struct stat status;
    char last = '\n';
    if (fstat(fd, &status) != 0 || !S_ISREG(status.st_mode) || status.st_size == 0) return;
    if (pread(fd, &last, 1, status.st_size - 1) == 1 && last != '\n') (void)!write(fd, "\n", 1);
}

bool log_open(struct log *log, const char *path) {
    *log = (struct log){.path = path};
    if (!path) return true;
    log->fd = strcmp(path, "-") == 0 ? dup(STDOUT_FILENO)
                                     : open(path, O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC | O_NOCTTY, 0666);
    if (log->fd < 0) log->fd = open(path, O_WRONLY | O_APPEND | O_CLOEXEC | O_NOCTTY);
    if (log->fd >= 0) {
        end_line(log->fd);
        return true;
    }
    say_error("cannot write %s: %s", path, strerror(errno));
    log->path = NULL;
    return false;
}

/* One write for all, unless it is a pipe that takes less, or a signal comes. */
static bool write_all(int fd, const char *text, size_t size) {
    while (size > 0) {
        const ssize_t written = write(fd, text, size);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return false;
        text += written;
        size -= (size_t)written;
    }
    return true;
}

void log_picture(struct log *log, const struct picture *picture) {
    char *line = NULL;
    size_t size = 0;
    if (!log->path) return;
    FILE *out = open_memstream(&line, &size);
    if (out) picture_write_json(picture, out);
    if (out) fputc('\n', out);
    const bool good = out && fclose(out) == 0 && write_all(log->fd, line, size);
    if (!good && !log->failed) say_error("cannot write %s: %s", log->path, strerror(errno));
    log->failed |= !good;
    free(line);
}

bool log_close(struct log *log) {
    if (log->path) close(log->fd);
    return !log->failed;
}
