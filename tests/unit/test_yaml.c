/* YAML as a tree: what a text becomes, written in a short form of its own, and the limits. */
#include <string.h>

#include "lang/node.h"
#include "near.h"

/* ---- The short form ----
 * scalars as they are, quoted ones in ', sequences (a b), mappings {k:v k:v}, aliases *(what they name),
 * keys that merge keys brought with < before them */

static void write_node(FILE *out, const struct node *node) {
    const bool mapping = node->kind == NODE_MAPPING;
    if (node->kind == NODE_SCALAR) {
        fprintf(out, node->quoted ? "'%s'" : "%s", node->text);
        assert_int_equal(strlen(node->text), node->count);
        return;
    }
    if (node->kind == NODE_ALIAS) {
        assert_int_not_equal(node->target->kind, NODE_ALIAS);
        fputs("*", out);
        write_node(out, node->target);
        return;
    }
    uint32_t children = 0;
    fputc(mapping ? '{' : '(', out);
    for (const struct node *child = node->first; child; child = child->next, children++) {
        if (child->merged) fputc('<', out);
        write_node(out, child);
        if (child->next) fputc(mapping && children % 2 == 0 ? ':' : ' ', out);
    }
    fputc(mapping ? '}' : ')', out);
    assert_int_equal(children, mapping ? 2 * node->count : node->count);
}

struct parsed {
    struct arena arena;
    struct diagnostics diag;
    struct node_problem problem;
    struct source source;
    struct node *root;
    char *text; /* the short form, or the first message */
};

static void parse(struct parsed *p, const char *text, size_t size, unsigned nesting, size_t nodes) {
    *p = (struct parsed){.source = {"t", text, size}};
    const struct node_limits limits = {nesting, nodes};
    size_t length;
    p->root = node_parse(&p->arena, &p->diag, &p->source, &limits, NULL, &p->problem);
    FILE *out = open_memstream(&p->text, &length);
    if (p->root)
        write_node(out, p->root);
    else
        fputs(p->problem.text ? p->problem.text
              : p->diag.first ? p->diag.first->message
                              : "nothing was said",
              out);
    fclose(out);
}

static void parsed_free(struct parsed *p) {
    free(p->text);
    arena_free(&p->arena);
    diag_free(&p->diag);
}

static struct row {
    const char *name, *text, *want;
    unsigned nesting; /* 0: 20 */
    size_t nodes;     /* 0: 100 */
} rows[] = {
    {.name = "a scalar", .text = "gold", .want = "gold"},
    {.name = "a block mapping", .text = "a: 1\nb:\n  c: 2\n", .want = "{a:1 b:{c:2}}"},
    {.name = "a flow mapping", .text = "{a: 1, b: {c: 2}}", .want = "{a:1 b:{c:2}}"},
    {.name = "JSON",
     .text = "{\"a\": [1, 2.5e3, true, null], \"b\": {\"c\": \"d\"}}",
     .want = "{'a':(1 2.5e3 true null) 'b':{'c':'d'}}"},
    {.name = "JSON with tabs",
     .text = "{\n\t\"a\": 1,\n\t\"b\": [\n\t\t2\n\t]\n}\n",
     .want = "{'a':1 'b':(2)}"},
    {.name = "a sequence", .text = "- 1\n- - 2\n  - 3\n", .want = "(1 (2 3))"},
    {.name = "empty collections", .text = "[[], {}]", .want = "(() {})"},
    {.name = "no values", .text = "a:\nb: ~\nc:\n", .want = "{a: b:~ c:}"},
    {.name = "quotes", .text = "['a', \"b\\n\", c d, '']", .want = "('a' 'b\n' c d '')"},
    {.name = "block scalars", .text = "a: |\n  x\n  y\nb: >-\n  x\n  y\n", .want = "{a:'x\ny\n' b:'x y'}"},
    {.name = "comments", .text = "# x\na: 1 # y\n# z\n", .want = "{a:1}"},
    {.name = "a document start and end", .text = "---\na: 1\n...\n", .want = "{a:1}"},
    {.name = "a version of YAML", .text = "%YAML 1.2\n---\na: 1\n", .want = "{a:1}"},
    {.name = "duplicate keys stay, for the checker", .text = "{a: 1, a: 2}", .want = "{a:1 a:2}"},
    {.name = "core tags mean nothing", .text = "[!!str 1, !!map {}, ! x]", .want = "(1 {} x)"},
    {.name = "another tag", .text = "[!x 1]", .want = "a scene has no tags, found `!x`"},

    {.name = "an alias", .text = "[&a 1, *a]", .want = "(1 *1)"},
    {.name = "an alias of a collection",
     .text = "[&a {b: [1]}, *a, *a]",
     .want = "({b:(1)} *{b:(1)} *{b:(1)})"},
    {.name = "an anchor may be given again", .text = "[&a 1, *a, &a 2, *a]", .want = "(1 *1 2 *2)"},
    {.name = "an anchor within an anchor", .text = "[&a [&b 1, *b], *a]", .want = "((1 *1) *(1 *1))"},
    {.name = "an alias as a key", .text = "{&a x: 1, *a : 2}", .want = "{x:1 *x:2}"},
    {.name = "an anchor of no value", .text = "{a: &n , b: *n }", .want = "{a: b:*}"},
    {.name = "no such anchor", .text = "[&gold 1, *gild]", .want = "no anchor `&gild` before this alias"},
    {.name = "an anchor after its alias", .text = "[*a, &a 1]", .want = "no anchor `&a` before this alias"},
    {.name = "a cycle", .text = "&a [*a]", .want = "`*a` stands inside the very node that it names"},
    {.name = "a cycle by a merge key",
     .text = "&a {<<: *a}",
     .want = "`*a` stands inside the very node that it names"},
    {.name = "a hidden cycle",
     .text = "&a {b: [{c: *a}]}",
     .want = "`*a` stands inside the very node that it names"},

    {.name = "a merge key",
     .text = "[&a {x: 1, y: 2}, {<<: *a, z: 3}]",
     .want = "({x:1 y:2} {z:3 <x:1 <y:2})"},
    {.name = "what is written wins",
     .text = "[&a {x: 1, y: 2}, {x: 3, <<: *a}]",
     .want = "({x:1 y:2} {x:3 <y:2})"},
    {.name = "what is written below wins",
     .text = "[&a {x: 1, y: 2}, {<<: *a, x: 3}]",
     .want = "({x:1 y:2} {x:3 <y:2})"},
    {.name = "the first of a list wins",
     .text = "[&a {x: 1}, &b {x: 2, y: 2}, {<<: [*a, *b]}]",
     .want = "({x:1} {x:2 y:2} {<x:1 <y:2})"},
    {.name = "the first of two merge keys wins",
     .text = "[&a {x: 1}, &b {x: 2, y: 2}, {<<: *b, <<: *a}]",
     .want = "({x:1} {x:2 y:2} {<x:2 <y:2})"},
    {.name = "a merge of a merge",
     .text = "[&a {x: 1}, &b {<<: *a, y: 2}, {<<: *b, x: 9}]",
     .want = "({x:1} {y:2 <x:1} {x:9 <y:2})"},
    {.name = "a mapping written out", .text = "{<<: {x: 1}, y: 2}", .want = "{y:2 <x:1}"},
    {.name = "nothing merged", .text = "{<<: {}, <<: [], y: 2}", .want = "{y:2}"},
    {.name = "an alias key counts as written", .text = "[&k x, {<<: {x: 1}, *k : 2}]", .want = "(x {*x:2})"},
    {.name = "a quoted << is a key", .text = "{'<<': 1}", .want = "{'<<':1}"},
    {.name = "a merge of a scalar",
     .text = "{<<: 1}",
     .want = "`<<` takes a mapping or a list of mappings, as in `<<: *base`"},
    {.name = "a merge of a list of scalars",
     .text = "{<<: [{}, 1]}",
     .want = "`<<` takes a mapping or a list of mappings, as in `<<: *base`"},
    {.name = "a merge of nothing",
     .text = "{<<: }",
     .want = "`<<` takes a mapping or a list of mappings, as in `<<: *base`"},

    {.name = "nesting at the limit", .text = "[[[1]]]", .want = "(((1)))", .nesting = 3},
    {.name = "nesting over the limit",
     .text = "[[[[1]]]]",
     .want = "more than 3 levels of nesting (the limit `nesting`)",
     .nesting = 3},
    {.name = "nesting through an alias, at the limit",
     .text = "[&a [1], [*a]]",
     .want = "((1) (*(1)))",
     .nesting = 3},
    {.name = "nesting through an alias, over the limit",
     .text = "[&a [1], [[*a]]]",
     .want = "more than 3 levels of nesting (the limit `nesting`)",
     .nesting = 3},
    {.name = "nesting through aliases of aliases",
     .text = "[&a [1], &b [*a], &c [*b]]",
     .want = "more than 3 levels of nesting (the limit `nesting`)",
     .nesting = 3},
    {.name = "values at the limit", .text = "[1, 2, 3]", .want = "(1 2 3)", .nodes = 4},
    {.name = "values over the limit",
     .text = "[1, 2, 3]",
     .want = "more than 3 values in one file (the limit `values`)",
     .nodes = 3},
    {.name = "values behind aliases, at the limit",
     .text = "[&a [1, 2], *a]",
     .want = "((1 2) *(1 2))",
     .nodes = 8},
    {.name = "values behind aliases, over the limit",
     .text = "[&a [1, 2], *a]",
     .want = "aliases make 8 values of this file, more than 7 (the limit `values`)",
     .nodes = 7},
    {.name = "a small bomb",
     .text = "[&a [1, 1], &b [*a, *a], &c [*b, *b], &d [*c, *c]]",
     .want = "aliases make 79 values of this file, more than 50 (the limit `values`)",
     .nodes = 50},

    {.name = "an empty file", .text = "", .want = "the file is empty"},
    {.name = "comments alone", .text = "# x\n", .want = "the file is empty"},
    {.name = "a document of nothing", .text = "---\n", .want = "the file is empty"},
    {.name = "null", .text = "null", .want = "the file is empty"},
    {.name = "a second document", .text = "a: 1\n---\nb: 2\n", .want = "a second document in the file"},
    {.name = "an empty second document", .text = "a: 1\n---\n", .want = "a second document in the file"},
    {.name = "an escaped zero", .text = "\"a\\0b\"", .want = "a text with the character NUL in it"},
    {.name = "not YAML", .text = "[1", .want = "did not find expected ',' or ']'"},
    {.name = "not UTF-8", .text = "\xff", .want = "invalid leading UTF-8 octet"},
};

static void check_row(void **state) {
    const struct row *row = *state;
    struct parsed p;
    parse(&p, row->text, strlen(row->text), row->nesting ? row->nesting : 20, row->nodes ? row->nodes : 100);
    assert_string_equal(p.text, row->want);
    assert_int_equal(p.root != NULL, p.diag.errors == 0 && !p.problem.text);
    parsed_free(&p);
}

/* ---- Spans ---- */

static struct where {
    const char *name, *text, *path; /* path: one digit for each step down, among children */
    unsigned line, column, length;
} wheres[] = {
    {"span: a key", "a: 1\nbcd: 22\n", "2", 1, 0, 3},
    {"span: its value", "a: 1\nbcd: 22\n", "3", 1, 5, 2},
    {"span: a quoted text has its quotes", "a: \"x y\"\n", "1", 0, 3, 5},
    {"span: a text over lines", "a: x\n  y\n", "1", 0, 3, 1},
    {"span: a flow collection", "a: [1, 2]\n", "1", 0, 3, 1},
    {"span: a block collection", "a:\n  b: 1\n", "1", 1, 2, 1},
    {"span: an alias", "[&abc 1, *abc]", "1", 0, 9, 4},
    {"span: a text without its anchor", "[&abc gold]", "0", 0, 6, 4},
    {"span: a text without its tag", "[!!str gold]", "0", 0, 7, 4},
    {"span: behind characters of many bytes", "{k\xc3\xb6nig: \xe7\x90\x83}", "1", 0, 8, 1},
    {"span: after carriage returns", "a: 1\r\nb: 2\r\n", "3", 1, 3, 1},
    {"span: what a merge key brought is where it was written", "[&a {x: 1}, {<<: *a}]", "11", 0, 8, 1},
};

static void check_where(void **state) {
    const struct where *row = *state;
    struct parsed p;
    parse(&p, row->text, strlen(row->text), 20, 100);
    const struct node *node = p.root;
    for (const char *step = row->path; *step; step++) {
        node = node->first;
        for (int i = *step - '0'; i > 0; i--) node = node->next;
    }
    assert_int_equal(node->span.line, row->line);
    assert_int_equal(node->span.column, row->column);
    assert_int_equal(node->span.length, row->length);
    parsed_free(&p);
}

static void null_is_a_key_without_a_value(void **state) {
    (void)state;
    struct parsed p;
    parse(&p, "[~, null, Null, NULL, '', '~', 'null', nul, 0, [], {}]", 54, 20, 100);
    int i = 0;
    for (const struct node *n = p.root->first; n; n = n->next, i++) assert_int_equal(node_is_null(n), i < 4);
    assert_int_equal(i, 11);
    parsed_free(&p);
}

/* ---- Bombs ---- */

static void many_merges_of_many_keys_end_early(void **state) {
    (void)state;
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    fputs("[&a {", out);
    for (int i = 0; i < 3000; i++) fprintf(out, "k%d: 1, ", i);
    fputs("}", out);
    for (int i = 0; i < 3000; i++) fputs(", {<<: *a}", out);
    fputs("]", out);
    fclose(out);
    struct parsed p;
    parse(&p, text, size, 20, 100 * 1000 * 1000);
    assert_null(p.root);
    assert_non_null(strstr(p.text, "merge keys (<<) have copied "));
    assert_true(p.arena.total < 64 << 20);
    parsed_free(&p);
    free(text);
}

/* libyaml compares each %TAG with all before it: 200,000 took it a minute. */
static void many_tag_directives_end_early(void **state) {
    (void)state;
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    for (int i = 0; i < 200000; i++) fprintf(out, "%%TAG !e%d! tag:x\n", i);
    fputs("---\na: 1\n", out);
    fclose(out);
    struct parsed p;
    parse(&p, text, size, 20, 1000000);
    assert_string_equal(p.text, "more than 100 times %TAG: a scene has no tags");
    parsed_free(&p);
    free(text);
}

/* An arena that is full in the middle of a text leaves nothing behind (the sanitizers tell). */
static void a_full_arena_leaves_by_its_jump(void **state) {
    (void)state;
    jmp_buf full;
    struct arena arena = {.limit = 300000, .on_full = &full};
    struct diagnostics diag = {0};
    struct node_problem problem = {0};
    char *text = calloc(400000, 1); /* long enough for a thread */
    for (size_t i = 0; i + 4 < 400000; i += 4) memcpy(text + i, "- a\n", 4);
    const struct source source = {"t", text, strlen(text)};
    const struct node_limits limits = {10, 1000000};
    if (setjmp(full) == 0) {
        node_parse(&arena, &diag, &source, &limits, NULL, &problem);
        fail_msg("the arena was never full");
    }
    assert_ptr_equal(arena.on_full, &full);
    arena_free(&arena);
    diag_free(&diag);
    free(text);
}

int main(void) {
    struct CMUnitTest tests[COUNT(rows) + COUNT(wheres)];
    size_t n = 0;
    for (size_t i = 0; i < COUNT(rows); i++)
        tests[n++] = (struct CMUnitTest){rows[i].name, check_row, NULL, NULL, &rows[i]};
    for (size_t i = 0; i < COUNT(wheres); i++)
        tests[n++] = (struct CMUnitTest){wheres[i].name, check_where, NULL, NULL, &wheres[i]};
    const struct CMUnitTest others[] = {
        cmocka_unit_test(null_is_a_key_without_a_value),
        cmocka_unit_test(many_merges_of_many_keys_end_early),
        cmocka_unit_test(many_tag_directives_end_early),
        cmocka_unit_test(a_full_arena_leaves_by_its_jump),
    };
    return cmocka_run_group_tests_name("rows", tests, NULL, NULL) +
           cmocka_run_group_tests_name("yaml", others, NULL, NULL);
}
