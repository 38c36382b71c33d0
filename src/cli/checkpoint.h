/* render --resume: the tiles of a picture that takes long, kept beside it until it is complete.
 *
 *     .king.png.partial     a text that says of which picture; then a record for each tile:
 *                           x, y, width, height, the pixels as floats, a checksum
 *
 * Records are only ever added, so that a run that is killed leaves whole ones and at most a torn last one, which its
 * checksum tells. A file of another picture, of other settings or of another program is no checkpoint of this one, and
 * is replaced. While a run has the file, it is locked; another one for the same picture goes without as long as that
 * lasts. */
#ifndef MONGE_CLI_CHECKPOINT_H
#define MONGE_CLI_CHECKPOINT_H

#include "cli/report.h"
#include "monge.h"

struct checkpoint;

/* The checkpoint of the picture that `output` is to become, `what` being a text that is the same for the same pixels
 * alone. Where there is none to go on with, one begins once the rendering has taken a while. NULL where there is no
 * memory. */
struct checkpoint *checkpoint_open(const char *output, const char *what);

/* For monge_job; lives as long as the checkpoint. */
const struct monge_tiles *checkpoint_tiles(const struct checkpoint *checkpoint);

/* Pixels that were known when it was opened. */
uint64_t checkpoint_pixels(const struct checkpoint *checkpoint);

/* Removes what there may be for a picture that is complete, of a run that was stopped; not what a run has that is at
 * work. */
void checkpoint_forget(const char *output);

/* Done with it, with the reason told where something could not be kept; `complete`: the picture is in its place, so
 * that the file goes. NULL is allowed. */
void checkpoint_close(struct checkpoint *checkpoint, bool complete, const struct report *report);

#endif
