/* Lines, places and indentation of a text. */
#include <string.h>

#include "base/source.h"
#include "near.h"

static struct source source_of(const char *text) { return (struct source){"test.yaml", text, strlen(text)}; }

/* ---- Lines ---- */

static struct line {
    const char *name, *text;
    uint32_t line;
    const char *want;
} lines[] = {
    {"line: of an empty text", "", 0, ""},
    {"line: the first", "ab\ncd\n", 0, "ab"},
    {"line: the second", "ab\ncd\n", 1, "cd"},
    {"line: behind the last break", "ab\ncd\n", 2, ""},
    {"line: past the end", "ab\ncd\n", 9, ""},
    {"line: without a final break", "ab\ncd", 1, "cd"},
    {"line: an empty one", "ab\n\ncd", 1, ""},
    {"line: carriage return and line feed", "ab\r\ncd\r\n", 1, "cd"},
    {"line: carriage return alone", "ab\rcd\ref", 2, "ef"},
    {"line: line feed and carriage return are two", "ab\n\rcd", 2, "cd"},
    {"line: next line (U+0085)",
     "ab\xc2\x85"
     "cd",
     1, "cd"},
    {"line: line separator (U+2028)",
     "ab\xe2\x80\xa8"
     "cd",
     1, "cd"},
    {"line: paragraph separator (U+2029)",
     "ab\xe2\x80\xa9"
     "cd",
     1, "cd"},
    {"line: a dash (U+2014) breaks nothing",
     "ab\xe2\x80\x94"
     "cd\nef",
     1, "ef"},
    {"line: an umlaut breaks nothing", "a\xc3\x85z\nef", 0, "a\xc3\x85z"},
    {"line: half a break at the end", "ab\xe2\x80", 0, "ab\xe2\x80"},
};

static void check_line(void **state) {
    const struct line *row = *state;
    const struct source source = source_of(row->text);
    size_t end, begin = source_line(&source, row->line, &end);
    assert_int_equal(end - begin, strlen(row->want));
    assert_memory_equal(row->text + begin, row->want, end - begin);
}

/* ---- Offsets ---- */

static struct offset {
    const char *name, *text;
    uint32_t line, column;
    size_t want;
} offsets[] = {
    {"offset: the beginning", "ab\ncd", 0, 0, 0},
    {"offset: within a line", "ab\ncd", 1, 1, 4},
    {"offset: end of a line", "ab\ncd", 0, 2, 2},
    {"offset: past the end of a line", "ab\ncd", 0, 7, 2},
    {"offset: past the end", "ab\ncd", 5, 5, 5},
    {"offset: columns count characters", "\xc3\xbc\xe7\x90\x83x", 0, 2, 5},
    {"offset: stray bytes belong to the character before", "a\x80\x80z", 0, 1, 3},
};

static void check_offset(void **state) {
    const struct offset *row = *state;
    const struct source source = source_of(row->text);
    assert_int_equal(source_offset((struct span){&source, row->line, row->column, 1}), row->want);
}

/* ---- Levels ---- */

/* As `k0 d2 k4`: keys and dashes with their columns; `:n` is the line where it is not 0. */
static void write_levels(const struct source_level *levels, int count, char *text) {
    for (int i = 0; i < count; i++) {
        text += sprintf(text, "%s%c%u", i ? " " : "", levels[i].dash ? 'd' : 'k', (unsigned)levels[i].column);
        if (levels[i].line) text += sprintf(text, ":%u", (unsigned)levels[i].line);
    }
    *text = '\0';
}

static struct level {
    const char *name, *text;
    uint32_t line; /* 0: the levels of the first line itself; else those open before this line */
    const char *want;
} levels[] = {
    {"own: a key", "scene:", 0, "k0"},
    {"own: indented", "   fov: 3", 0, "k3"},
    {"own: a dash and a key", "  - sphere: {}", 0, "d2 k4"},
    {"own: dashes", "- -  - x", 0, "d0 d2 d5 k7"},
    {"own: a dash alone", "  -", 0, "d2"},
    {"own: a negative number is no dash", "  -5", 0, "k2"},
    {"own: blank", "   ", 0, ""},
    {"own: a comment", "  # - x", 0, ""},
    {"own: a comment behind a dash", "  - # x", 0, "d2"},
    {"own: a tab counts as one", "\tx", 0, "k1"},
    {"open: nested keys", "a:\n  b:\n    c: 1\nX", 3, "k0 k2:1 k4:2"},
    {"open: a key ends what is deeper", "a:\n  b:\n    c: 1\n  d: 2\nX", 4, "k0 k2:3"},
    {"open: items", "a:\n  - b: 1\n    c: 2\n  - d: 3\nX", 4, "k0 d2:3 k4:3"},
    {"open: a dash under its key in the same column", "a:\n- b: 1\nX", 2, "k0 d0:1 k2:1"},
    {"open: a key ends a list in its column", "a:\n- b: 1\nc: 2\nX", 3, "k0:2"},
    {"open: blank lines and comments leave all open", "a:\n  b: 1\n\n# x\nX", 4, "k0 k2:1"},
    {"open: nothing before the first line", "X", 1, "k0"},
};

static void check_level(void **state) {
    const struct level *row = *state;
    const struct source source = source_of(row->text);
    struct source_level found[SOURCE_MAX_LEVELS];
    char text[300];
    const int count =
        row->line ? source_open_levels(&source, row->line, found) : source_line_levels(&source, 0, found);
    write_levels(found, count, text);
    assert_string_equal(text, row->want);
}

static void more_levels_than_are_kept(void **state) {
    (void)state;
    char text[1000] = "";
    for (int i = 0; i < 200; i++) strcat(text, "- ");
    const struct source source = source_of(text);
    struct source_level found[SOURCE_MAX_LEVELS];
    assert_int_equal(source_line_levels(&source, 0, found), SOURCE_MAX_LEVELS);
    assert_int_equal(source_open_levels(&source, 1, found), SOURCE_MAX_LEVELS);
}

int main(void) {
    struct CMUnitTest tests[COUNT(lines) + COUNT(offsets) + COUNT(levels) + 1];
    size_t n = 0;
    for (size_t i = 0; i < COUNT(lines); i++)
        tests[n++] = (struct CMUnitTest){lines[i].name, check_line, NULL, NULL, &lines[i]};
    for (size_t i = 0; i < COUNT(offsets); i++)
        tests[n++] = (struct CMUnitTest){offsets[i].name, check_offset, NULL, NULL, &offsets[i]};
    for (size_t i = 0; i < COUNT(levels); i++)
        tests[n++] = (struct CMUnitTest){levels[i].name, check_level, NULL, NULL, &levels[i]};
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(more_levels_than_are_kept);
    return cmocka_run_group_tests_name("source", tests, NULL, NULL);
}
