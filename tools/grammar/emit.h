/* Writes JSON, laid out for people: the upper levels a line for each item, what is below in one line. */
#ifndef GRAMMAR_EMIT_H
#define GRAMMAR_EMIT_H

#include <stdio.h>

#include "lang/node.h"

struct emitter {
    FILE *out;
    int lines; /* levels that have a line for each item */
    int depth;
    bool follows; /* an item of the same collection was written before */
    bool keyed;   /* a key was written, its value comes next */
};

/* Collections: '{' or '[', ended by '}' or ']'. In an object each value comes after its emit_key. */
void emit_open(struct emitter *j, char bracket);
void emit_close(struct emitter *j, char bracket);
void emit_key(struct emitter *j, const char *key);

void emit_text(struct emitter *j, const char *text);
void emit_raw(struct emitter *j, const char *json);         /* a value that is JSON already */
void emit_node(struct emitter *j, const struct node *node); /* a value of YAML */

/* A field of an object at once. */
void emit_pair(struct emitter *j, const char *key, const char *text);
void emit_field(struct emitter *j, const char *key, const char *json); /* a value that is JSON already */

#endif
