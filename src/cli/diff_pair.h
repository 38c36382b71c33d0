/* monge diff of two pictures: what is asked of each comparison, the verdict, and how it is told. */
#ifndef MONGE_CLI_DIFF_PAIR_H
#define MONGE_CLI_DIFF_PAIR_H

#include <stdio.h>

#include "cli/report.h"
#include "monge.h"

/* What the command line asks for. */
struct diff {
    const struct arguments *args;
    struct monge_picture *mask;  /* owned */
    const char *mask_file;       /* NULL: none */
    struct monge_region *ignore; /* owned */
    struct monge_compare how;
    struct report report; /* as text */
    unsigned metrics;     /* to be told; a bit each */
};

enum diff_verdict { DIFF_SAME, DIFF_WITHIN, DIFF_DIFFERENT };
extern const char *const DIFF_VERDICT[]; /* "same", "within the limits", "different" */

struct diff_pair {
    const struct diff *diff;
    const char *path_a, *path_b;
    struct monge_picture *a, *b; /* owned; NULL: it cannot be read */
    struct monge_difference difference;
    enum diff_verdict verdict;
};

/* Whether --max-delta is a limit for means, not for channels. */
bool diff_limits_means(const struct diff *diff);

/* Reads and compares the two files. False: diag says why, or it has been told. Either way to be freed. */
bool diff_pair_compare(struct diff_pair *pair, const struct diff *diff, const char *path_a,
                       const char *path_b, struct monge_diagnostics *diag);
void diff_pair_free(struct diff_pair *pair);

/* What there is to say behind the verdict, as a line; then the metrics that are asked for, a line each behind
 * `before`. */
void diff_pair_print(const struct diff_pair *pair, const char *before, FILE *out);

/* As a JSON object, with the name where there is one (NULL: none). */
void diff_pair_print_json(const struct diff_pair *pair, const char *name, FILE *out);

/* The same where nothing could be compared, for the reason "missing" or "trouble": of the files alone. NULL: there is
 * none. */
void diff_print_json_none(const char *name, const char *why, const char *path_a, const char *path_b,
                          FILE *out);

/* False: diag says why. */
bool diff_pair_write_heat_map(const struct diff_pair *pair, const char *path, struct monge_diagnostics *diag);

/* What a heat map of that name would write over: "the mask", or "a picture that is compared", which a and b are. NULL:
 * nothing of these. */
const char *diff_overwritten(const struct diff *diff, const char *out, const char *a, const char *b);

#endif
