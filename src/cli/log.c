#include "cli/log.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "cli/append.h"

enum { LINE_ROOM = 1 << 16 }; /* bytes of the log that are looked at for its last line */

static const char LINE_BEGIN[] = "{\"started\": \"";

/* Whether the text is the beginning of a line of ours, and not all of it. */
static bool is_torn(const char *text, size_t length) {
    const size_t begin = sizeof LINE_BEGIN - 1;
    return memcmp(text, LINE_BEGIN, length < begin ? length : begin) == 0 && text[length - 1] != '}';
}

/* A last line that was torn, as by a loss of power, is cut off; behind another one without its end a new line begins. */
static void end_line(int fd) {
    static char end[LINE_ROOM];
    struct stat status;
    if (fstat(fd, &status) != 0 || !S_ISREG(status.st_mode)) return;
    const off_t from = status.st_size > LINE_ROOM ? status.st_size - LINE_ROOM : 0;
    const ssize_t size = pread(fd, end, LINE_ROOM, from);
    if (size <= 0 || end[size - 1] == '\n') return;
    const char *before = memrchr(end, '\n', (size_t)size);
    const size_t line = before ? (size_t)(before - end) + 1 : 0;
    if ((before || from == 0) && is_torn(end + line, (size_t)size - line))
        (void)!ftruncate(fd, from + (off_t)line);
    else
        (void)!write(fd, "\n", 1);
}

static void note_start(struct log *log) {
    struct timespec now;
    struct tm utc;
    char seconds[24];
    clock_gettime(CLOCK_REALTIME, &now);
    gmtime_r(&now.tv_sec, &utc);
    strftime(seconds, sizeof seconds, "%Y-%m-%dT%H:%M:%S", &utc);
    snprintf(log->started, sizeof log->started, "%s.%03dZ", seconds, (int)(now.tv_nsec / 1000000));
}

bool log_open(struct log *log, const char *path, const struct report *report) {
    *log = (struct log){.path = path, .report = report};
    if (!path) return true;
    note_start(log);
    log->fd = strcmp(path, "-") == 0 ? dup(STDOUT_FILENO)
                                     : open(path, O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC | O_NOCTTY, 0666);
    const int reason = errno;
    if (log->fd < 0) log->fd = open(path, O_WRONLY | O_APPEND | O_CLOEXEC | O_NOCTTY); /* not to be read */
    if (log->fd >= 0) {
        end_line(log->fd);
        log_waiting_open(&log->waiting, path, log->fd);
        return true;
    }
    report_failure(report, "cannot-write", "cannot write %s: %s", path, strerror(reason));
    log->path = NULL;
    return false;
}

/* With its end. NULL: no memory. To be freed. */
static char *make_line(const struct log *log, const struct picture *picture) {
    char *line = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&line, &size);
    if (!out) return NULL;
    picture_write_json(picture, log->started, out);
    fputc('\n', out);
    if (fclose(out) == 0) return line;
    free(line);
    return NULL;
}

void log_keep(struct log *log, size_t unit, const struct picture *picture) {
    if (!log->path || !log->waiting.path) return;
    char *line = make_line(log, picture);
    log_waiting_add(&log->waiting, log->fd, unit, line ? line : "\n");
    free(line);
}

void log_picture(struct log *log, const struct picture *picture) {
    if (!log->path) return;
    char *line = make_line(log, picture);
    const bool good = line && append_whole(log->fd, line);
    if (!good && !log->failed)
        report_failure(log->report, "cannot-write", "cannot write %s: %s", log->path, strerror(errno));
    log->failed |= !good;
    free(line);
    log_waiting_take(&log->waiting);
}

bool log_close(struct log *log) {
    if (!log->path) return true;
    log_waiting_close(&log->waiting);
    close(log->fd);
    return !log->failed;
}
