/* New pictures become goldens. */
#ifndef MONGE_CLI_GOLDEN_TAKE_H
#define MONGE_CLI_GOLDEN_TAKE_H

#include "cli/golden/lock.h"

/* Whether the case failed in a way that its new picture would mend. */
bool golden_can_take(const struct golden_case *c);

/* Notes what there is of the golden, its picture and its line; and whether that is what there is now. */
void golden_note(const char *folder, const struct golden_lock *lock, struct golden_case *c);
bool golden_is_as_noted(const char *folder, const struct golden_lock *lock, const struct golden_case *c);

/* Whether the new picture of the case is its golden already. */
bool golden_is_taken(const char *folder, const struct golden_lock *lock, const struct golden_case *c);

/* Whether golden_take would write into the folder of the goldens, not where a link leads. False, with the reason told. */
bool golden_check_places(const char *folder, const struct golden_case *c);

/* Copies the picture of the golden, with its passes, to OUTPUT/old/NAME.png: its path from now on. False, with the reason
 * told. */
bool golden_keep(const char *output, struct golden_case *c);

/* Makes the new picture of the case its golden: in FOLDER, and in the lock, which is to be written. False, with the
 * reason told. */
bool golden_take(const char *folder, struct golden_lock *lock, const struct golden_case *c);

/* Removes a golden: its picture and what is beside it, its line. The same. */
bool golden_forget(const char *folder, struct golden_lock *lock, const struct golden_case *c);

#endif
