/* SARIF 2.1.0, the Static Analysis Results Interchange Format (OASIS, 2020). */
#include <ctype.h>
#include <string.h>

#include "base/diag_write.h"
#include "base/json.h"

/* The lines of a message string, up to a NULL. Braces are doubled, as single ones enclose placeholders (3.11.5). */
static void write_lines(struct json *json, const char *key, const char *const lines[]) {
    json_open(json, key, '{');
    json_key(json, "text");
    fputc('"', json->out);
    for (int i = 0; lines[i]; i++) {
        if (i > 0) json_escape("\n", 1, json->out);
        for (const char *at = lines[i]; *at;) {
            const size_t plain = strcspn(at, "{}");
            json_escape(at, plain, json->out);
            at += plain;
            if (*at) fprintf(json->out, "%c%c", *at, *at);
            at += *at != '\0';
        }
    }
    fputc('"', json->out);
    json_close(json, '}');
}

static void write_message(struct json *json, const char *key, const char *text) {
    write_lines(json, key, (const char *const[]){text, NULL});
}

/* ---- Rules ---- */

static bool is_failure(const struct diagnostic *d) { return d->severity == SEVERITY_FAILURE; }

static bool occurs(const struct diagnostics *diag, bool as_failure, const char *code) {
    for (const struct diagnostic *d = diag->first; d; d = d->next)
        if (is_failure(d) == as_failure && strcmp(d->code, code) == 0) return true;
    return false;
}

static void write_rules(struct json *json, const char *key, const struct diagnostics *diag, bool of_failures,
                        struct diag_stories stories) {
    json_open(json, key, '[');
    for (const struct diag_story *story = stories.first; story < stories.first + stories.count; story++) {
        if (!occurs(diag, of_failures, story->code)) continue;
        json_open(json, NULL, '{');
        json_text(json, "id", story->code);
        write_message(json, "shortDescription", story->summary);
        write_message(json, "fullDescription", story->text);
        json_close(json, '}');
    }
    json_close(json, ']');
}

static void write_tool(struct json *json, const struct diagnostics *diag, struct diag_stories stories,
                       const char *version) {
    json_open(json, "tool", '{');
    json_open(json, "driver", '{');
    json_text(json, "name", "monge");
    json_text(json, "version", version);
    write_rules(json, "rules", diag, false, stories);
    write_rules(json, "notifications", diag, true, stories);
    json_close(json, '}');
    json_close(json, '}');
}

/* ---- Results ---- */

/* A path as a relative or absolute reference of RFC 3986. */
static void write_uri(struct json *json, const char *path) {
    json_key(json, "uri");
    fputs(*path == '/' ? "\"file://" : "\"", json->out);
    for (const unsigned char *p = (const unsigned char *)path; *p; p++) {
        if (*p < 0x80 && (isalnum(*p) || strchr("-._~/", *p)))
            fputc(*p, json->out);
        else
            fprintf(json->out, "%%%02X", *p);
    }
    fputc('"', json->out);
}

static void write_location(struct json *json, const struct place *place, const char *text) {
    json_open(json, NULL, '{');
    json_open(json, "physicalLocation", '{');
    json_open(json, "artifactLocation", '{');
    write_uri(json, place->file);
    json_close(json, '}');
    json_open(json, "region", '{');
    json_number(json, "startLine", place->line);
    json_number(json, "startColumn", place->column);
    json_number(json, "endLine", place->line);
    json_number(json, "endColumn", place->column + place->extent);
    json_close(json, '}');
    json_close(json, '}');
    if (text) write_message(json, "message", text);
    json_close(json, '}');
}

static void write_related(struct json *json, const struct related *first) {
    if (!first) return;
    json_open(json, "relatedLocations", '[');
    for (const struct related *r = first; r; r = r->next)
        if (r->place.file) write_location(json, &r->place, r->text);
    json_close(json, ']');
}

/* The message, then its help and its note. */
static void write_texts(struct json *json, const struct diagnostic *d) {
    const char *lines[4] = {d->message};
    int count = 1;
    if (d->help) lines[count++] = d->help;
    if (d->note) lines[count++] = d->note;
    write_lines(json, "message", lines);
}

static void write_result(struct json *json, const struct diagnostic *d) {
    json_open(json, NULL, '{');
    json_text(json, "ruleId", d->code);
    json_text(json, "level", d->severity == SEVERITY_WARNING ? "warning" : "error");
    write_texts(json, d);
    if (d->place.file) {
        json_open(json, "locations", '[');
        write_location(json, &d->place, NULL);
        json_close(json, ']');
    }
    write_related(json, d->related);
    json_close(json, '}');
}

static void write_results(struct json *json, const struct diagnostics *diag) {
    json_open(json, "results", '[');
    for (const struct diagnostic *d = diag->first; d; d = d->next)
        if (!is_failure(d)) write_result(json, d);
    json_close(json, ']');
}

/* ---- The invocation ---- */

static void write_notification(struct json *json, const char *code, const char *level, const char *text) {
    json_open(json, NULL, '{');
    if (code) {
        json_open(json, "descriptor", '{');
        json_text(json, "id", code);
        json_close(json, '}');
    }
    json_text(json, "level", level);
    write_message(json, "message", text);
    json_close(json, '}');
}

static void write_invocation(struct json *json, const struct diagnostics *diag) {
    char more[DIAG_MORE_SIZE];
    json_open(json, "invocations", '[');
    json_open(json, NULL, '{');
    json_word(json, "executionSuccessful", diag->failures ? "false" : "true");
    json_open(json, "toolExecutionNotifications", '[');
    for (const struct diagnostic *d = diag->first; d; d = d->next)
        if (is_failure(d)) write_notification(json, d->code, "error", d->message);
    if (diag_more(diag, more)) write_notification(json, NULL, "note", more);
    json_close(json, ']');
    json_close(json, '}');
    json_close(json, ']');
}

void diag_write_sarif(const struct diagnostics *diag, struct diag_stories stories, const char *version,
                      FILE *out) {
    struct json json = {.out = out};
    json_open(&json, NULL, '{');
    json_text(&json, "$schema",
              "https://docs.oasis-open.org/sarif/sarif/v2.1.0/os/schemas/sarif-schema-2.1.0.json");
    json_text(&json, "version", "2.1.0");
    json_open(&json, "runs", '[');
    json_open(&json, NULL, '{');
    write_tool(&json, diag, stories, version);
    json_text(&json, "columnKind", "unicodeCodePoints");
    write_invocation(&json, diag);
    write_results(&json, diag);
    json_close(&json, '}');
    json_close(&json, ']');
    json_close(&json, '}');
}
