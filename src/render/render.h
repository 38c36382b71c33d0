/* Traces and shades a scene into a film, tile by tile on several threads. */
#ifndef MONGE_RENDER_RENDER_H
#define MONGE_RENDER_RENDER_H

#include "accel/accel.h"
#include "render/film.h"
#include "scene/scene.h"

/* Fills the film's region. The settings are the film's. False when job->cancel was set before it
 * was done, memory ran out, or the scene is too much for a ray, which diag (NULL: nobody) is told. job and
 * stats are not NULL; of stats, rays and threads are filled. */
bool render_film(const struct scene *scene, const struct accel *accel, const struct monge_job *job,
                 struct monge_film *film, struct monge_stats *stats, struct diagnostics *diag);

#endif
