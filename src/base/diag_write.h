/* Diagnostics for programs, and the stories that explain their codes. */
#ifndef MONGE_BASE_DIAG_WRITE_H
#define MONGE_BASE_DIAG_WRITE_H

#include "base/diag.h"

/* What there is to say about a code. All are texts for people; wrong and right are of one or more lines. */
struct diag_story {
    const char *code;
    const char *severity; /* "error", "warning", "failure", "error or warning" */
    const char *summary;  /* one sentence */
    const char *text;     /* what it means and how to mend it */
    const char *wrong, *right;
};

/* Sorted by code. */
struct diag_stories {
    const struct diag_story *first;
    size_t count;
};

/* NULL where there is none. */
const struct diag_story *diag_find_story(struct diag_stories stories, const char *code);

/* The story with its example, wrapped for a terminal. */
void diag_explain(const struct diag_story *story, FILE *out);

/* An array of objects, each with file, line, column, endLine, endColumn, severity, code, message, help, note,
 * related. Columns count code points from 1, the end is the first behind; null is what there is not.
 * Where not all are kept, the last object, of severity "note", says how many more there are. */
void diag_write_json(const struct diagnostics *diag, FILE *out);

/* SARIF 2.1.0: one run, its rules the codes that occur. Failures are notifications of the tool. */
void diag_write_sarif(const struct diagnostics *diag, struct diag_stories stories, const char *version,
                      FILE *out);

#endif
