/* Patterns of file names, as -o takes them:
 *
 *     {name}       the scene's name
 *     {PARAMETER}  the value that -D gives it, in characters that are safe in file names
 *     {frame}      the number of the frame, with the zeros that make all as long as the last
 *     %04d, %d     the same, of at least 4 digits or as it is; once; and %% is a %. Only with --frames:
 *                  without it a % is any other character
 *     {{, }}       a brace; a } that closes nothing is one, too
 */
#ifndef MONGE_CLI_PATTERN_H
#define MONGE_CLI_PATTERN_H

#include "cli/sweep.h"

struct pattern_values {
    const char *name;
    const struct monge_define *defines;
    size_t define_count;
    bool frames;    /* --frames is given */
    unsigned frame; /* 0: not known yet, it stays {frame} */
    int digits;     /* of the last frame */
};

/* False, with the reason on stderr, when something in the pattern has no meaning. */
bool pattern_check(const char *pattern, const struct sweep *sweep, bool frames);

/* The text of a pattern that pattern_check accepts. To be freed. */
char *pattern_expand(const char *pattern, const struct pattern_values *values);

/* The pattern of which nothing but the text comes. To be freed. */
char *pattern_of(const char *text, bool frames);

/* Whether {word} is in it; whether anything is that stands for the frame; whether anything stands for anything. */
bool pattern_has(const char *pattern, const char *word);
bool pattern_has_frame(const char *pattern);
bool pattern_is_plain(const char *pattern, bool frames);

/* What a picture is called where nobody has a name for it, without an extension: NAME-a=1-0001. To be freed. */
char *pattern_usual(const struct sweep *sweep, const struct pattern_values *values);

int pattern_digits(unsigned number); /* that it has in decimal */

/* The value as part of a file name. To be freed. */
char *pattern_safe(const char *value);

#endif
