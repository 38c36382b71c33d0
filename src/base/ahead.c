#include "base/ahead.h"

#include <pthread.h>
#include <stdlib.h>

struct ahead {
    bool (*fill)(void *context, unsigned slot);
    void *context;
    unsigned slots;
    pthread_t thread;
    pthread_mutex_t mutex; /* of all below */
    pthread_cond_t has_full, has_free;
    unsigned long full, taken, freed; /* how many slots so far: freed <= taken <= full <= freed + slots */
    bool stop;
};

/* Waits for a slot to fill. False: it is over. */
static bool wait_for_free(struct ahead *a) {
    pthread_mutex_lock(&a->mutex);
    while (!a->stop && a->full - a->freed == a->slots) pthread_cond_wait(&a->has_free, &a->mutex);
    const bool go_on = !a->stop;
    pthread_mutex_unlock(&a->mutex);
    return go_on;
}

static void *run(void *argument) {
    struct ahead *a = argument;
    bool more = true;
    for (unsigned slot = 0; more && wait_for_free(a); slot = (slot + 1) % a->slots) {
        more = a->fill(a->context, slot);
        pthread_mutex_lock(&a->mutex);
        a->full++;
        pthread_cond_signal(&a->has_full);
        pthread_mutex_unlock(&a->mutex);
    }
    return NULL;
}

static void free_all(struct ahead *a) {
    pthread_cond_destroy(&a->has_free);
    pthread_cond_destroy(&a->has_full);
    pthread_mutex_destroy(&a->mutex);
    free(a);
}

struct ahead *ahead_begin(unsigned slots, bool (*fill)(void *context, unsigned slot), void *context) {
    struct ahead *a = malloc(sizeof *a);
    if (!a) return NULL;
    *a = (struct ahead){.fill = fill, .context = context, .slots = slots};
    pthread_mutex_init(&a->mutex, NULL);
    pthread_cond_init(&a->has_full, NULL);
    pthread_cond_init(&a->has_free, NULL);
    if (pthread_create(&a->thread, NULL, run, a) == 0) return a;
    free_all(a);
    return NULL;
}

unsigned ahead_next(struct ahead *a) {
    pthread_mutex_lock(&a->mutex);
    a->freed = a->taken;
    pthread_cond_signal(&a->has_free);
    while (a->full == a->taken) pthread_cond_wait(&a->has_full, &a->mutex);
    const unsigned slot = (unsigned)(a->taken++ % a->slots);
    pthread_mutex_unlock(&a->mutex);
    return slot;
}

void ahead_end(struct ahead *a) {
    if (!a) return;
    pthread_mutex_lock(&a->mutex);
    a->stop = true;
    pthread_cond_signal(&a->has_free);
    pthread_mutex_unlock(&a->mutex);
    pthread_join(a->thread, NULL);
    free_all(a);
}
