/* One picture of a run of `monge render`. */
#ifndef MONGE_CLI_RENDER_PICTURE_H
#define MONGE_CLI_RENDER_PICTURE_H

#include "cli/work.h"

/* Renders the scene as it is now, whose load, or whose move to this frame, began at `begun`, into the last picture of
 * the unit, and writes it. The outcome is in the picture. */
enum status render_picture(struct unit *unit, struct load *load, double begun);

#endif
