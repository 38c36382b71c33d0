/* From libyaml's marks, which count characters, to offsets in bytes. */
#ifndef MONGE_LANG_CURSOR_H
#define MONGE_LANG_CURSOR_H

#include <stddef.h>

#include "base/source.h"

/* A place in a text that moves by characters: marks come nearly in order, so it never goes far. */
struct cursor {
    const struct source *source;
    size_t index, offset; /* the same place, in characters and in bytes */
};

static inline bool cursor_continues(const struct cursor *c, size_t offset) {
    return offset < c->source->size && ((unsigned char)c->source->text[offset] & 0xc0) == 0x80;
}

/* The offset of the character `index`; at most the size of the text. */
static inline size_t cursor_move(struct cursor *c, size_t index) {
    for (; c->index < index && c->offset < c->source->size; c->index++) do
            c->offset++;
        while (cursor_continues(c, c->offset));
    for (; c->index > index; c->index--) do
            c->offset--;
        while (cursor_continues(c, c->offset));
    return c->offset;
}

#endif
