#include "base/json.h"

#include <string.h>

#include "base/utf8.h"

void json_escape(const char *text, size_t size, FILE *out) {
    for (size_t bytes; size > 0; text += bytes, size -= bytes) {
        const uint32_t code = utf8_decode(text, size, &bytes);
        if (code == UINT32_MAX)
            fputs("\\ufffd", out);
        else if (code == '"' || code == '\\')
            fprintf(out, "\\%c", (int)code);
        else if (code == '\n')
            fputs("\\n", out);
        else if (code < 0x20 || code == 0x7f)
            fprintf(out, "\\u%04x", (unsigned)code);
        else
            fwrite(text, 1, bytes, out);
    }
}

void json_string(const char *text, FILE *out) {
    fputc('"', out);
    json_escape(text, strlen(text), out);
    fputc('"', out);
}

static void start_line(const struct json *json) { fprintf(json->out, "\n%*s", 2 * json->depth, ""); }

void json_key(struct json *json, const char *key) {
    if (json->started) fputc(',', json->out);
    if (json->depth > 0) start_line(json);
    json->started = true;
    if (!key) return;
    json_string(key, json->out);
    fputs(": ", json->out);
}

void json_open(struct json *json, const char *key, char bracket) {
    json_key(json, key);
    fputc(bracket, json->out);
    json->depth++;
    json->started = false;
}

void json_close(struct json *json, char bracket) {
    json->depth--;
    if (json->started) start_line(json);
    fputc(bracket, json->out);
    json->started = true;
    if (json->depth == 0) fputc('\n', json->out);
}

void json_text(struct json *json, const char *key, const char *text) {
    json_key(json, key);
    if (text)
        json_string(text, json->out);
    else
        fputs("null", json->out);
}

void json_number(struct json *json, const char *key, unsigned number) {
    json_key(json, key);
    fprintf(json->out, "%u", number);
}

void json_word(struct json *json, const char *key, const char *word) {
    json_key(json, key);
    fputs(word, json->out);
}
