/* The results of a run as JUnit's XML, which most servers of continuous integration show. */
#include <stdlib.h>
#include <string.h>

#include "cli/golden/tell.h"
#include "cli/say.h"

/* The bytes of the character, 0: it is no UTF-8, or none that XML may have. */
static size_t character(const unsigned char *c) {
    static const struct {
        unsigned char first, mask;
        uint32_t least;
    } forms[] = {{0x00, 0x80, 0}, {0xc0, 0xe0, 0x80}, {0xe0, 0xf0, 0x800}, {0xf0, 0xf8, 0x10000}};
    for (size_t n = 0; n < 4; n++) {
        if ((c[0] & forms[n].mask) != forms[n].first) continue;
        uint32_t code = c[0] & (unsigned char)~forms[n].mask;
        for (size_t i = 1; i <= n; i++) {
            if ((c[i] & 0xc0) != 0x80) return 0;
            code = code << 6 | (c[i] & 0x3f);
        }
        const bool control = (code < 0x20 && code != '\n' && code != '\t') || code == 0x7f;
        const bool none = code < forms[n].least || (code >= 0xd800 && code < 0xe000) || code > 0x10ffff ||
                          code == 0xfffe || code == 0xffff;
        return control || none ? 0 : n + 1;
    }
    return 0;
}

static void put_text(FILE *out, const char *text) {
    for (const char *c = text; *c;) {
        const size_t length = character((const unsigned char *)c);
        switch (*c) {
        case '&': fputs("&amp;", out); break;
        case '<': fputs("&lt;", out); break;
        case '>': fputs("&gt;", out); break;
        case '"': fputs("&quot;", out); break;
        case '\n': fputs("&#10;", out); break;
        default:
            if (length == 0) fputs("\xef\xbf\xbd", out);
            fwrite(c, 1, length, out);
        }
        c += length ? length : 1;
    }
}

static void put_attribute(FILE *out, const char *name, const char *text) {
    fprintf(out, " %s=\"", name);
    put_text(out, text);
    putc('"', out);
}

static void put_failure(FILE *out, const struct golden_case *c) {
    const char *element = c->status == GOLDEN_BROKEN ? "error" : "failure";
    char *message = golden_headline(c), *lines = golden_details(c);
    fprintf(out, "      <%s type=\"%s\"", element, GOLDEN_STATUS[c->status]);
    put_attribute(out, "message", *message ? message : GOLDEN_STATUS[c->status]);
    fputs(">", out);
    put_text(out, lines);
    fprintf(out, "</%s>\n", element);
    free(lines);
    free(message);
}

/* A picture that is the same but for a tolerance, or is the golden now, passes and says so. */
static void put_pass(FILE *out, const struct golden_case *c) {
    char *text = c->taken ? say_text("%s, and %s", GOLDEN_STATUS[c->status], GOLDEN_TAKEN) : golden_detail(c);
    fputs("      <system-out>", out);
    put_text(out, text ? text : "");
    fputs("</system-out>\n", out);
    free(text);
}

static bool has_failed(const struct golden_case *c) { return c->status != GOLDEN_SAME && !c->taken; }

/* The folder of the scene is its class. */
static void put_case(FILE *out, const struct golden_case *c) {
    const bool empty = !has_failed(c) && !c->unchanged && !c->within && !c->taken;
    const char *slash = strrchr(c->name, '/');
    char *folder = slash ? say_text("%.*s", (int)(slash - c->name), c->name) : say_text("scenes");
    fputs("    <testcase", out);
    put_attribute(out, "classname", folder);
    put_attribute(out, "name", slash ? slash + 1 : c->name);
    if (c->scene) put_attribute(out, "file", c->scene);
    fprintf(out, " time=\"%.3f\"%s>\n", c->seconds, empty ? "/" : "");
    if (c->unchanged) fputs("      <skipped message=\"unchanged\"/>\n", out);
    if (has_failed(c)) put_failure(out, c);
    if (c->within || c->taken) put_pass(out, c);
    if (!empty) fputs("    </testcase>\n", out);
    free(folder);
}

/* So that a run which was stopped does not look like one in which all is well. */
static void put_interruption(FILE *out, const char *interruption) {
    fputs("    <testcase classname=\"monge\" name=\"interrupted\">\n      <error", out);
    put_attribute(out, "message", interruption);
    fputs("/>\n    </testcase>\n", out);
}

char *golden_junit_text(const struct golden_results *results) {
    char *text = NULL;
    size_t size = 0, skipped = 0, failed = 0;
    char *interruption = golden_interruption(results);
    const size_t broken = golden_count(results, GOLDEN_BROKEN), more = interruption ? 1 : 0;
    FILE *out = say_text_begin(&text, &size);
    for (size_t i = 0; i < results->count; i++) {
        skipped += results->cases[i].unchanged;
        failed += has_failed(&results->cases[i]);
    }
    fputs("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n  <testsuite name=\"monge test\"", out);
    fprintf(out, " tests=\"%zu\" failures=\"%zu\" errors=\"%zu\" skipped=\"%zu\" time=\"%.3f\">\n",
            results->count + more, failed - broken, broken + more, skipped, results->seconds);
    for (size_t i = 0; i < results->count; i++) put_case(out, &results->cases[i]);
    if (interruption) put_interruption(out, interruption);
    fputs("  </testsuite>\n</testsuites>\n", out);
    say_text_end(out);
    free(interruption);
    return text;
}
