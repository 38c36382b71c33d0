/* What the files of expressions share; for expr*.c alone. */
#ifndef MONGE_LANG_EXPR_PARTS_H
#define MONGE_LANG_EXPR_PARTS_H

#include <stdint.h>

#include "lang/expr.h"

/* ---- The tree ---- */

enum term_kind {
    TERM_VALUE,  /* value */
    TERM_NAME,   /* name; value: of the constant or colour of that name, count 0: there is none */
    TERM_UNARY,  /* symbol parts[0] */
    TERM_BINARY, /* parts[0] symbol parts[1]; && and || too */
    TERM_CHOICE, /* parts[0] ? parts[1] : parts[2] */
    TERM_PART,   /* parts[0] [parts[1]], or parts[0].x with the index in parts[1] */
    TERM_VECTOR, /* [parts...] */
    TERM_CALL,   /* function symbol of parts */
};

struct term {
    enum term_kind kind;
    int symbol;
    uint32_t begin, end;     /* in the text, with the parentheses of its parts but not those around it */
    uint32_t offset, length; /* of what an error points at: the operator, the name that is called */
    unsigned count;          /* of parts */
    const struct term **parts;
    const char *name;
    struct quantity value;
};

struct expr {
    const char *text;
    const struct term *root;
};

/* ---- Words ---- */

/* Two characters of a symbol in one number. */
#define SYMBOL(first, second) ((first) | (second) << 8)

enum token_kind { TOKEN_END, TOKEN_NUMBER, TOKEN_COLOR, TOKEN_NAME, TOKEN_SYMBOL };

struct token {
    enum token_kind kind;
    int symbol;
    uint32_t offset, length;
};

struct parser {
    struct arena *arena;
    const char *text; /* with a final zero */
    uint32_t size;
    struct token token, last; /* the one to look at, and the one before it */
    unsigned depth;           /* of nesting */
    struct expr_error *error;
};

/* ---- expr_lex.c ---- */

/* Goes on to the next token. False: there is none that could stand anywhere; the error is told. */
bool lexer_next(struct parser *p);

/* ---- expr_slips.c: what is wrong, and the smallest fix ---- */

/* Tells an error at bytes of the text; false, for returning. */
bool slip(struct parser *p, size_t offset, size_t length, const char *code, const char *message,
          const char *help);

/* What the text has there, or its beginning and `...`, in backticks: for messages. */
const char *text_shown(struct arena *arena, const char *text, uint32_t begin, uint32_t end);

/* At the token that cannot go on with an expression that could end here, with `opener` open around it
 * (length 0: none). */
bool slip_after_value(struct parser *p, struct token opener);

/* At the token that stands where a value is expected. */
bool slip_no_value(struct parser *p);

/* After the `?` of a choice without its `:`. */
bool slip_no_colon(struct parser *p, struct token question);

/* At what stands behind the point after `of` and names no part. */
bool slip_part(struct parser *p, const struct term *of, struct token point);

/* The name that is no function. */
bool slip_unknown_function(struct parser *p, struct token name);

/* What may stand for a word of another language, or NULL. */
const char *word_instead(struct arena *arena, const char *word);

/* The index of the function, or -1. */
int function_find(const char *name, size_t length);

#endif
