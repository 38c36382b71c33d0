#include "base/diag_write.h"
#include "base/json.h"

/* 0 stands for what there is not. */
static void write_number(struct json *json, const char *key, uint32_t number) {
    if (number)
        json_number(json, key, number);
    else
        json_word(json, key, "null");
}

static void write_start(struct json *json, const struct place *place) {
    json_text(json, "file", place->file);
    write_number(json, "line", place->line);
    write_number(json, "column", place->column);
}

static void write_related(struct json *json, const struct related *first) {
    json_open(json, "related", '[');
    for (const struct related *r = first; r; r = r->next) {
        json_open(json, NULL, '{');
        write_start(json, &r->place);
        json_text(json, "message", r->text);
        json_close(json, '}');
    }
    json_close(json, ']');
}

static void write_one(struct json *json, const char *severity, const struct diagnostic *d) {
    json_open(json, NULL, '{');
    write_start(json, &d->place);
    write_number(json, "endLine", d->place.line);
    write_number(json, "endColumn", d->place.column + d->place.extent);
    json_text(json, "severity", severity);
    json_text(json, "code", d->code);
    json_text(json, "message", d->message);
    json_text(json, "help", d->help);
    json_text(json, "note", d->note);
    write_related(json, d->related);
    json_close(json, '}');
}

void diag_write_json(const struct diagnostics *diag, FILE *out) {
    static const char *const words[] = {
        [SEVERITY_ERROR] = "error", [SEVERITY_WARNING] = "warning", [SEVERITY_FAILURE] = "failure"};
    struct json json = {.out = out};
    char more[DIAG_MORE_SIZE];
    json_open(&json, NULL, '[');
    for (const struct diagnostic *d = diag->first; d; d = d->next) write_one(&json, words[d->severity], d);
    if (diag_more(diag, more)) write_one(&json, "note", &(struct diagnostic){.message = more});
    json_close(&json, ']');
}
