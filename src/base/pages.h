/* Memory for what is large. */
#ifndef MONGE_BASE_PAGES_H
#define MONGE_BASE_PAGES_H

#include <stddef.h>

/* Room for `size` bytes that are all going to be written soon, for free(); NULL: there is none. As malloc's, but in large
 * pages of 2 MiB, the last one whole: to get 4 KiB at a time, as each is first written to, takes longer than to inflate a
 * picture into them. */
void *pages_alloc(size_t size);

#endif
