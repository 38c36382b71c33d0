/* From libyaml's events to nodes: the only place that includes yaml.h. */
#include <string.h>
#include <yaml.h>

#include "base/table.h"
#include "lang/node.h"
#include "lang/spelling.h"

struct anchor {
    const char *name;
    struct node *node;
    bool open; /* its collection has not ended: an alias now would be a cycle */
};

struct reader {
    yaml_parser_t parser;
    yaml_event_t event; /* the current one */
    struct arena *arena;
    struct diagnostics *diag;
    const struct source *source;
    const struct node_limits *limits;
    struct table anchors; /* the newest of each name */
    size_t nodes;
    unsigned nesting;
};

bool node_is_null(const struct node *node) {
    const struct node *n = node_resolve(node);
    return n->kind == NODE_SCALAR && !n->quoted &&
           (n->count == 0 || strcmp(n->text, "~") == 0 || strcmp(n->text, "null") == 0);
}

/* ---- Events and marks ---- */

static struct span span_of(const struct reader *rd, yaml_mark_t from, yaml_mark_t to) {
    const size_t length = from.line == to.line && to.column > from.column ? to.column - from.column : 1;
    return (struct span){rd->source, (uint32_t)from.line, (uint32_t)from.column, (uint32_t)length};
}

static struct span span_at(const struct reader *rd, yaml_mark_t at) { return span_of(rd, at, at); }

/* What libyaml says, in the words of somebody who writes scenes. */
static const struct {
    const char *problem, *message, *help;
} yaml_problems[] = {
    {"found character that cannot start any token", "this character cannot start a value",
     "YAML indents with spaces, not tabs, and a value that starts with @, ` or % must be quoted"},
    {"found a tab character that violates indentation", "a tab in the indentation", "YAML indents with spaces"},
    {"found unexpected end of stream", "a quote that is never closed", "close it"},
    {"did not find expected ',' or ']'", "a list in [ ] that is not closed, or lacks a comma", "add `]` or `,`"},
    {"did not find expected ',' or '}'", "a mapping in { } that is not closed, or lacks a comma", "add `}` or `,`"},
    {"did not find expected key", "this line does not fit the lines before it", "give it the indentation of its siblings"},
    {"did not find expected '-' indicator", "this line does not fit the list before it", "start it with `- `, or indent it into an item"},
    {"mapping values are not allowed in this context", "a `:` where no key can stand",
     "check the indentation, or quote the text"},
    {"could not find expected ':'", "a key without a `:`", "a key and its value are written `key: value`"},
    {"control characters are not allowed", "a control character", "remove it"},
    {"invalid leading UTF-8 octet", "this is not UTF-8 text", "save the file as UTF-8"},
    {"invalid trailing UTF-8 octet", "this is not UTF-8 text", "save the file as UTF-8"},
    {"incomplete UTF-8 octet sequence", "this is not UTF-8 text", "save the file as UTF-8"},
};

/* Where a reader error is, which libyaml gives as an offset in bytes alone. */
static struct span span_of_offset(const struct reader *rd, size_t offset) {
    struct span span = {rd->source, 0, 0, 1};
    for (size_t i = 0; i < offset && i < rd->source->size; i++) {
        const unsigned char c = (unsigned char)rd->source->text[i];
        if (c == '\n') span.line++, span.column = 0;
        else if ((c & 0xc0) != 0x80) span.column++;
    }
    return span;
}

static void report_parser(struct reader *rd) {
    const yaml_parser_t *p = &rd->parser;
    if (p->error == YAML_MEMORY_ERROR) {
        diag_failure(rd->diag, "%s: out of memory", rd->source->name);
        return;
    }
    const char *problem = p->problem ? p->problem : "not YAML", *message = problem, *help = NULL;
    for (size_t i = 0; i < sizeof yaml_problems / sizeof *yaml_problems; i++)
        if (strcmp(yaml_problems[i].problem, problem) == 0) {
            message = yaml_problems[i].message;
            help = yaml_problems[i].help;
        }
    const struct span span =
        p->error == YAML_READER_ERROR ? span_of_offset(rd, p->problem_offset) : span_at(rd, p->problem_mark);
    struct diagnostic *d = diag_error(rd->diag, span, "%s", message);
    if (help) diag_help(rd->diag, d, "%s", help);
    const bool elsewhere = p->context_mark.line != p->problem_mark.line || p->context_mark.column != p->problem_mark.column;
    if (p->context && elsewhere && p->error != YAML_READER_ERROR)
        diag_related(rd->diag, d, span_at(rd, p->context_mark), "it belongs to what starts here");
}

static bool next_event(struct reader *rd) {
    yaml_event_delete(&rd->event);
    if (yaml_parser_parse(&rd->parser, &rd->event)) return true;
    report_parser(rd);
    return false;
}

/* Counts one more value against the limit. */
static bool count_node(struct reader *rd, struct span span) {
    if (++rd->nodes <= rd->limits->nodes) return true;
    diag_error(rd->diag, span, "more than %zu values in one file (the limit `values`)", rd->limits->nodes);
    return false;
}

/* ---- Anchors ---- */

static struct anchor *add_anchor(struct reader *rd, const yaml_char_t *name, struct node *node) {
    if (!name) return NULL;
    struct anchor *a = arena_alloc(rd->arena, sizeof *a);
    *a = (struct anchor){arena_text(rd->arena, (const char *)name, strlen((const char *)name)), node, true};
    table_put(rd->arena, &rd->anchors, a->name, a);
    return a;
}

static bool read_alias(struct reader *rd, struct node *node) {
    const char *name = (const char *)rd->event.data.alias.anchor;
    const struct anchor *a = table_find(&rd->anchors, name);
    if (a && !a->open) {
        node->kind = NODE_ALIAS;
        node->target = a->node;
        return true;
    }
    if (a) {
        struct diagnostic *d = diag_error(rd->diag, node->span, "`*%s` stands inside the very node that it names", name);
        diag_related(rd->diag, d, a->node->span, "`&%s` is given here", name);
        return false;
    }
    struct spelling s = spelling_begin(name);
    for (size_t i = 0; i < rd->anchors.capacity; i++)
        if (rd->anchors.slots[i].name) spelling_offer(&s, rd->anchors.slots[i].name);
    struct diagnostic *d = diag_error(rd->diag, node->span, "no anchor `&%s` before this alias", name);
    if (s.best) diag_help(rd->diag, d, "did you mean `*%s`?", s.best);
    return false;
}

/* ---- Merge keys ---- */

/* The mapping that merge keys fill: its keys so far, and where the next pair goes. */
struct merge {
    struct node *into;
    struct table keys;
    struct node **tail;
};

static void merge_begin(struct reader *rd, struct merge *merge, struct node *into) {
    *merge = (struct merge){.into = into, .tail = &into->first};
    for (struct node *key = into->first; key; key = key->next->next) {
        if (key->kind == NODE_SCALAR) table_put(rd->arena, &merge->keys, key->text, key);
        merge->tail = &key->next->next;
    }
}

/* Appends copies of the pairs of `from` whose keys are not there yet. False past the limit of values,
 * for which every pair counts that is looked at. */
static bool merge_pairs(struct reader *rd, struct merge *merge, const struct node *from) {
    for (const struct node *key = from->first; key; key = key->next->next) {
        if (!count_node(rd, merge->into->span)) return false;
        if (key->kind == NODE_SCALAR && table_find(&merge->keys, key->text)) continue;
        struct node *pair = arena_array(rd->arena, 2, sizeof *pair);
        pair[0] = *key;
        pair[1] = *key->next;
        pair[0].next = &pair[1];
        pair[1].next = NULL;
        if (key->kind == NODE_SCALAR) table_put(rd->arena, &merge->keys, key->text, pair);
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
    if (!ok) diag_error(rd->diag, value->span, "`<<` takes a mapping or a list of mappings, as in `<<: *base`");
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

/* Children up to the event `end`, linked; the current event starts the collection. */
static bool read_children(struct reader *rd, struct node *node, yaml_event_type_t end) {
    struct node **tail = &node->first;
    uint32_t count = 0;
    for (;; count++) {
        if (!next_event(rd)) return false;
        if (rd->event.type == end) break;
        struct node *child = read_node(rd);
        if (!child) return false;
        *tail = child;
        tail = &child->next;
    }
    node->count = end == YAML_MAPPING_END_EVENT ? count / 2 : count;
    return true;
}

static bool read_collection(struct reader *rd, struct node *node, bool mapping) {
    if (++rd->nesting > rd->limits->nesting) {
        struct diagnostic *d = diag_error(rd->diag, node->span, "more than %u levels of nesting", rd->limits->nesting);
        diag_help(rd->diag, d, "the limit `nesting`");
        return false;
    }
    node->kind = mapping ? NODE_MAPPING : NODE_SEQUENCE;
    const bool ok = read_children(rd, node, mapping ? YAML_MAPPING_END_EVENT : YAML_SEQUENCE_END_EVENT) &&
                    (!mapping || merge_all(rd, node));
    rd->nesting--;
    return ok;
}

static bool tag_allowed(struct reader *rd, const yaml_char_t *tag, const struct node *node) {
    const char *core = "tag:yaml.org,2002:";
    if (!tag || strcmp((const char *)tag, "!") == 0 || strncmp((const char *)tag, core, strlen(core)) == 0) return true;
    diag_help(rd->diag, diag_error(rd->diag, node->span, "a scene has no tags, found `%s`", (const char *)tag), "remove the tag");
    return false;
}

static void read_scalar(struct reader *rd, struct node *node) {
    node->kind = NODE_SCALAR;
    node->quoted = rd->event.data.scalar.style != YAML_PLAIN_SCALAR_STYLE;
    node->count = (uint32_t)rd->event.data.scalar.length;
    node->text = arena_text(rd->arena, (const char *)rd->event.data.scalar.value, node->count);
}

/* The node that the current event starts; NULL when it was reported as wrong. */
static struct node *read_node(struct reader *rd) {
    const yaml_event_t *e = &rd->event;
    struct node *node = arena_alloc(rd->arena, sizeof *node);
    node->span = span_of(rd, e->start_mark, e->end_mark);
    if (!count_node(rd, node->span)) return NULL;
    if (e->type == YAML_ALIAS_EVENT) return read_alias(rd, node) ? node : NULL;

    const bool scalar = e->type == YAML_SCALAR_EVENT, mapping = e->type == YAML_MAPPING_START_EVENT;
    const yaml_char_t *tag = scalar ? e->data.scalar.tag : mapping ? e->data.mapping_start.tag : e->data.sequence_start.tag;
    if (!tag_allowed(rd, tag, node)) return NULL;
    struct anchor *anchor = add_anchor(rd, scalar    ? e->data.scalar.anchor
                                           : mapping ? e->data.mapping_start.anchor
                                                     : e->data.sequence_start.anchor, node);
    if (scalar) read_scalar(rd, node);
    else if (!read_collection(rd, node, mapping)) return NULL;
    if (anchor) anchor->open = false;
    return node;
}

/* ---- Documents ---- */

static const char smallest_scene[] = "the smallest scene is:  scene: [{sphere: {}}]";

static struct node *read_stream(struct reader *rd) {
    if (!next_event(rd)) return NULL; /* stream start */
    if (!next_event(rd)) return NULL;
    if (rd->event.type == YAML_STREAM_END_EVENT) {
        diag_help(rd->diag, diag_error(rd->diag, (struct span){rd->source, 0, 0, 1}, "the file is empty"), "%s", smallest_scene);
        return NULL;
    }
    if (!next_event(rd)) return NULL;
    struct node *root = read_node(rd);
    if (!root || !next_event(rd) /* document end */ || !next_event(rd)) return NULL;
    if (rd->event.type != YAML_STREAM_END_EVENT) {
        diag_help(rd->diag, diag_error(rd->diag, span_at(rd, rd->event.start_mark), "a second document in the file"),
                  "a scene is one document: it would be ignored; remove it, or this `---`");
        return NULL;
    }
    return root;
}

struct node *node_parse(struct arena *arena, struct diagnostics *diag, const struct source *source,
                        const struct node_limits *limits) {
    struct reader rd = {.arena = arena, .diag = diag, .source = source, .limits = limits};
    if (!yaml_parser_initialize(&rd.parser)) {
        diag_failure(diag, "%s: out of memory", source->name);
        return NULL;
    }
    yaml_parser_set_input_string(&rd.parser, (const unsigned char *)source->text, source->size);
    yaml_parser_set_encoding(&rd.parser, YAML_UTF8_ENCODING);

    /* The arena leaves by longjmp when it is full; the parser must be freed on that way as well. */
    jmp_buf *outer = arena->on_full, full;
    struct node *volatile root = NULL;
    const bool is_full = setjmp(full) != 0;
    if (!is_full) {
        arena->on_full = &full;
        root = read_stream(&rd);
    }
    yaml_event_delete(&rd.event);
    yaml_parser_delete(&rd.parser);
    arena->on_full = outer;
    if (is_full && outer) longjmp(*outer, 1);
    return root;
}
