#include "base/pages.h"

#include <stdint.h>
#include <stdlib.h>
#include <sys/mman.h>

enum { LARGE = 1 << 21 /* bytes of a large page */ };

void *pages_alloc(size_t size) {
#ifdef MADV_HUGEPAGE /* where the system will not, it comes in small ones as ever */
    if (size >= LARGE && size <= SIZE_MAX - LARGE) {
        const size_t whole = (size + LARGE - 1) / LARGE * LARGE;
        void *memory = aligned_alloc(LARGE, whole);
        if (memory) madvise(memory, whole, MADV_HUGEPAGE);
        return memory;
    }
#endif
    return malloc(size);
}
