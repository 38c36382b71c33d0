/* Puts a layout together in the canonical style: blocks, line by line; layout_flow.c has what is within lines. */
#include <string.h>

#include "lang/printer.h"

static bool is_null(const struct layout_node *node) { return node->kind == NODE_SCALAR && node->size == 0; }

static bool is_block_scalar(const struct layout_node *node) {
    return node->kind == NODE_SCALAR && node->size > 0 && strchr("|>", *node->text);
}

static void print_block(struct printer *p, const struct layout_node *node, uint32_t column, bool begun);

/* ---- Values ---- */

/* The end of a line that opens something, with the first of `comments` where it stood there; the others
 * get lines of their own. */
static void open_lines(struct printer *p, const struct layout_comment *comments, uint32_t column) {
    const bool behind = comments && !comments->own_line;
    printer_end_line(p, behind ? comments : NULL);
    p->fresh = true;
    printer_comments(p, behind ? comments->next : comments, column);
}

/* What is no block, and begins at the end of the line or, behind comments, on one of its own at `column`. */
static void print_leaf(struct printer *p, const struct layout_entry *entry, uint32_t column) {
    const struct layout_node *node = entry->value;
    const bool empty = is_null(node) && !*node->props;
    if (entry->between.first) {
        open_lines(p, entry->between.first, column);
        printer_indent(p, column);
    } else if (p->column > 0 && !empty) {
        printer_word(p, " ");
    }
    if (node->flow && node->commented)
        print_lines(p, node, column);
    else if (node->spread && node->kind == NODE_SCALAR)
        print_scalar(p, node, column > 0 ? column : LAYOUT_INDENT);
    else
        print_inline(p, node);
    if (is_block_scalar(node)) return;
    printer_end_line(p, entry->trailing);
    if (!is_null(node) || !node->end.first) return;
    p->fresh = true;
    printer_comments(p, node->end.first, column);
}

/* A flow collection that becomes a block has no comments inside: that behind it goes to its first line. */
static struct layout_comments move_trailing(const struct layout_entry *entry, bool begun) {
    struct layout_comments between = entry->between;
    if (!entry->trailing) return between;
    if (begun)
        entry->value->first->trailing = entry->trailing;
    else if (between.last)
        between.last = between.last->next = entry->trailing;
    else
        between.first = between.last = entry->trailing;
    return between;
}

static void print_nested(struct printer *p, const struct layout_entry *entry, uint32_t column, bool item) {
    const struct layout_node *node = entry->value;
    const bool begun = item && !*node->props && !entry->between.first;
    const struct layout_comments between = move_trailing(entry, begun);
    if (*node->props || begun) printer_word(p, " ");
    printer_word(p, node->props);
    if (!begun) open_lines(p, between.first, column);
    print_block(p, node, column, begun);
}

/* Whether the value is printed as a block; the key or the dash has been. */
static bool is_nested(const struct printer *p, const struct layout_entry *entry, uint32_t column) {
    const struct layout_node *node = entry->value;
    if (node->kind != NODE_MAPPING && node->kind != NODE_SEQUENCE) return false;
    return !node->flow || print_breaks(p, node, entry->between.first ? column : p->column + (p->column > 0));
}

static void print_key(struct printer *p, const struct layout_node *key) {
    print_inline(p, key);
    printer_word(p, key->kind == NODE_ALIAS || is_null(key) ? " :" : ":");
}

/* The entries of a mapping or a sequence from `column` on; `begun`: the first one's line has been begun. */
static void print_block(struct printer *p, const struct layout_node *node, uint32_t column, bool begun) {
    for (const struct layout_entry *entry = node->first; entry; entry = entry->next, begun = false) {
        printer_comments(p, entry->before.first, column);
        if (!begun) printer_blank_line(p, entry->blank_before);
        printer_indent(p, column);
        if (entry->key)
            print_key(p, entry->key);
        else
            printer_word(p, "-");
        if (is_nested(p, entry, column + LAYOUT_INDENT))
            print_nested(p, entry, column + LAYOUT_INDENT, !entry->key);
        else
            print_leaf(p, entry, column + LAYOUT_INDENT);
    }
    printer_comments(p, node->end.first, column);
}

/* ---- Documents ---- */

/* Directives and comments, line by line. */
static void print_preamble(struct printer *p, const struct layout *layout) {
    bool blank = false;
    for (size_t i = 0, next; i < layout->preamble_size; i = next) {
        const char *text = layout->preamble + i, *feed = memchr(text, '\n', layout->preamble_size - i);
        size_t length = feed ? (size_t)(feed - text) : layout->preamble_size - i;
        next = i + length + 1;
        while (length > 0 && *text != '%' && (*text == ' ' || *text == '\t')) text++, length--;
        while (length > 0 && (text[length - 1] == ' ' || text[length - 1] == '\t')) length--;
        if (length > 0) {
            printer_blank_line(p, blank);
            printer_put(p, text, length);
            printer_end_line(p, NULL);
        }
        blank = length == 0;
    }
    printer_blank_line(p, blank);
    printer_word(p, "---");
    printer_end_line(p, layout->start);
}

static void print_root(struct printer *p, const struct layout_entry *root) {
    const struct layout_node *node = root->value;
    printer_comments(p, root->before.first, 0);
    printer_blank_line(p, root->blank_before);
    if (!is_nested(p, root, 0)) {
        print_leaf(p, root, 0);
        return;
    }
    const struct layout_comments between = move_trailing(root, false);
    p->fresh = true; /* the first entry begins where the root does */
    printer_word(p, node->props);
    if (*node->props)
        open_lines(p, between.first, 0);
    else
        printer_comments(p, between.first, 0);
    print_block(p, node, 0, false);
}

char *layout_print(struct arena *arena, const struct layout *layout, size_t *size) {
    struct printer printer = {.arena = arena, .fresh = true}, *p = &printer;
    if (layout->preamble) print_preamble(p, layout);
    print_root(p, &layout->root);
    printer_comments(p, layout->end.first, 0);
    return printer_text(p, size);
}
