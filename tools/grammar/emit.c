#include "emit.h"

#include <ctype.h>
#include <string.h>

static void new_line(struct emitter *j) {
    if (j->depth > 0 && j->depth <= j->lines) fprintf(j->out, "\n%*s", 2 * j->depth, "");
}

/* Before an item; a key and its value are one. */
static void begin_item(struct emitter *j) {
    if (!j->keyed) {
        if (j->follows) fputs(j->depth <= j->lines ? "," : ", ", j->out);
        new_line(j);
    }
    j->keyed = false;
    j->follows = true;
}

static void quote(struct emitter *j, const char *text) {
    fputc('"', j->out);
    for (; *text; text++) {
        if (*text == '"' || *text == '\\') fputc('\\', j->out);
        if (*text == '\n')
            fputs("\\n", j->out);
        else
            fputc(*text, j->out);
    }
    fputc('"', j->out);
}

void emit_open(struct emitter *j, char bracket) {
    begin_item(j);
    fputc(bracket, j->out);
    j->depth++;
    j->follows = false;
}

void emit_close(struct emitter *j, char bracket) {
    const bool empty = !j->follows;
    j->depth--;
    if (!empty && j->depth < j->lines) fprintf(j->out, "\n%*s", 2 * j->depth, "");
    fputc(bracket, j->out);
    j->follows = true;
}

void emit_key(struct emitter *j, const char *key) {
    begin_item(j);
    quote(j, key);
    fputs(": ", j->out);
    j->keyed = true;
}

void emit_text(struct emitter *j, const char *text) {
    begin_item(j);
    quote(j, text);
}

void emit_raw(struct emitter *j, const char *json) {
    begin_item(j);
    fputs(json, j->out);
}

/* Whether JSON writes the scalar as YAML does: a number, true or false. */
static bool is_plain(const struct node *node) {
    const char *digits = node->text + (*node->text == '-');
    if (node->quoted) return false;
    return strcmp(node->text, "true") == 0 || strcmp(node->text, "false") == 0 ||
           (isdigit((unsigned char)*digits) && !digits[strspn(digits, "0123456789.")]);
}

void emit_node(struct emitter *j, const struct node *node) {
    node = node_resolve(node);
    if (node->kind == NODE_SCALAR) {
        (is_plain(node) ? emit_raw : emit_text)(j, node->text);
        return;
    }
    const bool mapping = node->kind == NODE_MAPPING;
    emit_open(j, mapping ? '{' : '[');
    for (const struct node *item = node->first; item; item = item->next) {
        if (mapping) {
            emit_key(j, node_resolve(item)->text);
            item = item->next;
        }
        emit_node(j, item);
    }
    emit_close(j, mapping ? '}' : ']');
}

void emit_pair(struct emitter *j, const char *key, const char *text) {
    emit_key(j, key);
    emit_text(j, text);
}

void emit_field(struct emitter *j, const char *key, const char *json) {
    emit_key(j, key);
    emit_raw(j, json);
}
