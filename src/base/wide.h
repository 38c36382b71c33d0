/* Loops for machines with longer vectors. What has them is written once, INLINE, and compiled twice: into a function as
 * any other, and into one that is WIDE, for machines of which has_wide() is true. Both have the same results. */
#ifndef MONGE_BASE_WIDE_H
#define MONGE_BASE_WIDE_H

#include <stdbool.h>

#define INLINE static inline __attribute__((always_inline))

#if defined __x86_64__
#define WIDE __attribute__((target("avx2")))
static inline bool has_wide(void) { return __builtin_cpu_supports("avx2"); }
#else
#define WIDE
static inline bool has_wide(void) { return false; }
#endif

#endif
