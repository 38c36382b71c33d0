#include "cli/progress.h"

#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "cli/clock.h"

enum { MAX_COLUMNS = 200, MAX_BAR = 40 };

#define INTERVAL 0.1 /* seconds between two drawings, and before the first */

bool progress_wanted(enum progress_wish wish, bool quiet) {
    if (wish == PROGRESS_AUTO) return !quiet && isatty(STDERR_FILENO);
    return wish == PROGRESS_ALWAYS;
}

void progress_begin(struct progress *progress, const char *name) {
    const double now = clock_seconds();
    *progress = (struct progress){.name = name, .begun = now, .drawn = now};
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

static void draw_bar(struct progress *p, double part, double seconds_left) {
    char line[6 * MAX_COLUMNS] = "", tail[48], left[32];
    const size_t columns = terminal_columns();
    describe_left(seconds_left, left, sizeof left);
    size_t tail_length = (size_t)snprintf(tail, sizeof tail, "%3d%%  %s", (int)(100.0 * part), left);
    if (tail_length > columns) tail_length = columns;
    const size_t room = columns - tail_length;
    size_t used = copy_name(line, p->name, room / 2);
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

void progress_update(void *progress, uint64_t done, uint64_t total) {
    struct progress *p = progress;
    const double now = clock_seconds();
    if (done == 0 || now - p->drawn < INTERVAL) return;
    p->drawn = now;
    const double part = (double)done / (double)total;
    draw_bar(p, part, (now - p->begun) * (1.0 - part) / part);
}

void progress_end(struct progress *progress) {
    if (progress->columns > 0) draw(progress, "", 0);
}
