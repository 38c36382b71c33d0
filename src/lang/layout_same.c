/* Whether a text still says what another says: the net under layout_print. */
#include <string.h>
#include <yaml.h>

#include "lang/layout.h"

/* ---- Events ---- */

static bool same_word(const yaml_char_t *a, const yaml_char_t *b) {
    return a && b ? strcmp((const char *)a, (const char *)b) == 0 : !a && !b;
}

static bool same_scalar(const yaml_event_t *a, const yaml_event_t *b) {
    const bool plain_a = a->data.scalar.style == YAML_PLAIN_SCALAR_STYLE,
               plain_b = b->data.scalar.style == YAML_PLAIN_SCALAR_STYLE;
    return same_word(a->data.scalar.anchor, b->data.scalar.anchor) &&
           same_word(a->data.scalar.tag, b->data.scalar.tag) && plain_a == plain_b &&
           a->data.scalar.length == b->data.scalar.length &&
           memcmp(a->data.scalar.value, b->data.scalar.value, a->data.scalar.length) == 0;
}

static bool same_event(const yaml_event_t *a, const yaml_event_t *b) {
    if (a->type != b->type) return false;
    switch (a->type) {
    case YAML_SCALAR_EVENT: return same_scalar(a, b);
    case YAML_ALIAS_EVENT: return same_word(a->data.alias.anchor, b->data.alias.anchor);
    case YAML_SEQUENCE_START_EVENT:
        return same_word(a->data.sequence_start.anchor, b->data.sequence_start.anchor) &&
               same_word(a->data.sequence_start.tag, b->data.sequence_start.tag);
    case YAML_MAPPING_START_EVENT:
        return same_word(a->data.mapping_start.anchor, b->data.mapping_start.anchor) &&
               same_word(a->data.mapping_start.tag, b->data.mapping_start.tag);
    default: return true;
    }
}

/* One step of both; *more: there are further ones. */
static bool same_step(yaml_parser_t *a, yaml_parser_t *b, bool *more) {
    yaml_event_t of_a = {0}, of_b = {0};
    const bool good = yaml_parser_parse(a, &of_a) && yaml_parser_parse(b, &of_b) && same_event(&of_a, &of_b);
    *more = good && of_a.type != YAML_STREAM_END_EVENT && of_a.type != YAML_NO_EVENT;
    yaml_event_delete(&of_a);
    yaml_event_delete(&of_b);
    return good;
}

static bool begin_parser(yaml_parser_t *parser, const struct source *source) {
    if (!yaml_parser_initialize(parser)) return false;
    yaml_parser_set_input_string(parser, (const unsigned char *)source->text, source->size);
    yaml_parser_set_encoding(parser, YAML_UTF8_ENCODING);
    return true;
}

bool layout_same_events(struct arena *arena, const struct source *a, const struct source *b) {
    yaml_parser_t of_a = {0}, of_b = {0};
    bool good = begin_parser(&of_a, a) && begin_parser(&of_b, b), more = good;
    while (more) good = same_step(&of_a, &of_b, &more);
    const bool is_full = of_a.error == YAML_MEMORY_ERROR || of_b.error == YAML_MEMORY_ERROR;
    yaml_parser_delete(&of_a);
    yaml_parser_delete(&of_b);
    if (is_full) longjmp(*arena->on_full, 1);
    return good;
}

/* ---- Comments ---- */

bool layout_same_comments(struct arena *arena, const struct source *a, const struct source *b) {
    struct layout_marks of_a, of_b;
    layout_scan(arena, a, &of_a);
    layout_scan(arena, b, &of_b);
    const struct layout_comment *c = of_a.comments, *d = of_b.comments;
    for (; c && d; c = c->next, d = d->next)
        if (c->size != d->size || memcmp(c->text, d->text, c->size) != 0) return false;
    return !c && !d;
}
