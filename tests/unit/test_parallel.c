/* Every thread number once, at the same time. */
#include <pthread.h>
#include <stdatomic.h>
#include <sys/resource.h>

#include "base/parallel.h"
#include "near.h"

static atomic_uint calls[PARALLEL_MAX_THREADS];

static void count_call(void *context, unsigned thread) {
    atomic_fetch_add(&calls[thread], 1);
    atomic_fetch_add((atomic_uint *)context, thread);
}

static void run_and_check(unsigned threads) {
    atomic_uint sum = 0;
    for (unsigned i = 0; i < PARALLEL_MAX_THREADS; i++) atomic_store(&calls[i], 0);
    parallel_run(threads, count_call, &sum);
    for (unsigned i = 0; i < PARALLEL_MAX_THREADS; i++) assert_int_equal(atomic_load(&calls[i]), i < threads);
    assert_int_equal(atomic_load(&sum), threads * (threads - 1) / 2);
}

static void each_number_is_called_once(void **state) {
    (void)state;
    const unsigned threads[] = {1, 2, 3, 8, 64, 200};
    for (size_t i = 0; i < COUNT(threads); i++) run_and_check(threads[i]);
}

/* Comes back only if all four wait at once. */
static void meet(void *context, unsigned thread) {
    (void)thread;
    pthread_barrier_wait(context);
}

static void the_calls_run_at_the_same_time(void **state) {
    (void)state;
    pthread_barrier_t barrier;
    pthread_barrier_init(&barrier, NULL, 4);
    parallel_run(4, meet, &barrier);
    pthread_barrier_destroy(&barrier);
}

static pthread_t caller;
static atomic_bool is_caller;

static void note_caller(void *context, unsigned thread) {
    (void)context;
    (void)thread;
    if (pthread_equal(pthread_self(), caller)) atomic_store(&is_caller, true);
}

static void the_caller_works_too(void **state) {
    (void)state;
    caller = pthread_self();
    parallel_run(3, note_caller, NULL);
    assert_true(atomic_load(&is_caller));
}

/* With no address space left for stacks, pthread_create fails. */
static void the_work_is_done_without_threads(void **state) {
    (void)state;
#if defined __SANITIZE_ADDRESS__ || defined __SANITIZE_THREAD__ ||                                           \
    defined __clang__ /* which names its sanitizers otherwise */
    skip();           /* they reserve address space of their own */
#else
    struct rlimit before, none;
    getrlimit(RLIMIT_AS, &before);
    none = before;
    none.rlim_cur = 1;
    setrlimit(RLIMIT_AS, &none);
    static atomic_uint sum;
    parallel_run(20, count_call, &sum);
    setrlimit(RLIMIT_AS, &before);
    assert_int_equal(atomic_load(&sum), 190);
#endif
}

static void there_is_a_processor(void **state) {
    (void)state;
    assert_in_range(parallel_processors(), 1, 100000);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_number_is_called_once), cmocka_unit_test(the_calls_run_at_the_same_time),
        cmocka_unit_test(the_caller_works_too),       cmocka_unit_test(the_work_is_done_without_threads),
        cmocka_unit_test(there_is_a_processor),
    };
    return cmocka_run_group_tests_name("parallel", tests, NULL, NULL);
}
