#include "cli/interrupt.h"

#include <signal.h>
#include <stddef.h>
#include <time.h>

static const int SIGNALS[] = {SIGINT, SIGTERM, SIGHUP};
enum { SIGNAL_COUNT = sizeof SIGNALS / sizeof *SIGNALS };

enum { AGAIN = 500 /* milliseconds; some programs send each signal twice, as timeout(1) does */ };

/* Signals belong to the process, so this state does too. */
static atomic_bool flag;
static volatile sig_atomic_t which; /* the first that came */
static atomic_llong came;           /* when, in milliseconds; 0: none has */
static struct sigaction before[SIGNAL_COUNT];

static long long milliseconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return now.tv_sec * 1000LL + now.tv_nsec / 1000000;
}

static void on_signal(int number) {
    const long long now = milliseconds();
    long long first = 0;
    if (atomic_compare_exchange_strong(&came, &first, now)) {
        which = number;
        atomic_store(&flag, true);
    } else if (now - first >= AGAIN) {
        signal(number, SIG_DFL);
        raise(number);
    }
}

void interrupt_defer(void) {
    struct sigaction action = {.sa_handler = on_signal}; /* without SA_RESTART */
    sigemptyset(&action.sa_mask);
    for (int i = 0; i < SIGNAL_COUNT; i++) {
        sigaction(SIGNALS[i], NULL, &before[i]);
        if (before[i].sa_handler != SIG_IGN) sigaction(SIGNALS[i], &action, NULL);
    }
}

void interrupt_settle(void) {
    for (int i = 0; i < SIGNAL_COUNT; i++) sigaction(SIGNALS[i], &before[i], NULL);
    if (interrupt_pending()) raise(which);
}

const atomic_bool *interrupt_flag(void) { return &flag; }
bool interrupt_pending(void) { return atomic_load(&flag); }
