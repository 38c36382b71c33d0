/* The time that a batch still takes, against what it then took: batches that run in a time of their own, where each
 * second is shared among those at work, as processors are. */
#include <string.h>

#include "cli/progress.c"
#include "near.h"

static double now; /* what the clock says */

int __wrap_clock_gettime(clockid_t clock, struct timespec *time);
int __wrap_clock_gettime(clockid_t clock, struct timespec *time) {
    (void)clock;
    const double whole = (double)(long)now;
    *time = (struct timespec){(time_t)whole, (long)((now - whole) * 1e9)};
    return 0;
}

#define STEP 0.01
enum { MAX_SCENES = 24, MAX_STEPS = 100000 };

struct scene {
    unsigned count;  /* of such scenes in a row */
    unsigned pixels; /* of a picture, in a line */
    unsigned samples, frames;
    double load, render; /* seconds for the scene, and for a picture, where nothing else is at work */
};

static const struct row {
    const char *name;
    unsigned jobs;
    struct scene scenes[4];
    double from, factor; /* from these seconds on, what is estimated is right up to the factor */
} rows[] = {
    {"one picture", 1, {{1, 10000, 1, 1, 0, 10}}, 0.6, 1.02},
    {"equal ones", 2, {{12, 10000, 4, 1, 0.01, 1}}, 0.6, 1.1},
    {"a slow one after fast ones", 2, {{7, 10000, 1, 1, 0.01, 0.02}, {1, 40000, 4, 1, 0.01, 20}}, 0.7, 1.05},
    {"a slow one before fast ones", 2, {{1, 40000, 4, 1, 0.01, 20}, {9, 10000, 1, 1, 0.01, 0.02}}, 0.7, 5},
    {"many samples, at once", 1, {{7, 10000, 1, 1, 0, 0.1}, {1, 10000, 100, 1, 0, 10}}, 0.85, 1.05},
    {"reading takes long", 1, {{20, 10000, 1, 1, 0.5, 0.1}}, 0.65, 1.2},
    {"frames", 2, {{2, 10000, 1, 24, 0.1, 0.5}}, 0.8, 1.1},
    {"more at once than are left", 8, {{3, 10000, 1, 1, 0.1, 5}}, 0.8, 1.1},
};

/* A scene of the batch while it is at work. */
struct work {
    const struct scene *scene;
    struct progress_unit unit;
    struct picture picture;
    double load, render; /* what is left of it */
    unsigned frames;
    bool begun, done;
};

struct step {
    double at, left;
};

static struct step steps[MAX_STEPS];

static void begin_picture(struct work *work) {
    work->render = work->scene->render;
    progress_picture(&work->unit, "scene", &work->picture, 0);
}

static void end_picture(struct work *work) {
    progress_rendered(&work->unit);
    progress_done(&work->unit, PICTURE_RENDERED);
    if (--work->frames > 0)
        begin_picture(work);
    else {
        progress_unit_end(&work->unit);
        work->done = true;
    }
}

static void advance(struct work *work, double seconds) {
    if (work->load > 0.0) {
        work->load -= seconds;
        if (work->load > 0.0) return;
        progress_pictures(&work->unit, work->frames);
        begin_picture(work);
        return;
    }
    work->render -= seconds;
    if (work->render <= 0.0) {
        end_picture(work);
        return;
    }
    const unsigned pixels = work->scene->pixels;
    progress_update(&work->unit, (uint64_t)(pixels * (1.0 - work->render / work->scene->render)), pixels);
}

static size_t make_works(const struct row *row, struct work works[MAX_SCENES]) {
    size_t count = 0;
    for (const struct scene *scene = row->scenes; scene < row->scenes + 4; scene++)
        for (unsigned i = 0; i < scene->count; i++) {
            works[count] = (struct work){.scene = scene, .load = scene->load + 1e-9, .frames = scene->frames};
            works[count].picture.region = (struct monge_region){0, 0, scene->pixels, 1};
            works[count++].picture.settings.samples = scene->samples;
        }
    return count;
}

/* Runs the batch; how many steps it took, of which each notes what was left. */
static size_t run(const struct row *row) {
    static struct work works[MAX_SCENES];
    struct progress progress;
    const size_t count = make_works(row, works);
    size_t done = 0, step = 0;
    double part = 0.0;
    now = 1000.0;
    progress_begin(&progress, PROGRESS_NEVER, true, count, 0);
    while (done < count) {
        size_t working = 0;
        for (size_t i = 0; i < count; i++) {
            if (!works[i].begun && working < row->jobs) {
                works[i].begun = true;
                progress_unit_begin(&works[i].unit, &progress);
            }
            working += works[i].begun && !works[i].done;
        }
        share_time(&progress); /* as whatever is told of does */
        steps[step++] = (struct step){now - 1000.0, progress_seconds_left(&progress)};
        const double before = part;
        part = part_shown(&progress, steps[step - 1].left);
        assert_true(part >= before && part <= 1.0);
        assert_true(step < MAX_STEPS);
        now += STEP;
        done = 0;
        for (size_t i = 0; i < count; i++) {
            if (works[i].begun && !works[i].done) advance(&works[i], STEP / (double)working);
            done += works[i].done;
        }
    }
    assert_near(progress_seconds_left(&progress), 0.0, 0.0, "when all is done");
    assert_near(part_shown(&progress, 0.0), 1.0, 0.0, "the part that is done then");
    progress_end(&progress);
    return step;
}

static void check_row(void **state) {
    const struct row *row = *state;
    const size_t count = run(row);
    const double end = steps[count - 1].at + STEP;
    for (size_t i = 0; steps[i].at < 0.45; i++) assert_true(steps[i].left < 0.0); /* nobody knows yet */
    for (size_t i = 0; i < count; i++) {
        const double left = end - steps[i].at, slack = 5 * STEP; /* of the steps themselves */
        if (steps[i].at < row->from) continue;
        if (steps[i].left <= left * row->factor + slack && steps[i].left >= left / row->factor - slack)
            continue;
        fail_msg("at %.2f s: %.2f s are left, estimated %.2f", steps[i].at, left, steps[i].left);
    }
}

/* ---- What is no work ---- */

static void what_was_known_takes_no_time(void **state) {
    (void)state;
    struct progress progress;
    struct progress_unit unit;
    const struct picture picture = {.region = {0, 0, 1000, 1}, .settings.samples = 1};
    now = 1000.0;
    progress_begin(&progress, PROGRESS_NEVER, true, 1, 0);
    progress_unit_begin(&unit, &progress);
    progress_picture(&unit, "scene", &picture, 800);
    progress_update(&unit, 800, 1000);
    assert_true(progress_seconds_left(&progress) < 0.0);
    now += 1.0;
    progress_update(&unit, 900, 1000);
    assert_near(progress_seconds_left(&progress), 1.0, 1e-6, "seconds left");
    progress_end(&progress);
}

static void unchanged_ones_and_failures_say_nothing_of_the_pace(void **state) {
    (void)state;
    struct progress progress;
    struct progress_unit units[3];
    const struct picture picture = {.region = {0, 0, 1000, 1}, .settings.samples = 1};
    now = 1000.0;
    progress_begin(&progress, PROGRESS_NEVER, true, 4, 1);
    for (int i = 0; i < 2; i++) {
        progress_unit_begin(&units[i], &progress);
        progress_done(&units[i], i == 0 ? PICTURE_UNCHANGED : PICTURE_FAILED);
        progress_unit_end(&units[i]);
    }
    assert_true(progress_seconds_left(&progress) < 0.0);
    assert_near(part_shown(&progress, -1.0), 3.0 / 5.0, 1e-9, "the part");
    progress_unit_begin(&units[2], &progress);
    progress_picture(&units[2], "scene", &picture, 0);
    now += 1.0;
    progress_update(&units[2], 250, 1000);
    assert_near(progress_seconds_left(&progress), 3.0 + 4.0, 1e-6, "seconds left");
    assert_near(part_shown(&progress, 7.0), 1.0 / 8.0, 1e-6, "the part");
    assert_near(part_shown(&progress, 9.0), 1.0 / 8.0, 1e-6, "the part, when more turns out to be left");
    assert_int_equal(count_done(&progress), 3);
    progress_end(&progress);
}

int main(void) {
    enum { ROWS = sizeof rows / sizeof *rows };
    struct CMUnitTest tests[ROWS + 2];
    for (size_t i = 0; i < ROWS; i++)
        tests[i] = (struct CMUnitTest){rows[i].name, check_row, NULL, NULL, (void *)&rows[i]};
    tests[ROWS] = (struct CMUnitTest)cmocka_unit_test(what_was_known_takes_no_time);
    tests[ROWS + 1] =
        (struct CMUnitTest)cmocka_unit_test(unchanged_ones_and_failures_say_nothing_of_the_pace);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
