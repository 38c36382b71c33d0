#include "base/pages.h"

#include <stdint.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

enum { LEAST = 1 << 20 /* bytes about which the system is asked */ };

/* Asks for all of it; where the system will not, it comes piece by piece as ever. */
static void ask_for(char *pages, size_t size) {
    (void)pages, (void)size;
#ifdef MADV_HUGEPAGE
    madvise(pages, size, MADV_HUGEPAGE);
#endif
#ifdef MADV_POPULATE_WRITE
    madvise(pages, size, MADV_POPULATE_WRITE);
#endif
}

void *pages_alloc(size_t size) {
    char *memory = malloc(size);
    const size_t page = (size_t)sysconf(_SC_PAGESIZE), before = -(uintptr_t)memory % page;
    if (memory && size >= LEAST) ask_for(memory + before, (size - before) / page * page);
    return memory;
}
