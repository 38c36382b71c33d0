#include "cli/interrupt.h"

#include <signal.h>
#include <stddef.h>

static const int SIGNALS[] = {SIGINT, SIGTERM, SIGHUP};
enum { SIGNAL_COUNT = sizeof SIGNALS / sizeof *SIGNALS };

/* Signals belong to the process, so this state does too. */
static atomic_bool flag;
static volatile sig_atomic_t which;
static struct sigaction before[SIGNAL_COUNT];

static void on_signal(int number) {
    which = number;
    atomic_store(&flag, true);
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
