#include "cli/batch.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "cli/interrupt.h"
#include "cli/say.h"

/* What a unit said until it may be told. */
struct said {
    char *text;
    size_t size;
    bool done;
};

/* Shared by the threads, each of which takes the next unit until none is left. */
struct pool {
    const struct batch *batch;
    struct said *units;
    pthread_mutex_t lock; /* of all that follows */
    pthread_cond_t ended; /* a unit has */
    size_t next, told;    /* the first ones are begun, and told */
    unsigned running;
    bool stopped;
};

/* Pages in memory now; 0: unknown. */
static long resident_pages(void) {
    long all = 0, resident = 0;
    FILE *file = fopen("/proc/self/statm", "re");
    if (!file) return 0;
    if (fscanf(file, "%ld %ld", &all, &resident) != 2) resident = 0;
    fclose(file);
    return resident;
}

static bool memory_is_short(void) { return resident_pages() > sysconf(_SC_PHYS_PAGES) / 2; }

/* False: there is no further one to run. */
static bool take_unit(struct pool *pool, size_t *index) {
    pthread_mutex_lock(&pool->lock);
    while (!pool->stopped && pool->next < pool->batch->count && pool->running > 0 && memory_is_short())
        pthread_cond_wait(&pool->ended, &pool->lock);
    const bool taken = !pool->stopped && pool->next < pool->batch->count && !interrupt_pending();
    if (taken) {
        *index = pool->next++;
        pool->running++;
    }
    pthread_mutex_unlock(&pool->lock);
    return taken;
}

static void tell(struct pool *pool) {
    for (; pool->told < pool->next && pool->units[pool->told].done; pool->told++) {
        struct said *unit = &pool->units[pool->told];
        pool->batch->ended(pool->batch->context, pool->told, unit->text ? unit->text : "");
        free(unit->text);
    }
}

static void end_unit(struct pool *pool, size_t index, bool more) {
    pthread_mutex_lock(&pool->lock);
    pool->units[index].done = true;
    pool->running--;
    pool->stopped |= !more;
    tell(pool);
    pthread_cond_broadcast(&pool->ended);
    pthread_mutex_unlock(&pool->lock);
}

static bool run_apart(struct pool *pool, size_t index) {
    struct said *unit = &pool->units[index];
    FILE *stream = open_memstream(&unit->text, &unit->size);
    say_divert(stream);
    const bool more = pool->batch->run(pool->batch->context, index);
    say_divert(NULL);
    if (stream) fclose(stream);
    return more;
}

static void *run_units(void *context) {
    struct pool *pool = context;
    for (size_t index; take_unit(pool, &index);) {
        const bool more =
            pool->batch->held ? run_apart(pool, index) : pool->batch->run(pool->batch->context, index);
        end_unit(pool, index, more);
    }
    return NULL;
}

size_t batch_run(const struct batch *batch) {
    struct pool pool = {.batch = batch,
                        .units = calloc(batch->count + 1, sizeof *pool.units),
                        .lock = PTHREAD_MUTEX_INITIALIZER,
                        .ended = PTHREAD_COND_INITIALIZER};
    pthread_t *threads = calloc(batch->jobs, sizeof *threads);
    unsigned started = 0;
    if (!pool.units || !threads) say_no_memory();
    while (started + 1 < batch->jobs && pthread_create(&threads[started], NULL, run_units, &pool) == 0)
        started++;
    run_units(&pool);
    for (unsigned i = 0; i < started; i++) pthread_join(threads[i], NULL);
    free(threads);
    free(pool.units);
    return pool.next;
}
