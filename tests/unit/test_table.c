/* Against a list that is searched from end to end. */
#include <string.h>

#include "base/table.h"
#include "near.h"

static void an_empty_table_has_nothing(void **state) {
    (void)state;
    const struct table table = {0};
    assert_null(table_find(&table, ""));
    assert_null(table_find(&table, "gold"));
}

static void like_a_list(void **state) {
    (void)state;
    enum { NAMES = 3000, STEPS = 20000 };
    static char names[NAMES][12];
    static int values[STEPS], *list[NAMES];
    struct arena arena = {0};
    struct table table = {0};
    struct random r = random_begin();
    size_t count = 0;
    memset(list, 0, sizeof list);
    for (unsigned i = 0; i < NAMES; i++) snprintf(names[i], sizeof names[i], "%u", i * 7919 % 4001);
    for (int i = 0; i < STEPS; i++) {
        const unsigned n = random_below(&r, NAMES), m = random_below(&r, NAMES);
        char same[12];
        strcpy(same, names[m]); /* found by its letters, not its address */
        assert_ptr_equal(table_find(&table, same), list[m]);
        if (i % 3) continue;
        count += !list[n];
        table_put(&arena, &table, names[n], list[n] = &values[i]);
        assert_int_equal(table.count, count);
    }
    for (unsigned i = 0; i < NAMES; i++) assert_ptr_equal(table_find(&table, names[i]), list[i]);
    assert_true(4 * table.count <= 3 * table.capacity);
    assert_int_equal(table.capacity & (table.capacity - 1), 0);
    arena_free(&arena);
}

static void the_empty_name_is_a_name(void **state) {
    (void)state;
    struct arena arena = {0};
    struct table table = {0};
    int value = 0;
    table_put(&arena, &table, "", &value);
    assert_ptr_equal(table_find(&table, ""), &value);
    assert_null(table_find(&table, "a"));
    arena_free(&arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_empty_table_has_nothing),
        cmocka_unit_test(like_a_list),
        cmocka_unit_test(the_empty_name_is_a_name),
    };
    return cmocka_run_group_tests_name("table", tests, NULL, NULL);
}
