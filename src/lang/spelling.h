/* Did you mean? */
#ifndef MONGE_LANG_SPELLING_H
#define MONGE_LANG_SPELLING_H

#include <stdbool.h>

/* The number of letters to insert, delete, replace or swap with their neighbour to make b of a,
 * letter case apart (optimal string alignment distance); words longer than 64 bytes count as far. */
unsigned spelling_distance(const char *a, const char *b);

/* Keeps the nearest of a row of candidates. */
struct spelling {
    const char *word; /* as written */
    const char *best; /* NULL: none is near */
    unsigned distance;
};

struct spelling spelling_begin(const char *word);

/* Takes the candidate if it is nearer than the best and near at all: a third of the letters of the
 * longer word at most, or the word (of three letters or more) is how it begins. */
void spelling_offer(struct spelling *s, const char *candidate);

#endif
