/* What the options of `monge render` ask for, where that differs from what a scene says. */
#ifndef MONGE_CLI_ASKED_H
#define MONGE_CLI_ASKED_H

#include "cli/options.h"
#include "cli/report.h"
#include "monge.h"

/* "--size 320x240 --samples 4 -D a=1 --frames 3": the options that change pixels, in the order of the table, then the
 * parameters by name and the frame, unless it is the first; as a shell takes them, and numbers the same however they were
 * written. "" where nothing is asked for. To be freed. */
char *asked_text(const struct option_value *option, const struct monge_define *defines, size_t define_count,
                 unsigned frame);

/* Whether the option is one of those that change pixels, but for -D and --frames. */
bool asked_changes_pixels(enum option_id option);

/* Whether it says what picture is to be made: one of those, or -D or --frames. */
bool asked_makes_picture(enum option_id option);

/* The settings as the options have them, where they do. */
void asked_settings(const struct option_value *option, struct monge_settings *settings);

/* The region that is asked for, or the whole picture. False, with the reason told, when it is not inside. */
bool asked_region(const struct option_value *option, const char *scene, const struct monge_settings *settings,
                  const struct report *report, struct monge_region *region);

/* The frames that --frames asks for, of an animation of `total`; without it the first alone. All that a still, of which
 * the total is 0, has is one. NULL, with the reason told, where they are not there. To be freed. */
unsigned *asked_frames(const struct option_value *option, const char *scene, unsigned total,
                       const struct report *report, size_t *count);

#endif
