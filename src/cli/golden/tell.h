/* A run of `monge test` as it is told: in a terminal, or to programs. */
#ifndef MONGE_CLI_GOLDEN_TELL_H
#define MONGE_CLI_GOLDEN_TELL_H

#include <stdio.h>

#include "cli/golden/results.h"

struct golden_teller {
    FILE *out;
    bool tap;    /* as TAP version 13 */
    bool quiet;  /* only what is not the same is told */
    bool colors; /* of a terminal */
    size_t told; /* cases so far */
};

/* As lines. Begin comes before the first case, end after the last. */
void golden_tell_begin(struct golden_teller *teller);
void golden_tell(struct golden_teller *teller, const struct golden_case *c);
void golden_tell_end(struct golden_teller *teller, const struct golden_results *results);

/* What is to be said of a case beside its status: a sentence to its line; NULL: nothing. To be freed. */
char *golden_detail(const struct golden_case *c);

/* The same, and else the first thing that is wrong with it: a line to show in a list, "" where there is none. To be freed. */
char *golden_headline(const struct golden_case *c);

/* All the rest, perhaps many lines. To be freed. */
char *golden_details(const struct golden_case *c);

/* What is said of one that is taken. */
extern const char GOLDEN_TAKEN[];

/* The results as JUnit has them, XML. To be freed. */
char *golden_junit_text(const struct golden_results *results);

#endif
