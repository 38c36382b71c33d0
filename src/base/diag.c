#include "base/diag.h"

#include <stdarg.h>
#include <string.h>

#include "base/utf8.h"

enum {
    EXCERPT_WIDTH = 100, /* characters of a line that are shown */
    EXCERPT_LEAD = 60,   /* of these, at most so many before the caret */
};

/* ---- Safe text ---- */

/* Whether a terminal shows the character in a column of its own: no control, no line break, nothing
 * that turns the direction of writing. */
static bool is_plain(uint32_t code) {
    if (code < 0x20 || (code >= 0x7f && code < 0xa0)) return false;
    if (code >= 0x200b && code <= 0x200f) return false;
    if ((code >= 0x2028 && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069)) return false;
    return code != 0xfeff && code != UINT32_MAX;
}

/* Copies a text, each character that is not plain as `?` (a tab as a space); returns its end. A run of
 * continuation bytes counts as part of the character before. `to` may be `from`: nothing gets longer. */
static char *copy_safe(char *to, const char *from, size_t size) {
    for (size_t i = 0; i < size;) {
        size_t bytes;
        const bool plain = is_plain(utf8_decode(from + i, size - i, &bytes));
        if (!plain)
            *to++ = from[i] == '\t' ? ' ' : '?';
        else
            to = (char *)memmove(to, from + i, bytes) + bytes;
        for (i += bytes; i < size && ((unsigned char)from[i] & 0xc0) == 0x80;) i++;
    }
    return to;
}

/* ---- Places ---- */

/* Fills excerpt, caret and length of the place: the part of the line about the span. */
static void place_excerpt(struct arena *arena, struct span span, struct place *place) {
    size_t end;
    size_t at = source_line(span.source, span.line, &end);
    if (at >= end && span.column > 0) return;
    const uint32_t skip = span.column > EXCERPT_LEAD ? span.column - EXCERPT_LEAD : 0;
    for (uint32_t i = 0; i < skip && at < end; i++) at += source_character(span.source, at);

    const size_t begin = at;
    uint32_t shown = 0;
    for (; at < end && shown < EXCERPT_WIDTH; shown++) at += source_character(span.source, at);
    char *text = arena_alloc(arena, at - begin + 7), *to = text;
    if (skip) to = (char *)memcpy(to, "...", 3) + 3;
    to = copy_safe(to, span.source->text + begin, at - begin);
    if (at < end) memcpy(to, "...", 3);
    place->excerpt = text;
    place->caret = span.column - skip + (skip ? 3 : 0);
    const uint32_t room = shown > span.column - skip ? shown - (span.column - skip) : 1;
    if (place->length > room) place->length = room;
}

static struct place make_place(struct diagnostics *diag, struct span span) {
    if (!span.source) return (struct place){0};
    struct place place = {.line = span.line + 1, .column = span.column + 1, .extent = span.length};
    place.length = span.length ? span.length : 1;
    char *name = arena_text(&diag->arena, span.source->name, strlen(span.source->name));
    *copy_safe(name, name, strlen(name)) = '\0';
    place.file = name;
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

/* Of what a loop or a template says again with other numbers, the first time is enough. */
static bool is_said(const struct diagnostic *before, const struct diagnostic *d) {
    return strcmp(before->message, d->message) == 0 || (d->framed && strcmp(before->code, d->code) == 0);
}

/* The same, told of the same scene before; NULL: none. */
static struct diagnostic *find_same(const struct diagnostics *diag, const struct diagnostic *d) {
    for (struct diagnostic *e = diag->first; e; e = e->next)
        if (e->load >= diag->scene && e->severity == d->severity && same_file(&e->place, &d->place) &&
            e->place.line == d->place.line && e->place.column == d->place.column && is_said(e, d))
            return e;
    return NULL;
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
    *copy_safe(text, text, (size_t)length) = '\0';
    return text;
}

void diag_begin(struct diagnostics *diag) {
    diag->scene = ++diag->load;
    diag->before = diag->kept;
}

void diag_begin_again(struct diagnostics *diag) { diag->load++; }

bool diag_full(const struct diagnostics *diag) { return diag->kept - diag->before >= DIAG_MAX_KEPT; }

static void count(struct diagnostics *diag, enum severity severity) {
    switch (severity) {
    case SEVERITY_ERROR: diag->errors++; break;
    case SEVERITY_WARNING: diag->warnings++; break;
    case SEVERITY_FAILURE: diag->failures++; break;
    }
}

static void append_related(struct diagnostics *diag, struct diagnostic *d, struct span span,
                           const char *text) {
    struct related *related = arena_alloc(&diag->arena, sizeof *related);
    related->place = make_place(diag, span);
    related->text = text;
    struct related **at = &d->related;
    while (*at) at = &(*at)->next;
    *at = related;
}

/* What is under way, from the inside: a few of a long chain are enough. */
static void add_frames(struct diagnostics *diag, struct diagnostic *d) {
    enum { SHOWN = 6 };
    int i = 0;
    for (const struct diag_frame *frame = diag->frame; frame && i < SHOWN; frame = frame->outer, i++) {
        const char *told = frame->text(&diag->arena, frame);
        char *text = arena_text(&diag->arena, told, strlen(told));
        *copy_safe(text, text, strlen(text)) = '\0';
        append_related(diag, d, frame->span, text);
    }
}

/* Past the kept ones nothing is copied: a file of a million mistakes is no burden. */
static struct diagnostic *add(struct diagnostics *diag, enum severity severity, struct span span,
                              const char *code, const char *format, va_list args) {
    if (diag_full(diag) && severity != SEVERITY_FAILURE) {
        count(diag, severity);
        return &diag->beyond;
    }
    struct diagnostic *d = arena_alloc(&diag->arena, sizeof *d);
    d->severity = severity;
    d->code = code;
    d->load = diag->load;
    d->framed = diag->frame != NULL;
    d->message = format_text(&diag->arena, format, args);
    d->place = make_place(diag, span);
    struct diagnostic *same = find_same(diag, d);
    if (same && same->load == diag->load) return d;
    count(diag, severity);
    if (same) {
        same->load = diag->load;
        same->taken = false;
        diag->repeated++;
        return d;
    }
    diag->kept++;
    insert(diag, d);
    add_frames(diag, d);
    return d;
}

/* ---- From list to list ---- */

static const char *copy_text(struct arena *arena, const char *text) {
    return text ? arena_text(arena, text, strlen(text)) : NULL;
}

static struct place copy_place(struct arena *arena, const struct place *place) {
    struct place copy = *place;
    copy.file = copy_text(arena, place->file);
    copy.excerpt = copy_text(arena, place->excerpt);
    return copy;
}

static struct diagnostic *copy_diagnostic(struct arena *arena, const struct diagnostic *d) {
    struct diagnostic *copy = arena_alloc(arena, sizeof *copy);
    struct related **at = &copy->related;
    *copy = *d;
    copy->place = copy_place(arena, &d->place);
    copy->message = copy_text(arena, d->message);
    copy->help = copy_text(arena, d->help);
    copy->note = copy_text(arena, d->note);
    for (const struct related *r = d->related; r; r = r->next, at = &(*at)->next) {
        *at = arena_alloc(arena, sizeof **at);
        **at = (struct related){copy_place(arena, &r->place), copy_text(arena, r->text), NULL};
    }
    return copy;
}

static void append(struct diagnostics *diag, const struct diagnostic *d) {
    struct diagnostic *same = find_same(diag, d);
    if (same) {
        same->load = diag->load;
        diag->repeated++;
    } else if (!diag_full(diag) || d->severity == SEVERITY_FAILURE) {
        struct diagnostic *copy = copy_diagnostic(&diag->arena, d);
        copy->load = diag->load;
        diag->kept++;
        insert(diag, copy);
    }
}

void diag_append(struct diagnostics *diag, const struct diagnostics *from, bool again) {
    if (again)
        diag_begin_again(diag);
    else
        diag_begin(diag);
    diag->errors += from->errors;
    diag->warnings += from->warnings;
    diag->failures += from->failures;
    diag->repeated += from->repeated;
    for (const struct diagnostic *d = from->first; d; d = d->next) append(diag, d);
}

/* ---- Making them ---- */

struct diagnostic *diag_error(struct diagnostics *diag, struct span span, const char *code,
                              const char *format, ...) {
    va_list args;
    va_start(args, format);
    struct diagnostic *d = add(diag, SEVERITY_ERROR, span, code, format, args);
    va_end(args);
    return d;
}

struct diagnostic *diag_warning(struct diagnostics *diag, struct span span, const char *code,
                                const char *format, ...) {
    va_list args;
    va_start(args, format);
    struct diagnostic *d = add(diag, SEVERITY_WARNING, span, code, format, args);
    va_end(args);
    return d;
}

struct diagnostic *diag_failure(struct diagnostics *diag, const char *code, const char *format, ...) {
    va_list args;
    va_start(args, format);
    struct diagnostic *d = add(diag, SEVERITY_FAILURE, (struct span){0}, code, format, args);
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
    append_related(diag, d, span, format_text(&diag->arena, format, args));
    va_end(args);
}

const struct diagnostic *diag_take(struct diagnostics *diag) {
    const struct diagnostic *first = NULL;
    for (struct diagnostic *d = diag->first; d; d = d->next) {
        if (!first && !d->taken && d->severity != SEVERITY_WARNING) first = d;
        d->taken = true;
    }
    return first;
}

/* ---- Printing ---- */

enum { GUTTER = 5 };

static void print_place(const struct place *place, const char *help, FILE *out) {
    if (!place->excerpt) {
        if (help) fprintf(out, "%*s = %s\n", GUTTER, "", help);
        return;
    }
    fprintf(out, "%*u | %s\n%*s | %*s^", GUTTER, (unsigned)place->line, place->excerpt, GUTTER, "",
            (int)place->caret, "");
    for (uint32_t i = 1; i < place->length; i++) fputc('~', out);
    fprintf(out, help ? " %s\n" : "\n", help);
}

static void print_head(const struct place *place, const char *word, const char *code, const char *message,
                       FILE *out) {
    if (place->file)
        fprintf(out, "%s:%u:%u: ", place->file, (unsigned)place->line, (unsigned)place->column);
    else
        fputs("monge: ", out);
    fputs(word, out);
    if (code) fprintf(out, "[%s]", code);
    fprintf(out, ": %s\n", message);
}

static void print_one(const struct diagnostic *d, FILE *out) {
    print_head(&d->place, d->severity == SEVERITY_WARNING ? "warning" : "error", d->code, d->message, out);
    print_place(&d->place, d->help, out);
    if (d->note) fprintf(out, "%*s = %s\n", GUTTER, "", d->note);
    for (const struct related *r = d->related; r; r = r->next) {
        print_head(&r->place, "note", NULL, r->text, out);
        print_place(&r->place, NULL, out);
    }
}

bool diag_more(const struct diagnostics *diag, char text[DIAG_MORE_SIZE]) {
    const unsigned all = diag->errors + diag->warnings + diag->failures - diag->repeated;
    if (all > diag->kept) snprintf(text, DIAG_MORE_SIZE, "and %u more", all - diag->kept);
    return all > diag->kept;
}

void diag_print(const struct diagnostics *diag, FILE *out) {
    for (const struct diagnostic *d = diag->first; d; d = d->next) print_one(d, out);
    char more[DIAG_MORE_SIZE];
    if (diag_more(diag, more)) fprintf(out, "... %s\n", more);
}

void diag_print_new(struct diagnostics *diag, FILE *out) {
    char more[DIAG_MORE_SIZE];
    bool any = false;
    for (struct diagnostic *d = diag->first; d; d = d->next) {
        if (!d->printed) print_one(d, out);
        any |= !d->printed;
        d->printed = true;
    }
    if (any && diag_more(diag, more)) fprintf(out, "... %s\n", more);
}

void diag_free(struct diagnostics *diag) {
    arena_free(&diag->arena);
    *diag = (struct diagnostics){0};
}
