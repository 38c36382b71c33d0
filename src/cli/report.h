/* Where diagnostics go: as text to where this thread says things, those of each scene as soon as they are known; or, with
 * --format, gathered in one document for programs. */
#ifndef MONGE_CLI_REPORT_H
#define MONGE_CLI_REPORT_H

#include "cli/options.h"
#include "monge.h"

struct report {
    enum monge_format format;
    struct monge_diagnostics *all; /* of a document; NULL for text */
};

/* False, with the reason on stderr, when there is no memory. */
bool report_begin(struct report *report, const struct arguments *args);

/* Where to collect the next diagnostics, behind those that may be there already. NULL, with the reason on
 * stderr, when there is no memory. */
struct monge_diagnostics *report_open(const struct report *report);

/* What has gone wrong first while something was made; zeroed: nothing. */
struct problem {
    char *code, *message, *file; /* owned; file NULL: it has no place */
    unsigned line, column;       /* from 1 */
};

/* What goes wrong first from now on, on this thread, is noted there; NULL: no longer. */
void report_watch(struct problem *problem);
void problem_free(struct problem *problem);

/* What this thread tells a document from now on is kept apart; the end returns it, to be added in its turn. NULL: there is
 * no document. */
void report_apart(const struct report *report);
struct monge_diagnostics *report_apart_end(void);

/* Adds that, which is freed; again: it is of the same scene as what was added before. NULL: nothing. */
void report_add(const struct report *report, struct monge_diagnostics *apart, bool again);

/* Tells of a failure, or a warning, of a code in grammar/diagnostics.yaml. */
void report_failure(const struct report *report, const char *code, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
void report_warning(const struct report *report, const char *code, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Whether a document has failures to tell, without which it would not be known why the program ends. */
bool report_has_failures(const struct report *report);

/* Prints text that is new in it. */
void report_show(const struct report *report, struct monge_diagnostics *diag);

/* Done with what report_open returned: new text is printed, where it is wanted, and all forgotten. */
void report_close(const struct report *report, struct monge_diagnostics *diag, bool wanted);

/* Writes the document, where there is one, to `out`. */
void report_end(struct report *report, FILE *out);

#endif
