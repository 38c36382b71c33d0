#include <locale.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lang/importer.h"

enum { LINE_WIDTH = 120, MAX_COMMENT = 400 };

/* ---- A text that grows ---- */

static void make_room(struct text *text, size_t size) {
    if (text->room > size) return;
    const size_t room = 2 * size + 256;
    char *larger = arena_alloc(text->arena, room);
    if (text->size) memcpy(larger, text->bytes, text->size);
    text->bytes = larger;
    text->room = room;
}

void text_add(struct text *text, const char *format, ...) {
    va_list args, again;
    va_start(args, format);
    va_copy(again, args);
    const size_t length = (size_t)vsnprintf(NULL, 0, format, args);
    make_room(text, text->size + length + 1);
    vsnprintf(text->bytes + text->size, length + 1, format, again);
    text->size += length;
    va_end(again);
    va_end(args);
}

void text_cut(struct text *text, size_t size) {
    text->size = size;
    if (text->bytes) text->bytes[size] = '\0';
}

/* ---- Numbers ---- */

enum { NUMBER_SIZE = 64 };

/* The fewest significant digits that read back as the same number. */
static int digits_of(double value) {
    char text[NUMBER_SIZE];
    for (int digits = 1; digits < 17; digits++) {
        snprintf(text, sizeof text, "%.*e", digits - 1, value);
        if (strtod(text, NULL) == value) return digits;
    }
    return 17;
}

static int exponent_of(double value, int digits) {
    char text[NUMBER_SIZE];
    snprintf(text, sizeof text, "%.*e", digits - 1, value);
    return atoi(strchr(text, 'e') + 1);
}

/* printf writes the decimal point of the program's locale, the language has a point. */
static void mend_point(char *text) {
    const char *point = localeconv()->decimal_point;
    char *at = strcmp(point, ".") == 0 ? NULL : strstr(text, point);
    if (!at) return;
    *at = '.';
    memmove(at + 1, at + strlen(point), strlen(at + strlen(point)) + 1);
}

const char *number_text(struct arena *arena, double value) {
    char text[NUMBER_SIZE];
    const double plain = value + 0.0; /* no -0 */
    const int digits = digits_of(plain), exponent = exponent_of(plain, digits);
    const int decimals = digits - 1 - exponent;
    if (exponent >= -6 && exponent < 16)
        snprintf(text, sizeof text, "%.*f", decimals > 0 ? decimals : 0, plain);
    else
        snprintf(text, sizeof text, "%.*e", digits - 1, plain);
    mend_point(text);
    return arena_text(arena, text, strlen(text));
}

const char *vec3_text(struct arena *arena, vec3 v) {
    return arena_format(arena, "[%s, %s, %s]", number_text(arena, v.x), number_text(arena, v.y),
                        number_text(arena, v.z));
}

double tidy(double computed) {
    char text[NUMBER_SIZE];
    snprintf(text, sizeof text, "%.15g", computed);
    return strtod(text, NULL);
}

vec3 tidy_vec3(vec3 computed) { return (vec3){tidy(computed.x), tidy(computed.y), tidy(computed.z)}; }

/* ---- Nodes in comments ---- */

static void add_node(struct text *text, const struct node *node) {
    const struct node *n = node_resolve(node);
    if (text->size > MAX_COMMENT) return;
    if (n->kind == NODE_SCALAR) {
        text_add(text, "%.*s", MAX_COMMENT, n->text);
        return;
    }
    const bool mapping = n->kind == NODE_MAPPING;
    text_add(text, mapping ? "{" : "[");
    bool key = mapping;
    for (const struct node *child = n->first; child; child = child->next) {
        add_node(text, child);
        if (child->next) text_add(text, key ? ": " : ", ");
        key = mapping && !key;
    }
    text_add(text, mapping ? "}" : "]");
}

const char *node_text(struct arena *arena, const struct node *node) {
    struct text text = {.arena = arena};
    add_node(&text, node);
    if (text.size > MAX_COMMENT) {
        text_cut(&text, MAX_COMMENT);
        text_add(&text, " ...");
    }
    for (char *c = text.bytes; *c; c++)
        if (*c < ' ' || *c > '~') *c = '?'; /* a comment must not end early */
    return text.bytes;
}

/* ---- Mappings and lists ---- */

void block_add(struct block *block, struct arena *arena, const char *key, const char *value) {
    block->entries[block->count++] = arena_format(arena, "%s: %s", key, value);
}

static bool fits(int indent, const char *head, const char *const *entries, size_t count, size_t around) {
    size_t width = (size_t)indent + strlen(head) + 4;
    for (size_t i = 0; i < count && width <= LINE_WIDTH; i++) width += strlen(entries[i]) + around;
    return width <= LINE_WIDTH;
}

void text_block(struct text *text, int indent, const char *head, const struct block *block) {
    const size_t count = (size_t)block->count;
    const bool flow = fits(indent, head, block->entries, count, 2);
    text_add(text, "%*s%s:%s", indent, "", head, flow ? " {" : "\n");
    for (size_t i = 0; i < count; i++) {
        if (flow)
            text_add(text, "%s%s", i ? ", " : "", block->entries[i]);
        else
            text_add(text, "%*s%s\n", indent + 2, "", block->entries[i]);
    }
    if (flow) text_add(text, "}\n");
}

void text_list(struct text *text, int indent, const char *head, const char *const *entries, size_t count) {
    const bool flow = fits(indent, head, entries, count, 4);
    text_add(text, "%*s%s:%s", indent, "", head, flow ? " [" : "\n");
    for (size_t i = 0; i < count; i++) {
        if (flow)
            text_add(text, "%s{%s}", i ? ", " : "", entries[i]);
        else
            text_add(text, "%*s- %s\n", indent + 2, "", entries[i]);
    }
    if (flow) text_add(text, "]\n");
}
