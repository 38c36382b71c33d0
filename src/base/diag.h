/* Diagnostics: what is wrong with a scene, where, and how to mend it.
 *
 *     king.yaml:4:13: error[unknown-key]: a sphere has no key `raduis`
 *        4 |   - sphere: {raduis: 2}
 *          |              ^~~~~~ did you mean `radius`?
 *          = a sphere takes center, radius
 */
#ifndef MONGE_BASE_DIAG_H
#define MONGE_BASE_DIAG_H

#include <stdio.h>

#include "base/arena.h"
#include "base/source.h"

enum severity {
    SEVERITY_ERROR,   /* the scene is wrong */
    SEVERITY_WARNING, /* the scene still means something */
    SEVERITY_FAILURE, /* the system failed: a file, memory; has no place */
};

/* A span as people see it, with a copy of its line: it outlives the source. */
struct place {
    const char *file;      /* NULL: no place */
    uint32_t line, column; /* from 1 */
    uint32_t extent;       /* characters of the span, 0 where it is a point */
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
    const char *code; /* stable, of grammar/diagnostics.yaml: "unknown-key" */
    struct place place;
    const char *message; /* one line, no full stop */
    const char *help;    /* the smallest fix, drawn behind the caret; NULL: none */
    const char *note;    /* background in a line of its own; NULL: none */
    struct related *related;
    unsigned load;       /* which of the loads told it last */
    bool framed;         /* told of what was under way: a template, a loop */
    bool printed, taken; /* by diag_print_new, by diag_take */
    struct diagnostic *next;
};

enum { DIAG_MAX_KEPT = 50 }; /* of one load; further ones are counted, not kept */

/* What is under way while a diagnostic is made, the innermost first: a template in use, a turn of a
 * loop. Each is told as a related place. */
struct diag_frame {
    struct span span;
    const char *(*text)(struct arena *arena, const struct diag_frame *frame);
    const struct diag_frame *outer;
};

/* A list in the order of places within a file. Starts as a zeroed struct. */
struct diagnostics {
    struct arena arena;             /* owns all the texts */
    const struct diag_frame *frame; /* NULL: nothing is under way */
    struct diagnostic *first;
    unsigned kept;
    unsigned load, before;    /* how many loads have begun; how many were kept when the last scene's did */
    unsigned scene;           /* the load that the last scene began with */
    unsigned repeated;        /* counted once more because a scene was loaded again */
    struct diagnostic beyond; /* stands for the ones that are not kept */
    unsigned errors, warnings, failures; /* all of them, the ones not kept too */
};

/* A load begins: as many may be kept of it as of the one before, and what that one told may be told again. */
void diag_begin(struct diagnostics *diag);

/* The last scene is loaded again, for another frame or with other values: what was told of it counts again, but is kept once. */
void diag_begin_again(struct diagnostics *diag);

/* Adds what another list has, as a load of its own; again: of the last scene. The other stays as it is. */
void diag_append(struct diagnostics *diag, const struct diagnostics *from, bool again);

/* `code` is static. Each returns the diagnostic, to add help, a note or related places to; never NULL. The same
 * message of a load at the same place is kept and counted once, as long as there is room to keep it. What
 * they are told of a file may be in any bytes: it comes out as UTF-8 that a terminal can take. */
struct diagnostic *diag_error(struct diagnostics *diag, struct span span, const char *code,
                              const char *format, ...) __attribute__((format(printf, 4, 5)));
struct diagnostic *diag_warning(struct diagnostics *diag, struct span span, const char *code,
                                const char *format, ...) __attribute__((format(printf, 4, 5)));
struct diagnostic *diag_failure(struct diagnostics *diag, const char *code, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
void diag_help(struct diagnostics *diag, struct diagnostic *d, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
void diag_note(struct diagnostics *diag, struct diagnostic *d, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
void diag_related(struct diagnostics *diag, struct diagnostic *d, struct span span, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* Whether as many are kept as may be: further errors and warnings are counted, their texts unread. */
bool diag_full(const struct diagnostics *diag);

/* How many there are that are not kept, as "and 12 more". False where there are none. */
enum { DIAG_MORE_SIZE = 32 };
bool diag_more(const struct diagnostics *diag, char text[DIAG_MORE_SIZE]);

/* The first that is no warning of those told since the last time: what has gone wrong meanwhile; NULL: nothing. */
const struct diagnostic *diag_take(struct diagnostics *diag);

void diag_print(const struct diagnostics *diag, FILE *out);
void diag_print_new(struct diagnostics *diag, FILE *out); /* what it has not printed yet */
void diag_free(struct diagnostics *diag);

#endif
