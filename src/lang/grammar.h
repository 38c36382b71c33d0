/* The language as tables. They are generated from grammar/; so are the names KIND_X, KEY_X_Y,
 * CHOICE_X_Y_Z and FUNCTION_X of their rows (grammar_tables.h). */
#ifndef MONGE_LANG_GRAMMAR_H
#define MONGE_LANG_GRAMMAR_H

#include <stdbool.h>
#include <stdint.h>

enum grammar_type {
    GRAMMAR_NUMBER,    /* a number */
    GRAMMAR_INTEGER,   /* a whole number */
    GRAMMAR_BOOLEAN,   /* true or false */
    GRAMMAR_CHOICE,    /* one of the words in `choices` */
    GRAMMAR_TEXT,      /* any text but the empty one */
    GRAMMAR_POINT,     /* [x, y, z] */
    GRAMMAR_DIRECTION, /* [x, y, z], not null */
    GRAMMAR_FACTORS,   /* a number for all axes, or [x, y, z] */
    GRAMMAR_COLOR,     /* [r, g, b], "#rrggbb" or a CSS name */
    GRAMMAR_AMOUNT,    /* a number for all channels, or a colour */
    GRAMMAR_SIZE,      /* [width, height], whole numbers */
    GRAMMAR_MATRIX,    /* three or four rows of four numbers */
    GRAMMAR_OBJECT,    /* a mapping of kind `of` */
    GRAMMAR_LIST,      /* a list of kind `of` */
    GRAMMAR_MAP,       /* names, each with a mapping of kind `of` */
    GRAMMAR_ANY,       /* any value, given a meaning where it is used */
    GRAMMAR_VALUES,    /* names, each with any value; with `of` param also with that mapping */
    GRAMMAR_RANGES,    /* loop variables, each with a count, a list or a range */
    GRAMMAR_CONDITION, /* an expression that is true or false */
    GRAMMAR_NAME,      /* the name of one of kind `of` */
    GRAMMAR_FILES,     /* a path, or a list of paths */
    GRAMMAR_LATER,     /* a word of the language that this version does not have yet */
};

struct grammar_kind;

struct grammar_key {
    const char *name;
    enum grammar_type type;
    const struct grammar_kind
        *of; /* OBJECT, LIST, MAP; of a COLOR: the mapping that may stand instead; else NULL */
    const char *const *choices;  /* CHOICE: ends with NULL */
    const char *const *instead;  /* words of other renderers for this key; ends with NULL */
    const char *const *near;     /* words of other renderers for what is not quite this; ends with NULL */
    const char *const *excludes; /* keys that contradict this one; ends with NULL */
    const char *const *needs;    /* keys that must stand beside this one; ends with NULL */
    bool required;
    bool alternative; /* a mapping of the kind has exactly one of its alternatives */
    bool named;       /* OBJECT: a name of the file's definitions of that kind may stand instead */
    bool single;      /* LIST: a single item may stand without its list */
    bool has_default;
    double value[3];              /* the default: a number, choice, boolean or components */
    bool has_min, has_max, above; /* range of each number; above: min itself is out */
    double min, max;
    const char *default_text, *unit, *doc, *example; /* for people; NULL where there is none */
    const char *type_text, *range_text;              /* for people; "" where everything goes */
};

struct grammar_kind {
    const char *name;  /* as in KIND_name and the manual */
    const char *title; /* for messages: "a sphere" */
    const char *doc;
    const char *example; /* NULL: none */
    const struct grammar_key *keys;
    int key_count;
    uint64_t required, alternatives,
        companions; /* the keys that are so, or name others by excludes or needs: bit i is key i */
};

/* The key of that name, or -1. */
int grammar_find_key(const struct grammar_kind *kind, const char *name);

/* A CSS colour name, letter case apart; false leaves rgb alone. Components are sRGB bytes. */
struct grammar_color {
    const char *name;
    unsigned char rgb[3];
};
extern const struct grammar_color grammar_colors[];
extern const int grammar_color_count;

/* What an expression may call. Texts that are NULL are not there. */
struct grammar_function {
    const char *name;
    const char *call;           /* with its arguments: "mix(a, b, t)" */
    unsigned least, most;       /* arguments */
    const char *const *instead; /* words of other languages for it; ends with NULL, or is NULL */
    const char *doc, *domain, *example, *gives;
};
extern const struct grammar_function grammar_functions[];
extern const int grammar_function_count;

struct grammar_constant {
    const char *name;
    double value;
    const char *doc;
};
extern const struct grammar_constant grammar_constants[];
extern const int grammar_constant_count;

/* scenes/presets.yaml, whose materials are the presets. */
extern const char grammar_presets[];

extern const struct grammar_kind grammar_kinds[];
extern const int grammar_kind_count;

#endif
