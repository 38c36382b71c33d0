/* What cmocka 1.1.5 lacks: doubles that may differ by rounding, and random numbers with a seed. */
#ifndef MONGE_TESTS_NEAR_H
#define MONGE_TESTS_NEAR_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "base/vec3.h"

#define COUNT(rows) (sizeof(rows) / sizeof *(rows))

static inline void assert_near(double got, double want, double tolerance, const char *what) {
    if (!(fabs(got - want) <= tolerance) && got != want)
        fail_msg("%s: got %.17g, want %.17g", what, got, want);
}

static inline void assert_vec3_near(vec3 got, vec3 want, double tolerance, const char *what) {
    if (!(vec3_max_abs(vec3_sub(got, want)) <= tolerance))
        fail_msg("%s: got (%.17g, %.17g, %.17g), want (%.17g, %.17g, %.17g)", what, got.x, got.y, got.z,
                 want.x, want.y, want.z);
}

/* splitmix64. MONGE_SEED=n repeats a run that failed. */
struct random {
    uint64_t state;
};

static inline struct random random_begin(void) {
    const char *given = getenv("MONGE_SEED");
    const uint64_t seed = given ? strtoull(given, NULL, 0) : 20260101;
    printf("# seed %llu\n", (unsigned long long)seed);
    return (struct random){seed};
}

static inline uint64_t random_bits(struct random *r) {
    uint64_t z = r->state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
}

static inline unsigned random_below(struct random *r, unsigned n) { return (unsigned)(random_bits(r) % n); }

static inline double random_between(struct random *r, double a, double b) {
    return a + (b - a) * (double)(random_bits(r) >> 11) * 0x1p-53;
}

static inline vec3 random_vec3(struct random *r, double a, double b) {
    return (vec3){random_between(r, a, b), random_between(r, a, b), random_between(r, a, b)};
}

#endif
