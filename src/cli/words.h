/* Words as a shell has them. */
#ifndef MONGE_CLI_WORDS_H
#define MONGE_CLI_WORDS_H

#include <stdbool.h>

/* A text as one word. To be freed. */
char *word_quoted(const char *text);

/* The next word of options at *at, as a shell would have it, in place: blanks part words but in quotes, and \ takes what
 * follows as it is. NULL: there is none. *open: a quote is not closed. */
char *word_next(char **at, bool *open);

#endif
