/* From the words of a command line to the values of its options. */
#ifndef MONGE_CLI_OPTIONS_H
#define MONGE_CLI_OPTIONS_H

#include "cli/commands.h"

struct option_value {
    bool given;
    const char *text; /* as the user wrote it; NULL for a switch */
    uint32_t number
        [4]; /* of a whole number, a size or a region, in the order of writing; of frames: first, last (0: open), step */
    double fraction;  /* also of an amount */
    unsigned choice;  /* which of the words of the table, from 0 */
    unsigned choices; /* a bit for each that was given, in any of them */
    bool percent;     /* of an amount */
};

/* A VALUE_PAIR or VALUE_AREA as it was given. */
struct option_pair {
    enum option_id option;
    const char *text;
};

struct arguments {
    enum command_id command;
    struct option_value option[OPTIONS]; /* given twice: the last one */
    char **operands;                     /* within argv */
    size_t count;
    struct option_pair *pairs; /* owned: all of them, in the order of writing */
    size_t pair_count;
};

/* Parses the words after the command. Options and operands may be mixed; `--` ends the options; `-`
 * is an operand; --help ends it all. Moves the operands to the front of argv. False, with the reason
 * on stderr, when an option is unknown or its value is not what the table asks for. Either way the arguments
 * are to be freed. */
bool options_parse(enum command_id command, int argc, char **argv, struct arguments *args);

/* The rectangle of a VALUE_AREA; false where it is a file. */
bool options_area(const struct option_pair *pair, uint32_t number[4]);

void options_free(struct arguments *args);

#endif
