#include "cli/progress.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "cli/clock.h"

enum { MAX_COLUMNS = 200, MAX_BAR = 40 };

#define INTERVAL 0.1 /* seconds between two drawings, and before the first */

void progress_begin(struct progress *progress, enum progress_wish wish, bool quiet, size_t units) {
    const double now = clock_seconds();
    const bool seen = !quiet && isatty(STDERR_FILENO);
    if (wish == PROGRESS_AUTO) wish = seen ? PROGRESS_ALWAYS : PROGRESS_NEVER;
    *progress = (struct progress){.wish = wish,
                                  .lock = PTHREAD_MUTEX_INITIALIZER,
                                  .units = units,
                                  .pictures = units,
                                  .begun = now,
                                  .shown = now};
}

/* Columns that may be drawn in: the last one stays free, where some terminals would wrap. */
static size_t terminal_columns(void) {
    struct winsize size;
    if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return 79;
    return size.ws_col - 1u < MAX_COLUMNS ? size.ws_col - 1u : MAX_COLUMNS;
}

/* Copies at most `columns` characters of UTF-8, control characters as '?'; returns how many. */
static size_t copy_name(char *to, const char *name, size_t columns) {
    size_t count = 0;
    for (; *name; name++) {
        const unsigned char c = (unsigned char)*name;
        if ((c & 0xc0) != 0x80 && count++ == columns) return columns;
        *to++ = c < 0x20 || c == 0x7f ? '?' : (char)c;
    }
    return count;
}

static void describe_left(double seconds, char *text, size_t size) {
    const unsigned long s = (unsigned long)(seconds + 0.5);
    if (s < 3600)
        snprintf(text, size, "%lu:%02lu left", s / 60, s % 60);
    else
        snprintf(text, size, "%lu:%02lu:%02lu left", s / 3600, s / 60 % 60, s % 60);
}

/* One write, so that a line is never seen half drawn. Blanks cover what is left of a longer line. */
static void draw(struct progress *p, const char *line, size_t columns) {
    char text[8 * MAX_COLUMNS];
    const int blanks = p->columns > columns ? (int)(p->columns - columns) : 0;
    snprintf(text, sizeof text, "\r%s%*s%s", line, blanks, "", columns == 0 ? "\r" : "");
    fputs(text, stderr);
    fflush(stderr);
    p->columns = columns;
}

static void draw_bar(struct progress *p, const char *name, double part, double seconds_left) {
    char line[6 * MAX_COLUMNS] = "", tail[48], left[32];
    const size_t columns = terminal_columns();
    describe_left(seconds_left, left, sizeof left);
    size_t tail_length = (size_t)snprintf(tail, sizeof tail, "%3d%%  %s", (int)(100.0 * part), left);
    if (tail_length > columns) tail_length = columns;
    const size_t room = columns - tail_length;
    size_t used = copy_name(line, name, room / 2);
    char *end = line + strlen(line);
    if (room >= used + 8) {
        const size_t bar = room - used - 6 < MAX_BAR ? room - used - 6 : MAX_BAR;
        const size_t full = (size_t)((double)bar * part);
        end += sprintf(end, "  [");
        for (size_t i = 0; i < bar; i++) *end++ = i < full ? '#' : '-';
        end += sprintf(end, "] ");
        used += bar + 5;
    } else if (room > used) {
        *end++ = ' ';
        used++;
    }
    sprintf(end, "%.*s", (int)tail_length, tail);
    draw(p, line, used + tail_length);
}

/* ---- The batch ---- */

static size_t count_done(const struct progress *p) {
    return p->done[PICTURE_FAILED] + p->done[PICTURE_RENDERED] + p->done[PICTURE_UNCHANGED];
}

/* Units' worth that is not done; sums of parts are never quite whole. */
static double parts_left(const struct progress *p) {
    const double left = (double)p->units - p->parts;
    return left > 1e-9 ? left : 0.0;
}

static double part_done(const struct progress *p) { return 1.0 - parts_left(p) / (double)p->units; }

/* By what rendering has taken so far, which says nothing of pictures that need none. Negative: unknown. */
static double seconds_left(const struct progress *p, double now) {
    const double left = parts_left(p), rendered = p->parts - p->unchanged;
    if (left == 0.0) return 0.0;
    return rendered > 1e-9 ? (now - p->begun) * left / rendered : -1.0;
}

static void print_json(const struct progress *p, const struct progress_unit *unit, double now) {
    const double left = seconds_left(p, now);
    flockfile(stderr); /* in one piece, whatever other threads say */
    fprintf(stderr, "{\"done\": %zu, \"total\": %zu, \"rendered\": %zu, \"unchanged\": %zu, \"failed\": %zu",
            count_done(p), p->pictures, p->done[PICTURE_RENDERED], p->done[PICTURE_UNCHANGED],
            p->done[PICTURE_FAILED]);
    fprintf(stderr, ", \"part\": %.4f, \"seconds\": %.3f, \"seconds_left\": ", part_done(p), now - p->begun);
    fprintf(stderr, left < 0.0 ? "null" : "%.3f", left);
    if (unit && unit->name) {
        fputs(", \"picture\": ", stderr);
        monge_write_json_string(unit->name, stderr);
        fprintf(stderr, ", \"pixels\": %" PRIu64 ", \"of_pixels\": %" PRIu64, unit->pixels, unit->of_pixels);
    }
    fputs("}\n", stderr);
    funlockfile(stderr);
}

static void show(struct progress *p, const struct progress_unit *unit, double now) {
    char counts[64];
    p->shown = now;
    if (p->wish == PROGRESS_JSON) {
        print_json(p, unit, now);
        return;
    }
    const double left = seconds_left(p, now);
    snprintf(counts, sizeof counts, "%zu of %zu pictures", count_done(p), p->pictures);
    if (left >= 0.0) draw_bar(p, p->pictures > 1 ? counts : unit->name, part_done(p), left);
}

static double unit_part(const struct progress_unit *unit) {
    const double picture = unit->of_pixels ? (double)unit->pixels / (double)unit->of_pixels : 0.0;
    return ((double)unit->done + picture) / (double)unit->pictures;
}

void progress_pictures(struct progress_unit *unit, size_t pictures) {
    struct progress *p = unit->progress;
    pthread_mutex_lock(&p->lock);
    p->pictures += pictures - unit->pictures;
    unit->pictures = pictures;
    pthread_mutex_unlock(&p->lock);
}

void progress_picture(struct progress_unit *unit, const char *name) {
    pthread_mutex_lock(&unit->progress->lock);
    unit->name = name;
    pthread_mutex_unlock(&unit->progress->lock);
}

static void move(struct progress_unit *unit, size_t done, uint64_t pixels, uint64_t of_pixels) {
    const double before = unit_part(unit);
    unit->done = done;
    unit->pixels = pixels;
    unit->of_pixels = of_pixels;
    unit->progress->parts += unit_part(unit) - before;
}

void progress_update(void *context, uint64_t done, uint64_t total) {
    struct progress_unit *unit = context;
    struct progress *p = unit->progress;
    const double now = clock_seconds();
    pthread_mutex_lock(&p->lock);
    move(unit, unit->done, done, total);
    if (p->wish != PROGRESS_NEVER && done > 0 && now - p->shown >= INTERVAL) show(p, unit, now);
    pthread_mutex_unlock(&p->lock);
}

void progress_done(struct progress_unit *unit, enum outcome outcome) {
    struct progress *p = unit->progress;
    pthread_mutex_lock(&p->lock);
    p->done[outcome]++;
    if (outcome != PICTURE_RENDERED) p->unchanged += 1.0 / (double)unit->pictures;
    move(unit, unit->done + 1, 0, 0);
    if (p->wish == PROGRESS_JSON) show(p, unit, clock_seconds());
    unit->name = NULL;
    pthread_mutex_unlock(&p->lock);
}

void progress_hide(struct progress *progress) {
    pthread_mutex_lock(&progress->lock);
    if (progress->columns > 0) draw(progress, "", 0);
    pthread_mutex_unlock(&progress->lock);
}

void progress_end(struct progress *progress) {
    progress_hide(progress);
    pthread_mutex_destroy(&progress->lock);
}
