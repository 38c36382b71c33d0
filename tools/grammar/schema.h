/* What the two layers of the schema share: schema.c says which. */
#ifndef GRAMMAR_SCHEMA_H
#define GRAMMAR_SCHEMA_H

#include "definition.h"
#include "emit.h"

/* {"$ref": ...} to one of the schema's definitions, as JSON. */
const char *reference_to(const char *definition);

/* The field `enum` with the words of a choice. */
void write_enum(struct emitter *j, const struct node *choices);

/* The definition plain_NAME of a kind: no word for a mapping, a list, a choice, true or false, except in
 * mappings that bring names in. */
void write_plain(struct emitter *j, const char *name, const struct node *kind);

#endif
