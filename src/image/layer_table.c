#include "image/layer_table.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/json.h"

/* ---- Writing ---- */

static void write_text(FILE *out, const char *key, const char *text) {
    fprintf(out, ", \"%s\": ", key);
    if (text)
        json_string(text, out);
    else
        fputs("null", out);
}

char *layer_table_text(const struct layer_entries *entries) {
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (!out) return NULL;
    fputc('[', out);
    for (uint32_t i = 0; i < entries->count; i++) {
        const struct monge_entry *e = &entries->list[i];
        fprintf(out, "%s\n  {\"id\": %u", i ? "," : "", e->id);
        write_text(out, "name", e->name);
        write_text(out, "kind", e->kind);
        write_text(out, "file", e->file);
        fprintf(out, ", \"line\": %u, \"column\": %u}", e->line, e->column);
    }
    fputs("\n]\n", out);
    const bool good = !ferror(out);
    if (fclose(out) == 0 && good) return text;
    free(text);
    return NULL;
}

/* ---- Reading ---- */

/* What is left of the text. Each reader below takes what it is called for, and white space behind; false: it is not
 * there. */
struct scan {
    const char *at;
    struct arena *arena;
};

static bool take(struct scan *s, const char *word) {
    const size_t length = strlen(word);
    if (strncmp(s->at, word, length) != 0) return false;
    s->at += length;
    s->at += strspn(s->at, " \t\r\n");
    return true;
}

static bool read_number(struct scan *s, uint32_t *number) {
    uint64_t value = 0;
    const char *begin = s->at;
    for (; *s->at >= '0' && *s->at <= '9' && value <= UINT32_MAX; s->at++)
        value = value * 10 + (uint64_t)(*s->at - '0');
    *number = (uint32_t)value;
    return s->at > begin && value <= UINT32_MAX && take(s, "");
}

/* A code point below 0x10000 as UTF-8; halves of a pair become U+FFFD. Returns what follows it. */
static char *put_code(char *to, unsigned code) {
    if (code >= 0xd800 && code < 0xe000) code = 0xfffd;
    if (code < 0x80) {
        *to++ = (char)code;
    } else if (code < 0x800) {
        *to++ = (char)(0xc0 | code >> 6);
        *to++ = (char)(0x80 | (code & 0x3f));
    } else {
        *to++ = (char)(0xe0 | code >> 12);
        *to++ = (char)(0x80 | (code >> 6 & 0x3f));
        *to++ = (char)(0x80 | (code & 0x3f));
    }
    return to;
}

/* What follows a backslash. */
static bool read_escape(struct scan *s, char **to) {
    static const char *const escapes = "\"\"\\\\//b\bf\fn\nr\rt\t";
    unsigned code;
    for (const char *e = escapes; *e; e += 2)
        if (*e == *s->at) {
            *(*to)++ = e[1];
            s->at++;
            return true;
        }
    if (*s->at != 'u' || strspn(s->at + 1, "0123456789abcdefABCDEF") < 4 ||
        sscanf(s->at + 1, "%4x", &code) != 1 || code == 0)
        return false;
    *to = put_code(*to, code);
    s->at += 5;
    return true;
}

/* A text or null. */
static bool read_text(struct scan *s, const char **text) {
    *text = NULL;
    if (take(s, "null")) return true;
    const char *end = s->at;
    if (*end++ != '"') return false;
    for (; *end && *end != '"'; end++)
        if (*end == '\\' && end[1]) end++;
    char *result = arena_alloc(s->arena, (size_t)(end - s->at) + 1), *to = result;
    for (s->at++; *s->at && *s->at != '"';) {
        if (*s->at != '\\')
            *to++ = *s->at++;
        else if (s->at++, !read_escape(s, &to))
            return false;
    }
    *text = result;
    return take(s, "\"");
}

static bool read_member(struct scan *s, struct monge_entry *entry) {
    const char *key, *text;
    uint32_t number;
    if (*s->at != '"' || !read_text(s, &key) || !take(s, ":")) return false;
    if (strcmp(key, "id") == 0) return read_number(s, &entry->id);
    if (strcmp(key, "line") == 0) return read_number(s, &entry->line);
    if (strcmp(key, "column") == 0) return read_number(s, &entry->column);
    if (strcmp(key, "name") == 0) return read_text(s, &entry->name);
    if (strcmp(key, "kind") == 0) return read_text(s, &entry->kind);
    if (strcmp(key, "file") == 0) return read_text(s, &entry->file);
    return read_number(s, &number) || read_text(s, &text);
}

static bool read_entry(struct scan *s, struct monge_entry *entry) {
    *entry = (struct monge_entry){.id = 0};
    if (!take(s, "{")) return false;
    do
        if (!read_member(s, entry)) return false;
    while (take(s, ","));
    return entry->kind && take(s, "}");
}

bool layer_table_read(const char *text, struct arena *arena, struct layer_entries *entries) {
    struct scan s = {.at = text, .arena = arena};
    uint32_t room = 0;
    *entries = (struct layer_entries){.list = NULL};
    if (!take(&s, "") || !take(&s, "[")) return false;
    if (take(&s, "]")) return !*s.at;
    do {
        if (entries->count == room) {
            const size_t before = room * sizeof *entries->list;
            room = room ? 2 * room : 16;
            entries->list = arena_resize(arena, entries->list, before, room * sizeof *entries->list);
        }
        struct monge_entry *entry = &entries->list[entries->count++];
        if (!read_entry(&s, entry) || entry->id <= entries->highest) return false;
        entries->highest = entry->id;
    } while (take(&s, ","));
    return take(&s, "]") && !*s.at;
}
