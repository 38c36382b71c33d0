/* The filters of FLIP, each the product of one along x and one along y. */
#ifndef MONGE_IMAGE_FLIP_FILTER_H
#define MONGE_IMAGE_FLIP_FILTER_H

#include <stdbool.h>

enum { FLIP_MAX_PPD = 1000, FLIP_MAX_RADIUS = 136 };

/* One half of a filter: weight[k] for k pixels to either side; of an odd one minus that for the pixels before. */
struct flip_filter {
    int radius;
    float weight[FLIP_MAX_RADIUS + 1];
};

struct flip_filters {
    struct flip_filter luma, red_green;   /* of contrast sensitivity: equal along x and y */
    struct flip_filter blue_yellow[2];    /* a sum of two */
    struct flip_filter blur, edge, point; /* of features: a Gaussian and its derivatives; edge is odd */
    int radius;                           /* the largest */
};

/* ppd is above 0 and at most FLIP_MAX_PPD. */
void flip_filters_make(struct flip_filters *filters, double ppd);

#endif
