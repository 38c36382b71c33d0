/* Diagnostics: what is wrong with a scene, where, and how to mend it.
 *
 *     king.yaml:4:13: error: a sphere has no key `raduis`
 *        4 |   - sphere: {raduis: 2}
 *          |              ^~~~~~ did you mean `radius`?
 *          = a sphere takes center, radius
 */
#ifndef MONGE_BASE_DIAG_H
#define MONGE_BASE_DIAG_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "base/arena.h"

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

enum severity {
    SEVERITY_ERROR,   /* the scene is wrong */
    SEVERITY_WARNING, /* the scene still means something */
    SEVERITY_FAILURE, /* the system failed: a file, memory; has no place */
};

/* A span as people see it, with a copy of its line: it outlives the source. */
struct place {
    const char *file;      /* NULL: no place */
    uint32_t line, column; /* from 1 */
    const char *excerpt;   /* of the line, safe to print; NULL where the line is not in the source */
    uint32_t caret;        /* characters of the excerpt before the caret */
    uint32_t length;       /* characters to underline, at least 1 */
};

/* A place that explains another: "first given here". */
struct related {
    struct place place;
    const char *text;
    struct related *next;
};

struct diagnostic {
    enum severity severity;
    struct place place;
    const char *message; /* one line, no full stop */
    const char *help;    /* the smallest fix, drawn behind the caret; NULL: none */
    const char *note;    /* background in a line of its own; NULL: none */
    struct related *related;
    struct diagnostic *next;
};

enum { DIAG_MAX_KEPT = 50 }; /* further ones are counted, not kept */

/* A list in the order of places within a file. Starts as a zeroed struct. */
struct diagnostics {
    struct arena arena; /* owns all the texts */
    struct diagnostic *first;
    unsigned kept;
    struct diagnostic beyond; /* stands for the ones that are not kept */
    unsigned errors, warnings, failures; /* all of them, the ones not kept too */
};

/* Each returns the diagnostic, to add help, a note or related places to; never NULL. The same
 * message at the same place is kept and counted once. */
struct diagnostic *diag_error(struct diagnostics *diag, struct span span, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
struct diagnostic *diag_warning(struct diagnostics *diag, struct span span, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
struct diagnostic *diag_failure(struct diagnostics *diag, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
void diag_help(struct diagnostics *diag, struct diagnostic *d, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
void diag_note(struct diagnostics *diag, struct diagnostic *d, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
void diag_related(struct diagnostics *diag, struct diagnostic *d, struct span span, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

void diag_print(const struct diagnostics *diag, FILE *out);
void diag_free(struct diagnostics *diag);

#endif
