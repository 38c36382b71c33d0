/* Prints what is within lines: scalars and collections in brackets. */
#include <string.h>

#include "lang/printer.h"

static bool is_null(const struct layout_node *node) { return node->kind == NODE_SCALAR && node->size == 0; }

/* A null without an anchor: nothing at all. */
static bool is_bare(const struct layout_node *node) { return is_null(node) && !*node->props; }

/* ---- In one line ---- */

static void print_pair(struct printer *p, const struct layout_entry *entry) {
    print_inline(p, entry->key);
    if (entry->key->kind == NODE_ALIAS) printer_word(p, " ");
    if (entry->colon) printer_word(p, ": ");
    print_inline(p, entry->value);
}

void print_inline(struct printer *p, const struct layout_node *node) {
    printer_word(p, node->props);
    if (*node->props && !is_null(node)) printer_word(p, " ");
    if (!node->flow) {
        printer_put(p, node->text, node->size);
        return;
    }
    const bool mapping = node->kind == NODE_MAPPING;
    printer_word(p, mapping ? "{" : "[");
    for (const struct layout_entry *entry = node->first; entry; entry = entry->next) {
        if (mapping)
            print_pair(p, entry);
        else
            print_inline(p, entry->value);
        if (entry->next) printer_word(p, ", ");
        if (p->probing && p->column > LAYOUT_WIDTH) return;
    }
    printer_word(p, mapping ? "}" : "]");
}

static bool has_collections(const struct layout_node *node) {
    for (const struct layout_entry *entry = node->first; entry; entry = entry->next)
        if (entry->value->flow ? entry->value->first != NULL : entry->value->spread) return true;
    return false;
}

bool print_breaks(const struct printer *p, const struct layout_node *node, uint32_t column) {
    if (!node->flow || !node->first || node->commented) return false;
    if (node->spread && has_collections(node)) return true;
    struct printer probe = *p;
    probe.probing = true;
    probe.column = column;
    print_inline(&probe, node);
    return probe.column > LAYOUT_WIDTH;
}

/* ---- Scalars ---- */

static size_t line_length(const char *text, size_t size) {
    const char *feed = memchr(text, '\n', size);
    return feed ? (size_t)(feed - text) : size;
}

/* Without the blanks at the end, but for one behind a backslash. */
static size_t trimmed(const char *text, size_t size, bool escapes) {
    size_t length = size, slashes = 0;
    while (length > 0 && (text[length - 1] == ' ' || text[length - 1] == '\t')) length--;
    while (escapes && slashes < length && text[length - 1 - slashes] == '\\') slashes++;
    return slashes % 2 == 1 && length < size ? length + 1 : length;
}

/* A plain or quoted scalar: how its lines are indented is not part of it. */
static void print_folded(struct printer *p, const struct layout_node *node, uint32_t column) {
    const bool escapes = *node->text == '"';
    for (size_t i = 0; i < node->size;) {
        const size_t length = line_length(node->text + i, node->size - i), next = i + length + 1;
        size_t begin = i;
        if (i > 0)
            while (begin < i + length && (node->text[begin] == ' ' || node->text[begin] == '\t')) begin++;
        const size_t size =
            next > node->size ? i + length - begin : trimmed(node->text + begin, i + length - begin, escapes);
        if (i > 0 && size > 0) printer_indent(p, column);
        printer_put(p, node->text + begin, size);
        if (next <= node->size) printer_end_line(p, NULL);
        i = next;
    }
}

/* What stands behind | or >. */
struct block_header {
    size_t size;    /* with its line break */
    uint32_t digit; /* 0: none */
    char chomp;     /* + - or 0 */
};

static struct block_header read_header(const struct layout_node *node) {
    struct block_header h = {.size = line_length(node->text, node->size) + 1};
    for (size_t i = 1; i < node->size && !strchr(" \t\n#", node->text[i]); i++) {
        const char c = node->text[i];
        if (c == '+' || c == '-')
            h.chomp = c;
        else
            h.digit = (uint32_t)(c - '0');
    }
    if (node->cut) h.chomp = '-';
    return h;
}

static size_t leading_spaces(const char *text, size_t size) {
    size_t n = 0;
    while (n < size && text[n] == ' ') n++;
    return n;
}

/* By how much the lines of a block scalar are indented. */
static size_t block_indent(const struct layout_node *node, const struct block_header *h) {
    if (h->digit) return node->column + h->digit;
    for (size_t i = h->size; i < node->size; i += line_length(node->text + i, node->size - i) + 1) {
        const size_t spaces = leading_spaces(node->text + i, node->size - i);
        if (i + spaces < node->size && node->text[i + spaces] != '\n') return spaces;
    }
    return 0;
}

static void print_block_scalar(struct printer *p, const struct layout_node *node, uint32_t column) {
    const struct block_header h = read_header(node);
    const size_t indent = block_indent(node, &h);
    size_t last = p->line_count + 1;
    printer_put(p, node->text, 1);
    if (h.digit) printer_word(p, "2"); /* LAYOUT_INDENT */
    printer_put(p, &h.chomp, h.chomp != 0);
    printer_end_line(p, node->header);
    for (size_t i = h.size, length; i < node->size; i += length + 1) {
        length = line_length(node->text + i, node->size - i);
        if (length > indent) {
            printer_indent(p, column);
            printer_put(p, node->text + i + indent, length - indent);
        }
        printer_end_line(p, NULL);
        if (length > indent || h.chomp == '+') last = p->line_count;
    }
    p->line_count = last; /* without the blank lines behind it, which are not part of it */
    p->fresh = h.chomp == '+';
}

void print_scalar(struct printer *p, const struct layout_node *node, uint32_t column) {
    const bool block = node->size > 0 && strchr("|>", *node->text);
    printer_word(p, node->props);
    if (*node->props) printer_word(p, " ");
    if (block)
        print_block_scalar(p, node, column);
    else
        print_folded(p, node, column);
}

/* ---- With the author's line breaks ---- */

static void print_item(struct printer *p, const struct layout_node *node, uint32_t column) {
    if (node->flow && (node->commented || node->spread))
        print_lines(p, node, column);
    else if (node->spread)
        print_scalar(p, node, column);
    else
        print_inline(p, node);
}

/* `key:`, comments between, and the value. */
static void print_lines_pair(struct printer *p, const struct layout_entry *entry, uint32_t column) {
    const struct layout_comment *c = entry->between.first;
    print_inline(p, entry->key);
    if (entry->key->kind == NODE_ALIAS) printer_word(p, " ");
    if (entry->colon) printer_word(p, ":");
    if (c) {
        printer_end_line(p, c->own_line ? NULL : c);
        printer_comments(p, c->own_line ? c : c->next, column);
        printer_indent(p, column);
    } else if (entry->colon && !is_bare(entry->value)) {
        printer_word(p, " ");
    }
    print_item(p, entry->value, column);
}

/* Comments before the entry, and the start of its line where it has one of its own. */
static void begin_lines_entry(struct printer *p, const struct layout_entry *entry, bool first,
                              uint32_t column) {
    const struct layout_comment *between = entry->key ? NULL : entry->between.first;
    if ((entry->line_before || entry->before.first || between) && p->column > 0) printer_end_line(p, NULL);
    printer_comments(p, entry->before.first, column);
    printer_comments(p, between, column);
    if (p->column == 0)
        printer_indent(p, column);
    else if (!first)
        printer_word(p, " ");
}

void print_lines(struct printer *p, const struct layout_node *node, uint32_t column) {
    const bool mapping = node->kind == NODE_MAPPING;
    const struct layout_entry *first = node->first;
    printer_word(p, node->props);
    if (*node->props) printer_word(p, " ");
    printer_word(p, mapping ? "{" : "[");
    const bool hangs = !first || node->header || first->line_before || first->before.first ||
                       (!mapping && first->between.first);
    const uint32_t close = hangs ? column : p->column - 1, inner = hangs ? column + LAYOUT_INDENT : p->column;
    if (node->header) printer_end_line(p, node->header);
    for (const struct layout_entry *entry = first; entry; entry = entry->next) {
        begin_lines_entry(p, entry, entry == first, inner);
        if (mapping)
            print_lines_pair(p, entry, inner + LAYOUT_INDENT);
        else
            print_item(p, entry->value, inner + LAYOUT_INDENT);
        const bool closes = !entry->next && !entry->trailing && !node->close_line && !node->end.first;
        if (mapping && entry->colon && is_bare(entry->value) && (entry->next || closes))
            printer_word(p, " "); /* `:,` is no YAML */
        if (entry->next) printer_word(p, ",");
        if (entry->trailing) printer_end_line(p, entry->trailing);
    }
    if (p->column > 0 && (node->close_line || node->end.first)) printer_end_line(p, NULL);
    printer_comments(p, node->end.first, inner);
    if (p->column == 0) printer_indent(p, close);
    printer_word(p, mapping ? "}" : "]");
}
