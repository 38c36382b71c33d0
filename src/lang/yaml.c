/* From events to nodes. */
#include <string.h>

#include "base/table.h"
#include "lang/events.h"
#include "lang/node.h"
#include "lang/spelling.h"

struct anchor {
    const char *name;
    struct node *node;
    bool open;                    /* its collection has not ended: an alias now would be a cycle */
    double values;                /* of the node, those behind aliases each time */
    unsigned height;              /* collections within each other, the node's own included */
    const struct anchor *largest; /* of those that it refers to; NULL: none */
};

struct reader {
    struct events *events;
    const struct event *event; /* the current one; NULL: none yet, or no more */
    struct arena *arena;
    struct diagnostics *diag;
    const struct source *source;
    const struct node_limits *limits;
    const struct node_stream *stream; /* NULL: none, or its list is under way or over */
    struct node_problem *problem;
    struct table anchors; /* the newest of each name */
    uint32_t anchor_count;
    size_t nodes;                 /* in the text */
    size_t merged;                /* pairs that merge keys have looked at */
    double values;                /* nodes, those behind aliases each time */
    bool is_beyond;               /* an alias has taken `values` past the limit */
    struct span beyond;           /* that alias */
    bool passing;                 /* an item of the stream is being read */
    unsigned nesting;             /* collections that are open */
    unsigned height;              /* of the node that was read last, as in struct anchor */
    const struct anchor *largest; /* alias in the innermost anchored node */
};

struct node *node_get(const struct node *mapping, const char *key) {
    for (struct node *k = mapping->first; k; k = k->next->next)
        if (k->kind == NODE_SCALAR && k->text[0] == key[0] && strcmp(k->text, key) == 0) return k->next;
    return NULL;
}

bool node_is_null(const struct node *node) {
    const struct node *n = node_resolve(node);
    if (n->kind != NODE_SCALAR || n->quoted) return false;
    switch (n->text[0]) {
    case '\0': return true;
    case '~': return n->count == 1;
    case 'n': return strcmp(n->text, "null") == 0;
    case 'N': return strcmp(n->text, "Null") == 0 || strcmp(n->text, "NULL") == 0;
    default: return false;
    }
}

/* ---- Events and marks ---- */

static struct span span_of(const struct reader *rd, const struct event *e) {
    const uint32_t length =
        e->from.line == e->to.line && e->to.column > e->from.column ? e->to.column - e->from.column : 1;
    return (struct span){rd->source, e->from.line, e->from.column, length};
}

static struct span span_at(const struct reader *rd, struct event_mark at) {
    return (struct span){rd->source, at.line, at.column, 1};
}

/* Where a reader error is, which libyaml gives as an offset in bytes alone. */
static struct span span_of_offset(const struct reader *rd, size_t offset) {
    struct span span = {rd->source, 0, 0, 1};
    for (size_t i = 0, line_break; i < offset && i < rd->source->size;
         i += line_break ? line_break : source_character(rd->source, i)) {
        line_break = source_break(rd->source, i);
        if (line_break)
            span.line++, span.column = 0;
        else
            span.column++;
    }
    return span;
}

static void keep_problem(struct reader *rd) {
    const struct event_problem p = events_problem(rd->events);
    if (!p.text) {
        diag_failure(rd->diag, "out-of-memory", "%s: out of memory", rd->source->name);
        return;
    }
    rd->problem->text = p.text;
    rd->problem->context = p.context;
    rd->problem->at = p.is_offset ? span_of_offset(rd, p.offset) : span_at(rd, p.at);
    rd->problem->context_at = span_at(rd, p.context_at);
}

/* A text in quotes that ends where something unexpected follows may have begun far above. */
static void keep_quoted(struct reader *rd) {
    rd->problem->quoted_at = span_at(rd, rd->event->from);
    rd->problem->quoted_end = span_at(rd, rd->event->to);
}

static bool is_quoted(const struct event *e) {
    return e->style == EVENT_SINGLE_QUOTED || e->style == EVENT_DOUBLE_QUOTED;
}

static bool next_event(struct reader *rd) {
    if (rd->event && is_quoted(rd->event)) keep_quoted(rd);
    rd->event = events_next(rd->events);
    if (!rd->event) keep_problem(rd);
    return rd->event;
}

/* Counts one more node against the limit. */
static bool count_node(struct reader *rd, const struct node *node) {
    rd->values += 1.0;
    if (++rd->nodes <= rd->limits->nodes) return true;
    diag_error(rd->diag, node->span, "limit-values", "more than %zu values in one file (the limit `values`)",
               rd->limits->nodes);
    return false;
}

static bool nesting_allowed(struct reader *rd, const struct node *node, unsigned height,
                            const struct anchor *alias) {
    if (rd->nesting + height <= rd->limits->nesting) return true;
    struct diagnostic *d =
        diag_error(rd->diag, node->span, "limit-nesting",
                   "more than %u levels of nesting (the limit `nesting`)", rd->limits->nesting);
    if (alias)
        diag_related(rd->diag, d, alias->node->span, "`&%s` has %u of them", alias->name, alias->height);
    return false;
}

/* ---- Anchors ---- */

static const struct anchor *larger(const struct anchor *a, const struct anchor *b) {
    return !a || (b && b->values > a->values) ? b : a;
}

static struct anchor *add_anchor(struct reader *rd, const char *name, struct node *node) {
    struct anchor *a = arena_alloc(rd->arena, sizeof *a);
    *a = (struct anchor){.name = arena_text(rd->arena, name, strlen(name)), .node = node, .open = true};
    table_put(rd->arena, &rd->anchors, a->name, a);
    node->anchor = ++rd->anchor_count;
    return a;
}

/* How the largest of the aliases comes to its size, from anchor to anchor. */
static bool report_expansion(struct reader *rd, const struct anchor *largest) {
    enum { CHAIN = 5 };
    struct diagnostic *d =
        diag_error(rd->diag, rd->beyond, "limit-values",
                   "aliases make %.6g values of this file, more than %zu (the limit `values`)", rd->values,
                   rd->limits->nodes);
    int i = 0;
    for (const struct anchor *a = largest; a && i < CHAIN; a = a->largest, i++)
        if (a->largest)
            diag_related(rd->diag, d, a->node->span, "`&%s` makes %.6g, most of them by `*%s`", a->name,
                         a->values, a->largest->name);
        else
            diag_related(rd->diag, d, a->node->span, "`&%s` makes %.6g", a->name, a->values);
    return false;
}

static bool report_no_anchor(struct reader *rd, const struct node *node, const char *name) {
    struct spelling s = spelling_begin(name);
    for (size_t i = 0; i < rd->anchors.capacity; i++)
        if (rd->anchors.slots[i].name) spelling_offer(&s, rd->anchors.slots[i].name);
    struct diagnostic *d =
        diag_error(rd->diag, node->span, "no-anchor", "no anchor `&%.100s` before this alias", name);
    if (!s.best) {
        diag_help(rd->diag, d,
                  "it repeats what stands behind `&%.100s`; a text that starts with `*` needs quotes", name);
        return false;
    }
    const struct anchor *a = table_find(&rd->anchors, s.best);
    diag_help(rd->diag, d, "did you mean `*%s`?", s.best);
    diag_related(rd->diag, d, a->node->span, "`&%s` is given here", s.best);
    return false;
}

static bool read_alias(struct reader *rd, struct node *node) {
    const char *name = rd->event->text;
    const struct anchor *a = table_find(&rd->anchors, name);
    if (!a) return report_no_anchor(rd, node, name);
    if (a->open) {
        struct diagnostic *d = diag_error(rd->diag, node->span, "alias-in-itself",
                                          "`*%s` stands inside the very node that it names", name);
        diag_related(rd->diag, d, a->node->span, "`&%s` is given here", name);
        return false;
    }
    if (!nesting_allowed(rd, node, a->height, a)) return false;
    node->kind = NODE_ALIAS;
    node->target = a->node;
    rd->height = a->height;
    rd->largest = larger(rd->largest, a);
    rd->values += a->values;
    if (!rd->is_beyond && rd->values > (double)rd->limits->nodes) {
        rd->is_beyond = true;
        rd->beyond = node->span;
    }
    return true;
}

/* ---- Merge keys ---- */

/* The mapping that merge keys fill: its keys so far, and where the next pair goes. */
struct merge {
    struct node *into;
    struct table keys;
    struct node **tail;
};

/* The word that a key is, or NULL. */
static const char *key_word(const struct node *key) {
    const struct node *n = node_resolve(key);
    return n->kind == NODE_SCALAR ? n->text : NULL;
}

static void merge_begin(struct reader *rd, struct merge *merge, struct node *into) {
    *merge = (struct merge){.into = into, .tail = &into->first};
    for (struct node *key = into->first; key; key = key->next->next) {
        if (key_word(key)) table_put(rd->arena, &merge->keys, key_word(key), key);
        merge->tail = &key->next->next;
    }
}

/* Copies take memory that the text does not: a few for each of its nodes are enough for any scene. */
static bool count_merged(struct reader *rd, struct span span) {
    enum { FREE = 100000, EACH = 4 };
    if (++rd->merged <= FREE + EACH * rd->nodes) return true;
    struct diagnostic *d =
        diag_error(rd->diag, span, "limit-merged",
                   "merge keys (<<) have copied %zu pairs up to here, too many for a file of %zu values",
                   rd->merged, rd->nodes);
    diag_help(rd->diag, d, "use an alias for the whole, without <<");
    return false;
}

/* Appends copies of the pairs of `from` whose keys are not there yet. False when it is too much. */
static bool merge_pairs(struct reader *rd, struct merge *merge, const struct node *from) {
    for (const struct node *key = from->first; key; key = key->next->next) {
        if (!count_merged(rd, merge->into->span)) return false;
        const char *word = key_word(key);
        if (word && table_find(&merge->keys, word)) continue;
        struct node *pair = arena_array(rd->arena, 2, sizeof *pair);
        pair[0] = *key;
        pair[0].merged = true;
        pair[1] = *key->next;
        pair[0].next = &pair[1];
        pair[1].next = NULL;
        if (word) table_put(rd->arena, &merge->keys, word, pair);
        *merge->tail = pair;
        merge->tail = &pair[1].next;
        merge->into->count++;
    }
    return true;
}

static bool merge_value(struct reader *rd, struct merge *merge, const struct node *value) {
    const struct node *from = node_resolve(value);
    if (from->kind == NODE_MAPPING) return merge_pairs(rd, merge, from);
    bool ok = from->kind == NODE_SEQUENCE;
    for (const struct node *item = ok ? from->first : NULL; item && ok; item = item->next) {
        ok = node_resolve(item)->kind == NODE_MAPPING;
        if (ok && !merge_pairs(rd, merge, node_resolve(item))) return false;
    }
    if (!ok)
        diag_error(rd->diag, value->span, "bad-merge",
                   "`<<` takes a mapping or a list of mappings, as in `<<: *base`");
    return ok;
}

/* Takes the pairs `<<: ...` out of the mapping and merges them; keys written out win. */
static bool merge_all(struct reader *rd, struct node *mapping) {
    struct node *merges = NULL, **last = &merges;
    for (struct node **at = &mapping->first; *at;) {
        struct node *key = *at, *value = key->next;
        if (key->kind == NODE_SCALAR && !key->quoted && strcmp(key->text, "<<") == 0) {
            *at = value->next;
            mapping->count--;
            *last = value;
            last = &value->next;
        } else {
            at = &value->next;
        }
    }
    *last = NULL;
    if (!merges) return true;
    struct merge merge;
    merge_begin(rd, &merge, mapping);
    bool ok = true;
    for (const struct node *value = merges; value; value = value->next) ok &= merge_value(rd, &merge, value);
    return ok;
}

/* ---- Nodes ---- */

static struct node *read_node(struct reader *rd);

/* An item that anchors name stays. */
static void settle(struct node *node) {
    node->passing = false;
    if (node->kind != NODE_SEQUENCE && node->kind != NODE_MAPPING) return;
    for (struct node *child = node->first; child; child = child->next) settle(child);
}

/* The items of the streamed list, of which those stay that its reader wants to keep or that anchors
 * name; the current event starts the list. */
static bool read_streamed(struct reader *rd, struct node *list) {
    const struct node_stream *stream = rd->stream;
    struct node **tail = &list->first;
    rd->stream = NULL;
    rd->nesting++;
    for (;;) {
        if (!next_event(rd)) return false;
        if (rd->event->kind == EVENT_SEQUENCE_END) break;
        const struct arena_mark before = arena_mark(rd->arena);
        const uint32_t anchors = rd->anchor_count;
        rd->passing = true;
        struct node *item = read_node(rd);
        rd->passing = false;
        if (!item) return false;
        const bool done = !rd->is_beyond && stream->item(stream->context, item);
        if (done && rd->anchor_count == anchors) {
            arena_release(rd->arena, before);
        } else if (done) {
            settle(item);
        } else {
            *tail = item;
            tail = &item->next;
            list->count++;
        }
    }
    rd->nesting--;
    return true;
}

/* Shows the whole pairs of the root so far, without the key at *last whose value is to come. */
static void begin_stream(const struct reader *rd, struct node *root, struct node **last) {
    struct node *key = *last;
    *last = NULL;
    rd->stream->begin(rd->stream->context, root);
    *last = key;
}

static struct node *read_stream_list(struct reader *rd) {
    struct node *list = arena_room(rd->arena, sizeof *list);
    *list = (struct node){.span = span_of(rd, rd->event), .kind = NODE_SEQUENCE};
    return count_node(rd, list) && read_streamed(rd, list) ? list : NULL;
}

/* Whether the node that the current event starts, the value of `key` in the root, is the list to stream. */
static bool is_streamed(const struct reader *rd, const struct node *key) {
    return rd->stream && rd->nesting == 1 && rd->event->kind == EVENT_SEQUENCE_START && !rd->event->anchor &&
           !rd->event->tag && key->kind == NODE_SCALAR && strcmp(key->text, rd->stream->key) == 0;
}

/* Children up to the event `end`, linked; the current event starts the collection. */
static bool read_children(struct reader *rd, struct node *node, enum event_kind end) {
    struct node **tail = &node->first, **last = tail;
    uint32_t count = 0;
    unsigned height = 0;
    for (;; count++) {
        if (!next_event(rd)) return false;
        if (rd->event->kind == end) break;
        const bool streamed = count % 2 == 1 && end == EVENT_MAPPING_END && is_streamed(rd, *last);
        if (streamed) begin_stream(rd, node, last);
        struct node *child = streamed ? read_stream_list(rd) : read_node(rd);
        if (!child) return false;
        if (rd->height > height) height = rd->height;
        *tail = child;
        last = tail;
        tail = &child->next;
    }
    rd->height = height + 1;
    node->count = end == EVENT_MAPPING_END ? count / 2 : count;
    return true;
}

static bool read_collection(struct reader *rd, struct node *node, bool mapping) {
    if (!nesting_allowed(rd, node, 1, NULL)) return false;
    rd->nesting++;
    node->kind = mapping ? NODE_MAPPING : NODE_SEQUENCE;
    const bool ok = read_children(rd, node, mapping ? EVENT_MAPPING_END : EVENT_SEQUENCE_END) &&
                    (!mapping || merge_all(rd, node));
    rd->nesting--;
    return ok;
}

static bool tag_allowed(struct reader *rd, const char *tag, const struct node *node) {
    const char *core = "tag:yaml.org,2002:";
    if (strcmp(tag, "!") == 0 || strncmp(tag, core, strlen(core)) == 0) return true;
    struct diagnostic *d = diag_error(rd->diag, node->span, "tag", "a scene has no tags, found `%.40s`", tag);
    diag_help(rd->diag, d,
              tag[0] == '!' ? "remove it; an expression that starts with `!` needs quotes"
                            : "remove the tag");
    return false;
}

/* The text stands behind its node, in one piece of memory, see read_node. */
static bool read_scalar(struct reader *rd, struct node *node) {
    const struct event *e = rd->event;
    if (e->style == EVENT_DOUBLE_QUOTED && memchr(e->text, '\0', e->size)) {
        diag_help(rd->diag,
                  diag_error(rd->diag, node->span, "bad-character", "a text with the character NUL in it"),
                  "remove the `\\0`");
        return false;
    }
    node->kind = NODE_SCALAR;
    node->quoted = e->style != EVENT_PLAIN;
    node->count = (uint32_t)e->size;
    node->text = memcpy(node + 1, e->text, e->size + 1);
    rd->height = 0;
    return true;
}

/* Without the anchor and the tag that libyaml counts to a node: of plain text on one line. */
static void narrow_span(struct node *node, const struct event *e) {
    uint32_t length = 0;
    for (const char *c = node->text; *c; c++) length += ((unsigned char)*c & 0xc0) != 0x80;
    if (node->quoted || e->from.line != e->to.line || length == 0 || length >= node->span.length) return;
    node->span.column += node->span.length - length;
    node->span.length = length;
}

static bool read_content(struct reader *rd, struct node *node) {
    if (rd->event->kind != EVENT_SCALAR)
        return read_collection(rd, node, rd->event->kind == EVENT_MAPPING_START);
    if (!read_scalar(rd, node)) return false;
    narrow_span(node, rd->event);
    return true;
}

/* An anchored node: what it takes to repeat it is kept with its name. */
static bool read_anchored(struct reader *rd, struct node *node, const char *name) {
    const struct anchor *outer = rd->largest;
    const double before = rd->values - 1.0; /* the node itself is counted */
    struct anchor *a = add_anchor(rd, name, node);
    rd->largest = NULL;
    if (!read_content(rd, node)) return false;
    *a = (struct anchor){a->name, node, false, rd->values - before, rd->height, rd->largest};
    rd->largest = larger(outer, rd->largest);
    return true;
}

/* A node with an anchor, a tag or both. */
static bool read_marked(struct reader *rd, struct node *node) {
    const char *anchor = rd->event->anchor, *tag = rd->event->tag;
    if (tag && !tag_allowed(rd, tag, node)) return false;
    return anchor ? read_anchored(rd, node, anchor) : read_content(rd, node);
}

/* The node that the current event starts; NULL when it was reported as wrong. */
static struct node *read_node(struct reader *rd) {
    const struct event *e = rd->event;
    const size_t text = e->kind == EVENT_SCALAR ? e->size + 1 : 0;
    struct node *node = arena_room(rd->arena, sizeof *node + text);
    *node = (struct node){.span = span_of(rd, e), .passing = rd->passing};
    if (!count_node(rd, node)) return NULL;
    const bool ok = e->kind == EVENT_ALIAS    ? read_alias(rd, node)
                    : e->anchor || e->tag     ? read_marked(rd, node)
                    : e->kind == EVENT_SCALAR ? read_scalar(rd, node)
                                              : read_collection(rd, node, e->kind == EVENT_MAPPING_START);
    return ok ? node : NULL;
}

/* ---- Documents ---- */

static bool report_empty(struct reader *rd) {
    struct diagnostic *d =
        diag_error(rd->diag, (struct span){rd->source, 0, 0, 1}, "empty-file", "the file is empty");
    diag_help(rd->diag, d, "the smallest scene is:  scene: [{sphere: {}}]");
    return false;
}

/* libyaml compares each %TAG directive with all before it, which many make slow. */
static bool tag_directives_allowed(struct reader *rd) {
    enum { MANY = 100 };
    const char *at = rd->source->text, *end = at + rd->source->size;
    for (int i = 0; (at = memchr(at, '%', (size_t)(end - at))); at++)
        if ((size_t)(end - at) >= 4 && memcmp(at, "%TAG", 4) == 0 && ++i > MANY) {
            diag_error(rd->diag, (struct span){rd->source, 0, 0, 1}, "bad-document",
                       "more than %d times %%TAG: a scene has no tags", MANY);
            return false;
        }
    return true;
}

static struct node *read_stream(struct reader *rd) {
    if (!next_event(rd) /* stream start */ || !next_event(rd)) return NULL;
    if (rd->event->kind == EVENT_STREAM_END && !report_empty(rd)) return NULL;
    if (!next_event(rd)) return NULL;
    struct node *root = read_node(rd);
    if (!root || !next_event(rd) /* document end */ || !next_event(rd)) return NULL;
    if (rd->event->kind != EVENT_STREAM_END) {
        struct diagnostic *d = diag_error(rd->diag, span_at(rd, rd->event->from), "second-document",
                                          "a second document in the file");
        diag_help(rd->diag, d, "a scene is one document: it would be ignored; remove it, or this `---`");
        return NULL;
    }
    if (node_is_null(root) && !report_empty(rd)) return NULL;
    if (rd->is_beyond && !report_expansion(rd, rd->largest)) return NULL;
    return root;
}

/* Bytes of a text from where on a thread is worth its while. */
#ifdef MONGE_HOSTILE
enum { LONG = 0 };
#else
enum { LONG = 256 * 1024 };
#endif

struct node *node_parse(struct arena *arena, struct diagnostics *diag, const struct source *source,
                        const struct node_limits *limits, const struct node_stream *stream,
                        struct node_problem *problem) {
    struct reader rd = {.arena = arena,
                        .diag = diag,
                        .source = source,
                        .limits = limits,
                        .stream = stream,
                        .problem = problem};
    if (!tag_directives_allowed(&rd)) return NULL; /* before libyaml sees them */
    rd.events = events_begin(source, source->size > LONG);
    if (!rd.events) {
        diag_failure(diag, "out-of-memory", "%s: out of memory", source->name);
        return NULL;
    }

    /* The arena leaves by longjmp when it is full; its events must end on that way as well. */
    jmp_buf full, *const outer = arena_catch(arena, &full);
    struct node *volatile root = NULL;
    const bool is_full = setjmp(full) != 0;
    if (!is_full) root = read_stream(&rd);
    events_end(rd.events);
    arena_catch(arena, outer);
    if (is_full && outer) longjmp(*outer, 1);
    return root;
}
