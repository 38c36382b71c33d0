#include "lang/printer.h"

#include <string.h>

static void *grow(struct arena *arena, void *old, size_t count, size_t *room, size_t size) {
    *room = *room ? 2 * *room : 256;
    void *larger = arena_array(arena, *room, size);
    if (count) memcpy(larger, old, count * size);
    return larger;
}

void printer_put(struct printer *p, const char *text, size_t size) {
    for (size_t i = 0; i < size; i++) p->column += ((unsigned char)text[i] & 0xc0) != 0x80;
    if (p->probing || size == 0) return;
    while (p->room - p->size < size) p->text = grow(p->arena, p->text, p->size, &p->room, 1);
    memcpy(p->text + p->size, text, size);
    p->size += size;
}

void printer_word(struct printer *p, const char *word) { printer_put(p, word, strlen(word)); }

void printer_indent(struct printer *p, uint32_t column) {
    while (p->column < column) printer_put(p, " ", 1);
}

void printer_end_line(struct printer *p, const struct layout_comment *comment) {
    if (p->line_count == p->line_room)
        p->lines = grow(p->arena, p->lines, p->line_count, &p->line_room, sizeof *p->lines);
    p->lines[p->line_count++] = (struct printer_line){p->size, p->column, comment};
    p->column = 0;
    p->fresh = false;
}

void printer_blank_line(struct printer *p, bool wanted) {
    if (wanted && !p->fresh) printer_end_line(p, NULL);
}

void printer_comments(struct printer *p, const struct layout_comment *first, uint32_t column) {
    for (const struct layout_comment *c = first; c; c = c->next) {
        printer_blank_line(p, c->blank_before);
        printer_indent(p, column);
        printer_put(p, c->text, c->size);
        printer_end_line(p, NULL);
    }
}

/* ---- Comments behind lines ---- */

/* The column of the comments behind line `i` and the next ones whose comments were in the same column; *end: those after. */
static uint32_t comment_column(const struct printer *p, size_t i, size_t *end) {
    uint32_t width = 0;
    const uint32_t column = p->lines[i].comment->column;
    for (*end = i; *end < p->line_count && p->lines[*end].comment && p->lines[*end].comment->column == column;
         ++*end)
        if (p->lines[*end].width > width) width = p->lines[*end].width;
    return width + 2;
}

static size_t text_room(const struct printer *p) {
    size_t room = p->size + p->line_count + 1;
    for (size_t i = 0, end; i < p->line_count; i++) {
        if (!p->lines[i].comment) continue;
        const uint32_t column = comment_column(p, i, &end);
        for (; i < end; i++) room += column - p->lines[i].width + p->lines[i].comment->size;
        i--;
    }
    return room;
}

char *printer_text(const struct printer *p, size_t *size) {
    char *text = arena_alloc(p->arena, text_room(p)), *to = text;
    size_t begin = 0, end = 0;
    uint32_t column = 0;
    for (size_t i = 0; i < p->line_count; begin = p->lines[i++].end) {
        const struct printer_line *line = &p->lines[i];
        if (line->end > begin)
            to = (char *)memcpy(to, p->text + begin, line->end - begin) + (line->end - begin);
        if (line->comment && i >= end) column = comment_column(p, i, &end);
        if (line->comment) {
            to = (char *)memset(to, ' ', column - line->width) + (column - line->width);
            to = (char *)memcpy(to, line->comment->text, line->comment->size) + line->comment->size;
        }
        *to++ = '\n';
    }
    *size = (size_t)(to - text);
    return text;
}
