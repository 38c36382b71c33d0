/* Memory by lifetime: contents, alignment, marks, limits. Built small blocks and large. */
#include <stdalign.h>
#include <string.h>

#include "base/arena.h"
#include "near.h"

static void allocations_are_zeroed_aligned_and_apart(void **state) {
    (void)state;
    struct arena arena = {0};
    struct random r = random_begin();
    enum { COUNT_OF_BLOCKS = 2000 };
    static unsigned char *blocks[COUNT_OF_BLOCKS];
    static size_t sizes[COUNT_OF_BLOCKS];
    for (size_t i = 0; i < COUNT_OF_BLOCKS; i++) {
        sizes[i] = random_below(&r, i % 50 ? 200 : 100000);
        blocks[i] = arena_alloc(&arena, sizes[i]);
        assert_int_equal((uintptr_t)blocks[i] % alignof(max_align_t), 0);
        for (size_t j = 0; j < sizes[i]; j++) assert_int_equal(blocks[i][j], 0);
        memset(blocks[i], (int)(i % 255) + 1, sizes[i]);
    }
    for (size_t i = 0; i < COUNT_OF_BLOCKS; i++)
        for (size_t j = 0; j < sizes[i]; j++) assert_int_equal(blocks[i][j], i % 255 + 1);
    assert_true(arena.total > 0);
    arena_free(&arena);
    assert_int_equal(arena.total, 0);
    assert_null(arena.head);
    assert_non_null(arena_alloc(&arena, 1)); /* ready for use */
    arena_free(&arena);
}

static void memory_is_zeroed_again_after_a_release(void **state) {
    (void)state;
    struct arena arena = {0};
    arena_alloc(&arena, 8);
    const struct arena_mark mark = arena_mark(&arena);
    memset(arena_alloc(&arena, 40), 0xee, 40);
    arena_release(&arena, mark);
    const unsigned char *again = arena_alloc(&arena, 40);
    for (int i = 0; i < 40; i++) assert_int_equal(again[i], 0);
    arena_free(&arena);
}

static void marks_nest_and_keep_what_was_before(void **state) {
    (void)state;
    struct arena arena = {0};
    const struct arena_mark empty = arena_mark(&arena);
    char *first = arena_text(&arena, "first", 5);
    const struct arena_mark outer = arena_mark(&arena);
    const size_t before = arena.total;
    arena_text(&arena, "in the same block", 17);
    arena_alloc(&arena, 1000000);
    char *second = arena_text(&arena, "second", 6);
    const struct arena_mark inner = arena_mark(&arena);
    for (int i = 0; i < 100; i++) arena_alloc(&arena, 5000);
    arena_release(&arena, inner);
    assert_string_equal(second, "second");
    arena_release(&arena, outer);
    assert_true(arena.total <= 2 * before); /* a spare block at most */
    assert_string_equal(first, "first");
    assert_ptr_equal(arena_text(&arena, "", 0), first + alignof(max_align_t)); /* the room is used again */
    arena_release(&arena, empty);
    assert_true(arena.total <= before);
    arena_free(&arena);
    assert_int_equal(arena.total, 0);
}

/* Also where what comes next needs a block of its own, or one of the usual size. */
static void a_spare_block_serves_again(void **state) {
    (void)state;
    static const size_t sizes[] = {1, 1000, 1000000, 8, 30000};
    struct arena arena = {0};
    const struct arena_mark empty = arena_mark(&arena);
    for (int i = 0; i < 100; i++) {
        const size_t size = sizes[i % 5];
        unsigned char *bytes = arena_alloc(&arena, size), *more = arena_alloc(&arena, 64);
        memset(bytes, 0xee, size);
        for (int j = 0; j < 64; j++) assert_int_equal(more[j], 0);
        memset(more, 0xee, 64);
        arena_release(&arena, empty);
        assert_null(arena.head);
    }
    arena_free(&arena);
    assert_int_equal(arena.total, 0);
}

static void texts_are_copies_with_a_final_zero(void **state) {
    (void)state;
    struct arena arena = {0};
    assert_string_equal(arena_text(&arena, "abcdef", 3), "abc");
    assert_string_equal(arena_text(&arena, NULL, 0), "");
    assert_memory_equal(arena_text(&arena, "a\0b", 3), "a\0b", 4);
    char long_text[500];
    memset(long_text, 'x', sizeof long_text - 1);
    long_text[sizeof long_text - 1] = '\0';
    const char *formatted = arena_format(&arena, "%s-%d", long_text, 42);
    assert_int_equal(strlen(formatted), 502);
    assert_string_equal(formatted + 499, "-42");
    assert_string_equal(arena_format(&arena, "%s", ""), "");
    arena_free(&arena);
}

/* ---- Full ---- */

/* The sanitizers end a program that asks for more than there is, unless told so. */
const char *__asan_default_options(void);
const char *__asan_default_options(void) { return "allocator_may_return_null=1"; }
const char *__tsan_default_options(void);
const char *__tsan_default_options(void) { return "allocator_may_return_null=1"; }

static struct full {
    const char *name;
    size_t limit, count, size;
} fulls[] = {
    {"full: one large block", 100000, 1, 200000},
    {"full: many small blocks", 200000, SIZE_MAX, 100},
    {"full: more than can be addressed", 0, 1, SIZE_MAX},
    {"full: nearly more than can be addressed", 0, 1, SIZE_MAX - 40},
    {"full: more than there is", 0, 1, SIZE_MAX / 2},
};

static void check_full(void **state) {
    const struct full *row = *state;
    jmp_buf full;
    struct arena arena = {.limit = row->limit, .on_full = &full};
    char *volatile kept = NULL;
    if (setjmp(full) == 0) {
        kept = arena_text(&arena, "kept", 4);
        for (size_t i = 0; i < row->count; i++) arena_alloc(&arena, row->size);
        fail_msg("the arena was never full");
    }
    assert_string_equal(kept, "kept");
    assert_true(!row->limit || arena.total <= row->limit);
    arena_free(&arena);
}

static void an_array_that_overflows_is_full(void **state) {
    (void)state;
    jmp_buf full;
    struct arena arena = {.on_full = &full};
    if (setjmp(full) == 0) {
        arena_array(&arena, SIZE_MAX / 8 + 2, 8); /* the product wraps to 8 */
        fail_msg("the arena was never full");
    }
    assert_non_null(arena_array(&arena, 0, 8));
    assert_non_null(arena_array(&arena, 8, 0));
    arena_free(&arena);
}

static void after_being_full_smaller_pieces_still_fit(void **state) {
    (void)state;
    jmp_buf full;
    struct arena arena = {.limit = 300000, .on_full = &full};
    volatile int fulls_seen = 0;
    if (setjmp(full) != 0) fulls_seen++;
    if (fulls_seen < 3) arena_alloc(&arena, 400000);
    assert_int_equal(fulls_seen, 3);
    assert_non_null(arena_alloc(&arena, 1000));
    arena_free(&arena);
}

int main(void) {
    struct CMUnitTest tests[COUNT(fulls)];
    for (size_t i = 0; i < COUNT(fulls); i++)
        tests[i] = (struct CMUnitTest){fulls[i].name, check_full, NULL, NULL, &fulls[i]};
    const struct CMUnitTest others[] = {
        cmocka_unit_test(allocations_are_zeroed_aligned_and_apart),
        cmocka_unit_test(memory_is_zeroed_again_after_a_release),
        cmocka_unit_test(marks_nest_and_keep_what_was_before),
        cmocka_unit_test(a_spare_block_serves_again),
        cmocka_unit_test(texts_are_copies_with_a_final_zero),
        cmocka_unit_test(an_array_that_overflows_is_full),
        cmocka_unit_test(after_being_full_smaller_pieces_still_fit),
    };
    return cmocka_run_group_tests_name("full", tests, NULL, NULL) +
           cmocka_run_group_tests_name("arena", others, NULL, NULL);
}
