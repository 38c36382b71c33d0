/* libyaml's events of a text, in order. They are kept in batches, which a thread of their own fills ahead of the
 * reader where the text is long. */
#ifndef MONGE_LANG_EVENTS_H
#define MONGE_LANG_EVENTS_H

#include "base/source.h"

enum event_kind {
    EVENT_STREAM_START,
    EVENT_STREAM_END,
    EVENT_DOCUMENT_START,
    EVENT_DOCUMENT_END,
    EVENT_ALIAS,
    EVENT_SCALAR,
    EVENT_SEQUENCE_START,
    EVENT_SEQUENCE_END,
    EVENT_MAPPING_START,
    EVENT_MAPPING_END
};

enum event_style { EVENT_PLAIN, EVENT_SINGLE_QUOTED, EVENT_DOUBLE_QUOTED, EVENT_BLOCK };

struct event_mark {
    uint32_t line, column; /* from 0 */
};

struct event {
    enum event_kind kind;
    enum event_style style;     /* of a scalar */
    struct event_mark from, to; /* where it begins, and ends */
    const char *text;           /* of a scalar, zero-terminated; of an alias the name; else NULL */
    size_t size;                /* bytes of text, in which NUL may be */
    const char *anchor, *tag;   /* NULL: none */
};

/* Why there is no further event. */
struct event_problem {
    const char *text, *context;       /* libyaml's words, static; text NULL: memory ran out */
    struct event_mark at, context_at; /* where it stopped; where what it was reading begins */
    bool is_offset;                   /* `offset` says where, not `at` */
    size_t offset;                    /* bytes */
};

struct events;

/* `ahead`: by a thread, if there is one to be had. The source outlives the events. NULL: out of memory. */
struct events *events_begin(const struct source *source, bool ahead);

/* The next one, good until the next call; NULL: there is a problem. Not after the stream's end or NULL. */
const struct event *events_next(struct events *events);

struct event_problem events_problem(const struct events *events);

/* At any time. `events` may be NULL. */
void events_end(struct events *events);

#endif
