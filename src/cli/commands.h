/* The commands and their options as one table. Parsing, usage texts, the manual page and the
 * completion scripts all come from it, so they cannot disagree. */
#ifndef MONGE_CLI_COMMANDS_H
#define MONGE_CLI_COMMANDS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* As diff(1) has them; of several, the highest counts. */
enum status {
    STATUS_YES,
    STATUS_NO,      /* a scene is wrong, pictures differ */
    STATUS_TROUBLE, /* usage, files, system */
};

enum command_id {
    COMMAND_NONE, /* monge itself */
    COMMAND_RENDER,
    COMMAND_CHECK,
    COMMAND_INFO,
    COMMAND_TEST,
    COMMAND_ACCEPT,
    COMMAND_FMT,
    COMMAND_DIFF,
    COMMAND_EXPLAIN,
    COMMAND_IMPORT,
    COMMAND_SCHEMA,
    COMMAND_VERSION,
    COMMAND_HELP,
    COMMANDS
};

enum option_id {
    OPTION_OUTPUT,
    OPTION_IMPORT_OUTPUT, /* the same words, but of a scene */
    OPTION_ROOT,
    OPTION_DEFINE,
    OPTION_FRAMES,
    OPTION_SIZE,
    OPTION_SAMPLES,
    OPTION_REGION,
    OPTION_SHADING,
    OPTION_SHADOW,
    OPTION_NO_SHADOWS,
    OPTION_DEPTH,
    OPTION_BITS,
    OPTION_ENCODING,
    OPTION_AOV,
    OPTION_THREADS,
    OPTION_JOBS,
    OPTION_SKIP_UNCHANGED,
    OPTION_RESUME,
    OPTION_DRY_RUN,
    OPTION_KEEP_GOING,
    OPTION_FAIL_FAST,
    OPTION_STATS,
    OPTION_LOG,
    OPTION_PROGRESS,
    OPTION_FORMAT,
    OPTION_METRIC,
    OPTION_MAX_DELTA,
    OPTION_MAX_PIXELS,
    OPTION_IGNORE,
    OPTION_MASK,
    OPTION_PPD,
    OPTION_HEAT_MAP,
    OPTION_DIFF_JSON, /* the same word, but of one comparison */
    OPTION_LIMIT,
    OPTION_UNTRUSTED,
    OPTION_JSON,
    OPTION_GOLDEN,
    OPTION_TEST_OUTPUT, /* the same words as OPTION_OUTPUT, but of a folder */
    OPTION_GOLDEN_KIND,
    OPTION_CHANGED,
    OPTION_UPDATE_ONLY_FAILED,
    OPTION_OLD,
    OPTION_TEST_JSON, /* the same word, but with a file */
    OPTION_JUNIT,
    OPTION_TAP,
    OPTION_REPORT,
    OPTION_PRUNE,
    OPTION_CHECK_ONLY,
    OPTION_QUIET,
    OPTION_MAN,
    OPTION_COMPLETION,
    OPTION_HELP,
    OPTION_VERSION,
    OPTIONS
};

enum value_kind {
    VALUE_NONE,     /* a switch */
    VALUE_FILE,     /* any text but the empty one */
    VALUE_WHOLE,    /* low .. high */
    VALUE_FRACTION, /* low .. high, with a decimal point */
    VALUE_SIZE,     /* WxH, each low .. high */
    VALUE_REGION,   /* X,Y,W,H: X and Y from 0, W and H low .. high */
    VALUE_CHOICE,   /* one of the words of `value` */
    VALUE_CHOICES,  /* some of them, with commas between; may be given many times */
    VALUE_AMOUNT,   /* a whole number, or 0 .. 100 and % */
    VALUE_AREA,     /* as VALUE_REGION, or a file; may be given many times */
    VALUE_FRAMES,   /* N, A-B, A- or all, with :STEP behind it; each low .. high */
    VALUE_PAIR,     /* NAME=VALUE; may be given many times */
};

struct option_row {
    const char *name; /* without the dashes */
    char letter;      /* 0: none */
    enum value_kind kind;
    unsigned commands; /* a set bit 1 << command_id for each that takes it */
    const char *value; /* what help calls the value; the choices as a|b|c; NULL for a switch */
    uint32_t low, high;
    const char *doc; /* no capital, no full stop */
};
extern const struct option_row OPTION_TABLE[OPTIONS];

/* What an operand is, or the value of an option: for completion. */
enum argument {
    ARGUMENT_NONE, /* nothing that is known */
    ARGUMENT_FILE,
    ARGUMENT_FOLDER,
    ARGUMENT_SCENE, /* a file, a folder, @ and a list */
    ARGUMENT_PICTURE,
    ARGUMENT_WORDS, /* one of those that the table has */
    ARGUMENT_LIST,  /* some of them, with commas between */
    ARGUMENT_LIMIT, /* NAME=VALUE */
    ARGUMENT_CODE,
    ARGUMENT_HELP, /* what `monge help` may be followed by */
};

struct arguments;

struct example {
    const char *line, *doc;
};

struct command_row {
    const char *name;
    const char *operands;        /* "SCENE...", "" */
    const char *doc;             /* no capital, no full stop */
    const char *text[20];        /* paragraphs, up to a NULL */
    struct example examples[12]; /* up to a NULL */
    const char *operand;         /* "scene"; NULL where it needs none */
    enum argument argument;      /* what its operands are */
    enum status (*run)(const struct arguments *args);
};
extern const struct command_row COMMAND_TABLE[COMMANDS];

extern const char *const STATUS_DOC[STATUS_TROUBLE + 1];
extern const char SIGNAL_DOC[]; /* and what there is besides: the statuses of signals */

static inline bool command_takes(enum command_id command, enum option_id option) {
    return OPTION_TABLE[option].commands >> command & 1;
}

enum argument option_argument(enum option_id option);

/* COMMAND_NONE where there is none of that name. */
enum command_id command_find(const char *name);

/* Reports a name that is none, with the nearest; STATUS_TROUBLE. */
enum status command_unknown(const char *name);

/* Runs what the words after the program's name ask for; reorders argv. */
enum status command_run(int argc, char **argv);

#endif
