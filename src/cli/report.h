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
struct monge_diagnostics *report_open(struct report *report);

/* Prints text that is new in it. */
void report_show(const struct report *report, struct monge_diagnostics *diag);

/* Done with what report_open returned: new text is printed, where it is wanted, and all forgotten. */
void report_close(struct report *report, struct monge_diagnostics *diag, bool wanted);

/* Writes the document, where there is one, to `out`. */
void report_end(struct report *report, FILE *out);

#endif
