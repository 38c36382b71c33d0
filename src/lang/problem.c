#include "lang/problem.h"

#include <ctype.h>
#include <string.h>

/* ---- What libyaml says, in the words of somebody who writes scenes ---- */

enum remedy {
    AT_PROBLEM, /* where libyaml stopped */
    AT_CONTEXT, /* where what it was reading begins */
    BRACKET,    /* as AT_PROBLEM, with the bracket that opened; AT_CONTEXT at the end of the file */
    INDENT,     /* a line that does not fit those before it */
    COLON,      /* a second `:`, or a line before it that lacks one */
    TOKEN,      /* a character that cannot be there */
    START,      /* no start of a document */
};

#define NO_UTF8 AT_PROBLEM, "this is not UTF-8 text", "save the file as UTF-8"
#define NO_TAG  "a scene has no tags", "remove what starts with `!`"
#define NO_DIRECTIVE                                                                                         \
    "a line that starts with % is a directive to YAML, and this one is wrong",                               \
        "a scene needs none: remove the line"
#define NO_ALIAS     "an alias without a name"
#define MISSING      "a value is missing here"
#define NO_QUOTE_END AT_CONTEXT, "this quote is never closed", "close it"

/* The first row whose words are in libyaml's message is taken; NULL stands for any. */
static const struct row {
    const char *context, *problem;
    enum remedy remedy;
    const char *message, *help;
} yaml_problems[] = {
    {NULL, "leading UTF-8", NO_UTF8},
    {NULL, "trailing UTF-8", NO_UTF8},
    {NULL, "UTF-8 sequence", NO_UTF8},
    {NULL, "incomplete UTF-8", NO_UTF8},
    {NULL, "invalid Unicode character", NO_UTF8},
    {NULL, "control characters are not", AT_PROBLEM, "a control character", "remove it"},
    {"directive", NULL, AT_CONTEXT, NO_DIRECTIVE},
    {NULL, "duplicate %", AT_PROBLEM, NO_DIRECTIVE},
    {NULL, "undefined tag handle", AT_PROBLEM, NO_TAG},
    {"a tag", NULL, AT_CONTEXT, NO_TAG},
    {NULL, "incompatible YAML", AT_PROBLEM, "a version of YAML that is not known here",
     "a scene needs no such line: remove it"},
    {"anchor", NULL, AT_CONTEXT, "an anchor without a name",
     "as in `&gold`, of letters, digits, - and _; `&` in a text needs quotes around it"},
    {"alias", NULL, AT_CONTEXT, NO_ALIAS,
     "as in `*gold`, of letters, digits, - and _; `*` in a text needs quotes around it"},
    {"quoted scalar", "end of stream", NO_QUOTE_END},
    {"quoted scalar", "document indicator", NO_QUOTE_END},
    {"quoted scalar", "unknown escape", AT_PROBLEM, "a backslash with a letter that means nothing",
     "write `\\\\` for a backslash, or put the text into single quotes"},
    {"quoted scalar", NULL, AT_PROBLEM,
     "`\\x`, `\\u` and `\\U` take 2, 4 and 8 hexadecimal digits of a character",
     "write `\\\\` for a backslash"},
    {"block scalar", "tab", AT_PROBLEM, "a tab in the indentation", "YAML indents with spaces"},
    {"block scalar", NULL, AT_CONTEXT, "after `|` or `>` the text begins on the next line",
     "a text of one line needs neither"},
    {"flow sequence", NULL, BRACKET, "a list in [ ] that is not closed, or lacks a comma", "add `]` or `,`"},
    {"flow mapping", NULL, BRACKET, "a mapping in { } that is not closed, or lacks a comma",
     "add `}` or `,`"},
    {"plain scalar", "':'", AT_PROBLEM, "a `:` without a value, or without a space before it",
     "write `key: value`"},
    {NULL, "a tab character", TOKEN, NULL, NULL},
    {NULL, "cannot start any token", TOKEN, NULL, NULL},
    {NULL, "find expected ':'", AT_CONTEXT, "a key without a `:`",
     "a key and its value are written `key: value`, the key on one line"},
    {NULL, "mapping values", COLON, NULL, NULL},
    {NULL, "block sequence entries", AT_PROBLEM, "a list cannot begin here",
     "write its first `- ` on a line of its own"},
    {NULL, "mapping keys", AT_PROBLEM, "a `?` where no key can stand", "remove it, or quote the text"},
    {"block mapping", NULL, INDENT, NULL, NULL},
    {"block collection", NULL, INDENT, NULL, NULL},
    {NULL, "<document start>", START, NULL, NULL},
    {NULL, "node content", AT_PROBLEM, MISSING, "give it one, or remove the comma"},
};

static const struct row *find_row(const struct node_problem *p) {
    for (size_t i = 0; i < sizeof yaml_problems / sizeof *yaml_problems; i++) {
        const struct row *row = &yaml_problems[i];
        if ((!row->context || strstr(p->context, row->context)) &&
            (!row->problem || strstr(p->text, row->problem)))
            return row;
    }
    return NULL;
}

/* ---- The lines around ---- */

struct report {
    struct diagnostics *diag;
    const struct source *source;
    const struct node_problem *p;
};

/* The character at the span, and a final zero; empty at the end of the line. */
static void character_at(const struct report *r, struct span span, char text[8]) {
    const size_t at = source_offset(span), bytes = at < r->source->size ? source_character(r->source, at) : 0;
    const bool some = bytes > 0 && bytes < 8 && !source_break(r->source, at);
    if (some) memcpy(text, r->source->text + at, bytes);
    text[some ? bytes : 0] = '\0';
}

/* What cannot be seen at the start of a line, or NULL. */
static const char *invisible_start(const struct report *r, uint32_t line) {
    static const char *const marks[][2] = {{"\xef\xbb\xbf", "a byte order mark (U+FEFF)"},
                                           {"\xc2\xa0", "a non-breaking space (U+00A0)"},
                                           {"\xe2\x80\x8b", "a zero-width space (U+200B)"},
                                           {"\xe3\x80\x80", "an ideographic space (U+3000)"}};
    size_t end, begin = source_line(r->source, line, &end);
    while (begin < end && r->source->text[begin] == ' ') begin++;
    for (size_t i = 0; i < sizeof marks / sizeof *marks; i++)
        if (end - begin >= 3 && memcmp(r->source->text + begin, marks[i][0], strlen(marks[i][0])) == 0)
            return marks[i][1];
    return NULL;
}

/* The level of the same sort as `own` whose column is nearest, the deeper of two; NULL: none. */
static const struct source_level *nearest_level(const struct source_level *levels, int count,
                                                struct source_level own) {
    const struct source_level *best = NULL;
    uint32_t least = UINT32_MAX;
    for (int i = 0; i < count; i++) {
        const uint32_t c = levels[i].column, distance = c > own.column ? c - own.column : own.column - c;
        if (levels[i].dash != own.dash || distance > least) continue;
        best = &levels[i];
        least = distance;
    }
    return best;
}

/* The key of that column, which is there. */
static struct source_level level_at(const struct source_level *levels, int count, uint32_t column) {
    int i = 0;
    while (i < count - 1 && (levels[i].column != column || levels[i].dash)) i++;
    return levels[i];
}

static bool has_level(const struct source_level *levels, int count, struct source_level like) {
    for (int i = 0; i < count; i++)
        if (levels[i].column == like.column && levels[i].dash == like.dash) return true;
    return false;
}

/* `-sphere:` is a key to YAML. The help for it. */
static bool help_dash(const struct report *r, struct diagnostic *d, struct source_level level) {
    size_t end;
    const size_t i = source_line(r->source, level.line, &end) + level.column;
    if (level.dash || i + 1 >= end || r->source->text[i] != '-' ||
        !isalpha((unsigned char)r->source->text[i + 1]))
        return false;
    size_t stop = i + 1;
    while (stop < end && !strchr(" :", r->source->text[stop])) stop++;
    const char *which = level.line == d->place.line - 1 ? "" : " of the item above";
    diag_help(r->diag, d, "a space after the dash%s: write `- %.*s`", which, (int)(stop - i - 1),
              r->source->text + i + 1);
    return true;
}

/* A line whose first key or dash stands in a column of its own. False when that is not what is wrong. */
static bool report_indent(const struct report *r, uint32_t line) {
    struct source_level own[SOURCE_MAX_LEVELS], levels[SOURCE_MAX_LEVELS];
    if (source_line_levels(r->source, line, own) == 0) return false;
    const int count = source_open_levels(r->source, line, levels);
    const struct span at = {r->source, line, own[0].column, 1};
    const struct source_level *sibling = nearest_level(levels, count, own[0]);
    if (has_level(levels, count, (struct source_level){.column = own[0].column, .dash = !own[0].dash})) {
        struct diagnostic *d = diag_error(r->diag, at, "bad-indentation",
                                          own[0].dash ? "a list item among keys" : "a key among list items");
        const struct source_level other = own[0].dash ? level_at(levels, count, own[0].column) : own[0];
        if (!help_dash(r, d, other))
            diag_help(r->diag, d,
                      own[0].dash ? "remove the `- `" : "start it with `- `, or indent it into an item");
        return true;
    }
    if (!sibling || sibling->column == own[0].column) return false;
    const char *what = own[0].dash ? "list item" : "key";
    struct diagnostic *d =
        diag_error(r->diag, at, "bad-indentation", "this %s starts in column %u, its siblings in column %u",
                   what, (unsigned)own[0].column + 1, (unsigned)sibling->column + 1);
    if (sibling->column == 0)
        diag_help(r->diag, d, "do not indent it");
    else
        diag_help(r->diag, d, "indent it by %u space%s", (unsigned)sibling->column,
                  sibling->column == 1 ? "" : "s");
    diag_related(r->diag, d, (struct span){r->source, sibling->line, sibling->column, 1},
                 "a sibling starts in column %u", (unsigned)sibling->column + 1);
    return true;
}

/* Something behind a value that has ended. */
static void report_rest(const struct report *r, struct span at) {
    char found[8];
    character_at(r, at, found);
    const struct span q = r->p->quoted_at;
    if (strchr("]}", found[0]) && *found)
        diag_help(r->diag, diag_error(r->diag, at, "unopened-bracket", "a `%s` that nothing opened", found),
                  "remove it, or open it with `%s`", *found == ']' ? "[" : "{");
    else if (q.source && r->p->quoted_end.line == at.line && r->p->quoted_end.column <= at.column) {
        struct diagnostic *d =
            diag_error(r->diag, at, "after-quote", "something behind the closing quote of a text");
        if (q.line == at.line)
            diag_help(r->diag, d, "put all of the text into the quotes, and `\\` before a `\"` within");
        else
            diag_help(r->diag, d, "the text began on line %u: is it closed where it should be?",
                      (unsigned)q.line + 1);
        diag_related(r->diag, d, q, "the text opens here");
    } else
        diag_help(r->diag, diag_error(r->diag, at, "after-value", "something behind a value that has ended"),
                  "remove it, or quote the whole value");
}

static bool report_invisible(const struct report *r, uint32_t line) {
    const char *invisible = invisible_start(r, line);
    if (!invisible) return false;
    diag_help(r->diag,
              diag_error(r->diag, (struct span){r->source, line, 0, 1}, "bad-character",
                         "the line begins with %s", invisible),
              "remove it; YAML indents with spaces");
    return true;
}

/* The line has a `:` that cannot be: its key began on a line before, or is a value itself. */
static void report_colon(const struct report *r, struct span at) {
    struct source_level own[SOURCE_MAX_LEVELS], before[SOURCE_MAX_LEVELS];
    const int here = source_line_levels(r->source, at.line, own),
              count = source_open_levels(r->source, at.line, before);
    const struct source_level *last = count > 0 ? &before[count - 1] : NULL;
    size_t end, i = last ? source_line(r->source, last->line, &end) + last->column : 0;
    const char *text = r->source->text, *colon = last ? memchr(text + i, ':', end - i) : NULL;
    const size_t begin = source_offset((struct span){r->source, at.line, here ? own[here - 1].column : 0, 1});
    const bool second = memmem(text + begin, source_offset(at) - begin, ": ", 2) != NULL;
    if (second || !last || last->dash) {
        diag_help(r->diag, diag_error(r->diag, at, "colon-in-value", "a `: ` within a value"),
                  "quote the whole value");
    } else if (!colon) {
        diag_help(r->diag,
                  diag_error(r->diag, (struct span){r->source, last->line, last->column, 1}, "no-colon",
                             "a key without a `:`"),
                  "a key and its value are written `key: value`");
    } else if (colon + 1 < text + end && colon[1] != ' ') {
        diag_help(r->diag,
                  diag_error(r->diag, (struct span){r->source, last->line, last->column, 1},
                             "no-space-after-colon", "a `:` without a space after it"),
                  "write `key: value`");
    } else if (!report_indent(r, at.line)) {
        diag_help(r->diag, diag_error(r->diag, at, "misplaced-colon", "a `:` where no key can stand"),
                  "check the indentation, or quote the text");
    }
}

static void report_token(const struct report *r, struct span at) {
    char found[8];
    struct source_level levels[SOURCE_MAX_LEVELS];
    character_at(r, at, found);
    if (*found != '\t') {
        const char *what = *found == '`' ? "a backtick" : found;
        diag_help(r->diag,
                  diag_error(r->diag, at, "bad-start-of-value", "a value cannot start with %s", what),
                  "quote the text");
        return;
    }
    struct diagnostic *d = diag_error(r->diag, at, "tab-in-indentation", "a tab in the indentation");
    const int count = source_open_levels(r->source, at.line, levels);
    const struct source_level *last = count > 0 ? &levels[count - 1] : NULL;
    if (last && last->column > 0)
        diag_help(r->diag, d, "YAML indents with spaces; line %u has %u", (unsigned)last->line + 1,
                  (unsigned)last->column);
    else
        diag_help(r->diag, d, "YAML indents with spaces, two for each level");
}

static void report_start(const struct report *r, struct span at) {
    const bool directive = r->source->text[0] == '%';
    struct diagnostic *d =
        diag_error(r->diag, at, "bad-document",
                   directive ? "a scene cannot begin here" : "this does not belong to the scene before it");
    diag_help(r->diag, d,
              directive ? "remove the lines that start with %%, or put a line `---` after them"
                        : "remove it, or what ends the scene above it");
}

/* ---- What is no slip of YAML's grammar ---- */

static bool starts_with(const struct source *source, const char *bytes, size_t count) {
    return source->size >= count && memcmp(source->text, bytes, count) == 0;
}

/* A picture, a program: told as such, whichever of its bytes came first. */
static bool report_binary(const struct report *r) {
    static const char *const starts[][2] = {{"\x89PNG", "a PNG picture"},
                                            {"\xff\xd8\xff", "a JPEG picture"},
                                            {"GIF8", "a GIF picture"},
                                            {"%PDF", "a PDF document"},
                                            {"PK\x03\x04", "a zip archive"},
                                            {"\x1f\x8b", "a compressed file"},
                                            {"\x7f"
                                             "ELF",
                                             "a program"}};
    const struct source *source = r->source;
    const char *what = NULL;
    for (size_t i = 0; i < sizeof starts / sizeof *starts; i++)
        if (starts_with(source, starts[i][0], strlen(starts[i][0]))) what = starts[i][1];
    const bool wide = starts_with(source, "\xff\xfe", 2) || starts_with(source, "\xfe\xff", 2); /* UTF-16 */
    int zeros = 0;
    for (size_t i = 0; i < source->size && i < 512; i++) zeros += source->text[i] == '\0';
    if (!what && !wide && zeros >= 4) what = "a binary file";
    if (!what) return false;
    struct diagnostic *d =
        diag_error(r->diag, (struct span){source, 0, 0, 1}, "not-yaml", "this is %s, no scene", what);
    diag_help(r->diag, d, "a scene is text in YAML; is it the right file?");
    return true;
}

/* The digits of a colour in hexadecimal at text[i], or 0. */
static size_t hex_color(const char *text, size_t i, size_t end) {
    size_t n = i;
    while (n < end && isxdigit((unsigned char)text[n])) n++;
    const bool ends = n == end || strchr(" ,]}\r\n", text[n]);
    return ends && (n - i == 3 || n - i == 6) ? n - i : 0;
}

/* In `{diffuse: #ff0000}` the rest of the line is a comment, with its bracket. */
static bool report_hash_in(const struct report *r, uint32_t line) {
    size_t end;
    const size_t begin = source_line(r->source, line, &end);
    const char *text = r->source->text;
    char quote = '\0';
    bool open = false;
    uint32_t column = 0;
    for (size_t i = begin; i < end; i += source_character(r->source, i), column++) {
        if (quote || text[i] == '"' || text[i] == '\'') {
            if (!quote)
                quote = text[i];
            else if (text[i] == quote)
                quote = '\0';
            continue;
        }
        open |= text[i] == '{' || text[i] == '[';
        if (text[i] != '#' || i == begin || text[i - 1] != ' ') continue;
        const size_t digits = open ? hex_color(text, i + 1, end) : 0;
        if (digits == 0) return false;
        struct diagnostic *d =
            diag_error(r->diag, (struct span){r->source, line, column, (uint32_t)digits + 1}, "not-yaml",
                       "a `#` after a space starts a comment: the rest of the line is lost");
        diag_help(r->diag, d, "quote the colour: \"%.*s\"", (int)digits + 1, text + i);
        return true;
    }
    return false;
}

static bool report_hash(const struct report *r) {
    enum { LINES = 20 }; /* that an open bracket is looked for */
    const uint32_t last = r->p->at.line;
    for (uint32_t line = last > LINES ? last - LINES : 0; line <= last; line++)
        if (report_hash_in(r, line)) return true;
    return false;
}

/* Where a value begins on its line that goes on at `at`; `at` itself: nothing of it stands before. */
static size_t value_begin(const char *text, size_t line, size_t at) {
    size_t i = at;
    for (int depth = text[at] == ')'; i > line; i--) {
        const char c = text[i - 1];
        if (depth == 0 && (strchr(",[{", c) || (c == ':' && text[i] == ' '))) break;
        depth += c == ')' || c == ']' ? 1 : (c == '(' || c == '[') && depth > 0 ? -1 : 0;
    }
    while (text[i] == ' ') i++;
    return i < at ? i : at;
}

/* Where it ends; `begin`: not on its line. */
static size_t value_end(const char *text, size_t begin, size_t line_end) {
    size_t i = begin;
    int depth = 0;
    for (; i < line_end; i++) {
        if (depth == 0 && strchr(",]}", text[i])) break;
        depth += strchr("([{", text[i]) ? 1 : strchr(")]}", text[i]) ? -1 : 0;
    }
    while (i > begin && text[i - 1] == ' ') i--;
    return depth == 0 ? i : begin;
}

/* In `{eye: last * [1, 2, 3]}` a bracket stands within a value, in `[1, 2, 3] * last` what is an alias to YAML. */
static bool report_bracket_within(const struct report *r, struct span at) {
    const char *text = r->source->text;
    size_t stop;
    const size_t line = source_line(r->source, at.line, &stop), i = source_offset(at);
    if (i >= stop || !strchr("[{)*", text[i])) return false;
    const size_t begin = value_begin(text, line, i), end = value_end(text, begin, stop);
    if (begin == i || memchr(text + begin, '"', end - begin)) return false;
    struct diagnostic *d =
        diag_error(r->diag, at, "not-yaml", "a `%c` within a value that has begun before it", text[i]);
    if (end == begin)
        diag_help(r->diag, d, "put the whole value into quotes");
    else
        diag_help(r->diag, d, "put the value into quotes: \"%.*s\"", (int)(end - begin), text + begin);
    return true;
}

/* ---- The report ---- */

static void report_bracket(const struct report *r, const struct row *row) {
    const struct span at = r->p->at, opened = r->p->context_at;
    char bracket[8];
    character_at(r, opened, bracket);
    if (source_offset(at) >= r->source->size) {
        diag_help(r->diag,
                  diag_error(r->diag, opened, "unclosed-bracket", "this `%s` is never closed", bracket),
                  "add `%s`", *bracket == '[' ? "]" : "}");
        return;
    }
    if (report_bracket_within(r, at)) return;
    char found[8];
    character_at(r, at, found);
    struct diagnostic *d = diag_error(r->diag, at, "not-yaml", "%s", row->message);
    size_t end;
    source_line(r->source, opened.line, &end);
    const bool filled =
        source_offset(opened) + 1 < end; /* something stands behind the bracket: its line may be all of it */
    if (*found == ':' && at.line != opened.line && filled)
        diag_help(r->diag, d, "close the `%s` with `%s`, or add `,` before this key", bracket,
                  *bracket == '[' ? "]" : "}");
    else
        diag_help(r->diag, d, "%s", *found == ':' ? "add `,` before this key" : row->help);
    diag_related(r->diag, d, opened, "`%s` opens here", bracket);
}

static bool report_line(const struct report *r) {
    struct source_level own[SOURCE_MAX_LEVELS];
    return source_line_levels(r->source, r->p->at.line, own) > 0 && own[0].column == r->p->at.column &&
           report_indent(r, r->p->at.line);
}

void problem_report(struct diagnostics *diag, const struct node_problem *problem) {
    const struct report report = {diag, problem->at.source, problem}, *r = &report;
    const struct row *row = find_row(problem);
    if (report_binary(r) || report_invisible(r, problem->at.line)) return;
    const bool within =
        row && (row->remedy == BRACKET || strcmp(row->message ? row->message : "", MISSING) == 0);
    if (within && report_hash(r)) return;
    if (row && row->message && strcmp(row->message, NO_ALIAS) == 0 &&
        report_bracket_within(r, problem->context_at))
        return;
    switch (row ? row->remedy : AT_PROBLEM) {
    case BRACKET: report_bracket(r, row); return;
    case COLON: report_colon(r, problem->at); return;
    case TOKEN: report_token(r, problem->at); return;
    case START: report_start(r, problem->at); return;
    case INDENT:
        if (!report_line(r)) report_rest(r, problem->at);
        return;
    case AT_PROBLEM:
    case AT_CONTEXT: break;
    }
    const struct span at = row && row->remedy == AT_CONTEXT ? problem->context_at : problem->at;
    struct diagnostic *d = diag_error(diag, at, "not-yaml", "%s", row ? row->message : problem->text);
    if (row) diag_help(diag, d, "%s", row->help);
}
