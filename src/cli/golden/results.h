/* The results of a run, as one JSON document: grammar/testing.md has its members. */
#ifndef MONGE_CLI_GOLDEN_RESULTS_H
#define MONGE_CLI_GOLDEN_RESULTS_H

#include "cli/golden/golden.h"
#include "cli/golden/places.h"

struct golden_results {
    char *folder;                /* owned: of the goldens */
    char *from;                  /* owned: the folder that paths count from, absolute; NULL: not known */
    char *accept;                /* owned: a shell's words that take all new pictures; NULL: of another run */
    struct golden_places places; /* of a run that looks for orphans */
    size_t elsewhere;            /* goldens of scenes that are in these places, and not in the run */
    struct golden_case *cases;
    size_t count;
    size_t
        interrupted; /* scenes that are not judged, as a signal came; their goldens are none of the cases */
    double seconds;
};

size_t golden_count(const struct golden_results *results, enum golden_status status);

/* "30 goldens: 27 same, 2 changed, 1 new"; what is taken counts as that: "30 goldens: 27 same, 3 taken". To be freed. */
char *golden_summary(const struct golden_results *results);

/* "interrupted: 3 scenes not judged"; NULL: it was not. To be freed. */
char *golden_interruption(const struct golden_results *results);

/* The words of a shell that take new pictures: of the run in `output`, NULL: in the usual folder. To be freed. */
char *golden_accept_words(const char *folder, const char *output);

/* The document. To be freed; its end is a line break. */
char *golden_results_text(const struct golden_results *results);

enum golden_reading {
    GOLDEN_READ,
    GOLDEN_DAMAGED, /* it is, or was, a document of a run, and cannot be used; not told */
    GOLDEN_UNREAD   /* it cannot be read, or is a document of somebody else; the reason is told */
};

/* Reads a document again: what accept and the next run need of it; one that is not there gives no cases, as one that is not
 * read. To be freed. */
enum golden_reading golden_results_read(struct golden_results *results, const char *path);
void golden_results_free(struct golden_results *results);

const struct golden_case *golden_results_find(const struct golden_results *results,
                                              const char *name); /* or NULL */

#endif
