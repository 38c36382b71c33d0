/* The library's face: what it tells of the scene language. */
#include "lang/manual.h"
#include "monge.h"

const char *monge_schema(void) { return lang_schema; }
const char *monge_example(void) { return lang_example(); }
bool monge_help(const char *word, FILE *out) { return lang_help(word, out); }
const char *monge_help_nearest(const char *word) { return lang_help_nearest(word); }
const char *monge_kind(size_t index) { return lang_kind_name(index); }
