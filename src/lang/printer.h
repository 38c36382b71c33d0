/* Lines of text, to be read by lines alone: between the files that print a layout. */
#ifndef MONGE_LANG_PRINTER_H
#define MONGE_LANG_PRINTER_H

#include "lang/layout.h"

enum { LAYOUT_WIDTH = 100 /* columns, without a trailing comment */, LAYOUT_INDENT = 2 };

/* A line that is done. Its text ends at `end`, and begins where the line before ends. */
struct printer_line {
    size_t end;
    uint32_t width;                       /* characters */
    const struct layout_comment *comment; /* behind it, not in the text yet; or NULL */
};

struct printer {
    struct arena *arena;
    char *text;
    size_t size, room;
    struct printer_line *lines;
    size_t line_count, line_room;
    uint32_t column; /* characters of the line so far */
    bool fresh;      /* no blank line may follow: the start, or behind a line that opens a block */
    bool probing;    /* nothing counts but whether it fits */
};

void printer_put(struct printer *p, const char *text, size_t size);
void printer_word(struct printer *p, const char *word);
void printer_indent(struct printer *p, uint32_t column);                        /* at the start of a line */
void printer_end_line(struct printer *p, const struct layout_comment *comment); /* NULL: none behind it */
void printer_blank_line(struct printer *p, bool wanted);

/* A line each. */
void printer_comments(struct printer *p, const struct layout_comment *first, uint32_t column);

/* The text of all lines, the comments behind them two spaces away, or in one column where neighbours were. */
char *printer_text(const struct printer *p, size_t *size);

/* A flow collection, scalar or alias, with its anchor, in one line. */
void print_inline(struct printer *p, const struct layout_node *node);

/* A scalar, with its anchor, that may go over several lines, which begin at `column`. */
void print_scalar(struct printer *p, const struct layout_node *node, uint32_t column);

/* A flow collection with comments inside, with the line breaks that it had; its lines begin at `column`. */
void print_lines(struct printer *p, const struct layout_node *node, uint32_t column);

/* Whether a flow collection that would begin at `column` becomes a block: it does not fit, or has
 * collections inside and was on several lines. */
bool print_breaks(const struct printer *p, const struct layout_node *node, uint32_t column);

#endif
