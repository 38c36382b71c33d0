/* JSON (RFC 8259), a value on each line:
 *
 *     struct json json = {.out = out};
 *     json_open(&json, NULL, '{');                 {
 *     json_text(&json, "name", "king");              "name": "king",
 *     json_number(&json, "samples", 8);              "samples": 8
 *     json_close(&json, '}');                      }
 */
#ifndef MONGE_BASE_JSON_H
#define MONGE_BASE_JSON_H

#include <stdbool.h>
#include <stdio.h>

/* Starts as {.out = out}. */
struct json {
    FILE *out;
    int depth;    /* of what is open */
    bool started; /* whether the innermost of it has a value */
};

/* A text in quotes. It may be in any bytes: what is no UTF-8 becomes U+FFFD. */
void json_string(const char *text, FILE *out);

/* What stands between the quotes, of `size` bytes. */
void json_escape(const char *text, size_t size, FILE *out);

/* Each writes a value: of `key` within an object; in a list, or alone, key is NULL. */
void json_open(struct json *json, const char *key, char bracket);     /* '{' or '[' */
void json_text(struct json *json, const char *key, const char *text); /* NULL: null */
void json_number(struct json *json, const char *key, unsigned number);
void json_word(struct json *json, const char *key, const char *word); /* true, false or null */

/* The same for a value that the caller writes to json->out. */
void json_key(struct json *json, const char *key);

/* Closes the innermost, which `bracket` must fit; a line break ends the outermost. */
void json_close(struct json *json, char bracket);

#endif
