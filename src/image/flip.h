/* FLIP: the difference that is seen when two pictures alternate (Andersson, Nilsson, Akenine-Möller, Oskarsson,
 * Åström, Fairchild: FLIP: A Difference Evaluator for Alternating Images, HPG 2020), for pictures of low range.
 * Alpha is not looked at: `seen` does. */
#ifndef MONGE_IMAGE_FLIP_H
#define MONGE_IMAGE_FLIP_H

#include "image/compare.h"

/* The mean of the error over the pixels that are not ignored, one of which there is. What is ignored in b is as it
 * is in a, so that it does not show in its neighbours. map is NULL, or room for the error of each pixel, 0 .. 1,
 * row by row, 0 for those that are ignored. ppd: pixels per degree, above 0. The same bits for every number of
 * threads. False: no memory. */
bool flip_mean(const struct comparison *comparison, double ppd, float *map, double *mean);

#endif
