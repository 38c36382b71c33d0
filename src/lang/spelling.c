#include "lang/spelling.h"

#include <stddef.h>
#include <string.h>

enum { SPELLING_MAX = 64 };

static int lower(char c) { return c >= 'A' && c <= 'Z' ? c + 32 : c; }

static unsigned least(unsigned a, unsigned b) { return a < b ? a : b; }

/* The distance of words of m and n letters, or more than `limit` when it is more. Cells of the table
 * further than `limit` from its diagonal are more than that, and so is all below a row that is. */
static unsigned distance_within(const char *a, size_t m, const char *b, size_t n, unsigned limit) {
    unsigned row[3][SPELLING_MAX + 2]; /* rows i - 2, i - 1 and i of the table, in turn */
    for (size_t j = 0; j <= n + 1; j++) row[0][j] = (unsigned)j;
    for (size_t i = 1; i <= m; i++) {
        unsigned *now = row[i % 3];
        const unsigned *last = row[(i + 2) % 3], *before = row[(i + 1) % 3];
        const size_t from = i > limit ? i - limit : 1, to = i + limit < n ? i + limit : n;
        unsigned nearest = now[from - 1] = from == 1 ? (unsigned)i : limit + 1;
        for (size_t j = from; j <= to; j++) {
            const unsigned replace = last[j - 1] + (lower(a[i - 1]) != lower(b[j - 1]));
            now[j] = least(replace, least(last[j], now[j - 1]) + 1);
            if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]))
                now[j] = least(now[j], before[j - 2] + 1);
            nearest = least(nearest, now[j]);
        }
        now[to + 1] = limit + 1;
        if (nearest > limit) return limit + 1;
    }
    return row[m % 3][n];
}

unsigned spelling_distance(const char *a, const char *b) {
    const size_t m = strlen(a), n = strlen(b);
    if (m > SPELLING_MAX || n > SPELLING_MAX) return SPELLING_MAX;
    return distance_within(a, m, b, n, SPELLING_MAX);
}

struct spelling spelling_begin(const char *word) {
    return (struct spelling){.word = word, .distance = SPELLING_MAX};
}

static bool begins_with(const char *text, const char *start, size_t length) {
    for (size_t i = 0; i < length; i++)
        if (lower(text[i]) != lower(start[i])) return false;
    return true;
}

void spelling_offer(struct spelling *s, const char *candidate) {
    const size_t m = strlen(s->word), n = strlen(candidate), longer = m > n ? m : n,
                 apart = m > n ? m - n : n - m;
    const bool start = m >= 3 && m < n && begins_with(candidate, s->word, m);
    if (longer > SPELLING_MAX || s->distance == 0 || (apart > longer / 3 && !start)) return;
    const unsigned limit = least((unsigned)longer / 3, s->distance - 1); /* what would be better */
    const unsigned edits = apart > limit ? limit + 1 : distance_within(s->word, m, candidate, n, limit);
    const unsigned distance = start ? least(edits, (unsigned)longer / 3) : edits;
    if (distance > limit) return;
    s->best = candidate;
    s->distance = distance;
}
