#include "lang/format.h"

#include <string.h>

#include "lang/layout.h"
#include "lang/node.h"
#include "lang/problem.h"

static bool is_yaml(struct arena *arena, struct diagnostics *diag, const struct source *source,
                    const struct lang_limits *limits) {
    const struct node_limits node_limits = {limits->nesting, limits->values};
    struct node_problem problem = {0};
    if (node_parse(arena, diag, source, &node_limits, NULL, &problem)) return true;
    if (problem.text) problem_report(diag, &problem);
    return false;
}

/* With line feeds for all line breaks that YAML takes for one. */
static const struct source *with_line_feeds(struct arena *arena, const struct source *source) {
    struct source *plain = arena_alloc(arena, sizeof *plain);
    char *text = arena_alloc(arena, source->size + 1);
    *plain = (struct source){source->name, text, 0};
    for (size_t i = 0; i < source->size;) {
        const size_t size = source_break(source, i);
        text[plain->size++] = size > 0 && size < 3 ? '\n' : source->text[i];
        i += size > 0 && size < 3 ? size : 1;
    }
    return plain;
}

/* LINE SEPARATOR and PARAGRAPH SEPARATOR, which end a line for some readers of YAML and not for others. */
static bool has_separator(struct diagnostics *diag, const struct source *source) {
    struct span span = {source, 0, 0, 1};
    for (size_t i = 0, size; i < source->size; i += size ? size : source_character(source, i)) {
        size = source_break(source, i);
        if (size == 3) {
            diag_help(diag,
                      diag_error(diag, span, "bad-character",
                                 "a line separator (U+2028) or paragraph separator (U+2029)"),
                      "remove it");
            return true;
        }
        span.line += size > 0;
        span.column = size > 0 ? 0 : span.column + 1;
    }
    return false;
}

char *format_text(struct arena *arena, struct diagnostics *diag, const struct source *source,
                  const struct lang_limits *limits, size_t *size) {
    if (!is_yaml(arena, diag, source, limits) || has_separator(diag, source)) return NULL;
    const struct source *plain = with_line_feeds(arena, source);
    const struct layout *layout = layout_read(arena, diag, plain);
    if (!layout) return NULL;
    char *text = layout_print(arena, layout, size);
    const struct source result = {source->name, text, *size};
    if (layout_same_events(arena, source, &result) && layout_same_comments(arena, plain, &result))
        return text;
    diag_failure(diag, "format-differs",
                 "%s: a mistake in Monge: the formatted text would not say the same; it is left as it is",
                 source->name);
    return NULL;
}
