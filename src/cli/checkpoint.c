#include "cli/checkpoint.h"

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "cli/clock.h"
#include "cli/interrupt.h"
#include "cli/say.h"

/* Seconds between two times of writing, and before the first. */
#ifdef MONGE_HOSTILE
#define INTERVAL 0.05
#else
#define INTERVAL 1.0
#endif

#define PATIENCE 1.0 /* seconds that a run which was killed may take to be gone */

#define MAGIC "monge checkpoint 1\n"

enum { MAX_RECORD = 1 << 24 /* bytes; a tile is far smaller */ };

/* A tile in the file. */
struct known {
    struct monge_region tile;
    off_t pixels; /* where they begin */
};

/* A tile that was rendered and is not in the file yet. */
struct waiting {
    struct monge_region tile;
    const float *rgb;
    size_t stride;
};

struct waitings {
    struct waiting *all;
    size_t count, room;
};

struct checkpoint {
    char *path, *head; /* owned; the head is the text that the file begins with */
    const char *output;
    struct monge_tiles tiles;
    struct known *known; /* sorted by place */
    size_t known_count;
    pthread_mutex_t lock; /* of what follows */
    struct waitings waiting;
    double written; /* when that was, by clock_seconds */
    bool writing;   /* a thread does, and has the rest for itself */
    int fd;         /* -1: there is no file */
    off_t end;      /* of the last whole record */
    bool taken;     /* another run has the file, which this one asks for again whenever it would write */
    bool told;      /* that it is so */
    int trouble;    /* errno; from then on nothing is written */
};

/* ---- Records ---- */

static uint64_t checksum(uint64_t sum, const void *bytes, size_t size) { /* FNV-1a; 0 begins */
    const unsigned char *byte = bytes;
    if (sum == 0) sum = 0xcbf29ce484222325u;
    for (size_t i = 0; i < size; i++) sum = (sum ^ byte[i]) * 0x100000001b3u;
    return sum;
}

static size_t pixel_bytes(const struct monge_region *tile) {
    return 3 * sizeof(float) * (size_t)tile->width * tile->height;
}

static size_t record_bytes(const struct monge_region *tile) {
    return sizeof *tile + pixel_bytes(tile) + sizeof(uint64_t);
}

static bool read_all(int fd, void *to, size_t size, off_t at) {
    char *next = to;
    while (size > 0) {
        const ssize_t got = pread(fd, next, size, at);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return false;
        next += got;
        at += got;
        size -= (size_t)got;
    }
    return true;
}

static bool write_all(int fd, const void *from, size_t size, off_t at) {
    const char *next = from;
    while (size > 0) {
        const ssize_t written = pwrite(fd, next, size, at);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return false;
        next += written;
        at += written;
        size -= (size_t)written;
    }
    return true;
}

/* Whether a whole record begins at `at`. */
static bool read_record(int fd, off_t at, struct monge_region *tile) {
    uint64_t sum;
    if (!read_all(fd, tile, sizeof *tile, at)) return false;
    if (tile->width == 0 || tile->height == 0 || (uint64_t)tile->width * tile->height > MAX_RECORD / 16)
        return false;
    const size_t size = pixel_bytes(tile);
    char *pixels = malloc(size);
    const bool whole = pixels && read_all(fd, pixels, size, at + (off_t)sizeof *tile) &&
                       read_all(fd, &sum, sizeof sum, at + (off_t)(sizeof *tile + size)) &&
                       sum == checksum(checksum(0, tile, sizeof *tile), pixels, size);
    free(pixels);
    return whole;
}

static char *put(char *to, const void *from, size_t size) { return (char *)memcpy(to, from, size) + size; }

static char *put_record(char *to, const struct waiting *w) {
    const char *begin = to;
    to = put(to, &w->tile, sizeof w->tile);
    for (uint32_t y = 0; y < w->tile.height; y++)
        to = put(to, w->rgb + y * w->stride, 3 * sizeof(float) * w->tile.width);
    const uint64_t sum = checksum(0, begin, (size_t)(to - begin));
    return put(to, &sum, sizeof sum);
}

/* ---- The file ---- */

/* Opens and locks it, made where `flags` say so. errno: EWOULDBLOCK where another run has it. */
static int open_locked(const char *path, int flags) {
    for (;;) {
        struct stat opened, there;
        const int fd = open(path, O_RDWR | O_CLOEXEC | O_NOFOLLOW | flags, 0666);
        if (fd < 0) return -1;
        if (flock(fd, LOCK_EX | LOCK_NB) == 0) {
            if (stat(path, &there) == 0 && fstat(fd, &opened) == 0 && there.st_ino == opened.st_ino)
                return fd;
            close(fd); /* its run has completed and removed it meanwhile */
            if (!(flags & O_CREAT) && access(path, F_OK) != 0) return -1;
            continue;
        }
        const int reason = errno;
        close(fd);
        errno = reason;
        return -1;
    }
}

/* The same of a file that is there. A run that was killed has it until the system is done with that, which is waited for. */
static int open_soon(const char *path) {
    const struct timespec pause = {0, 20000000};
    const double end = clock_seconds() + PATIENCE;
    int fd;
    while ((fd = open_locked(path, 0)) < 0 && errno == EWOULDBLOCK && clock_seconds() < end &&
           !interrupt_pending())
        nanosleep(&pause, NULL);
    return fd;
}

static bool has_head(int fd, const char *head) {
    const size_t length = strlen(head);
    char *there = malloc(length);
    const bool same = there && read_all(fd, there, length, 0) && memcmp(there, head, length) == 0;
    free(there);
    return same;
}

static int compare_places(const void *a, const void *b) {
    const struct monge_region *p = a, *q = b;
    if (p->y != q->y) return p->y < q->y ? -1 : 1;
    return p->x < q->x ? -1 : p->x > q->x;
}

/* What an earlier run has left, up to the first record that is not whole. */
static void read_records(struct checkpoint *cp) {
    struct monge_region tile;
    cp->end = (off_t)strlen(cp->head);
    for (; read_record(cp->fd, cp->end, &tile); cp->end += (off_t)record_bytes(&tile)) {
        struct known *known = realloc(cp->known, (cp->known_count + 1) * sizeof *known);
        if (!known) break;
        cp->known = known;
        cp->known[cp->known_count++] = (struct known){tile, cp->end + (off_t)sizeof tile};
    }
    if (cp->known_count > 0) qsort(cp->known, cp->known_count, sizeof *cp->known, compare_places);
}

static bool begin_file(struct checkpoint *cp) {
    if (cp->fd < 0) cp->fd = open_locked(cp->path, O_CREAT);
    if (cp->fd < 0 || ftruncate(cp->fd, 0) != 0) return false;
    cp->end = (off_t)strlen(cp->head);
    return write_all(cp->fd, cp->head, (size_t)cp->end, 0);
}

/* 0, or errno. */
static int write_records(struct checkpoint *cp, const struct waitings *w) {
    size_t size = 0;
    for (size_t i = 0; i < w->count; i++) size += record_bytes(&w->all[i].tile);
    char *bytes = malloc(size), *to = bytes;
    for (size_t i = 0; bytes && i < w->count; i++) to = put_record(to, &w->all[i]);
    const bool good = bytes && (cp->end > 0 || begin_file(cp)) && write_all(cp->fd, bytes, size, cp->end) &&
                      fdatasync(cp->fd) == 0;
    const int reason = good ? 0 : errno;
    if (good) cp->end += (off_t)size;
    free(bytes);
    return reason;
}

/* What the disk has no room for must not take the room of the picture. */
static void give_up(struct checkpoint *cp) {
    if (cp->fd < 0) return;
    unlink(cp->path);
    close(cp->fd);
    cp->fd = -1;
}

/* ---- Tiles ---- */

static bool known_tile(void *context, const struct monge_region *tile, float *rgb, size_t stride) {
    const struct checkpoint *cp = context;
    const struct known *known =
        cp->known_count == 0 ? NULL
                             : bsearch(tile, cp->known, cp->known_count, sizeof *cp->known, compare_places);
    if (!known || known->tile.width != tile->width || known->tile.height != tile->height) return false;
    const size_t row = 3 * sizeof(float) * tile->width;
    for (uint32_t y = 0; y < tile->height; y++)
        if (!read_all(cp->fd, rgb + y * stride, row, known->pixels + (off_t)(y * row))) return false;
    return true;
}

static bool add_waiting(struct waitings *w, const struct waiting *tile) {
    if (w->count == w->room) {
        const size_t room = w->room ? 2 * w->room : 256;
        struct waiting *all = realloc(w->all, room * sizeof *all);
        if (!all) return false; /* it is rendered again another time */
        *w = (struct waitings){all, w->count, room};
    }
    w->all[w->count++] = *tile;
    return true;
}

/* What could not be written waits on, ahead of what has come meanwhile. */
static void put_back(struct waitings *now, struct waitings taken) {
    for (size_t i = 0; i < now->count; i++) add_waiting(&taken, &now->all[i]);
    free(now->all);
    *now = taken;
}

/* Writes what waits; the lock is held, but not while it writes. */
static void write_waiting(struct checkpoint *cp) {
    const struct waitings taken = cp->waiting;
    cp->waiting = (struct waitings){NULL, 0, 0};
    cp->writing = true;
    pthread_mutex_unlock(&cp->lock);
    const int reason = taken.count == 0 ? 0 : write_records(cp, &taken);
    if (reason && reason != EWOULDBLOCK && cp->known_count == 0) give_up(cp);
    pthread_mutex_lock(&cp->lock);
    cp->taken = reason == EWOULDBLOCK;
    if (cp->taken)
        put_back(&cp->waiting, taken);
    else
        free(taken.all);
    cp->trouble = cp->taken ? 0 : reason;
    cp->writing = false;
    cp->written = clock_seconds();
}

static void tile_done(void *context, const struct monge_region *tile, const float *rgb, size_t stride) {
    struct checkpoint *cp = context;
    pthread_mutex_lock(&cp->lock);
    if (!cp->trouble) {
        add_waiting(&cp->waiting, &(struct waiting){*tile, rgb, stride});
        if (!cp->writing && clock_seconds() - cp->written >= INTERVAL) write_waiting(cp);
    }
    pthread_mutex_unlock(&cp->lock);
}

static void rendering_stopped(void *context) {
    struct checkpoint *cp = context;
    pthread_mutex_lock(&cp->lock);
    if (!cp->trouble) write_waiting(cp);
    pthread_mutex_unlock(&cp->lock);
}

/* ---- All of it ---- */

static char *path_of(const char *output) {
    const char *slash = strrchr(output, '/'), *base = slash ? slash + 1 : output;
    return say_text("%.*s.%s.partial", (int)(base - output), output, base);
}

static void say_taken(struct checkpoint *cp) {
    cp->told = true;
    say_note("%s is rendered by another run as well, which keeps %s: this one goes without", cp->output,
             cp->path);
}

/* Whether a run has made it: one that was killed may not have come to the head. */
static bool is_checkpoint(int fd) {
    struct stat status;
    return has_head(fd, MAGIC) || (fstat(fd, &status) == 0 && S_ISREG(status.st_mode) && status.st_size == 0);
}

void checkpoint_forget(const char *output) {
    char *path = path_of(output);
    const int fd = open_locked(path, 0);
    if (fd >= 0 && is_checkpoint(fd)) unlink(path);
    if (fd >= 0) close(fd);
    free(path);
}

static void free_checkpoint(struct checkpoint *cp) {
    if (cp->fd >= 0) close(cp->fd);
    pthread_mutex_destroy(&cp->lock);
    free(cp->waiting.all);
    free(cp->known);
    free(cp->head);
    free(cp->path);
    free(cp);
}

struct checkpoint *checkpoint_open(const char *output, const char *what) {
    struct checkpoint *cp = calloc(1, sizeof *cp);
    if (!cp) return NULL;
    const uint32_t order = 0x01020304; /* of the bytes in a number: as this machine has it */
    *cp = (struct checkpoint){.path = path_of(output), .output = output, .written = clock_seconds()};
    cp->head = say_text(MAGIC "%s\n%.4s\n\n", what, (const char *)&order);
    cp->tiles = (struct monge_tiles){cp, known_tile, tile_done, rendering_stopped};
    pthread_mutex_init(&cp->lock, NULL);
    cp->fd = open_soon(cp->path);
    cp->taken = cp->fd < 0 && errno == EWOULDBLOCK;
    if (cp->taken) say_taken(cp);
    if (cp->fd >= 0 && has_head(cp->fd, cp->head)) read_records(cp);
    return cp;
}

const struct monge_tiles *checkpoint_tiles(const struct checkpoint *checkpoint) { return &checkpoint->tiles; }

uint64_t checkpoint_pixels(const struct checkpoint *checkpoint) {
    uint64_t pixels = 0;
    for (size_t i = 0; i < checkpoint->known_count; i++)
        pixels += (uint64_t)checkpoint->known[i].tile.width * checkpoint->known[i].tile.height;
    return pixels;
}

void checkpoint_close(struct checkpoint *cp, bool complete, const struct report *report) {
    if (!cp) return;
    if (cp->taken && !cp->told) say_taken(cp);
    if (cp->trouble)
        report_warning(report, "cannot-write", "cannot write the checkpoint %s: %s", cp->path,
                       strerror(cp->trouble));
    if (cp->fd >= 0 && complete) unlink(cp->path);
    free_checkpoint(cp);
}
