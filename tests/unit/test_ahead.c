/* A thread that works ahead: what it makes comes in order, however fast either side is, and it ends when told. */
#include <stdatomic.h>
#include <unistd.h>

#include "base/ahead.h"
#include "near.h"

enum { MOST_SLOTS = 8 };

struct work {
    unsigned slots, count;           /* how many pieces there are */
    unsigned fill_pause, take_pause; /* microseconds, now and then */
    unsigned made;                   /* by the thread */
    unsigned piece[MOST_SLOTS];      /* in each slot */
    atomic_uint taken;
    bool wrong;
};

static bool fill(void *context, unsigned slot) {
    struct work *w = context;
    w->wrong |= slot != w->made % w->slots;
    w->wrong |= w->made >= atomic_load(&w->taken) + w->slots; /* what is being read is left alone */
    if (w->fill_pause && w->made % 7 == 0) usleep(w->fill_pause);
    w->piece[slot] = w->made++;
    return w->made < w->count;
}

static struct row {
    const char *name;
    struct work work;
    unsigned take; /* of them, before it is ended */
} rows[] = {
    {"all of many", {.slots = 4, .count = 5000}, 5000},
    {"one slot", {.slots = 1, .count = 500}, 500},
    {"a slow maker", {.slots = 3, .count = 100, .fill_pause = 200}, 100},
    {"a slow taker", {.slots = 3, .count = 100, .take_pause = 200}, 100},
    {"one piece", {.slots = 8, .count = 1}, 1},
    {"ended at once", {.slots = 2, .count = 1000000000}, 0},
    {"ended in the middle", {.slots = 2, .count = 1000000000}, 77},
    {"ended while it works", {.slots = 2, .count = 1000000000, .fill_pause = 1000}, 8},
};

static void check_row(void **state) {
    const struct row *row = *state;
    struct work w = row->work;
    struct ahead *ahead = ahead_begin(w.slots, fill, &w);
    assert_non_null(ahead);
    for (unsigned i = 0; i < row->take; i++) {
        const unsigned slot = ahead_next(ahead);
        assert_int_equal(w.piece[slot], i);
        if (w.take_pause && i % 7 == 0) usleep(w.take_pause);
        assert_int_equal(w.piece[slot], i);
        atomic_store(&w.taken, i + 1);
    }
    ahead_end(ahead);
    assert_false(w.wrong);
    assert_in_range(w.made, row->take, row->take + w.slots);
}

static void nothing_can_be_ended(void **state) {
    (void)state;
    ahead_end(NULL);
}

int main(void) {
    struct CMUnitTest tests[COUNT(rows) + 1] = {cmocka_unit_test(nothing_can_be_ended)};
    for (size_t i = 0; i < COUNT(rows); i++)
        tests[i + 1] = (struct CMUnitTest){rows[i].name, check_row, NULL, NULL, &rows[i]};
    return cmocka_run_group_tests_name("ahead", tests, NULL, NULL);
}
