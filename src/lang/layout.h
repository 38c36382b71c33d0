/* A YAML text as it is laid out: what it says, and the comments and blank lines between.
 *
 *     # about the ball             before an entry           scene:        an entry of a mapping: key and value
 *     - sphere: {}  # it is round  trailing                    - sphere:   an entry of a sequence: value alone
 *     # the end                    end of the sequence
 *
 * layout_read takes a text apart, layout_print puts it together in the canonical style. Everything
 * belongs to the arena, and points into the text. */
#ifndef MONGE_LANG_LAYOUT_H
#define MONGE_LANG_LAYOUT_H

#include "base/arena.h"
#include "base/diag.h"
#include "lang/node.h"

struct layout_comment {
    const char *text; /* from its # on, without blanks at the end */
    size_t size;
    size_t at;         /* offset of the # */
    uint32_t column;   /* of the #, in characters */
    bool own_line;     /* nothing is before it on its line */
    bool blank_before; /* the line before is blank */
    struct layout_comment *next;
};

struct layout_comments {
    struct layout_comment *first, *last;
};

struct layout_entry;

struct layout_node {
    enum node_kind kind;
    bool flow;         /* a collection in brackets */
    bool braces;       /* flow: false for a pair `a: b` in a list */
    bool spread;       /* a flow collection or scalar on several lines */
    bool commented;    /* flow: comments stand inside */
    bool close_line;   /* flow: the closing bracket begins a line */
    bool cut;          /* a block scalar that the end of the text cuts off before its last line break */
    const char *props; /* anchor and tag as written, or "" */
    const char *text;  /* scalar, alias: as written */
    size_t size;
    uint32_t column; /* block collection: of its entries; block scalar: of the collection around */
    struct layout_comment
        *header;                /* flow: behind the opening bracket; block scalar: behind | or >; or NULL */
    struct layout_comments end; /* after the last entry; of a null in a block: below it */
    struct layout_entry *first;
    struct layout_node *outer; /* while reading: the next collection around that has ended as well */
};

struct layout_entry {
    struct layout_node *key; /* NULL in a sequence and for the root */
    struct layout_node *value;
    bool colon;                      /* the key is followed by one, as always but in {a, b} */
    bool blank_before, line_before;  /* a blank line; in a flow collection: a line break */
    struct layout_comments before;   /* lines of their own */
    struct layout_comments between;  /* after the colon or the dash, before the value or its first entry */
    struct layout_comment *trailing; /* behind the value, or NULL */
    struct layout_entry *next;
};

struct layout {
    const char *preamble; /* lines up to the `---`, or NULL where there is none */
    size_t preamble_size;
    struct layout_comment *start; /* behind the `---`, or NULL */
    struct layout_entry root;
    struct layout_comments end;
};

/* The comments of a text, and where its dashes and explicit keys are. */
struct layout_marks {
    struct layout_comment *comments;
    size_t *dashes; /* offsets of the `-` of list items, in order */
    size_t dash_count;
    size_t odd_key;     /* offset of the first key behind `?`, or SIZE_MAX */
    size_t start, body; /* offsets of the `---` and of what follows it; SIZE_MAX and 0 without one */
};

/* `source` must be YAML, in UTF-8 with line feeds alone; arena->on_full must be set. */
void layout_scan(struct arena *arena, const struct source *source, struct layout_marks *marks);

/* The same; one document. NULL, reported, for what has no canonical form: a key behind `?`, or one that
 * is a collection or goes over several lines. */
struct layout *layout_read(struct arena *arena, struct diagnostics *diag, const struct source *source);

/* The text in the canonical style; a final zero follows its *size bytes. */
char *layout_print(struct arena *arena, const struct layout *layout, size_t *size);

/* Whether two texts mean the same to YAML: collections, scalars, anchors, aliases, tags. arena->on_full
 * must be set. */
bool layout_same_events(struct arena *arena, const struct source *a, const struct source *b);

/* Whether they have the same comments in the same order; both as for layout_scan. */
bool layout_same_comments(struct arena *arena, const struct source *a, const struct source *b);

#endif
