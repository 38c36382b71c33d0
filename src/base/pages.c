#include "base/pages.h"

#include <stdint.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

enum { LEAST = 1 << 20 /* bytes about which the system is asked */ };

void *pages_alloc(size_t size) {
    char *memory = malloc(size);
#ifdef MADV_HUGEPAGE /* where the system will not, it comes in small ones as ever */
    const size_t page = (size_t)sysconf(_SC_PAGESIZE), before = -(uintptr_t)memory % page;
    if (memory && size >= LEAST) madvise(memory + before, (size - before) / page * page, MADV_HUGEPAGE);
#endif
    return memory;
}
