/* Events of texts: the same with a thread and without one, problems in their place, and an end at any time. */
#include <string.h>

#include "lang/events.h"
#include "near.h"

/* One line for each event, and for the problem. */
static void write_event(FILE *out, const struct event *e) {
    static const char *const kinds[] = {
        "stream", "end of stream", "document", "end of document", "alias", "scalar", "[", "]", "{", "}"};
    fprintf(out, "%s %u:%u-%u:%u", kinds[e->kind], e->from.line, e->from.column, e->to.line, e->to.column);
    if (e->anchor) fprintf(out, " &%s", e->anchor);
    if (e->tag) fprintf(out, " tag %s", e->tag);
    if (e->kind == EVENT_SCALAR) fprintf(out, " style %d", (int)e->style);
    if (e->text) fprintf(out, " %zu '", e->size);
    if (e->text) fwrite(e->text, 1, e->size + 1, out);
    fputs("\n", out);
}

static void write_problem(FILE *out, struct event_problem p) {
    fprintf(out, "problem: %s, %s", p.text, p.context);
    if (p.is_offset)
        fprintf(out, " at byte %zu\n", p.offset);
    else
        fprintf(out, " at %u:%u, %u:%u\n", p.at.line, p.at.column, p.context_at.line, p.context_at.column);
}

/* At most `most` events, in a text to be freed. */
static char *written(const char *text, size_t size, bool ahead, size_t most, size_t *length) {
    const struct source source = {"t", text, size};
    char *all = NULL;
    FILE *out = open_memstream(&all, length);
    struct events *events = events_begin(&source, ahead);
    assert_non_null(events);
    bool over = false;
    while (!over && most-- > 0) {
        const struct event *e = events_next(events);
        if (e)
            write_event(out, e);
        else
            write_problem(out, events_problem(events));
        over = !e || e->kind == EVENT_STREAM_END;
    }
    events_end(events);
    fclose(out);
    return all;
}

static void assert_same(const char *text, size_t size, size_t most) {
    size_t alone, ahead;
    char *one = written(text, size, false, most, &alone), *other = written(text, size, true, most, &ahead);
    assert_int_equal(alone, ahead);
    assert_memory_equal(one, other, alone);
    free(one);
    free(other);
}

/* ---- Short texts ---- */

static struct row {
    const char *name, *text, *want;
} rows[] = {
    {"nothing", "", "stream 0:0-0:0\nend of stream 0:0-0:0\n"},
    {"styles", "['a', \"b\", c]",
     "stream 0:0-0:0\ndocument 0:0-0:0\n[ 0:0-0:1\nscalar 0:1-0:4 style 1 1 'a\nscalar 0:6-0:9 style 2 1 'b\n"
     "scalar 0:11-0:12 style 0 1 'c\n] 0:12-0:13\nend of document 1:0-1:0\nend of stream 1:0-1:0\n"},
    {"a block", "|\n a\n",
     "stream 0:0-0:0\ndocument 0:0-0:0\nscalar 0:0-2:0 style 3 2 'a\n\nend of document 2:0-2:0\n"
     "end of stream 2:0-2:0\n"},
    {"anchors, tags, an alias", "{&a !b c: *a, &d e: !f [], &g h: &i {}}",
     "stream 0:0-0:0\ndocument 0:0-0:0\n{ 0:0-0:1\nscalar 0:1-0:8 &a tag !b style 0 1 'c\nalias 0:10-0:12 1 "
     "'a\n"
     "scalar 0:14-0:18 &d style 0 1 'e\n[ 0:20-0:24 tag !f\n] 0:24-0:25\nscalar 0:27-0:31 &g style 0 1 'h\n"
     "{ 0:33-0:37 &i\n} 0:37-0:38\n} 0:38-0:39\nend of document 1:0-1:0\nend of stream 1:0-1:0\n"},
    {"no YAML", "[a",
     "stream 0:0-0:0\ndocument 0:0-0:0\n[ 0:0-0:1\nscalar 0:1-0:2 style 0 1 'a\n"
     "problem: did not find expected ',' or ']', while parsing a flow sequence at 1:0, 0:0\n"},
    {"no UTF-8", "\xff", "problem: invalid leading UTF-8 octet,  at byte 0\n"},
};

/* Without the zeros behind texts. */
static void check_row(void **state) {
    const struct row *row = *state;
    size_t length, kept = 0;
    char *all = written(row->text, strlen(row->text), false, SIZE_MAX, &length);
    for (size_t i = 0; i < length; i++)
        if (all[i]) all[kept++] = all[i];
    all[kept] = '\0';
    assert_string_equal(all, row->want);
    free(all);
    assert_same(row->text, strlen(row->text), SIZE_MAX);
}

/* ---- Long texts ---- */

/* Some of the scalars are longer than a batch has room for, and one has a NUL. */
static char *long_text(size_t *size) {
    char *text = NULL;
    struct random r = random_begin();
    FILE *out = open_memstream(&text, size);
    fputs("- \"\\0\"\n", out);
    for (int i = 0; i < 20000; i++) {
        const unsigned kind = random_below(&r, 2000);
        fprintf(out, "- &a%d {k: [%d, 'x'], ", i % 100, i);
        for (unsigned n = kind == 0 ? 200000 : kind % 20; n > 0; n--) fputc('a' + (char)(n % 26), out);
        fprintf(out, "b: *a%d}\n", random_below(&r, (unsigned)(i % 100) + 1));
    }
    fclose(out);
    return text;
}

static void long_texts_are_the_same(void **state) {
    (void)state;
    size_t size;
    char *text = long_text(&size);
    assert_same(text, size, SIZE_MAX);
    text[size / 2] = '\x01'; /* a problem far behind the begin */
    assert_same(text, size, SIZE_MAX);
    free(text);
}

static void reading_ends_at_any_time(void **state) {
    (void)state;
    size_t size;
    char *text = long_text(&size);
    for (size_t most = 0; most < 10000; most = 3 * most + 1) assert_same(text, size, most);
    free(text);
}

int main(void) {
    struct CMUnitTest tests[COUNT(rows) + 2] = {cmocka_unit_test(long_texts_are_the_same),
                                                cmocka_unit_test(reading_ends_at_any_time)};
    for (size_t i = 0; i < COUNT(rows); i++)
        tests[i + 2] = (struct CMUnitTest){rows[i].name, check_row, NULL, NULL, &rows[i]};
    return cmocka_run_group_tests_name("events", tests, NULL, NULL);
}
