#include "base/parallel.h"

#include <pthread.h>
#include <sched.h>
#include <stdbool.h>

struct parallel_task {
    void (*work)(void *context, unsigned thread);
    void *context;
    unsigned thread;
    pthread_t id;
    bool started;
};

static void *parallel_enter(void *argument) {
    struct parallel_task *task = argument;
    task->work(task->context, task->thread);
    return NULL;
}

void parallel_run(unsigned threads, void (*work)(void *context, unsigned thread), void *context) {
    struct parallel_task tasks[PARALLEL_MAX_THREADS];
    if (threads > PARALLEL_MAX_THREADS) threads = PARALLEL_MAX_THREADS;
    for (unsigned i = 1; i < threads; i++) {
        tasks[i] = (struct parallel_task){.work = work, .context = context, .thread = i};
        tasks[i].started = pthread_create(&tasks[i].id, NULL, parallel_enter, &tasks[i]) == 0;
    }
    work(context, 0);
    for (unsigned i = 1; i < threads; i++) {
        if (tasks[i].started)
            pthread_join(tasks[i].id, NULL);
        else
            work(context, i);
    }
}

unsigned parallel_processors(void) {
    cpu_set_t allowed;
    const int count = sched_getaffinity(0, sizeof allowed, &allowed) == 0 ? CPU_COUNT(&allowed) : 1;
    return count > 0 ? (unsigned)count : 1;
}
