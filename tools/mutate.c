/* The small ways to break a C source, and the source with one of them:
 *
 *     mutate draw SEED FILE...   all ways, in the order in which to try them, a line each:
 *                                FILE NUMBER LINE KIND BEFORE AFTER, with tabs between
 *     mutate make FILE NUMBER    the source, broken in this way, on standard output
 *
 * It knows tokens and brackets, nothing of types: some ways do not compile. Only what stands in braces is
 * broken, and numbers with a name, never comments, texts, directives, assertions and messages. Nor are sizes of
 * arrays in declarations, `type name[3], other[4]`: room for more changes nothing. */
#include <ctype.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_TOKENS = 20000, MAX_WAYS = 20000 };

struct token {
    const char *at;
    int length;
    enum { WORD, NUMBER, SIGN, TEXT } type;
    int match; /* of a bracket its other, by number; else -1 */
    int depth; /* of braces around */
};

/* One change: what stands from one place to another is replaced. */
struct way {
    const char *kind;
    const char *from, *to, *by;
    int by_length;
    const char *line, *line_end; /* all lines that it touches */
    uint64_t line_hash, kind_hash, hash;
    int number, round;
    double turn;
    const char *file;
};

static struct token tokens[MAX_TOKENS];
static int token_count;
static struct way ways[MAX_WAYS];
static int way_count;

static void fail(const char *what, const char *which) {
    fprintf(stderr, "mutate: %s: %s\n", which, what);
    exit(2);
}

/* ---- Tokens ---- */

static bool is_word(char c) { return isalnum((unsigned char)c) || c == '_'; }

static int sign_length(const char *at) {
    static const char *const signs[] = {"<<=", ">>=", "...", "->", "++", "--", "<<", ">>", "<=", ">=", "==",
                                        "!=",  "&&",  "||",  "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^="};
    for (size_t i = 0; i < sizeof signs / sizeof *signs; i++)
        if (!strncmp(at, signs[i], strlen(signs[i]))) return (int)strlen(signs[i]);
    return 1;
}

/* What is no token: blanks, comments, and directives with the lines that continue them. */
static const char *skip(const char *at, bool at_line_start) {
    for (;; at++) {
        if (*at == '\n') {
            at_line_start = true;
        } else if (at[0] == '/' && at[1] == '*') {
            at = strstr(at + 2, "*/") + 1;
        } else if ((at[0] == '/' && at[1] == '/') || (*at == '#' && at_line_start)) {
            while (at[1] && (at[1] != '\n' || *at == '\\')) at++;
        } else if (!isspace((unsigned char)*at)) {
            return at;
        }
    }
}

static const char *token_end(struct token *t) {
    const char *at = t->at;
    if (*at == '"' || *at == '\'') {
        t->type = TEXT;
        for (at++; *at != *t->at; at++) at += *at == '\\';
        return at + 1;
    }
    if (isdigit((unsigned char)*at) || (*at == '.' && isdigit((unsigned char)at[1]))) {
        t->type = NUMBER;
        while (is_word(*at) || *at == '.' || ((*at == '+' || *at == '-') && strchr("eEpP", at[-1]))) at++;
        return at;
    }
    t->type = is_word(*at) ? WORD : SIGN;
    if (t->type == SIGN) return at + sign_length(at);
    while (is_word(*at)) at++;
    return at;
}

static void tokenize(const char *text) {
    int open[100], depth = 0, braces = 0;
    token_count = 0;
    for (const char *at = skip(text, true); *at; at = skip(at, false)) {
        if (token_count >= MAX_TOKENS - 2 || depth >= 100) fail("too long", "source");
        struct token *t = &tokens[token_count];
        *t = (struct token){.at = at, .match = -1};
        at = token_end(t);
        t->length = (int)(at - t->at);
        if (t->type == SIGN && t->length == 1 && strchr("([{", *t->at)) open[depth++] = token_count;
        if (t->type == SIGN && t->length == 1 && strchr(")]}", *t->at) && depth > 0) {
            t->match = open[--depth];
            tokens[t->match].match = token_count;
        }
        braces -= t->length == 1 && *t->at == '}';
        t->depth = braces;
        braces += t->length == 1 && *t->at == '{';
        token_count++;
    }
    tokens[token_count] = (struct token){.at = text + strlen(text), .type = TEXT, .match = -1};
}

static bool is(int i, const char *text) {
    return i >= 0 && i < token_count && tokens[i].length == (int)strlen(text) &&
           !strncmp(tokens[i].at, text, strlen(text));
}

static bool is_one_of(int i, const char *const *texts) {
    for (; *texts; texts++)
        if (is(i, *texts)) return true;
    return false;
}

static const char *end_of(int i) { return tokens[i].at + tokens[i].length; }

/* ---- Ways ---- */

/* From one token to another, both changed too. */
static void add(const char *kind, int first, int last, const char *by, int by_length) {
    if (way_count == MAX_WAYS) fail("too many ways", kind);
    ways[way_count++] = (struct way){
        .kind = kind, .from = tokens[first].at, .to = end_of(last), .by = by, .by_length = by_length};
}

static void add_text(const char *kind, int first, int last, const char *by) {
    add(kind, first, last, by, (int)strlen(by));
}

static void add_copy(const char *kind, int first, int last, const char *before, int copy_first, int copy_last,
                     const char *after) {
    const int copied = (int)(end_of(copy_last) - tokens[copy_first].at);
    char *by = malloc(strlen(before) + (size_t)copied + strlen(after) + 1);
    const int length = sprintf(by, "%s%.*s%s", before, copied, tokens[copy_first].at, after);
    add(kind, first, last, by, length);
}

struct exchange {
    const char *kind, *what, *by;
};

static const struct exchange signs[] = {
    {"arithmetic", "+=", "-="}, {"arithmetic", "-=", "+="}, {"arithmetic", "*=", "/="},
    {"arithmetic", "/=", "*="}, {"arithmetic", "++", "--"}, {"arithmetic", "--", "++"},
    {"arithmetic", "<<", ">>"}, {"arithmetic", ">>", "<<"}, {"compare", "<", "<="},
    {"compare", "<=", "<"},     {"compare", ">", ">="},     {"compare", ">=", ">"},
    {"compare", "==", "!="},    {"compare", "!=", "=="},    {"logic", "&&", "||"},
    {"logic", "||", "&&"},
};

static const struct exchange binary_signs[] = {
    {"arithmetic", "+", "-"}, {"arithmetic", "-", "+"}, {"arithmetic", "*", "/"}, {"arithmetic", "/", "*"},
    {"arithmetic", "%", "*"}, {"arithmetic", "&", "|"}, {"arithmetic", "|", "&"},
};

static const struct exchange words[] = {
    {"constant", "true", "false"},
    {"constant", "false", "true"},
    {"name", "vec3_add", "vec3_sub"},
    {"name", "vec3_sub", "vec3_add"},
    {"name", "box3_upper", "box3_lower"},
    {"name", "box3_lower", "box3_upper"},
    {"name", "larger", "smaller"},
    {"name", "smaller", "larger"},
    {"name", "affine_point", "affine_direction"},
    {"name", "affine_direction", "affine_point"},
    {"name", "object_from_world", "world_from_object"},
    {"name", "world_from_object", "object_from_world"},
};

static const struct exchange members[] = {
    {"member", "x", "y"},     {"member", "y", "z"},     {"member", "z", "x"},
    {"member", "min", "max"}, {"member", "max", "min"},
};

static void exchange(int i, const struct exchange *table, size_t count) {
    for (size_t k = 0; k < count; k++)
        if (is(i, table[k].what)) add_text(table[k].kind, i, i, table[k].by);
}
#define EXCHANGE(i, table) exchange(i, table, sizeof(table) / sizeof *(table))

static const char *const keywords[] = {"return", "case", "else", "if",   "while",  "for",
                                       "switch", "do",   "goto", "void", "sizeof", NULL};

static bool ends_operand(int i) {
    return i >= 0 && (tokens[i].type == NUMBER || (tokens[i].type == WORD && !is_one_of(i, keywords)) ||
                      is(i, ")") || is(i, "]"));
}

/* The rank of a sign among those that bind operands; 0: it ends any expression. */
static int rank(int i) {
    static const char *const by_rank[][5] = {{"&&", "||"},
                                             {"==", "!="},
                                             {"<", "<=", ">", ">="},
                                             {"+", "-", "&", "|"},
                                             {"*", "/", "%", "<<", ">>"}};
    for (int k = 0; k < 5; k++)
        for (int j = 0; j < 5; j++)
            if (by_rank[k][j] && is(i, by_rank[k][j])) return k + 1;
    return 0;
}

/* The last token of what the binary sign takes on its right. */
static int operand_end(int sign) {
    int i = sign + 1;
    while (is(i, "-") || is(i, "!") || is(i, "*") || is(i, "&")) i++;
    for (; i < token_count; i++) {
        if (tokens[i].match > i) i = tokens[i].match;
        const bool ends = is(i + 1, ")") || is(i + 1, "]") || is(i + 1, "}") || is(i + 1, ",") ||
                          is(i + 1, ";") || is(i + 1, "?") || is(i + 1, ":");
        if (ends || (rank(i + 1) > 0 && rank(i + 1) <= rank(sign))) return i;
    }
    return sign;
}

static bool same_tokens(int a, int b, int count) {
    for (int i = 0; i < count; i++)
        if (tokens[a + i].length != tokens[b + i].length ||
            strncmp(tokens[a + i].at, tokens[b + i].at, (size_t)tokens[a + i].length))
            return false;
    return true;
}

/* `a < b ? a : b` and its like, which does not ask whether the two are equal. */
static bool is_choice(int sign) {
    const int question = operand_end(sign) + 1, right = question - sign - 1;
    if (rank(sign) != 3 || !is(question, "?")) return false;
    int colon = question + 1;
    while (!is(colon, ":") && !is(colon, ";")) colon++;
    int end = colon + 1;
    while (!is(end, ",") && !is(end, ";") && !is(end, ")")) end++;
    const int first = colon - question - 1, second = end - colon - 1;
    if (first <= sign && second == right && same_tokens(colon + 1, sign + 1, right))
        return same_tokens(question + 1, sign - first, first);
    return second <= sign && first == right && same_tokens(question + 1, sign + 1, right) &&
           same_tokens(colon + 1, sign - second, second);
}

static void change_sign(int i) {
    if (is_choice(i)) return;
    const bool binary = ends_operand(i - 1);
    EXCHANGE(i, signs);
    if (binary) EXCHANGE(i, binary_signs);
    if (binary && rank(i) > 0 && (rank(i) == 1 || rank(i) >= 4)) add("term", i, operand_end(i), "", 0);
    if (!binary && (is(i, "-") || is(i, "!"))) add("unary", i, i, "", 0);
}

static void change_number(int i) {
    char text[64], *end;
    snprintf(text, sizeof text, "%.*s", tokens[i].length, tokens[i].at);
    const double value = strtod(text, &end);
    char *by = malloc(64);
    if (value == 0.0 || value == 1.0)
        sprintf(by, "%s%s", value == 0.0 ? "1" : "0", strchr(text, '.') ? ".0" : "");
    else if (strchr(text, '.') || strchr(text, 'e') || strchr(text, 'p'))
        sprintf(by, "%.17g", 1.25 * value);
    else
        sprintf(by, "%.0f", value + 1.0);
    add_text("constant", i, i, by);
}

/* f(a, b, c): neighbours in each other's place. */
static void swap_arguments(int open) {
    int first = open + 1, comma = -1;
    for (int i = open + 1; i <= tokens[open].match; i++) {
        if (i < tokens[open].match && tokens[i].match > i) i = tokens[i].match;
        if (!is(i, ",") && i != tokens[open].match) continue;
        if (comma >= 0) {
            char *by = malloc((size_t)(tokens[i].at - tokens[first].at) + 3);
            const int length =
                sprintf(by, "%.*s, %.*s", (int)(end_of(i - 1) - tokens[comma + 1].at), tokens[comma + 1].at,
                        (int)(end_of(comma - 1) - tokens[first].at), tokens[first].at);
            add("swap", first, i - 1, by, length);
            first = comma + 1;
        }
        comma = i;
    }
}

/* The arguments of a sum, a product or the larger of two would change places for nothing. */
static void change_word(int i) {
    static const char *const unwrapped[] = {"sqrt",     "fabs",           "floor",    "vec3_neg",
                                            "vec3_abs", "vec3_normalize", "isfinite", NULL};
    static const char *const commutative[] = {"vec3_add",   "vec3_mul", "vec3_dot", "box3_upper",
                                              "box3_lower", "larger",   "smaller",  "times", NULL};
    EXCHANGE(i, words);
    if (is(i - 1, ".") || is(i - 1, "->")) EXCHANGE(i, members);
    if (!is(i + 1, "(")) return;
    if (is_one_of(i, unwrapped)) add("unwrap", i, i, "", 0);
    if (is(i, "if") || is(i, "while"))
        add_copy("negate", i + 1, tokens[i + 1].match, "(!", i + 1, tokens[i + 1].match, ")");
    else if (!is_one_of(i, keywords) && !is_one_of(i, commutative))
        swap_arguments(i + 1);
}

/* An assignment or a call; a jump under a condition. */
static void delete_statement(int i) {
    static const char *const before[] = {";", "{", "}", ")", "else", NULL};
    static const char *const second[] = {"(", "=", ".", "->", "[", "+=", "-=", "*=", "/=", "++", "--", NULL};
    static const char *const jumps[] = {"return", "break", "continue", NULL};
    if (!is_one_of(i - 1, before)) return;
    const bool jump = is(i - 1, ")") && is_one_of(i, jumps);
    const bool statement = (tokens[i].type == WORD && !is_one_of(i, keywords) && is_one_of(i + 1, second)) ||
                           (is(i, "*") && !is(i - 1, ")"));
    if (!jump && !statement) return;
    for (int end = i; end < token_count && !is(end, ")") && !is(end, "}"); end++) {
        if (tokens[end].match > end) end = tokens[end].match;
        if (is(end + 1, ";")) {
            add("delete", i, end, "", 0);
            return;
        }
    }
}

/* Whether the comma before a name lies between declarators: its statement begins with two words, or a word and `*`. */
static bool separates_declarators(int comma) {
    int i = comma - 1;
    for (; i >= 0 && !is(i, ";") && !is(i, "(") && !is(i, "{"); i--) {
        if (is(i, "}") && !is(i + 1, ",")) break; /* of a block; that of an initializer has a comma behind it */
        if (tokens[i].match >= 0) i = tokens[i].match;
    }
    return tokens[i + 1].type == WORD && (tokens[i + 2].type == WORD || is(i + 2, "*"));
}

/* Of an array that is declared: `type name[3][4], other[5]`. */
static bool is_array_size(int i) {
    if (!is(i - 1, "[")) return false;
    for (i -= 2; is(i, "]"); i--) i = tokens[i].match;
    return tokens[i].type == WORD && (tokens[i - 1].type == WORD || is(i - 1, "*") ||
                                      (is(i - 1, ",") && separates_declarators(i - 1)));
}

/* An assertion, or the words of a message. */
static bool is_said(int i) {
    return is(i + 1, "(") && (is(i, "assert") || !strncmp(tokens[i].at, "diag_", 5));
}

static void find_ways(const char *text) {
    way_count = 0;
    tokenize(text);
    for (int i = 0; i < token_count; i++) {
        const bool inside = tokens[i].depth > 0;
        if (inside) delete_statement(i);
        if (is_said(i)) i = tokens[i + 1].match;
        if (tokens[i].type == NUMBER && (inside ? !is_array_size(i) : is(i - 1, "="))) change_number(i);
        if (tokens[i].type == SIGN && inside) change_sign(i);
        if (tokens[i].type == WORD && inside) change_word(i);
    }
}

/* ---- What they are called, and their order ---- */

static uint64_t hash_bytes(uint64_t hash, const char *bytes, size_t count) {
    for (size_t i = 0; i < count; i++) hash = (hash ^ (unsigned char)bytes[i]) * 0x100000001b3u;
    hash ^= hash >> 32;
    return hash * 0x9e3779b97f4a7c15u;
}

static void find_lines(struct way *way, const char *text) {
    way->line = way->from;
    while (way->line > text && way->line[-1] != '\n') way->line--;
    way->line_end = way->to + strcspn(way->to, "\n");
}

/* By the words of its line, so that a line moved by others keeps its ways. */
static void find_hashes(struct way *way, const char *seed) {
    uint64_t hash = hash_bytes(0xcbf29ce484222325u, seed, strlen(seed));
    hash = hash_bytes(hash, way->file, strlen(way->file));
    way->line_hash = hash_bytes(hash, way->line, (size_t)(way->line_end - way->line));
    way->kind_hash = hash_bytes(way->line_hash, way->kind, strlen(way->kind));
    const long place[] = {way->from - way->line, way->to - way->line};
    way->hash = hash_bytes(way->kind_hash, (const char *)place, sizeof place);
    way->hash = hash_bytes(way->hash, way->by, (size_t)way->by_length);
}

#define ORDER(a, b) ((a) > (b)) - ((a) < (b))

/* Within a line a kind first, then a place: what there is much of is not drawn more. */
static int by_line(const void *a, const void *b) {
    const struct way *x = a, *y = b;
    if (x->line != y->line) return ORDER(x->line, y->line);
    return x->kind_hash != y->kind_hash ? ORDER(x->kind_hash, y->kind_hash) : ORDER(x->hash, y->hash);
}

static int by_round(const void *a, const void *b) {
    const struct way *x = a, *y = b;
    if (x->round != y->round) return ORDER(x->round, y->round);
    return x->line_hash != y->line_hash ? ORDER(x->line_hash, y->line_hash) : ORDER(x->number, y->number);
}

static int by_turn(const void *a, const void *b) {
    const struct way *x = a, *y = b;
    return x->turn != y->turn ? ORDER(x->turn, y->turn) : strcmp(x->file, y->file);
}

/* A way in each line of each file, spread evenly over the files, then a second one, and so on. */
static void order_file(struct way *first, int count) {
    int lines = 0;
    qsort(first, (size_t)count, sizeof *first, by_line);
    for (int i = 0; i < count; i++) {
        first[i].round = i && first[i].line == first[i - 1].line ? first[i - 1].round + 1 : 0;
        lines += first[i].round == 0;
    }
    qsort(first, (size_t)count, sizeof *first, by_round);
    for (int i = 0; i < count; i++) first[i].turn = (i + 0.5) / lines;
}

/* Code without its comments, each blank or run of them as one space, none at the end unless there is more. */
static void print_code(const char *from, const char *to, bool more) {
    bool blank = false;
    for (const char *at = from; at < to; at++) {
        const bool comment = at[0] == '/' && at[1] == '*';
        if (comment) {
            const char *end = strstr(at + 2, "*/");
            at = end ? end + 1 : to;
        }
        if (comment || isspace((unsigned char)*at)) {
            blank = true;
            continue;
        }
        if (blank) putchar(' ');
        blank = false;
        putchar(*at);
    }
    if (blank && more) putchar(' ');
}

static const char *trimmed(const char *from) { return from + strspn(from, " \t"); }

static void print_way(const struct way *way, const char *text) {
    int line = 1;
    for (const char *at = text; at < way->line; at++) line += *at == '\n';
    printf("%s\t%d\t%d\t%s\t", way->file, way->number, line, way->kind);
    print_code(trimmed(way->line), way->line_end, false);
    putchar('\t');
    print_code(trimmed(way->line), way->from, true);
    print_code(way->by, way->by + way->by_length, true);
    print_code(way->to, way->line_end, false);
    putchar('\n');
}

/* The whole file, with zeros on both sides; never freed. */
static char *read_file(const char *path) {
    enum { ROOM = 1 << 20 };
    FILE *file = fopen(path, "r");
    char *text = calloc(1, ROOM + 2);
    if (!file || !text || fread(text + 1, 1, ROOM, file) == ROOM) fail("cannot be read", path);
    fclose(file);
    return text + 1;
}

static void make(const char *path, int number) {
    const char *text = read_file(path);
    find_ways(text);
    if (number < 0 || number >= way_count) fail("has no such way", path);
    const struct way *way = &ways[number];
    printf("#line 1 \"%s\"\n%.*s%.*s%s", path, (int)(way->from - text), text, way->by_length, way->by,
           way->to);
}

static void draw(const char *seed, char **files, int count) {
    struct way *all = malloc(MAX_WAYS * sizeof *all);
    char *texts[100];
    int total = 0;
    for (int k = 0; k < count && k < 100; k++) {
        texts[k] = read_file(files[k]);
        find_ways(texts[k]);
        if (total + way_count > MAX_WAYS) fail("too many ways", files[k]);
        for (int i = 0; i < way_count; i++) {
            ways[i].file = files[k];
            ways[i].number = i;
            find_lines(&ways[i], texts[k]);
            find_hashes(&ways[i], seed);
        }
        memcpy(all + total, ways, (size_t)way_count * sizeof *ways);
        order_file(all + total, way_count);
        total += way_count;
    }
    qsort(all, (size_t)total, sizeof *all, by_turn);
    for (int i = 0; i < total; i++) {
        int k = 0;
        while (files[k] != all[i].file) k++;
        print_way(&all[i], texts[k]);
    }
}

int main(int argc, char **argv) {
    if (argc > 3 && !strcmp(argv[1], "draw")) {
        draw(argv[2], argv + 3, argc - 3);
    } else if (argc == 4 && !strcmp(argv[1], "make")) {
        make(argv[2], atoi(argv[3]));
    } else {
        fprintf(stderr, "usage: mutate draw SEED FILE... | mutate make FILE NUMBER\n");
        return 2;
    }
    return 0;
}
