/* Did you mean: the nearest of some words by edit distance. */
#ifndef MONGE_CLI_SUGGEST_H
#define MONGE_CLI_SUGGEST_H

/* Begins as {.word = what the user wrote}. */
struct suggestion {
    const char *word, *best;
    unsigned distance; /* of best */
};

void suggestion_try(struct suggestion *suggestion, const char *candidate);

/* NULL where nothing is near enough to be meant. */
const char *suggestion_best(const struct suggestion *suggestion);

#endif
