#include "cli/limits.h"

#include <ctype.h>
#include <stdint.h>
#include <string.h>

#include "cli/say.h"
#include "cli/suggest.h"

static const struct limit_row {
    const char *name;
    size_t offset, high;
    unsigned unit; /* of the suffixes: k is this, M its square, G its cube */
} rows[] = {
    {"file_bytes", offsetof(struct limits, load.file_bytes), SIZE_MAX, 1024},
    {"memory_bytes", offsetof(struct limits, load.memory_bytes), SIZE_MAX, 1024},
    {"values", offsetof(struct limits, load.values), SIZE_MAX, 1000},
    {"nesting", offsetof(struct limits, load.nesting), 1000, 1000},
    {"recursion", offsetof(struct limits, load.recursion), 1000, 1000},
    {"steps", offsetof(struct limits, load.steps), SIZE_MAX, 1000},
    {"objects", offsetof(struct limits, load.objects), SIZE_MAX, 1000},
    {"pixels", offsetof(struct limits, pixels), MONGE_MAX_PIXELS, 1000},
};
enum { ROWS = sizeof rows / sizeof *rows };

const char *limits_name(size_t i) { return i < ROWS ? rows[i].name : NULL; }

static bool unknown_limit(enum command_id command, const char *name) {
    struct suggestion nearest = {.word = name};
    char all[128] = "";
    for (int i = 0; i < ROWS; i++) {
        suggestion_try(&nearest, rows[i].name);
        snprintf(all + strlen(all), sizeof all - strlen(all), "%s%s", i > 0 ? ", " : "", rows[i].name);
    }
    const char *best = suggestion_best(&nearest);
    if (best)
        say_usage(command, "--limit: no limit `%s`; did you mean `%s`?", name, best);
    else
        say_usage(command, "--limit: no limit `%s`; there are %s", name, all);
    return false;
}

/* A whole number from 1, with k, M or G behind it for one, two or three times the unit. */
static bool read_amount(const char *text, const struct limit_row *row, size_t *amount) {
    static const char suffixes[] = "kMG";
    size_t value = 0;
    const char *at = text;
    for (; isdigit((unsigned char)*at); at++) {
        const size_t digit = (size_t)(*at - '0');
        if (value > (SIZE_MAX - digit) / 10) return false;
        value = value * 10 + digit;
    }
    const char *suffix = *at ? strchr(suffixes, *at) : NULL;
    for (int i = 0; suffix && i <= suffix - suffixes; i++) {
        if (value > SIZE_MAX / row->unit) return false;
        value *= row->unit;
    }
    if (at == text || (suffix ? at[1] : *at) || value < 1 || value > row->high) return false;
    *amount = value;
    return true;
}

static bool read_limit(enum command_id command, const char *text, struct limits *limits) {
    char name[64];
    snprintf(name, sizeof name, "%.*s", (int)strcspn(text, "="), text);
    int i = 0;
    while (i < ROWS && strcmp(rows[i].name, name) != 0) i++;
    if (i == ROWS) return unknown_limit(command, name);
    if (read_amount(strchr(text, '=') + 1, &rows[i], (size_t *)((char *)limits + rows[i].offset)))
        return true;
    if (rows[i].high == SIZE_MAX)
        say_usage(command, "--limit %s: expected a whole number from 1, as 200, 5k, 30M or 2G", text);
    else
        say_usage(command, "--limit %s: expected a whole number from 1 to %zu", text, rows[i].high);
    return false;
}

bool limits_read(const struct arguments *args, struct limits *limits) {
    *limits = (struct limits){.pixels = MONGE_MAX_PIXELS};
    for (size_t i = 0; i < args->pair_count; i++)
        if (args->pairs[i].option == OPTION_LIMIT && !read_limit(args->command, args->pairs[i].text, limits))
            return false;
    return true;
}
