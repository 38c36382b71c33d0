/* render --aov: the auxiliary passes of a picture, in files beside it. */
#ifndef MONGE_CLI_AOV_H
#define MONGE_CLI_AOV_H

#include "cli/report.h"

/* The file of a pass beside the picture. To be freed. */
char *aov_path(enum monge_layer layer, const char *picture);

/* Renders the passes of `set`, of which there is one at least, and writes them beside the picture that is of these
 * settings and this region. False, with the reason on stderr, when that cannot be done; without one when
 * job->cancel is set. */
bool aov_write(struct monge_scene *scene, const struct monge_settings *settings,
               const struct monge_region *region, unsigned set, const struct monge_job *job,
               const char *picture, struct report *report);

/* Notes the files of these passes for the film's picture, which is to be written when they are in place. */
void aov_note(struct monge_film *film, unsigned set, const char *picture);

/* Whether the files of these passes beside the picture are those that it says, by monge:passes. */
bool aov_unchanged(const struct monge_picture *picture, unsigned set, const char *path);

#endif
