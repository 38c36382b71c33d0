#include "lang/spelling.h"

#include <stddef.h>
#include <string.h>

enum { SPELLING_MAX = 64 };

static int lower(char c) { return c >= 'A' && c <= 'Z' ? c + 32 : c; }

static unsigned least(unsigned a, unsigned b) { return a < b ? a : b; }

unsigned spelling_distance(const char *a, const char *b) {
    const size_t m = strlen(a), n = strlen(b);
    if (m > SPELLING_MAX || n > SPELLING_MAX) return SPELLING_MAX;
    unsigned row[3][SPELLING_MAX + 1]; /* rows i - 2, i - 1 and i of the table, in turn */
    for (size_t j = 0; j <= n; j++) row[0][j] = (unsigned)j;
    for (size_t i = 1; i <= m; i++) {
        unsigned *now = row[i % 3];
        const unsigned *last = row[(i + 2) % 3], *before = row[(i + 1) % 3];
        now[0] = (unsigned)i;
        for (size_t j = 1; j <= n; j++) {
            const unsigned replace = last[j - 1] + (lower(a[i - 1]) != lower(b[j - 1]));
            now[j] = least(replace, least(last[j], now[j - 1]) + 1);
            if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]))
                now[j] = least(now[j], before[j - 2] + 1);
        }
    }
    return row[m % 3][n];
}

struct spelling spelling_begin(const char *word) { return (struct spelling){.word = word, .distance = SPELLING_MAX}; }

void spelling_offer(struct spelling *s, const char *candidate) {
    const unsigned distance = spelling_distance(s->word, candidate);
    const size_t longer = strlen(s->word) > strlen(candidate) ? strlen(s->word) : strlen(candidate);
    if (distance < s->distance && 3 * distance <= longer) {
        s->best = candidate;
        s->distance = distance;
    }
}
