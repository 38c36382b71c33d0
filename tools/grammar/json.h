/* Writes JSON, laid out for people: the upper levels a line for each item, what is below in one line. */
#ifndef GRAMMAR_JSON_H
#define GRAMMAR_JSON_H

#include <stdio.h>

#include "lang/node.h"

struct json {
    FILE *out;
    int lines; /* levels that have a line for each item */
    int depth;
    bool follows; /* an item of the same collection was written before */
    bool keyed;   /* a key was written, its value comes next */
};

/* Collections: '{' or '[', ended by '}' or ']'. In an object each value comes after its json_key. */
void json_open(struct json *j, char bracket);
void json_close(struct json *j, char bracket);
void json_key(struct json *j, const char *key);

void json_text(struct json *j, const char *text);
void json_raw(struct json *j, const char *json);         /* a value that is JSON already */
void json_node(struct json *j, const struct node *node); /* a value of YAML */

/* A field of an object at once. */
void json_pair(struct json *j, const char *key, const char *text);
void json_field(struct json *j, const char *key, const char *json); /* a value that is JSON already */

#endif
