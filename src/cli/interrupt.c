#include "cli/interrupt.h"

#include <pthread.h>
#include <signal.h>
#include <stddef.h>

static const int SIGNALS[] = {SIGINT, SIGTERM, SIGHUP};
enum { SIGNAL_COUNT = sizeof SIGNALS / sizeof *SIGNALS };

/* Signals belong to the process, so this state does too. */
static atomic_bool flag;
static volatile sig_atomic_t which;
static struct sigaction before[SIGNAL_COUNT];
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static unsigned deferring; /* threads */

static void on_signal(int number) {
    which = number;
    atomic_store(&flag, true);
}

static void defer_signals(void) {
    struct sigaction action = {.sa_handler = on_signal}; /* without SA_RESTART */
    sigemptyset(&action.sa_mask);
    for (int i = 0; i < SIGNAL_COUNT; i++) {
        sigaction(SIGNALS[i], NULL, &before[i]);
        if (before[i].sa_handler != SIG_IGN) sigaction(SIGNALS[i], &action, NULL);
    }
}

static void settle_signals(void) {
    for (int i = 0; i < SIGNAL_COUNT; i++) sigaction(SIGNALS[i], &before[i], NULL);
    if (interrupt_pending()) raise(which);
}

void interrupt_defer(void) {
    pthread_mutex_lock(&lock);
    if (deferring++ == 0) defer_signals();
    pthread_mutex_unlock(&lock);
}

void interrupt_settle(void) {
    pthread_mutex_lock(&lock);
    if (--deferring == 0) settle_signals();
    pthread_mutex_unlock(&lock);
}

const atomic_bool *interrupt_flag(void) { return &flag; }
bool interrupt_pending(void) { return atomic_load(&flag); }
