/* The definition of the language, grammar/language.yaml, as nodes. All texts live as long as the program. */
#ifndef GRAMMAR_DEFINITION_H
#define GRAMMAR_DEFINITION_H

#include <stdio.h>

#include "lang/node.h"

/* What everything is made of: language.yaml, functions.yaml, colors.yaml, types.yaml, and the presets. */
struct definition {
    const struct node *kinds;                 /* a mapping: names, each with a kind */
    const struct node *functions, *constants; /* mappings: names of expressions, each with what it is */
    const struct node *colors;                /* a mapping: names, each with "#rrggbb" */
    const struct node *types;                 /* a mapping: names, each with the JSON Schema of values */
    const struct source *presets;             /* scenes/presets.yaml */
};

/* Reads the definition in `folder`. Ends the program with a message and 2 when it is not right. */
struct definition definition_read(const char *folder);
void definition_free(void);

/* A text of YAML within the definition. */
const struct node *parse_text(const char *text);

/* ---- Fields of a kind or key. NULL: it has none. ---- */

const struct node *get(const struct node *mapping, const char *field);
const char *text_of(const struct node *mapping, const char *field);
bool is_true(const struct node *mapping, const char *field);
bool type_is(const struct node *key, const char *type);

/* The first pair of a kind's keys: for (k = keys_of(kind); k; k = k->next->next), k->text and k->next. */
const struct node *keys_of(const struct node *kind);

/* ---- For people ---- */

char *format(const char *text, ...) __attribute__((format(printf, 1, 2)));
const char *upper(const char *text); /* as in names of C */

/* What the value is: "a number", "list of object"; with links within the manual, as Markdown, or plain. */
const char *type_text(const struct node *key, bool links);

/* "over 0, scene units"; "" where everything goes. */
const char *range_text(const struct node *key);

/* A sequence of scalars: "[0, 0, 1]". */
const char *row_text(const struct node *row);

/* A default as people write it: `[0, 0, 1]`, `8`, `srgb`, or words for it. NULL: none. */
const char *default_text(const struct node *key);

/* ---- What is made of it ---- */

void write_header(FILE *out, const struct definition *language);
void write_tables(FILE *out, const struct definition *language);
void write_reference(FILE *out, const struct definition *language);
void write_schema(FILE *out, const struct definition *language);
void write_schema_source(FILE *out, const struct definition *language);

#endif
