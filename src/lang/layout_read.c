/* From a text to its layout: libyaml's events make the tree, and each comment goes to the node it stands by. */
#include <string.h>
#include <yaml.h>

#include "lang/cursor.h"
#include "lang/layout.h"

struct reader {
    yaml_parser_t parser;
    yaml_event_t event; /* the current one */
    struct arena *arena;
    struct cursor cursor;
    struct layout_marks marks;
    struct layout_comment *next; /* comment that belongs to nothing yet */
    size_t taken;                /* comments that do */
    size_t dash;                 /* the next of marks.dashes */
    uint32_t column;             /* of the entries of the innermost block collection */
    unsigned brackets;           /* flow collections that are open */
    struct layout_entry *last;   /* the one whose value has ended last; NULL: none */
    struct layout_node *closed;  /* block collections that have ended since, from the innermost */
};

/* ---- Places ---- */

static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n'; }

static size_t offset_of(struct reader *rd, yaml_mark_t mark) { return cursor_move(&rd->cursor, mark.index); }

static size_t line_start(const struct reader *rd, size_t at) {
    const char *text = rd->cursor.source->text, *feed = at ? memrchr(text, '\n', at) : NULL;
    return feed ? (size_t)(feed - text) + 1 : 0;
}

static uint32_t column_of(const struct reader *rd, size_t at) {
    uint32_t column = 0;
    for (size_t i = line_start(rd, at); i < at; i += source_character(rd->cursor.source, i)) column++;
    return column;
}

/* Whether the line before that of `at` is blank. */
static bool blank_before(const struct reader *rd, size_t at) {
    const char *text = rd->cursor.source->text;
    size_t i = line_start(rd, at);
    if (i == 0) return false;
    for (i--; i > 0 && text[i - 1] != '\n'; i--)
        if (!is_space(text[i - 1])) return false;
    return true;
}

static bool has_break(const struct reader *rd, size_t begin, size_t end) {
    return end > begin && memchr(rd->cursor.source->text + begin, '\n', end - begin);
}

/* Nothing but blanks before `at` on its line. */
static bool begins_line(const struct reader *rd, size_t at) {
    const char *text = rd->cursor.source->text;
    while (at > 0 && (text[at - 1] == ' ' || text[at - 1] == '\t')) at--;
    return at == 0 || text[at - 1] == '\n';
}

/* ---- Comments ---- */

static void append(struct layout_comments *list, struct layout_comment *c) {
    c->next = NULL;
    if (list->last)
        list->last->next = c;
    else
        list->first = c;
    list->last = c;
}

/* The next comment before `end`, or NULL. */
static struct layout_comment *take_comment(struct reader *rd, size_t end) {
    struct layout_comment *c = rd->next;
    if (!c || c->at >= end) return NULL;
    rd->next = c->next;
    c->next = NULL;
    rd->taken++;
    return c;
}

static void take_comments(struct reader *rd, size_t end, struct layout_comments *list) {
    for (struct layout_comment *c; (c = take_comment(rd, end));) append(list, c);
}

/* The comment behind what has ended last goes to it; true when it is one. */
static bool take_trailing(struct reader *rd, struct layout_comment *c) {
    if (c->own_line || !rd->last || rd->last->trailing) return false;
    rd->last->trailing = c;
    return true;
}

/* Comments up to `end`, where the next entry of a block or the end is: each goes to the innermost
 * collection that has ended and is not further to the right than the comment, or else before the next. */
static void deal_comments(struct reader *rd, size_t end, int64_t next_column,
                          struct layout_comments *before) {
    bool first = true;
    for (struct layout_comment *c; (c = take_comment(rd, end)); first = false) {
        if (first && take_trailing(rd, c)) continue;
        struct layout_node *n = c->column > next_column ? rd->closed : NULL;
        while (n && n->column > c->column) n = n->outer;
        while (n && n->outer && n->outer->column == n->column)
            n = n->outer; /* a list in the column of its key */
        append(n ? &n->end : before, c);
        rd->closed = n;
    }
    rd->closed = NULL;
}

static void close_node(struct reader *rd, struct layout_node *node) {
    struct layout_node **at = &rd->closed;
    while (*at) at = &(*at)->outer;
    *at = node;
}

/* ---- Nodes ---- */

static struct layout_node *read_node(struct reader *rd, struct layout_entry *owner);

/* The events of a text that has been parsed before are without errors. */
static void next_event(struct reader *rd) {
    yaml_event_delete(&rd->event);
    if (!yaml_parser_parse(&rd->parser, &rd->event)) longjmp(*rd->arena->on_full, 1);
}

static struct layout_entry *add_entry(struct reader *rd, struct layout_entry ***tail) {
    struct layout_entry *entry = arena_alloc(rd->arena, sizeof *entry);
    **tail = entry;
    *tail = &entry->next;
    return entry;
}

/* A key is on one line, but for those that are refused: no comment can be in it. */
static void read_key(struct reader *rd, struct layout_entry *entry) {
    struct layout_entry key = {0}, *last = rd->last;
    const size_t at = offset_of(rd, rd->event.start_mark);
    entry->key = read_node(rd, &key);
    if ((entry->key->flow || entry->key->spread) && at < rd->marks.odd_key) rd->marks.odd_key = at;
    rd->last = last;
    rd->closed = NULL;
    entry->colon = true;
    next_event(rd);
}

/* Whether the key that ends at `at` is followed by a colon, which must be on its line. */
static bool has_colon(const struct reader *rd, size_t at) {
    const struct source *source = rd->cursor.source;
    while (at < source->size && (source->text[at] == ' ' || source->text[at] == '\t')) at++;
    return at < source->size && source->text[at] == ':';
}

/* The end of the anchor or tag that begins at `at`. */
static size_t prop_end(const char *text, size_t at, size_t end) {
    const bool verbatim = text[at] == '!' && at + 1 < end && text[at + 1] == '<', tag = text[at] == '!';
    size_t i = at + 1;
    if (verbatim)
        while (i < end && text[i] != '>') i++;
    while (i < end && !is_space(text[i]) && (tag || !strchr(",[]{}:?", text[i]))) i++;
    return i;
}

/* Keeps the anchor and the tag at `at`; returns where the node's content begins. */
static size_t read_props(struct reader *rd, struct layout_node *node, size_t at, size_t end) {
    const char *text = rd->cursor.source->text;
    node->props = "";
    while (at < end) {
        if (text[at] == '&' || text[at] == '!') {
            const size_t stop = prop_end(text, at, end);
            node->props = arena_format(rd->arena, "%s%s%.*s", node->props, *node->props ? " " : "",
                                       (int)(stop - at), text + at);
            at = stop;
        } else if (text[at] == '#') {
            while (at < end && text[at] != '\n') at++;
        } else if (is_space(text[at])) {
            at++;
        } else {
            break;
        }
    }
    return at;
}

static void read_text(struct reader *rd, struct layout_node *node, size_t begin, size_t end) {
    const char *text = rd->cursor.source->text;
    node->text = text + begin;
    node->size = end - begin;
    node->spread = has_break(rd, begin, end);
    node->column = rd->column;
    if (node->size == 0 || !strchr("|>", *node->text) ||
        rd->event.data.scalar.style == YAML_PLAIN_SCALAR_STYLE)
        return;
    node->header = take_comment(rd, end);
    node->cut = end == rd->cursor.source->size && text[end - 1] != '\n';
}

static void read_block(struct reader *rd, struct layout_node *node, struct layout_entry *owner) {
    const bool mapping = node->kind == NODE_MAPPING;
    const uint32_t outer = rd->column;
    struct layout_entry **tail = &node->first;
    for (next_event(rd);
         rd->event.type != YAML_MAPPING_END_EVENT && rd->event.type != YAML_SEQUENCE_END_EVENT;
         next_event(rd)) {
        const size_t at = mapping ? offset_of(rd, rd->event.start_mark) : rd->marks.dashes[rd->dash++];
        const bool first = !node->first;
        struct layout_entry *entry = add_entry(rd, &tail);
        if (first) take_comments(rd, at, &owner->between);
        if (first)
            node->column = rd->column = column_of(rd, at);
        else
            deal_comments(rd, at, node->column, &entry->before);
        entry->blank_before = blank_before(rd, at);
        if (mapping) read_key(rd, entry);
        entry->value = read_node(rd, entry);
    }
    rd->column = outer;
    close_node(rd, node);
}

/* Comments before an entry or the closing bracket of a flow collection. */
static void take_flow_comments(struct reader *rd, struct layout_node *node, size_t end,
                               struct layout_comments *list) {
    bool first = true;
    for (struct layout_comment *c; (c = take_comment(rd, end)); first = false) {
        if (first && !node->first && !c->own_line)
            node->header = c;
        else if (!first || !node->first || !take_trailing(rd, c))
            append(list, c);
    }
}

static void read_flow(struct reader *rd, struct layout_node *node, size_t begin) {
    const bool mapping = node->kind == NODE_MAPPING;
    const size_t taken = rd->taken;
    size_t at = begin, end = begin;
    struct layout_entry **tail = &node->first;
    rd->brackets++;
    for (next_event(rd);
         rd->event.type != YAML_MAPPING_END_EVENT && rd->event.type != YAML_SEQUENCE_END_EVENT;
         next_event(rd)) {
        struct layout_comments before = {0};
        at = offset_of(rd, rd->event.start_mark);
        take_flow_comments(rd, node, at, &before);
        struct layout_entry *entry = add_entry(rd, &tail);
        entry->before = before;
        entry->line_before = has_break(rd, end, at);
        if (mapping) {
            const size_t key_end = offset_of(rd, rd->event.end_mark);
            read_key(rd, entry);
            entry->colon = has_colon(rd, key_end);
        }
        entry->value = read_node(rd, entry);
        end = offset_of(rd, rd->event.end_mark);
        rd->last = entry;
    }
    rd->brackets--;
    const size_t close = offset_of(rd, rd->event.end_mark) - node->braces;
    if (node->braces) take_flow_comments(rd, node, close, &node->end);
    node->close_line = begins_line(rd, close);
    node->commented = rd->taken > taken;
    node->spread = has_break(rd, begin, close);
}

static bool is_block(const yaml_event_t *e) {
    return (e->type == YAML_MAPPING_START_EVENT && e->data.mapping_start.style == YAML_BLOCK_MAPPING_STYLE) ||
           (e->type == YAML_SEQUENCE_START_EVENT &&
            e->data.sequence_start.style == YAML_BLOCK_SEQUENCE_STYLE);
}

/* The node that the current event starts, the value of `owner`. */
static struct layout_node *read_node(struct reader *rd, struct layout_entry *owner) {
    struct layout_node *node = arena_alloc(rd->arena, sizeof *node);
    const yaml_event_type_t type = rd->event.type;
    const size_t start = offset_of(rd, rd->event.start_mark), end = offset_of(rd, rd->event.end_mark);
    const size_t begin = read_props(rd, node, start, end);
    node->kind = type == YAML_MAPPING_START_EVENT    ? NODE_MAPPING
                 : type == YAML_SEQUENCE_START_EVENT ? NODE_SEQUENCE
                 : type == YAML_ALIAS_EVENT          ? NODE_ALIAS
                                                     : NODE_SCALAR;
    if (is_block(&rd->event)) {
        read_block(rd, node, owner);
        return node;
    }
    node->flow = node->kind == NODE_MAPPING || node->kind == NODE_SEQUENCE;
    node->braces = node->flow && begin < end && strchr("[{", rd->cursor.source->text[begin]);
    if (begin < end || *node->props)
        take_comments(rd, begin, &owner->between); /* where a null is, libyaml tells by what follows */
    if (node->flow)
        read_flow(rd, node, begin);
    else
        read_text(rd, node, begin, end);
    rd->last = owner;
    if (!node->flow && node->size == 0 && rd->brackets == 0) {
        node->column = rd->column + 1;
        close_node(rd, node);
    }
    return node;
}

/* ---- Documents ---- */

static struct layout *read_document(struct reader *rd) {
    const struct source *source = rd->cursor.source;
    const struct layout_marks *m = &rd->marks;
    struct layout *layout = arena_alloc(rd->arena, sizeof *layout);
    rd->next = m->comments;
    if (m->start != SIZE_MAX) {
        layout->preamble = source->text;
        layout->preamble_size = m->start;
        while (take_comment(rd, m->start)) continue;
        if (rd->next && !rd->next->own_line && !has_break(rd, m->body, rd->next->at))
            layout->start = take_comment(rd, SIZE_MAX);
    }
    next_event(rd); /* stream start */
    next_event(rd); /* document start */
    next_event(rd);
    const size_t at = offset_of(rd, rd->event.start_mark);
    take_comments(rd, at, &layout->root.before);
    layout->root.blank_before = blank_before(rd, at);
    layout->root.value = read_node(rd, &layout->root);
    deal_comments(rd, SIZE_MAX, -1, &layout->end);
    return layout;
}

static struct layout *refuse_key(struct reader *rd, struct diagnostics *diag) {
    struct span span = {rd->cursor.source, 0, column_of(rd, rd->marks.odd_key), 1};
    for (size_t i = 0; i < rd->marks.odd_key; i++) span.line += span.source->text[i] == '\n';
    diag_help(
        diag,
        diag_error(diag, span, "odd-key", "a key behind `?`, or one that is no word, has no canonical form"),
        "write `key: value`");
    return NULL;
}

struct layout *layout_read(struct arena *arena, struct diagnostics *diag, const struct source *source) {
    struct reader rd = {.arena = arena, .cursor = {.source = source}};
    layout_scan(arena, source, &rd.marks);
    if (!yaml_parser_initialize(&rd.parser)) longjmp(*arena->on_full, 1);
    yaml_parser_set_input_string(&rd.parser, (const unsigned char *)source->text, source->size);
    yaml_parser_set_encoding(&rd.parser, YAML_UTF8_ENCODING);
    jmp_buf *outer = arena->on_full, full;
    struct layout *volatile layout = NULL;
    const bool is_full = setjmp(full) != 0;
    if (!is_full) {
        arena->on_full = &full;
        layout = read_document(&rd);
    }
    yaml_event_delete(&rd.event);
    yaml_parser_delete(&rd.parser);
    arena->on_full = outer;
    if (is_full) longjmp(*outer, 1);
    return rd.marks.odd_key == SIZE_MAX ? layout : refuse_key(&rd, diag);
}
