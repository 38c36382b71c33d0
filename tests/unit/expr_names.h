/* A scope for expressions: n 3, depth 4, v [1, 2, 3], w [10, 20], zero 0; steel is no quantity, later is not known yet. */
#ifndef MONGE_TESTS_EXPR_NAMES_H
#define MONGE_TESTS_EXPR_NAMES_H

#include <string.h>

#include "lang/expr.h"
#include "near.h"

static const struct known {
    const char *name;
    enum expr_found found;
    struct quantity value;
} known[] = {
    {"n", EXPR_FOUND, {1, {3}}},      {"depth", EXPR_FOUND, {1, {4}}}, {"v", EXPR_FOUND, {3, {1, 2, 3}}},
    {"w", EXPR_FOUND, {2, {10, 20}}}, {"zero", EXPR_FOUND, {1, {0}}},  {"steel", EXPR_OTHER, {0, {0}}},
    {"later", EXPR_LATER, {0, {0}}},
};

/* The context counts the questions. */
static inline enum expr_found known_find(void *context, const char *name, struct quantity *out) {
    ++*(unsigned *)context;
    for (size_t i = 0; i < COUNT(known); i++)
        if (strcmp(name, known[i].name) == 0) {
            if (known[i].found == EXPR_FOUND) *out = known[i].value;
            return known[i].found;
        }
    return EXPR_MISSING;
}

static inline void known_names(void *context, void (*each)(void *to, const char *name), void *to) {
    (void)context;
    for (size_t i = 0; i < COUNT(known); i++) each(to, known[i].name);
}

/* The bytes stand alone in memory, so that the sanitizers see whoever reads on. */
static inline enum expr_result parse_and_evaluate(struct arena *arena, const char *text, size_t size,
                                                  unsigned *asked, struct quantity *out,
                                                  struct expr_error *error) {
    char *bytes = malloc(size ? size : 1);
    memcpy(bytes, text, size);
    const struct expr *expr = expr_parse(arena, bytes, size, error);
    free(bytes);
    const struct expr_scope scope = {asked, known_find, known_names};
    return expr ? expr_evaluate(expr, &scope, arena, out, error) : EXPR_WRONG;
}

#endif
