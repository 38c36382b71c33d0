#include "cli/suggest.h"

#include <stddef.h>
#include <string.h>

enum { MAX_WORD = 40 };

static unsigned least(unsigned a, unsigned b) { return a < b ? a : b; }

/* Insertions, deletions, changes and swaps of neighbours that turn `a` into `b` (the "optimal string
 * alignment" of Damerau and Levenshtein); both at most MAX_WORD long. */
static unsigned edit_distance(const char *a, const char *b) {
    const size_t m = strlen(a), n = strlen(b);
    unsigned row[MAX_WORD + 1][MAX_WORD + 1];
    for (size_t i = 0; i <= m; i++) row[i][0] = (unsigned)i;
    for (size_t j = 0; j <= n; j++) row[0][j] = (unsigned)j;
    for (size_t i = 1; i <= m; i++) {
        for (size_t j = 1; j <= n; j++) {
            const unsigned change = row[i - 1][j - 1] + (a[i - 1] != b[j - 1]);
            row[i][j] = least(change, 1 + least(row[i - 1][j], row[i][j - 1]));
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[i][j] = least(row[i][j], row[i - 2][j - 2] + 1);
        }
    }
    return row[m][n];
}

void suggestion_try(struct suggestion *suggestion, const char *candidate) {
    const size_t length = strlen(suggestion->word);
    if (length == 0 || length > MAX_WORD || strlen(candidate) > MAX_WORD) return;
    unsigned distance = edit_distance(suggestion->word, candidate);
    if (strncmp(candidate, suggestion->word, length) == 0) distance = 1; /* the word is an abbreviation */
    if (suggestion->best && suggestion->distance <= distance) return;
    suggestion->best = candidate;
    suggestion->distance = distance;
}

const char *suggestion_best(const struct suggestion *suggestion) {
    if (!suggestion->best) return NULL;
    return suggestion->distance <= 1 + strlen(suggestion->word) / 4 ? suggestion->best : NULL;
}
