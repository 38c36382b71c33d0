/* The report of `monge test`: one page of HTML that holds its pictures and needs nothing else. */
#ifndef MONGE_CLI_GOLDEN_PAGE_H
#define MONGE_CLI_GOLDEN_PAGE_H

#include <stdbool.h>
#include <stddef.h>

/* Writes `path`, complete or not at all: `results` is the JSON document of the run, `pictures` the files that it
 * names, by the same paths. One that cannot be read is left out. False, with the reason on stderr, when the page
 * cannot be written. */
bool page_write(const char *path, const char *results, char *const *pictures, size_t count);

/* What is around them: made by the build from the folder page/. */
extern const char page_text[];

#endif
