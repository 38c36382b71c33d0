/* JSON: strings in any bytes, and the layout of values. */
#include <stdlib.h>
#include <string.h>

#include "base/json.h"
#include "near.h"

static struct row {
    const char *name, *text, *want;
} rows[] = {
    {"nothing", "", "\"\""},
    {"a word", "king", "\"king\""},
    {"quotes and backslashes", "a\"b\\c", "\"a\\\"b\\\\c\""},
    {"line breaks, tabs and other controls", "\n\t\001\177", "\"\\n\\u0009\\u0001\\u007f\""},
    {"characters of two to four bytes", "\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80",
     "\"\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80\""},
    {"bytes that are no UTF-8", "a\xff\xc3", "\"a\\ufffd\\ufffd\""},
    {"half a surrogate pair", "\xed\xa0\x80", "\"\\ufffd\\ufffd\\ufffd\""},
    {"an overlong slash", "\xc0\xaf/", "\"\\ufffd\\ufffd/\""},
};

static void check_string(void **state) {
    const struct row *row = *state;
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    json_string(row->text, out);
    fclose(out);
    assert_string_equal(text, row->want);
    free(text);
}

static void check_layout(void **state) {
    (void)state;
    char *text = NULL;
    size_t size = 0;
    struct json json = {.out = open_memstream(&text, &size)};
    json_open(&json, NULL, '{');
    json_text(&json, "name", "king");
    json_open(&json, "list", '[');
    json_number(&json, NULL, 8);
    json_word(&json, NULL, "true");
    json_text(&json, NULL, NULL);
    json_open(&json, NULL, '{');
    json_close(&json, '}');
    json_close(&json, ']');
    json_number(&json, "last", 0);
    json_close(&json, '}');
    fclose(json.out);
    assert_string_equal(text, "{\n  \"name\": \"king\",\n  \"list\": [\n    8,\n    true,\n    null,\n    "
                              "{}\n  ],\n  \"last\": 0\n}\n");
    free(text);
}

int main(void) {
    enum { ROWS = sizeof rows / sizeof *rows };
    struct CMUnitTest tests[ROWS + 1] = {cmocka_unit_test(check_layout)};
    for (int i = 0; i < ROWS; i++)
        tests[i + 1] = (struct CMUnitTest){rows[i].name, check_string, NULL, NULL, &rows[i]};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
