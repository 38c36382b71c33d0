#include <math.h>
#include <string.h>

#include "lang/functions.h"

/* The finalizer of splitmix64 (Steele, Lea, Flood 2014). */
static uint64_t mix_bits(uint64_t z) {
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
}

uint64_t random_bits_of(uint64_t start, const double *v, unsigned count) {
    uint64_t bits = start;
    for (unsigned i = 0; i < count; i++) {
        const double value = v[i] + 0.0; /* of -0 makes 0 */
        uint64_t part;
        memcpy(&part, &value, sizeof part);
        bits = mix_bits((bits ^ part) + 0x9e3779b97f4a7c15u);
    }
    return bits;
}

/* The slope at a corner times the way from it. In one dimension slopes are any of -1 .. 1, in two the
 * 8 directions of a compass, in three those to the 12 edges of a cube. */
static double corner_value(const double *corner, const double *way, unsigned dimensions) {
    static const double s = 0.70710678118654757;
    static const double compass[8][2] = {{1, 0},  {s, s},   {0, 1},  {-s, s},
                                         {-1, 0}, {-s, -s}, {0, -1}, {s, -s}};
    const uint64_t bits = random_bits_of(dimensions, corner, dimensions);
    if (dimensions == 1) return way[0] * ((double)(bits >> 11) * 0x1p-52 - 1.0);
    if (dimensions == 2) return way[0] * compass[bits >> 61][0] + way[1] * compass[bits >> 61][1];
    const unsigned axis = (unsigned)((bits >> 32) * 3 >> 32); /* the one that the edge runs along */
    const double a = way[axis == 0], b = way[axis == 2 ? 1 : 2];
    return s * ((bits & 1 ? a : -a) + (bits & 2 ? b : -b));
}

double noise_at(const double *at, unsigned dimensions) {
    /* With slopes of length one the most is sqrt(dimensions) / 2, in the middle of a cell. */
    static const double scale[] = {0, 2, 1.4142135623730951, 1.1547005383792515};
    double low[3], way[3], fade[3], sum = 0.0;
    for (unsigned i = 0; i < dimensions; i++) {
        low[i] = floor(at[i]);
        const double t = way[i] = at[i] - low[i];
        fade[i] = t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
    }
    for (unsigned which = 0; which < 1u << dimensions; which++) {
        double corner[3] = {0}, from[3] = {0}, weight = 1.0;
        for (unsigned i = 0; i < dimensions; i++) {
            const unsigned high = which >> i & 1;
            corner[i] = low[i] + high;
            from[i] = way[i] - high;
            weight *= high ? fade[i] : 1.0 - fade[i];
        }
        sum += weight * corner_value(corner, from, dimensions);
    }
    return fmin(fmax(scale[dimensions] * sum, -1.0), 1.0); /* rounding may leave them */
}
