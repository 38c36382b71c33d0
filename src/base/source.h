/* A text that was read: its places and its lines. */
#ifndef MONGE_BASE_SOURCE_H
#define MONGE_BASE_SOURCE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* One text that was read: a file, or standard input. Outlives the spans that point into it. */
struct source {
    const char *name; /* as the user gave it */
    const char *text; /* UTF-8, no byte order mark; not zero-terminated */
    size_t size;      /* bytes */
};

/* A stretch of characters on one line of a source. */
struct span {
    const struct source *source; /* NULL: nowhere in particular */
    uint32_t line;               /* from 0 */
    uint32_t column;             /* characters, from 0 */
    uint32_t length;             /* characters; 0 draws one caret */
};

/* The length in bytes of the line break at text[i], as YAML counts breaks; 0 for none. */
size_t source_break(const struct source *source, size_t i);

/* The length in bytes of the character at text[i], with the continuation bytes that follow. */
size_t source_character(const struct source *source, size_t i);

/* Where the line starts, and in *end where its break or the text ends. Past the end: both at the end. */
size_t source_line(const struct source *source, uint32_t line, size_t *end);

/* Where the span starts; at most the end of its line. */
size_t source_offset(struct span span);

/* What begins in a column: a dash, or a key (or whatever else follows the dashes).
 *
 *     scene:              key 0
 *       - sphere: {}      dash 2, key 4
 */
struct source_level {
    uint32_t line, column; /* from 0 */
    bool dash;
};

enum { SOURCE_MAX_LEVELS = 64 };

/* The levels that one line begins, from the left; 0 of a blank one or a comment. */
int source_line_levels(const struct source *source, uint32_t line,
                       struct source_level levels[SOURCE_MAX_LEVELS]);

/* The levels that lines before `line` leave open, the innermost last, each with the last line that
 * begins there. By indentation alone: a guess where texts or lists go over several lines. */
int source_open_levels(const struct source *source, uint32_t line,
                       struct source_level levels[SOURCE_MAX_LEVELS]);

#endif
