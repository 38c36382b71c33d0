#include "image/flip_filter.h"

#include <math.h>

#include "base/elementary.h"

static const double pi = 3.14159265358979323846;

/* Contrast sensitivity, as sums of a * sqrt(pi / b) * exp(-pi^2 d^2 / b) of the distance d in degrees: the paper's
 * table 1. */
static const double luma_b = 0.0047, red_green_b = 0.0053;
static const double blue_yellow_a[2] = {34.1, 13.5}, blue_yellow_b[2] = {0.04, 0.025};

/* The width of the feature detectors in degrees: the paper's section 4.2. */
static const double feature_width = 0.082;

/* What weighs less than this beside the middle is lost in single precision. */
#define SMALLEST 1e-8

static double gaussian(double x, double deviation) {
    return elementary_exp(-x * x / (2.0 * deviation * deviation));
}

/* The standard deviation in pixels of exp(-pi^2 d^2 / b). */
static double deviation_of(double b, double ppd) { return sqrt(b / 2.0) / pi * ppd; }

/* Both sides and the middle. */
static double sum_of(int radius, double deviation) {
    double sum = 1.0;
    for (int k = 1; k <= radius; k++) sum += 2.0 * gaussian(k, deviation);
    return sum;
}

static void make_gaussian(struct flip_filter *f, int radius, double deviation, double scale) {
    f->radius = 0;
    for (int k = 0; k <= radius; k++) {
        const double value = gaussian(k, deviation);
        f->weight[k] = (float)(scale * value);
        if (value > SMALLEST) f->radius = k;
    }
}

static void make_contrast(struct flip_filters *filters, double ppd) {
    const int radius = (int)ceil(3.0 * deviation_of(blue_yellow_b[0], ppd));
    const double luma = deviation_of(luma_b, ppd), red_green = deviation_of(red_green_b, ppd);
    double height[2], volume = 0.0;
    make_gaussian(&filters->luma, radius, luma, 1.0 / sum_of(radius, luma));
    make_gaussian(&filters->red_green, radius, red_green, 1.0 / sum_of(radius, red_green));
    for (int i = 0; i < 2; i++) {
        const double sum = sum_of(radius, deviation_of(blue_yellow_b[i], ppd));
        height[i] = blue_yellow_a[i] * sqrt(pi / blue_yellow_b[i]);
        volume += height[i] * sum * sum;
    }
    for (int i = 0; i < 2; i++)
        make_gaussian(&filters->blue_yellow[i], radius, deviation_of(blue_yellow_b[i], ppd),
                      sqrt(height[i] / volume));
}

/* The derivatives are scaled so that what is above zero of them, and what is below, sums to 1. */
static void make_features(struct flip_filters *filters, double ppd) {
    const double deviation = 0.5 * feature_width * ppd;
    const int radius = (int)ceil(3.0 * deviation);
    double slope[FLIP_MAX_RADIUS + 1], bend[FLIP_MAX_RADIUS + 1], slopes = 0.0, above = 0.0, below = 0.0;
    for (int k = 0; k <= radius; k++) {
        const double g = gaussian(k, deviation), sides = k > 0 ? 2.0 : 1.0;
        slope[k] = k * g;
        bend[k] = (k * k / (deviation * deviation) - 1.0) * g;
        slopes += slope[k];
        *(bend[k] > 0.0 ? &above : &below) += sides * fabs(bend[k]);
    }
    make_gaussian(&filters->blur, radius, deviation, 1.0 / sum_of(radius, deviation));
    filters->blur.radius = filters->edge.radius = filters->point.radius = radius;
    for (int k = 0; k <= radius; k++) {
        filters->edge.weight[k] = (float)(slope[k] / slopes);
        filters->point.weight[k] = (float)(bend[k] / (bend[k] > 0.0 ? above : below));
    }
}

void flip_filters_make(struct flip_filters *filters, double ppd) {
    make_contrast(filters, ppd);
    make_features(filters, ppd);
    filters->radius = filters->blue_yellow[0].radius;
    if (filters->radius < filters->blur.radius) filters->radius = filters->blur.radius;
}
