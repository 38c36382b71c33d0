#include "lang/events.h"

#include <stdlib.h>
#include <string.h>
#include <yaml.h>

#include "base/ahead.h"

#ifdef MONGE_HOSTILE
enum { BATCH_EVENTS = 3, BATCH_TEXT = 16, BATCHES = 2 };
#else
enum { BATCH_EVENTS = 2048, BATCH_TEXT = 64 * 1024, BATCHES = 4 };
#endif
enum {
    BATCH_EVENTS_ALONE = BATCH_EVENTS < 256 ? BATCH_EVENTS : 256
}; /* without a thread: what stays in the cache */

struct batch {
    struct event events[BATCH_EVENTS];
    unsigned count;
    bool last; /* behind its events there are no more */
    char *text;
    size_t used, room; /* bytes of text, which is never moved while an event points there */
};

struct events {
    yaml_parser_t parser; /* this and what follows is the thread's, until it has filled the last batch */
    yaml_event_t event;   /* that was parsed and is in no batch yet; YAML_NO_EVENT: none */
    bool out_of_memory;
    struct ahead *ahead; /* NULL: no thread */
    struct batch *now;   /* that is read; NULL: none yet */
    unsigned next;       /* event of it */
    unsigned most;       /* events of a batch */
    unsigned batch_count;
    struct batch batches[];
};

/* ---- Filling ---- */

static void batch_begin(struct batch *b) {
    if (b->room > BATCH_TEXT) {
        free(b->text);
        b->text = NULL;
        b->room = 0;
    }
    b->count = 0;
    b->used = 0;
}

/* Only a first event may have more text than there is usually room for. */
static bool batch_grow(struct batch *b, size_t bytes, bool *out_of_memory) {
    if (b->count > 0) return false;
    free(b->text);
    b->room = bytes > BATCH_TEXT ? bytes : BATCH_TEXT;
    b->text = malloc(b->room);
    *out_of_memory = !b->text;
    if (!b->text) b->room = 0;
    return b->text;
}

/* A copy, for which there is room; NULL of NULL. */
static const char *keep(struct batch *b, const yaml_char_t *text, size_t size) {
    if (!text) return NULL;
    char *copy = memcpy(b->text + b->used, text, size);
    copy[size] = '\0';
    b->used += size + 1;
    return copy;
}

static size_t length(const yaml_char_t *text) { return text ? strlen((const char *)text) : 0; }

static struct event_mark mark_of(const yaml_mark_t *mark) {
    return (struct event_mark){(uint32_t)mark->line, (uint32_t)mark->column};
}

static enum event_style style_of(yaml_scalar_style_t style) {
    switch (style) {
    case YAML_SINGLE_QUOTED_SCALAR_STYLE: return EVENT_SINGLE_QUOTED;
    case YAML_DOUBLE_QUOTED_SCALAR_STYLE: return EVENT_DOUBLE_QUOTED;
    case YAML_LITERAL_SCALAR_STYLE:
    case YAML_FOLDED_SCALAR_STYLE: return EVENT_BLOCK;
    default: return EVENT_PLAIN;
    }
}

/* False: it does not go into this batch. */
static bool batch_add(struct batch *b, const yaml_event_t *e, bool *out_of_memory) {
    enum event_kind kind = EVENT_STREAM_END;
    enum event_style style = EVENT_PLAIN;
    const yaml_char_t *text = NULL, *anchor = NULL, *tag = NULL;
    size_t size = 0;
    switch (e->type) {
    case YAML_STREAM_START_EVENT: kind = EVENT_STREAM_START; break;
    case YAML_DOCUMENT_START_EVENT: kind = EVENT_DOCUMENT_START; break;
    case YAML_DOCUMENT_END_EVENT: kind = EVENT_DOCUMENT_END; break;
    case YAML_SEQUENCE_END_EVENT: kind = EVENT_SEQUENCE_END; break;
    case YAML_MAPPING_END_EVENT: kind = EVENT_MAPPING_END; break;
    case YAML_ALIAS_EVENT:
        kind = EVENT_ALIAS;
        text = e->data.alias.anchor;
        size = length(text);
        break;
    case YAML_SCALAR_EVENT:
        kind = EVENT_SCALAR;
        style = style_of(e->data.scalar.style);
        text = e->data.scalar.value;
        size = e->data.scalar.length;
        anchor = e->data.scalar.anchor;
        tag = e->data.scalar.tag;
        break;
    case YAML_SEQUENCE_START_EVENT:
        kind = EVENT_SEQUENCE_START;
        anchor = e->data.sequence_start.anchor;
        tag = e->data.sequence_start.tag;
        break;
    case YAML_MAPPING_START_EVENT:
        kind = EVENT_MAPPING_START;
        anchor = e->data.mapping_start.anchor;
        tag = e->data.mapping_start.tag;
        break;
    default: break;
    }
    size_t bytes = size + 1;
    if (anchor || tag) bytes += length(anchor) + 1 + length(tag) + 1;
    if (b->room - b->used < bytes && !batch_grow(b, bytes, out_of_memory)) return false;
    struct event *out = &b->events[b->count++];
    out->kind = kind;
    out->style = style;
    out->from = mark_of(&e->start_mark);
    out->to = mark_of(&e->end_mark);
    out->text = keep(b, text, size);
    out->size = size;
    out->anchor = anchor ? keep(b, anchor, length(anchor)) : NULL;
    out->tag = tag ? keep(b, tag, length(tag)) : NULL;
    return true;
}

/* What begins or ends a collection owns nothing, in most cases. */
static void drop(yaml_event_t *e, const struct event *kept) {
    const bool owns = kept->text || kept->anchor || kept->tag || kept->kind == EVENT_DOCUMENT_START;
    if (owns)
        yaml_event_delete(e);
    else
        e->type = YAML_NO_EVENT;
}

/* Fills a batch; returns whether there is more. */
static bool fill(void *context, unsigned number) {
    struct events *ev = context;
    struct batch *b = &ev->batches[number];
    batch_begin(b);
    while (b->count < ev->most && !b->last) {
        const bool is_new = ev->event.type == YAML_NO_EVENT;
        if (is_new && !yaml_parser_parse(&ev->parser, &ev->event)) b->last = true;
        if (b->last || !batch_add(b, &ev->event, &ev->out_of_memory)) break;
        b->last = ev->event.type == YAML_STREAM_END_EVENT;
        drop(&ev->event, &b->events[b->count - 1]);
    }
    b->last |= ev->out_of_memory;
    return !b->last;
}

/* ---- Reading ---- */

struct events *events_begin(const struct source *source, bool ahead) {
    const unsigned batches = ahead ? BATCHES : 1;
    struct events *ev = calloc(1, sizeof *ev + batches * sizeof *ev->batches);
    if (!ev || !yaml_parser_initialize(&ev->parser)) {
        free(ev);
        return NULL;
    }
    yaml_parser_set_input_string(&ev->parser, (const unsigned char *)source->text, source->size);
    yaml_parser_set_encoding(&ev->parser, YAML_UTF8_ENCODING);
    ev->batch_count = batches;
    ev->most = ahead ? BATCH_EVENTS : BATCH_EVENTS_ALONE;
    ev->ahead = ahead ? ahead_begin(BATCHES, fill, ev) : NULL;
    return ev;
}

const struct event *events_next(struct events *ev) {
    while (!ev->now || ev->next == ev->now->count) {
        if (ev->now && ev->now->last) return NULL;
        if (!ev->ahead) fill(ev, 0);
        ev->now = &ev->batches[ev->ahead ? ahead_next(ev->ahead) : 0];
        ev->next = 0;
    }
    return &ev->now->events[ev->next++];
}

struct event_problem events_problem(const struct events *ev) {
    const yaml_parser_t *p = &ev->parser;
    if (ev->out_of_memory || p->error == YAML_MEMORY_ERROR) return (struct event_problem){0};
    return (struct event_problem){.text = p->problem ? p->problem : "not YAML",
                                  .context = p->context ? p->context : "",
                                  .at = mark_of(&p->problem_mark),
                                  .context_at = mark_of(&p->context_mark),
                                  .is_offset = p->error == YAML_READER_ERROR,
                                  .offset = p->problem_offset};
}

void events_end(struct events *ev) {
    if (!ev) return;
    ahead_end(ev->ahead);
    for (unsigned i = 0; i < ev->batch_count; i++) free(ev->batches[i].text);
    yaml_event_delete(&ev->event);
    yaml_parser_delete(&ev->parser);
    free(ev);
}
