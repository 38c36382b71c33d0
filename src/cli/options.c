#include "cli/options.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/asked.h"
#include "cli/paths.h"
#include "cli/say.h"
#include "cli/suggest.h"

/* ---- Values ---- */

/* A decimal number low .. high, digits alone. Returns what follows it, NULL where there is none. */
static const char *read_whole(const char *text, uint32_t low, uint32_t high, uint32_t *number) {
    uint64_t value = 0;
    const char *at = text;
    for (; isdigit((unsigned char)*at); at++) {
        value = value * 10 + (uint64_t)(*at - '0');
        if (value > UINT32_MAX) return NULL;
    }
    if (at == text || value < low || value > high) return NULL;
    *number = (uint32_t)value;
    return at;
}

static bool read_fraction(const char *text, double low, double high, double *number) {
    char *end = NULL;
    if (!*text || text[strspn(text, "0123456789.+-eE")]) return false; /* strtod takes more: nan, 0x1p3 */
    const double value = strtod(text, &end);
    if (*end || !(value >= low && value <= high)) return false;
    *number = value;
    return true;
}

static bool read_size(const struct option_row *row, const char *text, uint32_t number[2]) {
    text = read_whole(text, row->low, row->high, &number[0]);
    if (!text || *text != 'x') return false;
    text = read_whole(text + 1, row->low, row->high, &number[1]);
    return text && !*text;
}

static bool read_region(const struct option_row *row, const char *text, uint32_t number[4]) {
    for (int i = 0; i < 4; i++) {
        if (i > 0 && *text++ != ',') return false;
        text = read_whole(text, i < 2 ? 0 : row->low, row->high, &number[i]);
        if (!text) return false;
    }
    return !*text;
}

/* N, A-B, A- or all; then perhaps :STEP. */
static bool read_frames(const struct option_row *row, const char *text, uint32_t number[3]) {
    number[0] = row->low;
    number[1] = 0;
    number[2] = 1;
    if (strncmp(text, "all", 3) == 0) {
        text += 3;
    } else {
        text = read_whole(text, row->low, row->high, &number[0]);
        if (!text) return false;
        if (*text != '-')
            number[1] = number[0];
        else if (isdigit((unsigned char)*++text) &&
                 !(text = read_whole(text, number[0], row->high, &number[1])))
            return false;
    }
    if (*text == ':' && !(text = read_whole(text + 1, 1, row->high, &number[2]))) return false;
    return !*text;
}

/* NAME=VALUE; what they may be is for those to say who use them. */
static bool read_pair(const char *text) { return *text != '=' && strchr(text, '='); }

/* A text of `length` bytes. */
static bool read_choice(const char *choices, const char *text, size_t length, unsigned *choice) {
    for (*choice = 0; choices; ++*choice) {
        if (strcspn(choices, "|") == length && strncmp(choices, text, length) == 0) return true;
        choices = strchr(choices, '|');
        if (choices) choices++;
    }
    return false;
}

/* Words with commas between; their bits are added to *choices. */
static bool read_choices(const char *choices, const char *text, unsigned *bits) {
    for (;; text++) {
        unsigned choice;
        const size_t length = strcspn(text, ",");
        if (!read_choice(choices, text, length, &choice)) return false;
        *bits |= 1u << choice;
        text += length;
        if (!*text) return true;
    }
}

static bool read_amount(const char *text, struct option_value *value) {
    char number[32];
    const size_t length = strlen(text);
    value->percent = length > 0 && text[length - 1] == '%';
    if (length >= sizeof number) return false;
    memcpy(number, text, length + 1);
    if (!value->percent)
        return number[strspn(number, "0123456789")] == '\0' &&
               read_fraction(number, 0, 1e18, &value->fraction);
    number[length - 1] = '\0';
    return read_fraction(number, 0, 100, &value->fraction);
}

bool options_area(const struct option_pair *pair, uint32_t number[4]) {
    return read_region(&OPTION_TABLE[pair->option], pair->text, number);
}

/* What is of digits and commas alone is meant to be a rectangle. */
static bool read_area(const struct option_row *row, const char *text, uint32_t number[4]) {
    return text[strspn(text, "0123456789,-. ")] ? true : read_region(row, text, number);
}

static bool read_value(const struct option_row *row, const char *text, struct option_value *value) {
    value->text = text;
    switch (row->kind) {
    case VALUE_NONE: return true;
    case VALUE_FILE: return *text;
    case VALUE_WHOLE: {
        const char *end = read_whole(text, row->low, row->high, &value->number[0]);
        return end && !*end;
    }
    case VALUE_FRACTION: return read_fraction(text, row->low, row->high, &value->fraction);
    case VALUE_SIZE: return read_size(row, text, value->number);
    case VALUE_REGION: return read_region(row, text, value->number);
    case VALUE_CHOICE: return read_choice(row->value, text, strlen(text), &value->choice);
    case VALUE_CHOICES: return read_choices(row->value, text, &value->choices);
    case VALUE_AMOUNT: return read_amount(text, value);
    case VALUE_AREA: return read_area(row, text, value->number);
    case VALUE_FRAMES: return read_frames(row, text, value->number);
    case VALUE_PAIR: return read_pair(text);
    }
    return false;
}

/* Adds "phong, diffuse or signature", with that word before the last one. */
static void describe_words(const char *choices, const char *last, char *text, size_t size) {
    while (choices) {
        const int length = (int)strcspn(choices, "|");
        const char *next = choices[length] ? choices + length + 1 : NULL;
        const char *link = !next ? "" : strchr(next, '|') ? ", " : last;
        const size_t used = strlen(text);
        snprintf(text + used, size - used, "%.*s%s", length, choices, link);
        choices = next;
    }
}

static void describe_value(const struct option_row *row, char *text, size_t size) {
    switch (row->kind) {
    case VALUE_NONE: snprintf(text, size, "nothing"); break;
    case VALUE_FILE: snprintf(text, size, "%s", row->value); break;
    case VALUE_WHOLE: snprintf(text, size, "a whole number from %u to %u", row->low, row->high); break;
    case VALUE_FRACTION: snprintf(text, size, "a number from %u to %u", row->low, row->high); break;
    case VALUE_SIZE: snprintf(text, size, "WxH like 640x480, each from %u to %u", row->low, row->high); break;
    case VALUE_REGION:
        snprintf(text, size, "X,Y,W,H like 0,0,320,240, X and Y from 0, W and H from %u", row->low);
        break;
    case VALUE_CHOICE: *text = '\0', describe_words(row->value, " or ", text, size); break;
    case VALUE_CHOICES:
        snprintf(text, size, "some of ");
        describe_words(row->value, " and ", text, size);
        snprintf(text + strlen(text), size - strlen(text), ", with commas between");
        break;
    case VALUE_AMOUNT: snprintf(text, size, "a whole number, or 0 to 100 and %%"); break;
    case VALUE_AREA:
        snprintf(text, size, "X,Y,W,H like 0,0,320,240, X and Y from 0, W and H from %u, or a PNG file",
                 row->low);
        break;
    case VALUE_FRAMES:
        snprintf(text, size, "N, A-B, A- or all, perhaps with :STEP, from %u", row->low);
        break;
    case VALUE_PAIR: snprintf(text, size, "%s", row->value); break;
    }
}

/* The nearest of the words of a table to another one. To be freed. NULL: none is near. */
static char *find_near(const char *choices, const char *word) {
    char *all = say_text("%s", choices);
    struct suggestion nearest = {.word = word};
    for (char *at = all, *choice; (choice = strsep(&at, "|"));) suggestion_try(&nearest, choice);
    const char *best = suggestion_best(&nearest);
    char *near = best ? say_text("%s", best) : NULL;
    free(all);
    return near;
}

/* Of a list it is the first word that is wrong which is told; where a comma has no word beside it, the list. */
static void refuse_words(enum command_id command, const struct option_row *row, const char *shown,
                         const char *expected, const char *text) {
    unsigned choice;
    const char *at = text;
    size_t length;
    while (length = strcspn(at, ","), read_choice(row->value, at, length, &choice)) at += length + 1;
    char *word = length > 0 ? say_text("%.*s", (int)length, at) : say_text("%s", text);
    char *near = find_near(row->value, word);
    if (near)
        say_usage(command, "%s: expected %s, found `%s`; did you mean `%s`?", shown, expected, word, near);
    else
        say_usage(command, "%s: expected %s, found `%s`", shown, expected, word);
    free(near);
    free(word);
}

/* `shown` is the option as the user wrote it, --size or -o. A NULL text is a value that is missing. */
static bool set_value(struct arguments *args, enum option_id option, const char *shown, const char *text) {
    const struct option_row *row = &OPTION_TABLE[option];
    char expected[128];
    if (text && read_value(row, text, &args->option[option])) {
        if (row->kind == VALUE_PAIR || row->kind == VALUE_AREA || option == OPTION_MASK)
            args->pairs[args->pair_count++] = (struct option_pair){option, text};
        return args->option[option].given = true;
    }
    describe_value(row, expected, sizeof expected);
    if (text && row->kind == VALUE_CHOICES)
        refuse_words(args->command, row, shown, expected, text);
    else if (text)
        say_usage(args->command, "%s: expected %s, found `%s`", shown, expected, text);
    else
        say_usage(args->command, "%s: expected %s, found nothing", shown, expected);
    return false;
}

/* ---- Options ---- */

/* The words that are left. */
struct words {
    int count;
    char **next;
};

static const char *take_word(struct words *words) {
    if (words->count == 0) return NULL;
    words->count--;
    return *words->next++;
}

/* Whether the command has it in golden.yaml, by rules that take options of render. */
static bool is_of_rules(enum command_id command, enum option_id o) {
    const bool rendered = command_takes(COMMAND_RENDER, o) && (asked_makes_picture(o) || o == OPTION_AOV);
    return command == COMMAND_TEST && rendered && !command_takes(command, o);
}

/* Both as the user wrote them; a value that is missing, NULL, or would need quotes is told as the help has it. */
static void refer_to_rules(enum option_id o, const char *shown, const char *value) {
    static const char plain[] = "0123456789.,:=+-_%/"
                                "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
    const struct option_row *row = &OPTION_TABLE[o];
    char *entry;
    if (!value || !*value || value[strspn(value, plain)]) value = row->value;
    if (o == OPTION_AOV)
        entry = say_text("aov: true");
    else if (row->kind == VALUE_NONE)
        entry = say_text("options: %s", shown);
    else
        entry = say_text("options: \"%s %s\"", shown, value);
    say_usage(COMMAND_TEST, "no option `%s`; it goes into golden.yaml, `rules: [{scenes: \"*\", %s}]`", shown,
              entry);
    free(entry);
}

static enum option_id find_long(enum command_id command, const char *name, size_t length) {
    enum option_id o = 0;
    while (o < OPTIONS && !(command_takes(command, o) && strncmp(OPTION_TABLE[o].name, name, length) == 0 &&
                            !OPTION_TABLE[o].name[length]))
        o++;
    return o;
}

static enum option_id find_letter(enum command_id command, char letter) {
    enum option_id o = 0;
    while (o < OPTIONS && !(command_takes(command, o) && OPTION_TABLE[o].letter == letter)) o++;
    return o;
}

/* Whether the word is an option, by its name: -o, --size or --size=640x480. */
static bool is_option(enum command_id command, const char *word) {
    if (word[0] != '-' || !word[1]) return false;
    if (word[1] != '-') return !word[2] && find_letter(command, word[1]) < OPTIONS;
    return find_long(command, word + 2, strcspn(word + 2, "=")) < OPTIONS;
}

/* The word behind an option is its value: a file, but for one that is called as an option, whose own value was left out. */
static bool set_next_value(struct arguments *args, enum option_id option, const char *shown,
                           struct words *rest) {
    const enum value_kind kind = OPTION_TABLE[option].kind;
    const char *text = take_word(rest);
    if (!text || !(kind == VALUE_FILE || kind == VALUE_AREA) || !is_option(args->command, text))
        return set_value(args, option, shown, text);
    say_usage(args->command, "%s: expected %s, found the option %s; a file of that name is ./%s", shown,
              OPTION_TABLE[option].value, text, text);
    return false;
}

/* Those of diff, and what somebody may call them: a tolerance needs its reason. What it is besides; NULL: none of these. */
static const char *tolerance_note(enum command_id command, const char *word) {
    static const struct {
        const char *word, *note;
    } rows[] = {{"tolerance", ""},
                {"max-delta", ""},
                {"max-pixels", ""},
                {"metric", ""},
                {"ignore", "all pixels of a golden count; "},
                {"mask", "all pixels of a golden count; "}};
    for (size_t i = 0; command == COMMAND_TEST && i < sizeof rows / sizeof *rows; i++)
        if (strcmp(word, rows[i].word) == 0) return rows[i].note;
    return NULL;
}

/* Reports a long option, `length` bytes of name, that the command does not have. */
static bool unknown_long(enum command_id command, const char *name, size_t length, struct words *rest) {
    char word[64], shown[sizeof word + 2];
    snprintf(word, sizeof word, "%.*s", (int)length, name);
    snprintf(shown, sizeof shown, "--%s", word);
    for (enum option_id o = 0; o < OPTIONS; o++) {
        if (!is_of_rules(command, o) || strcmp(OPTION_TABLE[o].name, word) != 0) continue;
        refer_to_rules(o, shown, name[length] ? name + length + 1 : take_word(rest));
        return false;
    }
    struct suggestion nearest = {.word = word};
    for (enum option_id o = 0; o < OPTIONS; o++)
        if (command_takes(command, o)) suggestion_try(&nearest, OPTION_TABLE[o].name);
    const char *best = suggestion_best(&nearest);
    const bool side = strcmp(word, "width") == 0 || strcmp(word, "height") == 0;
    const char *note = tolerance_note(command, word);
    if (note)
        say_usage(command,
                  "no option `%s`; %sa tolerance stands in golden.yaml, `rules: [{scenes: \"*\", tolerance: "
                  "{max: 0.004, pixels: 0.1%%, reason: edges differ}}]`, or in the scene",
                  shown, note);
    else if (side && command_takes(command, OPTION_SIZE))
        say_usage(command, "no option `%s`; did you mean `--size WxH`?", shown);
    else if (best)
        say_usage(command, "no option `%s`; did you mean `--%s`?", shown, best);
    else
        say_usage(command, "no option `%s`", shown);
    return false;
}

/* --name, --name VALUE or --name=VALUE; `word` begins after the dashes. */
static bool parse_long(struct arguments *args, const char *word, struct words *rest) {
    const size_t length = strcspn(word, "=");
    const enum option_id o = find_long(args->command, word, length);
    if (o == OPTIONS) return unknown_long(args->command, word, length, rest);
    char shown[64];
    snprintf(shown, sizeof shown, "--%s", OPTION_TABLE[o].name);
    const char *value = word[length] ? word + length + 1 : NULL;
    if (OPTION_TABLE[o].kind != VALUE_NONE)
        return value ? set_value(args, o, shown, value) : set_next_value(args, o, shown, rest);
    if (!value) return args->option[o].given = true;
    say_usage(args->command, "%s takes no value, found `%s`", shown, value);
    return false;
}

/* The same of a letter; the value is what follows it. */
static bool unknown_letter(enum command_id command, const char *word, const char *shown, const char *value) {
    enum option_id o = 0;
    while (o < OPTIONS && !(is_of_rules(command, o) && OPTION_TABLE[o].letter == shown[1])) o++;
    if (o < OPTIONS)
        refer_to_rules(o, shown, value);
    else if (path_input_extension(word))
        say_usage(command, "no option `%s`; a file of that name is ./%s", shown, word);
    else
        say_usage(command, "no option `%s`", shown);
    return false;
}

/* -q, -o VALUE, -oVALUE, or several together, as the user wrote them. */
static bool parse_letters(struct arguments *args, const char *word, struct words *rest) {
    for (const char *letters = word + 1; *letters; letters++) {
        const enum option_id o = find_letter(args->command, *letters);
        const char shown[3] = {'-', *letters, '\0'};
        if (o == OPTIONS)
            return unknown_letter(args->command, word, shown, letters[1] ? letters + 1 : take_word(rest));
        if (OPTION_TABLE[o].kind != VALUE_NONE)
            return letters[1] ? set_value(args, o, shown, letters + 1) : set_next_value(args, o, shown, rest);
        args->option[o].given = true;
    }
    return true;
}

bool options_parse(enum command_id command, int argc, char **argv, struct arguments *args) {
    *args = (struct arguments){.command = command, .operands = argv};
    args->pairs = calloc((size_t)argc + 1, sizeof *args->pairs);
    if (!args->pairs) {
        say_error("out of memory");
        return false;
    }
    struct words rest = {argc, argv};
    bool options_end = false;
    while (rest.count > 0 && !args->option[OPTION_HELP].given) {
        char *word = *rest.next;
        take_word(&rest);
        bool good = true;
        if (options_end || word[0] != '-' || !word[1])
            argv[args->count++] = word;
        else if (strcmp(word, "--") == 0)
            options_end = true;
        else if (word[1] == '-')
            good = parse_long(args, word + 2, &rest);
        else
            good = parse_letters(args, word, &rest);
        if (!good) return false;
    }
    return true;
}

void options_free(struct arguments *args) { free(args->pairs); }
