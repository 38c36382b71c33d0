#include "base/source.h"

size_t source_break(const struct source *source, size_t i) {
    const unsigned char *t = (const unsigned char *)source->text;
    const size_t left = source->size - i;
    if (t[i] == '\n') return 1;
    if (t[i] == '\r') return left > 1 && t[i + 1] == '\n' ? 2 : 1;
    if (t[i] == 0xc2 && left > 1 && t[i + 1] == 0x85) return 2;
    if (t[i] == 0xe2 && left > 2 && t[i + 1] == 0x80 && (t[i + 2] & 0xfe) == 0xa8) return 3;
    return 0;
}

size_t source_character(const struct source *source, size_t i) {
    size_t n = 1;
    while (i + n < source->size && ((unsigned char)source->text[i + n] & 0xc0) == 0x80) n++;
    return n;
}

/* Where the line that begins at `i` ends. */
static size_t line_end(const struct source *source, size_t i) {
    for (; i < source->size; i++) {
        const unsigned char c = (unsigned char)source->text[i];
        if (c > '\r' && c < 0xc2) continue; /* most bytes: files are long */
        if (source_break(source, i)) break;
    }
    return i;
}

/* Where the line after one that ends at `end` begins. */
static size_t line_after(const struct source *source, size_t end) {
    return end < source->size ? end + source_break(source, end) : end;
}

size_t source_line(const struct source *source, uint32_t line, size_t *end) {
    size_t i = 0;
    for (; line > 0 && i < source->size; line--) i = line_after(source, line_end(source, i));
    *end = line_end(source, i);
    return i;
}

size_t source_offset(struct span span) {
    size_t end, i = source_line(span.source, span.line, &end);
    for (uint32_t c = 0; c < span.column && i < end; c++) i += source_character(span.source, i);
    return i;
}

/* ---- Indentation ---- */

static size_t skip_blanks(const struct source *source, size_t i, size_t end) {
    while (i < end && (source->text[i] == ' ' || source->text[i] == '\t')) i++;
    return i;
}

/* The levels of the line text[begin] .. text[end]. */
static int line_levels(const struct source *source, uint32_t line, size_t begin, size_t end,
                       struct source_level levels[SOURCE_MAX_LEVELS]) {
    int count = 0;
    size_t i = skip_blanks(source, begin, end);
    while (i < end && source->text[i] != '#' && count < SOURCE_MAX_LEVELS) {
        const bool dash = source->text[i] == '-' &&
                          (i + 1 == end || source->text[i + 1] == ' ' || source->text[i + 1] == '\t');
        levels[count++] = (struct source_level){line, (uint32_t)(i - begin), dash};
        if (!dash) break;
        i = skip_blanks(source, i + 1, end);
    }
    return count;
}

int source_line_levels(const struct source *source, uint32_t line,
                       struct source_level levels[SOURCE_MAX_LEVELS]) {
    size_t end, begin = source_line(source, line, &end);
    return line_levels(source, line, begin, end, levels);
}

/* A dash may stand in the column of the key that its list belongs to. */
static bool ends_level(struct source_level open, struct source_level next) {
    return open.column > next.column || (open.column == next.column && (open.dash || !next.dash));
}

int source_open_levels(const struct source *source, uint32_t line,
                       struct source_level levels[SOURCE_MAX_LEVELS]) {
    int count = 0;
    size_t begin = 0;
    for (uint32_t n = 0; n < line && begin < source->size; n++) {
        struct source_level here[SOURCE_MAX_LEVELS];
        const size_t end = line_end(source, begin);
        const int found = line_levels(source, n, begin, end, here);
        for (int i = 0; i < found; i++) {
            while (count > 0 && ends_level(levels[count - 1], here[i])) count--;
            if (count < SOURCE_MAX_LEVELS) levels[count++] = here[i];
        }
        begin = line_after(source, end);
    }
    return count;
}
