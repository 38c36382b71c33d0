/* The language explained, for people and for editors. */
#ifndef MONGE_LANG_MANUAL_H
#define MONGE_LANG_MANUAL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* The JSON Schema of scenes: grammar/scene.schema.json. Generated. */
extern const char lang_schema[];

/* Prints what there is to know of a kind, of a key in each of its kinds, of a function or a constant of
 * expressions; of the language as a whole for `language`, and lists for `functions` and `presets`. False,
 * with nothing printed: there is no such word. */
bool lang_help(const char *word, FILE *out);

/* A scene to begin with, as YAML; static. */
const char *lang_example(void);

/* The name of the kind of that number, in the order of the manual; NULL: there are no more. */
const char *lang_kind_name(size_t index);

/* The word of the language that was probably meant; NULL: none is near. */
const char *lang_help_nearest(const char *word);

#endif
