#include "cli/log_waiting.h"

#include <errno.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/append.h"
#include "cli/say.h"

/* ---- Files ---- */

static off_t file_size(int fd) {
    struct stat status;
    return fstat(fd, &status) == 0 && S_ISREG(status.st_mode) ? status.st_size : -1;
}

/* What is in a file from `from` on. NULL: nothing can be read. To be freed. */
static char *read_from(int fd, off_t from) {
    const off_t end = file_size(fd);
    if (end < 0 || from < 0) return NULL;
    const size_t size = from < end ? (size_t)(end - from) : 0;
    char *text = malloc(size + 1);
    size_t length = 0;
    while (text && length < size) {
        const ssize_t got = pread(fd, text + length, size - length, from + (off_t)length);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) break;
        length += (size_t)got;
    }
    if (text) text[length] = '\0';
    return text;
}

/* The next line, ended by a zero instead; NULL: there is none that is whole. */
static char *next_line(char **at) {
    char *line = *at, *end = strchr(line, '\n');
    if (!end) return NULL;
    *end = '\0';
    *at = end + 1;
    return line;
}

/* ---- What an earlier run left ---- */

struct line {
    unsigned long long unit;
    char *text;
};

/* Those of a unit are as they were written. */
static int compare_lines(const void *a, const void *b) {
    const struct line *p = a, *q = b;
    if (p->unit != q->unit) return p->unit < q->unit ? -1 : 1;
    return p->text < q->text ? -1 : 1;
}

/* The lines that wait, in the order of the batch. To be freed. */
static struct line *read_lines(char *at, size_t *count) {
    size_t room = 0;
    struct line *lines = NULL;
    for (char *text; (text = next_line(&at));) {
        if (*count == room) {
            room = room ? 2 * room : 64;
            struct line *more = realloc(lines, room * sizeof *lines);
            if (!more) break;
            lines = more;
        }
        char *tab;
        const unsigned long long unit = strtoull(text, &tab, 10);
        if (*tab == '\t') lines[(*count)++] = (struct line){unit, tab + 1};
    }
    if (*count > 0) qsort(lines, *count, sizeof *lines, compare_lines);
    return lines;
}

/* How many of the lines the log has already: the first ones, as both have the same order. */
static size_t count_written(const struct line *lines, size_t count, char *at) {
    size_t written = 0;
    for (char *text; written < count && (text = next_line(&at));)
        written += strcmp(text, lines[written].text) == 0;
    return written;
}

static void move_lines(const struct log_waiting *waiting, int log) {
    size_t count = 0;
    char *text = read_from(waiting->fd, 0), *at = text, *head = text ? next_line(&at) : NULL;
    char *written = head ? read_from(log, (off_t)strtoll(head, NULL, 10)) : NULL;
    struct line *lines = written ? read_lines(at, &count) : NULL;
    bool good = true;
    for (size_t i = written ? count_written(lines, count, written) : 0; good && i < count; i++) {
        char *line = say_text("%s\n", lines[i].text);
        good = append_whole(log, line);
        free(line);
    }
    if (good && (written || !head)) (void)!ftruncate(waiting->fd, 0);
    free(lines);
    free(written);
    free(text);
}

/* ---- All of it ---- */

/* Opens and locks the file; -1: another run has it, or it cannot be made. */
static int open_locked(const char *path) {
    for (;;) {
        struct stat status;
        const int fd = open(path, O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
        if (fd < 0) return -1;
        const bool locked = flock(fd, LOCK_EX | LOCK_NB) == 0;
        if (locked && fstat(fd, &status) == 0 && status.st_nlink > 0) return fd;
        close(fd);
        if (!locked) return -1;
    } /* its run has removed it meanwhile */
}

void log_waiting_open(struct log_waiting *waiting, const char *path, int log) {
    const char *slash = strrchr(path, '/'), *base = slash ? slash + 1 : path;
    *waiting = (struct log_waiting){.fd = -1, .lock = PTHREAD_MUTEX_INITIALIZER};
    if (strcmp(path, "-") == 0 || file_size(log) < 0) return;
    char *beside = say_text("%.*s.%s.waiting", (int)(base - path), path, base);
    waiting->fd = open_locked(beside);
    if (waiting->fd < 0) {
        free(beside);
        return;
    }
    waiting->path = beside;
    move_lines(waiting, log);
}

void log_waiting_add(struct log_waiting *waiting, int log, size_t unit, const char *line) {
    if (!waiting->path) return;
    pthread_mutex_lock(&waiting->lock);
    char *head = waiting->count == 0 ? say_text("%lld\n", (long long)file_size(log)) : say_text("%s", "");
    char *text = say_text("%s%zu\t%s", head, unit, line);
    append_whole(waiting->fd, text); /* where there is no room, the log will tell */
    waiting->count++;
    free(text);
    free(head);
    pthread_mutex_unlock(&waiting->lock);
}

void log_waiting_take(struct log_waiting *waiting) {
    if (!waiting->path) return;
    pthread_mutex_lock(&waiting->lock);
    if (--waiting->count == 0) (void)!ftruncate(waiting->fd, 0);
    pthread_mutex_unlock(&waiting->lock);
}

void log_waiting_close(struct log_waiting *waiting) {
    if (waiting->path) {
        if (waiting->count == 0) unlink(waiting->path);
        close(waiting->fd);
    }
    free(waiting->path);
    pthread_mutex_destroy(&waiting->lock);
}
