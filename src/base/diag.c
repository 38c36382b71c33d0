#include "base/diag.h"

#include <stdarg.h>
#include <string.h>

enum {
    EXCERPT_WIDTH = 100, /* characters of a line that are shown */
    EXCERPT_LEAD = 60,   /* of these, at most so many before the caret */
};

/* ---- Places ---- */

/* The length in bytes of the line break at text[i], as YAML counts breaks; 0 for none. */
static size_t break_length(const struct source *source, size_t i) {
    const unsigned char *t = (const unsigned char *)source->text;
    const size_t left = source->size - i;
    if (t[i] == '\n') return 1;
    if (t[i] == '\r') return left > 1 && t[i + 1] == '\n' ? 2 : 1;
    if (t[i] == 0xc2 && left > 1 && t[i + 1] == 0x85) return 2;
    if (t[i] == 0xe2 && left > 2 && t[i + 1] == 0x80 && (t[i + 2] & 0xfe) == 0xa8) return 3;
    return 0;
}

/* Where the line starts, and in *end where its break or the text ends. Past the end: both at the end. */
static size_t find_line(const struct source *source, uint32_t line, size_t *end) {
    size_t i = 0;
    for (; line > 0 && i < source->size; line--) {
        size_t skip = 0;
        while (i < source->size && !(skip = break_length(source, i))) i++;
        i += skip;
    }
    for (*end = i; *end < source->size && !break_length(source, *end);) ++*end;
    return i;
}

static size_t character_bytes(const char *text, size_t left) {
    size_t n = 1;
    while (n < left && ((unsigned char)text[n] & 0xc0) == 0x80) n++;
    return n;
}

/* Appends one character, with what could act on a terminal replaced. */
static char *append_safe(char *to, const char *from, size_t bytes) {
    const unsigned char first = (unsigned char)from[0];
    const bool c1_control = bytes == 2 && first == 0xc2 && (unsigned char)from[1] < 0xa0;
    const bool not_utf8 = first >= 0x80 && (bytes == 1 || first < 0xc2 || first > 0xf4);
    if (first == '\t') *to++ = ' ';
    else if (first < 0x20 || first == 0x7f || c1_control || not_utf8) *to++ = '?';
    else {
        memcpy(to, from, bytes);
        to += bytes;
    }
    return to;
}

/* Fills excerpt, caret and length of the place: the part of the line about the span. */
static void place_excerpt(struct arena *arena, struct span span, struct place *place) {
    size_t end;
    size_t at = find_line(span.source, span.line, &end);
    if (at >= end && span.column > 0) return;
    const uint32_t skip = span.column > EXCERPT_LEAD ? span.column - EXCERPT_LEAD : 0;
    for (uint32_t i = 0; i < skip && at < end; i++) at += character_bytes(span.source->text + at, end - at);

    char *text = arena_alloc(arena, 4 * (size_t)EXCERPT_WIDTH + 8), *to = text;
    if (skip) to = memcpy(to, "...", 3), to += 3;
    uint32_t shown = 0;
    for (; at < end && shown < EXCERPT_WIDTH; shown++) {
        const size_t bytes = character_bytes(span.source->text + at, end - at);
        to = append_safe(to, span.source->text + at, bytes < 4 ? bytes : 4);
        at += bytes;
    }
    if (at < end) memcpy(to, "...", 3);
    place->excerpt = text;
    place->caret = span.column - skip + (skip ? 3 : 0);
    const uint32_t room = shown > span.column - skip ? shown - (span.column - skip) : 1;
    if (place->length > room) place->length = room;
}

static struct place make_place(struct diagnostics *diag, struct span span) {
    if (!span.source) return (struct place){0};
    struct place place = {.line = span.line + 1, .column = span.column + 1, .length = span.length ? span.length : 1};
    place.file = arena_text(&diag->arena, span.source->name, strlen(span.source->name));
    place_excerpt(&diag->arena, span, &place);
    return place;
}

/* ---- The list ---- */

static bool same_file(const struct place *a, const struct place *b) {
    return a->file && b->file && strcmp(a->file, b->file) == 0;
}

static bool place_before(const struct place *a, const struct place *b) {
    return a->line != b->line ? a->line < b->line : a->column < b->column;
}

static bool already_there(const struct diagnostics *diag, const struct diagnostic *d) {
    for (const struct diagnostic *e = diag->first; e; e = e->next)
        if (e->severity == d->severity && same_file(&e->place, &d->place) && e->place.line == d->place.line &&
            e->place.column == d->place.column && strcmp(e->message, d->message) == 0)
            return true;
    return false;
}

/* Before the first of the same file that comes later in it; else at the end. */
static void insert(struct diagnostics *diag, struct diagnostic *d) {
    struct diagnostic **at = &diag->first;
    while (*at && !(same_file(&(*at)->place, &d->place) && place_before(&d->place, &(*at)->place)))
        at = &(*at)->next;
    d->next = *at;
    *at = d;
}

static char *format_text(struct arena *arena, const char *format, va_list args) {
    va_list again;
    va_copy(again, args);
    const int length = vsnprintf(NULL, 0, format, again);
    va_end(again);
    char *text = arena_alloc(arena, (size_t)length + 1);
    vsnprintf(text, (size_t)length + 1, format, args);
    for (char *c = text; *c; c++)
        if ((unsigned char)*c < 0x20 || *c == 0x7f) *c = '?';
    return text;
}

static void count(struct diagnostics *diag, enum severity severity) {
    switch (severity) {
    case SEVERITY_ERROR: diag->errors++; break;
    case SEVERITY_WARNING: diag->warnings++; break;
    case SEVERITY_FAILURE: diag->failures++; break;
    }
}

/* Past the kept ones nothing is copied: a file of a million mistakes is no burden. */
static struct diagnostic *add(struct diagnostics *diag, enum severity severity, struct span span,
                              const char *format, va_list args) {
    if (diag->kept >= DIAG_MAX_KEPT && severity != SEVERITY_FAILURE) {
        count(diag, severity);
        return &diag->beyond;
    }
    struct diagnostic *d = arena_alloc(&diag->arena, sizeof *d);
    d->severity = severity;
    d->message = format_text(&diag->arena, format, args);
    d->place = make_place(diag, span);
    if (already_there(diag, d)) return d;
    count(diag, severity);
    diag->kept++;
    insert(diag, d);
    return d;
}

struct diagnostic *diag_error(struct diagnostics *diag, struct span span, const char *format, ...) {
    va_list args;
    va_start(args, format);
    struct diagnostic *d = add(diag, SEVERITY_ERROR, span, format, args);
    va_end(args);
    return d;
}

struct diagnostic *diag_warning(struct diagnostics *diag, struct span span, const char *format, ...) {
    va_list args;
    va_start(args, format);
    struct diagnostic *d = add(diag, SEVERITY_WARNING, span, format, args);
    va_end(args);
    return d;
}

struct diagnostic *diag_failure(struct diagnostics *diag, const char *format, ...) {
    va_list args;
    va_start(args, format);
    struct diagnostic *d = add(diag, SEVERITY_FAILURE, (struct span){0}, format, args);
    va_end(args);
    return d;
}

void diag_help(struct diagnostics *diag, struct diagnostic *d, const char *format, ...) {
    if (d == &diag->beyond) return;
    va_list args;
    va_start(args, format);
    d->help = format_text(&diag->arena, format, args);
    va_end(args);
}

void diag_note(struct diagnostics *diag, struct diagnostic *d, const char *format, ...) {
    if (d == &diag->beyond) return;
    va_list args;
    va_start(args, format);
    d->note = format_text(&diag->arena, format, args);
    va_end(args);
}

void diag_related(struct diagnostics *diag, struct diagnostic *d, struct span span, const char *format, ...) {
    if (d == &diag->beyond) return;
    va_list args;
    va_start(args, format);
    struct related *related = arena_alloc(&diag->arena, sizeof *related);
    related->place = make_place(diag, span);
    related->text = format_text(&diag->arena, format, args);
    va_end(args);
    struct related **at = &d->related;
    while (*at) at = &(*at)->next;
    *at = related;
}

/* ---- Printing ---- */

enum { GUTTER = 5 };

static void print_place(const struct place *place, const char *help, FILE *out) {
    if (!place->excerpt) {
        if (help) fprintf(out, "%*s = %s\n", GUTTER, "", help);
        return;
    }
    fprintf(out, "%*u | %s\n%*s | %*s^", GUTTER, (unsigned)place->line, place->excerpt, GUTTER, "", (int)place->caret, "");
    for (uint32_t i = 1; i < place->length; i++) fputc('~', out);
    fprintf(out, help ? " %s\n" : "\n", help);
}

static void print_head(const struct place *place, const char *word, const char *message, FILE *out) {
    if (place->file) fprintf(out, "%s:%u:%u: ", place->file, (unsigned)place->line, (unsigned)place->column);
    else fputs("monge: ", out);
    fprintf(out, "%s: %s\n", word, message);
}

static void print_one(const struct diagnostic *d, FILE *out) {
    print_head(&d->place, d->severity == SEVERITY_WARNING ? "warning" : "error", d->message, out);
    print_place(&d->place, d->help, out);
    if (d->note) fprintf(out, "%*s = %s\n", GUTTER, "", d->note);
    for (const struct related *r = d->related; r; r = r->next) {
        print_head(&r->place, "note", r->text, out);
        print_place(&r->place, NULL, out);
    }
}

void diag_print(const struct diagnostics *diag, FILE *out) {
    for (const struct diagnostic *d = diag->first; d; d = d->next) print_one(d, out);
    const unsigned all = diag->errors + diag->warnings + diag->failures;
    if (all > diag->kept) fprintf(out, "... and %u more\n", all - diag->kept);
}

void diag_free(struct diagnostics *diag) {
    arena_free(&diag->arena);
    *diag = (struct diagnostics){0};
}
