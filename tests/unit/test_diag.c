/* Diagnostics as text: places, excerpts, order, and texts that could harm a terminal. */
#include <string.h>

#include "base/diag.h"
#include "near.h"

/* What diag_print writes; the caller frees it. */
static char *printed(const struct diagnostics *diag) {
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    diag_print(diag, out);
    fclose(out);
    return text;
}

static void assert_printed(const struct diagnostics *diag, const char *want) {
    char *text = printed(diag);
    assert_string_equal(text, want);
    free(text);
}

/* ---- One message ---- */

#define TEN     "0123456789"
#define HUNDRED TEN TEN TEN TEN TEN TEN TEN TEN TEN TEN

static struct row {
    const char *name, *text;
    uint32_t line, column, length;
    const char *want;
} rows[] = {
    {"a word", "scene:\n  - spere: {}\n", 1, 4, 5,
     "f:2:5: error[code]: oops\n    2 |   - spere: {}\n      |     ^~~~~\n"},
    {"a caret alone", "abc", 0, 1, 0, "f:1:2: error[code]: oops\n    1 | abc\n      |  ^\n"},
    {"longer than the line", "abc", 0, 1, 9, "f:1:2: error[code]: oops\n    1 | abc\n      |  ^~\n"},
    {"at the end of the line", "abc\n", 0, 3, 1, "f:1:4: error[code]: oops\n    1 | abc\n      |    ^\n"},
    {"an empty line", "a\n\nb", 1, 0, 1, "f:2:1: error[code]: oops\n    2 | \n      | ^\n"},
    {"behind the end", "abc\n", 1, 0, 1, "f:2:1: error[code]: oops\n    2 | \n      | ^\n"},
    {"nowhere in the text", "abc\n", 7, 3, 1, "f:8:4: error[code]: oops\n"},
    {"an empty text", "", 0, 0, 1, "f:1:1: error[code]: oops\n    1 | \n      | ^\n"},
    {"carriage returns are not shown", "ab\r\ncd\r\n", 1, 0, 2,
     "f:2:1: error[code]: oops\n    2 | cd\n      | ^~\n"},
    {"characters count, not bytes", "k\xc3\xb6nig: 1", 0, 7, 1,
     "f:1:8: error[code]: oops\n    1 | k\xc3\xb6nig: 1\n      |        ^\n"},
    {"a tab takes one column", "\ta\tb", 0, 3, 1, "f:1:4: error[code]: oops\n    1 |  a b\n      |    ^\n"},
    {"an escape code", "a\033[31mb", 0, 6, 1, "f:1:7: error[code]: oops\n    1 | a?[31mb\n      |       ^\n"},
    {"a control of the second set",
     "a\xc2\x9b"
     "b",
     0, 2, 1, "f:1:3: error[code]: oops\n    1 | a?b\n      |   ^\n"},
    {"a turn of direction",
     "a\xe2\x80\xae"
     "b",
     0, 2, 1, "f:1:3: error[code]: oops\n    1 | a?b\n      |   ^\n"},
    {"a byte order mark",
     "\xef\xbb\xbf"
     "b",
     0, 1, 1, "f:1:2: error[code]: oops\n    1 | ?b\n      |  ^\n"},
    {"not UTF-8",
     "a\xff"
     "b\xe9",
     0, 2, 1, "f:1:3: error[code]: oops\n    1 | a?b?\n      |   ^\n"},
    {"half a surrogate pair",
     "a\xed\xa0\x80"
     "b",
     0, 2, 1, "f:1:3: error[code]: oops\n    1 | a?b\n      |   ^\n"},
    {"an overlong slash",
     "a\xc0\xaf"
     "b",
     0, 2, 1, "f:1:3: error[code]: oops\n    1 | a?b\n      |   ^\n"},
    {"past the last code point",
     "a\xf4\x90\x80\x80"
     "b",
     0, 2, 1, "f:1:3: error[code]: oops\n    1 | a?b\n      |   ^\n"},
    {"a smiley",
     "a\xf0\x9f\x98\x80"
     "b",
     0, 2, 1,
     "f:1:3: error[code]: oops\n    1 | a\xf0\x9f\x98\x80"
     "b\n      |   ^\n"},
    {"the start of a long line", HUNDRED "xyz", 0, 5, 1,
     "f:1:6: error[code]: oops\n    1 | " HUNDRED "...\n      |      ^\n"},
    {"the middle of a long line", HUNDRED HUNDRED, 0, 100, 1,
     "f:1:101: error[code]: oops\n    1 | ..." HUNDRED
     "...\n      |                                                                ^\n"},
    {"the end of a long line", HUNDRED, 0, 90, 50,
     "f:1:91: error[code]: oops\n    1 | ..." TEN TEN TEN TEN TEN TEN TEN "\n"
     "      |                                                                ^~~~~~~~~~\n"},
};

static void check_row(void **state) {
    const struct row *row = *state;
    const struct source source = {"f", row->text, strlen(row->text)};
    struct diagnostics diag = {0};
    diag_error(&diag, (struct span){&source, row->line, row->column, row->length}, "code", "oops");
    assert_printed(&diag, row->want);
    diag_free(&diag);
}

static void a_zero_byte_is_shown(void **state) {
    (void)state;
    const struct source source = {"f", "a\0b", 3};
    struct diagnostics diag = {0};
    diag_error(&diag, (struct span){&source, 0, 2, 1}, "code", "oops");
    assert_printed(&diag, "f:1:3: error[code]: oops\n    1 | a?b\n      |   ^\n");
    diag_free(&diag);
}

/* ---- Parts and kinds ---- */

static const struct source three_lines = {"king.yaml", "one\ntwo\nthree\n", 14};

static struct span at(uint32_t line, uint32_t column) { return (struct span){&three_lines, line, column, 2}; }

static void help_note_and_related(void **state) {
    (void)state;
    struct diagnostics diag = {0};
    struct diagnostic *d = diag_error(&diag, at(2, 1), "code", "`%s` is given twice", "hr");
    diag_note(&diag, d, "%d takes these", 3);
    diag_related(&diag, d, at(0, 0), "first given %s", "here");
    diag_related(&diag, d, at(1, 0), "and here");
    diag_help(&diag, d, "remove %s", "it");
    assert_printed(&diag, "king.yaml:3:2: error[code]: `hr` is given twice\n    3 | three\n      |  ^~ "
                          "remove it\n      = 3 takes these\n"
                          "king.yaml:1:1: note: first given here\n    1 | one\n      | ^~\n"
                          "king.yaml:2:1: note: and here\n    2 | two\n      | ^~\n");
    diag_free(&diag);
}

static void warnings_and_failures(void **state) {
    (void)state;
    struct diagnostics diag = {0};
    diag_warning(&diag, at(0, 0), "code", "odd");
    diag_help(&diag, diag_failure(&diag, "code", "cannot read %s", "x"), "try y");
    assert_printed(&diag, "king.yaml:1:1: warning[code]: odd\n    1 | one\n      | ^~\nmonge: error[code]: "
                          "cannot read x\n      = try y\n");
    assert_int_equal(diag.errors, 0);
    assert_int_equal(diag.warnings, 1);
    assert_int_equal(diag.failures, 1);
    diag_free(&diag);
    assert_int_equal(diag.failures, 0);
    assert_printed(&diag, "");
}

static void texts_cannot_harm_a_terminal(void **state) {
    (void)state;
    const struct source source = {"a\033]0;b.yaml", "", 0};
    struct diagnostics diag = {0};
    struct diagnostic *d = diag_error(&diag, (struct span){&source, 3, 0, 1}, "code", "found `%s`",
                                      "\033[2J\xc2\x9b\x7f\n\xff\xe2\x80\xa8");
    diag_help(&diag, d, "\r%s", "\xe2\x80\xae");
    assert_printed(&diag, "a?]0;b.yaml:4:1: error[code]: found `?[2J?????`\n    4 | \n      | ^ ??\n");
    diag_free(&diag);
}

/* ---- The list ---- */

static void places_are_in_order_within_their_file(void **state) {
    (void)state;
    const struct source other = {"other.yaml", "x\n", 2};
    struct diagnostics diag = {0};
    diag_error(&diag, at(2, 0), "code", "e");
    diag_error(&diag, at(0, 2), "code", "b");
    diag_error(&diag, (struct span){&other, 0, 0, 1}, "code", "x");
    diag_error(&diag, at(0, 1), "code", "a");
    diag_warning(&diag, at(1, 0), "code", "c");
    diag_error(&diag, at(1, 0), "code", "d");
    char order[10] = "", *to = order;
    for (const struct diagnostic *d = diag.first; d; d = d->next) *to++ = d->message[0];
    assert_string_equal(order, "abcdex");
    diag_free(&diag);
}

static void the_same_at_the_same_place_counts_once(void **state) {
    (void)state;
    struct diagnostics diag = {0};
    diag_error(&diag, at(0, 0), "code", "a");
    diag_related(&diag, diag_error(&diag, at(0, 0), "code", "a"), at(1, 1), "lost");
    diag_error(&diag, at(0, 1), "code", "a");
    diag_warning(&diag, at(0, 0), "code", "a");
    diag_error(&diag, at(0, 0), "code", "b");
    assert_int_equal(diag.errors, 3);
    assert_int_equal(diag.kept, 4);
    for (const struct diagnostic *d = diag.first; d; d = d->next) assert_null(d->related);
    diag_free(&diag);
}

static void fifty_are_kept_and_all_are_counted(void **state) {
    (void)state;
    struct diagnostics diag = {0};
    for (int i = 0; i < 100000; i++) {
        assert_int_equal(diag_full(&diag), i >= DIAG_MAX_KEPT);
        struct diagnostic *d = i % 10 ? diag_error(&diag, at((uint32_t)i, 0), "code", "e%d", i)
                                      : diag_warning(&diag, at((uint32_t)i, 0), "code", "w%d", i);
        diag_help(&diag, d, "help");
        diag_note(&diag, d, "note");
        diag_related(&diag, d, at(0, 0), "related");
    }
    assert_int_equal(diag.errors, 90000);
    assert_int_equal(diag.warnings, 10000);
    assert_int_equal(diag.kept, DIAG_MAX_KEPT);
    assert_true(diag.arena.total < 200000);
    diag_failure(&diag, "code", "failures are always kept");
    char *text = printed(&diag);
    assert_non_null(
        strstr(text, "king.yaml:50:1: error[code]: e49\n   50 | \n      | ^ help\n      = note\n"));
    assert_non_null(strstr(text, "monge: error[code]: failures are always kept\n... and 99950 more\n"));
    assert_null(strstr(text, "e50"));
    free(text);
    diag_free(&diag);
}

static void a_place_outlives_its_source(void **state) {
    (void)state;
    char *text = strdup("abc"), *name = strdup("f");
    const struct source source = {name, text, 3};
    struct diagnostics diag = {0};
    diag_error(&diag, (struct span){&source, 0, 0, 1}, "code", "oops");
    free(text);
    free(name);
    assert_printed(&diag, "f:1:1: error[code]: oops\n    1 | abc\n      | ^\n");
    diag_free(&diag);
}

static void add_mistakes(struct diagnostics *diag, const struct source *source, int count) {
    diag_begin(diag);
    struct diagnostic *d = diag_error(diag, (struct span){source, 0, 1, 1}, "code", "first");
    diag_help(diag, d, "help");
    diag_related(diag, d, (struct span){source, 0, 2, 1}, "related");
    for (int i = 1; i < count; i++) diag_error(diag, (struct span){source, 0, 2, 1}, "code", "e%d", i);
}

static void what_is_appended_outlives_its_list(void **state) {
    (void)state;
    const struct source source = {"f", "abc", 3};
    struct diagnostics diag = {0}, one = {0}, two = {0}, full = {0};
    add_mistakes(&one, &source, 1);
    add_mistakes(&two, &source, 2);
    add_mistakes(&full, &source, 60);
    diag_append(&diag, &one, false);
    diag_append(&diag, &two, true); /* its first is told again */
    assert_int_equal(diag.kept, 2);
    assert_int_equal(diag.errors, 3);
    diag_append(&diag, &one, false);
    assert_int_equal(diag.kept, 3);
    diag_append(&diag, &full, false);
    assert_int_equal(diag.kept, 53);
    diag_free(&one);
    diag_free(&two);
    diag_free(&full);
    char *text = printed(&diag);
    assert_non_null(
        strstr(text, "f:1:2: error[code]: first\n    1 | abc\n      |  ^ help\nf:1:3: note: related\n"));
    assert_non_null(strstr(text, "f:1:3: error[code]: e1\n"));
    assert_non_null(strstr(text, "... and 10 more\n"));
    free(text);
    diag_free(&diag);
}

int main(void) {
    struct CMUnitTest tests[COUNT(rows)];
    for (size_t i = 0; i < COUNT(rows); i++)
        tests[i] = (struct CMUnitTest){rows[i].name, check_row, NULL, NULL, &rows[i]};
    const struct CMUnitTest others[] = {
        cmocka_unit_test(a_zero_byte_is_shown),
        cmocka_unit_test(help_note_and_related),
        cmocka_unit_test(warnings_and_failures),
        cmocka_unit_test(texts_cannot_harm_a_terminal),
        cmocka_unit_test(places_are_in_order_within_their_file),
        cmocka_unit_test(the_same_at_the_same_place_counts_once),
        cmocka_unit_test(fifty_are_kept_and_all_are_counted),
        cmocka_unit_test(a_place_outlives_its_source),
        cmocka_unit_test(what_is_appended_outlives_its_list),
    };
    return cmocka_run_group_tests_name("rows", tests, NULL, NULL) +
           cmocka_run_group_tests_name("diag", others, NULL, NULL);
}
