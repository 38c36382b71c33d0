/* Random texts in every layout that YAML allows, with comments: formatting keeps what they say, and
 * formatting again changes nothing. The seed is printed; MONGE_SEED=n in the environment sets it. */
#include <string.h>

#include "lang/file.h"
#include "lang/format.h"
#include "near.h"

enum { TEXTS = 4000, ROOM = 1 << 16 };

static struct random chance;
static char text[ROOM];
static size_t size;
static int comments, anchors;

/* ---- Chance ---- */

static unsigned below(unsigned n) { return random_below(&chance, n); }

static bool once_in(unsigned n) { return below(n) == 0; }

static void put(const char *words) {
    const size_t length = strlen(words);
    if (size + length >= ROOM) return;
    memcpy(text + size, words, length);
    size += length;
}

static void put_number(const char *format, int n) {
    char words[80];
    snprintf(words, sizeof words, format, n);
    put(words);
}

static void spaces(unsigned n) {
    while (n-- > 0) put(" ");
}

static void indent(int column) { spaces(column > 0 ? (unsigned)column : 0); }

#define ONE_OF(words) (words[below(sizeof words / sizeof *words)])

/* ---- Lines ---- */

static void comment(void) {
    static const char *const kinds[] = {"# remark %d", "#%d", "# `key: [%d, {'\"` }", "## %d ##  ",
                                        "# \xc3\xa9 %d\t"};
    put_number(ONE_OF(kinds), comments++);
}

static void end_line(void) {
    if (once_in(4)) {
        spaces(1 + below(12));
        comment();
    } else if (once_in(5)) {
        spaces(below(3));
    }
    put(once_in(40) ? "\r\n" : "\n");
}

/* Blank lines, and comments up to `column` or thereabouts. */
static void between_lines(int column) {
    while (once_in(4)) {
        if (once_in(2)) {
            indent((int)below(4) ? column : (int)below((unsigned)column + 5));
            comment();
        } else if (once_in(3)) {
            spaces(below(4));
        }
        put("\n");
    }
}

/* ---- Values in lines ---- */

static void plain(void) {
    static const char *const words[] = {"1",
                                        "-0.5",
                                        "gold",
                                        "1e-3",
                                        "a long text of several words",
                                        "r * 2 + sin(30)",
                                        "x:y",
                                        "c#d",
                                        "\xc3\xa9t\xc3\xa9",
                                        "<",
                                        "-x"};
    put(ONE_OF(words));
}

static void quoted(int column) {
    static const char *const words[] = {"\"#ffd700\"", "'it''s'", "\"a \\\"b\\\" \\n\"",
                                        "\"\"",        "''",      "\"[not, a: list] # nor a comment\""};
    if (once_in(6)) {
        put(once_in(2) ? "\"two  \n\n" : "\"two \\  \n");
        indent(column + 1 + (int)below(5));
        put("lines\"");
    } else
        put(ONE_OF(words));
}

static void flow(int column, int depth);

static void prop(void) {
    if (!once_in(8)) return;
    if (once_in(5)) put("! ");
    put_number("&a%d ", anchors++);
    if (once_in(6)) spaces(2);
}

static void flow_break(int column) {
    if (once_in(12)) {
        spaces(below(3));
        if (once_in(3)) {
            put(" ");
            comment();
        }
        put("\n");
        while (once_in(4)) {
            if (once_in(2)) indent(column + (int)below(6)), comment();
            put("\n");
        }
        indent(column + 1 + (int)below(7));
    } else
        spaces(below(3));
}

static void flow_value(int column, int depth) {
    const unsigned kind = below(8);
    const bool alias = anchors > 0 && once_in(12);
    if (alias) {
        put_number("*a%d ", (int)below((unsigned)anchors));
        return;
    }
    prop();
    if (kind < 4)
        plain();
    else if (kind < 5)
        quoted(column);
    else
        flow(column, depth - 1);
}

static void flow_key(int column) {
    (void)column;
    static const char *const keys[] = {"k%d", "\"quoted %d\"", "'single %d'", "two words %d"};
    put_number(ONE_OF(keys), (int)below(100));
}

static void flow(int column, int depth) {
    const bool mapping = once_in(2);
    put(mapping ? "{" : "[");
    flow_break(column);
    for (unsigned n = depth > 0 ? below(6) : 0; n > 0; n--) {
        if (mapping && once_in(15)) {
            plain();
        } else {
            if (mapping || once_in(12)) {
                flow_key(column);
                put(":");
                spaces(1);
                if (once_in(6)) flow_break(column);
            }
            if (!mapping || !once_in(10)) flow_value(column, depth);
        }
        flow_break(column);
        if (n > 1 || once_in(6)) put(",");
        flow_break(column);
    }
    put(mapping ? "}" : "]");
}

/* ---- Blocks ---- */

static void block(int column, int depth);

static void block_scalar(int column) {
    static const char *const heads[] = {"|", ">", "|-", ">-", "|+", ">+"};
    const int at = column + 1 + (int)below(4);
    put(ONE_OF(heads));
    const bool digit = once_in(3);
    if (digit) put_number("%d", at - column);
    end_line();
    for (unsigned n = 1 + below(4), i = 0; i < n; i++) {
        while (once_in(5)) put("\n");
        indent(at);
        if ((i > 0 || digit) && once_in(4)) spaces(1 + below(3));
        put(once_in(4) ? "# no comment \n" : "text: of [it\n");
    }
    while (once_in(4)) put("\n");
}

/* What follows `key:` or `-` in a line whose block is in `column`. */
static void value(int column, int depth, bool item) {
    const unsigned kind = below(depth > 0 ? 14 : 8);
    if (kind >= 8) {
        if (item && once_in(2)) {
            const unsigned gap = 1 + below(3);
            spaces(gap);
            block(-(column + 1 + (int)gap), depth - 1);
            return;
        }
        if (once_in(5)) put_number(" &a%d", anchors++);
        end_line();
        between_lines(column + 2);
        block(column + 1 + (int)below(4), depth - 1);
        return;
    }
    if (kind == 0) {
        if (once_in(3)) put_number(" &a%d", anchors++);
        end_line();
        return;
    }
    if (once_in(8)) {
        end_line();
        between_lines(column + 1);
        indent(column + 1 + (int)below(4));
    } else
        spaces(1 + below(2));
    if (anchors > 0 && once_in(10)) {
        put_number("*a%d", (int)below((unsigned)anchors));
        end_line();
        return;
    }
    prop();
    if (kind == 1) {
        block_scalar(column);
        return;
    }
    if (kind < 4)
        plain();
    else if (kind == 4)
        quoted(column);
    else
        flow(column, 3);
    if (kind == 2 && once_in(3)) {
        put("\n");
        while (once_in(4)) put("\n");
        indent(column + 1 + (int)below(5));
        put("and more");
    }
    end_line();
}

/* A mapping or a sequence in `column`; where that is negative, its first line has been begun in -column. */
static void block(int column, int depth) {
    const bool mapping = once_in(2);
    bool begun = column < 0;
    if (begun) column = -column;
    for (unsigned n = 1 + below(4), i = 0; i < n; i++, begun = false) {
        if (!begun) {
            if (i > 0) between_lines(column);
            indent(column);
        }
        if (mapping) {
            if (once_in(9)) put_number("&a%d ", anchors++);
            flow_key(column);
        }
        put(mapping ? ":" : "-");
        value(column, depth, !mapping);
    }
}

static void make_text(void) {
    size = 0;
    comments = anchors = 0;
    if (once_in(20)) put("\xef\xbb\xbf");
    if (once_in(8)) {
        if (once_in(2)) put("%YAML 1.1 # version\n");
        between_lines(0);
        put("---");
        end_line();
    }
    between_lines(2);
    if (once_in(20)) {
        flow(0, 4);
        end_line();
    } else
        block((int)below(3), 4);
    between_lines(4);
    if (once_in(10)) put("...\n");
    if (once_in(10) && size > 0) size--;
}

/* ---- What must hold ---- */

static char *format(struct arena *arena, struct diagnostics *diag, const char *bytes, size_t count,
                    size_t *formatted) {
    static const struct lang_limits limits = {.nesting = 100, .values = 1000000};
    return format_text(arena, diag, file_from_memory(arena, "t", bytes, count), &limits, formatted);
}

static void fail_text(const char *why, const struct diagnostics *diag, const char *first,
                      const char *second) {
    printf("---- the text\n%.*s---- formatted\n%s---- again\n%s----\n", (int)size, text, first ? first : "",
           second ? second : "");
    diag_print(diag, stdout);
    fail_msg("%s", why);
}

/* Returns whether the text was YAML. */
static bool check_text(void) {
    struct arena arena = {0};
    struct diagnostics diag = {0};
    jmp_buf full;
    arena.on_full = &full;
    if (setjmp(full) != 0) fail_text("the arena is full", &diag, NULL, NULL);
    size_t first_size = 0, second_size = 0;
    char *first = format(&arena, &diag, text, size, &first_size);
    if (!first && diag.failures > 0) fail_text("does not say the same", &diag, NULL, NULL);
    if (first) {
        char *second = format(&arena, &diag, first, first_size, &second_size);
        if (!second || first_size != second_size || memcmp(first, second, first_size) != 0)
            fail_text("changes when formatted again", &diag, first, second);
    }
    if (!first && getenv("FORMAT_SHOW")) fail_text("not YAML", &diag, NULL, NULL);
    diag_free(&diag);
    arena_free(&arena);
    return first != NULL;
}

static void check_texts(void **state) {
    (void)state;
    int good = 0;
    chance = random_begin();
    for (int i = 0; i < TEXTS; i++) {
        make_text();
        good += check_text();
    }
    print_message("%d of %d texts were YAML\n", good, TEXTS);
    assert_true(good > TEXTS / 2);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(check_texts)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
