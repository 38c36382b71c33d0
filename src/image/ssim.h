/* SSIM: structural similarity (Wang, Bovik, Sheikh, Simoncelli: Image Quality Assessment: From Error Visibility to
 * Structural Similarity, IEEE Transactions on Image Processing 13, 2004), of luma: 0.299 R + 0.587 G + 0.114 B of the
 * numbers in the files. Alpha is not looked at: `seen` does. */
#ifndef MONGE_IMAGE_SSIM_H
#define MONGE_IMAGE_SSIM_H

#include "image/compare.h"

/* The mean over the pixels whose window of 11 x 11 (a Gaussian of 1.5 pixels) is within the picture. In a picture of less
 * than 11 pixels that way it is over all, and the edge pixels are repeated; so it is where some are ignored, over all others,
 * and 1 where there are none: what is ignored in b is as it is in a. The same bits for every number of threads. False: no
 * memory. */
bool ssim_mean(const struct comparison *comparison, double *mean);

#endif
