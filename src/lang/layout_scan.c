/* Comments are what libyaml's tokens leave, but for white space. */
#include <string.h>
#include <yaml.h>

#include "lang/cursor.h"
#include "lang/layout.h"

struct scanner {
    yaml_parser_t parser;
    yaml_token_t token; /* the current one */
    struct arena *arena;
    struct cursor cursor;
    struct layout_marks *marks;
    struct layout_comment **tail;
    size_t covered; /* the end of the tokens so far */
    size_t dash_room;
    bool ended; /* a `...` has been */
};

/* ---- Comments ---- */

static size_t line_start(const struct source *source, size_t at) {
    while (at > 0 && source->text[at - 1] != '\n') at--;
    return at;
}

static bool is_blank(char c) { return c == ' ' || c == '\t'; }

/* Whether the line that ends before offset `at`, the start of a line, has nothing on it. */
static bool blank_line_before(const struct source *source, size_t at) {
    if (at == 0) return false;
    size_t i = at - 1;
    while (i > 0 && is_blank(source->text[i - 1])) i--;
    return i == 0 || source->text[i - 1] == '\n';
}

static size_t add_comment(struct scanner *sc, size_t at) {
    const struct source *source = sc->cursor.source;
    const char *text = source->text + at, *feed = memchr(text, '\n', source->size - at);
    const size_t length = feed ? (size_t)(feed - text) : source->size - at, begin = line_start(source, at);
    size_t first = begin, size = length;
    while (first < at && is_blank(source->text[first])) first++;
    while (is_blank(text[size - 1])) size--;
    struct layout_comment *c = arena_alloc(sc->arena, sizeof *c);
    *c = (struct layout_comment){.text = text,
                                 .size = size,
                                 .at = at,
                                 .own_line = first == at || sc->ended,
                                 .blank_before = blank_line_before(source, begin)};
    for (size_t i = begin; i < at; i += source_character(source, i)) c->column++;
    *sc->tail = c;
    sc->tail = &c->next;
    return at + length;
}

/* Comments between the tokens so far and the offset `end`. */
static void scan_gap(struct scanner *sc, size_t end) {
    for (size_t i = sc->covered; i < end;)
        if (sc->cursor.source->text[i] == '#')
            i = add_comment(sc, i);
        else
            i++;
}

/* The comment behind | or >. */
static void scan_header(struct scanner *sc, size_t at, size_t end) {
    const char *text = sc->cursor.source->text;
    while (at < end && text[at] != '\n' && text[at] != '#') at++;
    if (at < end && text[at] == '#') add_comment(sc, at);
}

/* ---- Tokens ---- */

static void add_dash(struct scanner *sc, size_t at) {
    struct layout_marks *m = sc->marks;
    if (m->dash_count == sc->dash_room) {
        sc->dash_room = sc->dash_room ? 2 * sc->dash_room : 64;
        size_t *larger = arena_array(sc->arena, sc->dash_room, sizeof *larger);
        if (m->dash_count) memcpy(larger, m->dashes, m->dash_count * sizeof *larger);
        m->dashes = larger;
    }
    m->dashes[m->dash_count++] = at;
}

static bool is_block_scalar(const yaml_token_t *token) {
    const yaml_scalar_style_t style = token->data.scalar.style;
    return token->type == YAML_SCALAR_TOKEN &&
           (style == YAML_LITERAL_SCALAR_STYLE || style == YAML_FOLDED_SCALAR_STYLE);
}

static void take_token(struct scanner *sc) {
    const yaml_token_t *token = &sc->token;
    const size_t begin = cursor_move(&sc->cursor, token->start_mark.index),
                 end = cursor_move(&sc->cursor, token->end_mark.index);
    if (begin > sc->covered) scan_gap(sc, begin);
    if (token->type == YAML_BLOCK_ENTRY_TOKEN) add_dash(sc, begin);
    if (token->type == YAML_KEY_TOKEN && end > begin && sc->marks->odd_key == SIZE_MAX)
        sc->marks->odd_key = begin;
    if (token->type == YAML_DOCUMENT_START_TOKEN) sc->marks->start = begin, sc->marks->body = end;
    if (token->type == YAML_DOCUMENT_END_TOKEN) sc->ended = true;
    if (is_block_scalar(token)) scan_header(sc, begin, end);
    if (end > sc->covered) sc->covered = end;
}

/* What is YAML fails for lack of memory alone. */
static void scan_tokens(struct scanner *sc) {
    do {
        yaml_token_delete(&sc->token);
        if (!yaml_parser_scan(&sc->parser, &sc->token)) longjmp(*sc->arena->on_full, 1);
        take_token(sc);
    } while (sc->token.type != YAML_STREAM_END_TOKEN && sc->token.type != YAML_NO_TOKEN);
}

void layout_scan(struct arena *arena, const struct source *source, struct layout_marks *marks) {
    struct scanner sc = {
        .arena = arena, .cursor = {.source = source}, .marks = marks, .tail = &marks->comments};
    *marks = (struct layout_marks){.odd_key = SIZE_MAX, .start = SIZE_MAX};
    if (!yaml_parser_initialize(&sc.parser)) longjmp(*arena->on_full, 1);
    yaml_parser_set_input_string(&sc.parser, (const unsigned char *)source->text, source->size);
    yaml_parser_set_encoding(&sc.parser, YAML_UTF8_ENCODING);
    jmp_buf *outer = arena->on_full, full;
    const bool is_full = setjmp(full) != 0;
    if (!is_full) {
        arena->on_full = &full;
        scan_tokens(&sc);
    }
    yaml_token_delete(&sc.token);
    yaml_parser_delete(&sc.parser);
    arena->on_full = outer;
    if (is_full) longjmp(*outer, 1);
}
