#include "cli/progress.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "cli/clock.h"

enum { MAX_COLUMNS = 200, MAX_BAR = 40 };

#define INTERVAL 0.1 /* seconds between two drawings, and before the first bar */
#define TICK     1.0 /* seconds after which what has not changed is shown again */

/* Carriage returns do not move what a dumb terminal has printed. */
static bool is_seen(void) {
    const char *terminal = getenv("TERM");
    return isatty(STDERR_FILENO) && !(terminal && strcmp(terminal, "dumb") == 0);
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
    *text = '\0';
    if (seconds < 0.0) return;
    if (s < 3600)
        snprintf(text, size, "  %lu:%02lu left", s / 60, s % 60);
    else
        snprintf(text, size, "  %lu:%02lu:%02lu left", s / 3600, s / 60 % 60, s % 60);
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
    size_t tail_length = (size_t)snprintf(tail, sizeof tail, "%3d%%%s", (int)(100.0 * part), left);
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

/* ---- The time that is left ---- */

/* Before so many seconds there is no ground for it; or this part of the work of a single scene. */
#define FEW_SECONDS 0.5
#define FEW_WORK    0.05

static size_t count_working(const struct progress *p) {
    size_t count = 0;
    for (const struct progress_unit *unit = p->first; unit; unit = unit->next) count++;
    return count;
}

static bool is_rendering(const struct progress_unit *unit) { return unit->name != NULL; }

/* Shares the time up to now among those at work. What it takes to write a picture counts as its rendering. */
static void share_time(struct progress *p) {
    const double now = clock_seconds();
    const double share = p->first ? (now - p->now) / (double)count_working(p) : 0.0;
    for (struct progress_unit *unit = p->first; unit; unit = unit->next) {
        if (unit->work == 0.0) {
            unit->reading += share;
            continue;
        }
        unit->seconds += share;
        p->seconds += share;
    }
    p->now = now;
}

static size_t count_done(const struct progress *p) {
    return p->done[PICTURE_FAILED] + p->done[PICTURE_RENDERED] + p->done[PICTURE_UNCHANGED];
}

/* Pictures' worth of the unit that is not rendered. */
static double pictures_left(const struct progress_unit *unit) {
    const double left = (double)(unit->pictures - unit->done);
    return unit->of_pixels ? left - (double)unit->pixels / (double)unit->of_pixels : left;
}

static double mean_work(const struct progress *p) {
    return p->known_units ? p->known_work / (double)p->known_units : 0.0;
}

static double work_left(const struct progress *p) {
    double work = (double)(p->units - p->begun) * mean_work(p);
    for (const struct progress_unit *unit = p->first; unit; unit = unit->next)
        work += unit->work > 0.0 ? pictures_left(unit) * unit->work : mean_work(p);
    return work;
}

static double rendering_left(const struct progress *p) {
    const double pace = p->seconds / p->worked; /* seconds for a piece of work */
    double seconds = (double)(p->units - p->begun) * mean_work(p) * pace;
    for (const struct progress_unit *unit = p->first; unit; unit = unit->next) {
        const double own = unit->worked > 0.0 ? unit->seconds / unit->worked : pace;
        seconds += unit->work > 0.0 ? pictures_left(unit) * unit->work * own : mean_work(p) * pace;
    }
    return seconds;
}

/* Of those whose first picture has not begun, until it does. */
static double reading_left(const struct progress *p) {
    const double mean = p->known_units ? p->reading / (double)p->known_units : 0.0;
    double seconds = (double)(p->units - p->begun) * mean;
    for (const struct progress_unit *unit = p->first; unit; unit = unit->next)
        if (unit->work == 0.0 && unit->reading < mean) seconds += mean - unit->reading;
    return seconds;
}

double progress_seconds_left(const struct progress *p) {
    if (count_done(p) == p->pictures) return 0.0;
    const double part = p->worked / (p->worked + work_left(p));
    const bool enough = p->now - p->start >= FEW_SECONDS || (p->units == 1 && part >= FEW_WORK);
    return p->worked > 0.0 && enough ? rendering_left(p) + reading_left(p) : -1.0;
}

/* Of the time; as long as that is not known, of the work, or of the pictures where nothing has been rendered. */
static double part_done(const struct progress *p, double seconds_left) {
    const double seconds = p->now - p->start;
    if (seconds_left == 0.0) return 1.0;
    if (seconds_left > 0.0) return seconds / (seconds + seconds_left);
    if (p->worked > 0.0) return p->worked / (p->worked + work_left(p));
    return (double)count_done(p) / (double)p->pictures;
}

/* The part of the pictures tells nothing of the time; of that it never goes back: where more turns out to be left, it waits. */
static double part_shown(struct progress *p, double seconds_left) {
    const double part = part_done(p, seconds_left);
    if (p->worked == 0.0) return part;
    if (part > p->part) p->part = part;
    return p->part;
}

/* ---- The batch ---- */

static void print_running(const struct progress_unit *unit) {
    fputs("{\"scene\": ", stderr);
    monge_write_json_string(unit->picture->scene, stderr);
    fputs(", \"output\": ", stderr);
    monge_write_json_string(unit->picture->output, stderr);
    if (unit->picture->frame) fprintf(stderr, ", \"frame\": %u", unit->picture->frame);
    fprintf(stderr, ", \"pixels\": %" PRIu64 ", \"of_pixels\": %" PRIu64 "}", unit->pixels, unit->of_pixels);
}

static void print_json(const struct progress *p, double part, double left) {
    flockfile(stderr); /* in one piece, whatever other threads say */
    fprintf(stderr, "{\"done\": %zu, \"total\": %zu, \"rendered\": %zu, \"unchanged\": %zu, \"failed\": %zu",
            count_done(p), p->pictures, p->done[PICTURE_RENDERED], p->done[PICTURE_UNCHANGED],
            p->done[PICTURE_FAILED]);
    fprintf(stderr, ", \"part\": %.4f, \"seconds\": %.3f, \"seconds_left\": ", part, p->now - p->start);
    fprintf(stderr, left < 0.0 ? "null" : "%.3f", left);
    fputs(", \"running\": [", stderr);
    bool any = false;
    for (const struct progress_unit *unit = p->first; unit; unit = unit->next) {
        if (!is_rendering(unit)) continue;
        fputs(any ? ", " : "", stderr);
        print_running(unit);
        any = true;
    }
    fputs("]}\n", stderr);
    funlockfile(stderr);
}

/* Of several at work, the first one that began. */
static const char *name_at_work(const struct progress *p) {
    for (const struct progress_unit *unit = p->first; unit; unit = unit->next)
        if (unit->name) return unit->name;
    return "";
}

static void show(struct progress *p) {
    char title[8 * MAX_COLUMNS];
    const double left = progress_seconds_left(p), part = part_shown(p, left);
    p->shown = p->now;
    if (p->wish == PROGRESS_JSON) {
        print_json(p, part, left);
        return;
    }
    if (p->pictures > 1)
        snprintf(title, sizeof title, "%zu of %zu pictures  %s", count_done(p), p->pictures, name_at_work(p));
    else
        snprintf(title, sizeof title, "%s", name_at_work(p));
    draw_bar(p, title, part, left);
}

static bool is_due(const struct progress *p) { return p->now - p->shown >= INTERVAL; }

/* ---- When nothing is done for long ---- */

static void wait_interval(struct progress *p) {
    struct timespec until;
    clock_gettime(CLOCK_REALTIME, &until);
    until.tv_nsec += (long)(1e9 * INTERVAL);
    until.tv_sec += until.tv_nsec / 1000000000;
    until.tv_nsec %= 1000000000;
    pthread_cond_timedwait(&p->ended, &p->lock, &until);
}

/* A bar is drawn only while a picture is rendered: otherwise its thread may be writing to the terminal. */
static bool may_tick(const struct progress *p) { return p->wish == PROGRESS_JSON || *name_at_work(p); }

static void *tick(void *context) {
    struct progress *p = context;
    pthread_mutex_lock(&p->lock);
    while (!p->is_over) {
        const bool first = p->wish == PROGRESS_ALWAYS && p->columns == 0;
        share_time(p);
        if (may_tick(p) && (first ? is_due(p) : p->now - p->shown >= TICK)) show(p);
        wait_interval(p);
    }
    pthread_mutex_unlock(&p->lock);
    return NULL;
}

/* The first picture of JSON is shown as soon as it is begun. */
void progress_begin(struct progress *progress, enum progress_wish wish, bool quiet, size_t units,
                    size_t missing) {
    const double now = clock_seconds();
    if (wish == PROGRESS_AUTO) wish = !quiet && is_seen() ? PROGRESS_ALWAYS : PROGRESS_NEVER;
    *progress = (struct progress){.wish = wish,
                                  .lock = PTHREAD_MUTEX_INITIALIZER,
                                  .ended = PTHREAD_COND_INITIALIZER,
                                  .units = units,
                                  .pictures = units + missing,
                                  .done[PICTURE_FAILED] = missing,
                                  .start = now,
                                  .now = now,
                                  .shown = wish == PROGRESS_JSON ? now - 2 * INTERVAL : now};
    progress->ticks = wish != PROGRESS_NEVER && pthread_create(&progress->ticker, NULL, tick, progress) == 0;
}

/* ---- Units ---- */

void progress_unit_begin(struct progress_unit *unit, struct progress *progress) {
    *unit = (struct progress_unit){.progress = progress, .pictures = 1};
    pthread_mutex_lock(&progress->lock);
    share_time(progress);
    struct progress_unit **at = &progress->first;
    while (*at) at = &(*at)->next;
    *at = unit;
    progress->begun++;
    pthread_mutex_unlock(&progress->lock);
}

void progress_unit_end(struct progress_unit *unit) {
    struct progress *p = unit->progress;
    pthread_mutex_lock(&p->lock);
    share_time(p);
    struct progress_unit **at = &p->first;
    while (*at != unit) at = &(*at)->next;
    *at = unit->next;
    pthread_mutex_unlock(&p->lock);
}

void progress_pictures(struct progress_unit *unit, size_t pictures) {
    struct progress *p = unit->progress;
    pthread_mutex_lock(&p->lock);
    p->pictures += pictures - unit->pictures;
    unit->pictures = pictures;
    pthread_mutex_unlock(&p->lock);
}

void progress_picture(struct progress_unit *unit, const char *name, const struct picture *picture,
                      uint64_t known) {
    struct progress *p = unit->progress;
    const uint64_t pixels = (uint64_t)picture->region.width * picture->region.height;
    pthread_mutex_lock(&p->lock);
    share_time(p);
    p->known_units += unit->work == 0.0;
    p->reading += unit->work == 0.0 ? unit->reading : 0.0;
    p->known_work -= (double)unit->pictures * unit->work;
    unit->work = (double)pixels * picture->settings.samples;
    p->known_work += (double)unit->pictures * unit->work;
    unit->name = name;
    unit->picture = picture;
    unit->pixels = 0;
    unit->of_pixels = pixels;
    unit->known = known;
    if (p->wish == PROGRESS_JSON && is_due(p)) show(p);
    pthread_mutex_unlock(&p->lock);
}

/* Pixels that were there before are no work, and they come first. */
static uint64_t pixels_made(const struct progress_unit *unit, uint64_t done) {
    return done > unit->known ? done - unit->known : 0;
}

static void move(struct progress_unit *unit, uint64_t done) {
    const uint64_t made = pixels_made(unit, done) - pixels_made(unit, unit->pixels);
    const double work = unit->work * (double)made / (double)unit->of_pixels;
    unit->pixels = done;
    unit->worked += work;
    unit->progress->worked += work;
}

void progress_update(void *context, uint64_t done, uint64_t total) {
    struct progress_unit *unit = context;
    struct progress *p = unit->progress;
    (void)total;
    pthread_mutex_lock(&p->lock);
    share_time(p);
    if (done > unit->pixels) move(unit, done);
    if (p->wish != PROGRESS_NEVER && done > 0 && is_due(p)) show(p);
    pthread_mutex_unlock(&p->lock);
}

void progress_rendered(struct progress_unit *unit) {
    pthread_mutex_lock(&unit->progress->lock);
    share_time(unit->progress);
    unit->name = NULL;
    pthread_mutex_unlock(&unit->progress->lock);
}

void progress_done(struct progress_unit *unit, enum outcome outcome) {
    struct progress *p = unit->progress;
    pthread_mutex_lock(&p->lock);
    share_time(p);
    if (outcome == PICTURE_RENDERED) move(unit, unit->of_pixels); /* not every tile is told of */
    p->done[outcome]++;
    unit->done++;
    unit->pixels = unit->of_pixels = 0;
    if (p->wish == PROGRESS_JSON) show(p);
    pthread_mutex_unlock(&p->lock);
}

void progress_pause(struct progress *progress) {
    pthread_mutex_lock(&progress->lock);
    if (progress->columns > 0) draw(progress, "", 0);
}

void progress_resume(struct progress *progress) { pthread_mutex_unlock(&progress->lock); }

void progress_hide(struct progress *progress) {
    progress_pause(progress);
    progress_resume(progress);
}

static void end_ticking(struct progress *p) {
    if (!p->ticks) return;
    pthread_mutex_lock(&p->lock);
    p->is_over = true;
    pthread_cond_signal(&p->ended);
    pthread_mutex_unlock(&p->lock);
    pthread_join(p->ticker, NULL);
}

void progress_end(struct progress *progress) {
    end_ticking(progress);
    progress_hide(progress);
    pthread_cond_destroy(&progress->ended);
    pthread_mutex_destroy(&progress->lock);
}
