/* The metrics that tell what is seen, FLIP and SSIM, of pictures with alpha as well. These are looked at over black and
 * over white, and the worse of both counts: what is hidden under alpha 0 is not seen, and nothing looks the same over
 * both but what is the same. As programs that show pictures do, the numbers in the files are mixed, and rounded. */
#ifndef MONGE_IMAGE_SEEN_H
#define MONGE_IMAGE_SEEN_H

#include "image/compare.h"

/* flip_mean; with alpha, that of the larger error of each pixel, which map gets. False: no memory. */
bool seen_flip(const struct comparison *comparison, double ppd, float *map, double *mean);

/* ssim_mean; with alpha, the smaller one. False: no memory. */
bool seen_ssim(const struct comparison *comparison, double *mean);

#endif
