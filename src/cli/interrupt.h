/* Ctrl-C and its like while something must not be left half done.
 *
 *     interrupt_defer();        from here SIGINT, SIGTERM and SIGHUP only set the flag
 *     ...                       render with it as monge_job's cancel; write; tell what is done
 *     interrupt_settle();       dies here of the signal that has come, if one has
 *
 * Defer and settle are the main thread's, once around all its work. There, calls that wait (a write to a full pipe) end
 * with EINTR. A second signal, half a second or more after the first, ends the program at once. One that was ignored
 * when the program started, as under nohup, stays so. */
#ifndef MONGE_CLI_INTERRUPT_H
#define MONGE_CLI_INTERRUPT_H

#include <stdatomic.h>
#include <stdbool.h>

void interrupt_defer(void);
void interrupt_settle(void);

const atomic_bool *interrupt_flag(void);
bool interrupt_pending(void);

#endif
