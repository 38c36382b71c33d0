#include "cli/sweep.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/say.h"
#include "cli/words.h"

enum { MAX_COMBINATIONS = 1000000 };

static void *grow(void *array, size_t count, size_t size) {
    void *larger = realloc(array, count * size);
    if (!larger) say_no_memory();
    return larger;
}

static void add_value(struct axis *axis, char *value) {
    axis->values = grow(axis->values, axis->count + 1, sizeof *axis->values);
    axis->values[axis->count++] = value;
}

/* ---- Ranges ---- */

static size_t count_digits(const char *text) { return strspn(text, "0123456789"); }

/* A decimal number at *text, perhaps with an exponent; *text moves behind it. */
static bool read_number(const char **text, double *number) {
    const char *at = *text + (**text == '-');
    if (count_digits(at) == 0) return false;
    at += count_digits(at);
    if (*at == '.' && count_digits(at + 1) > 0) at += 1 + count_digits(at + 1);
    if (*at == 'e' || *at == 'E') {
        const char *exponent = at + 1 + (at[1] == '+' || at[1] == '-');
        if (count_digits(exponent) > 0) at = exponent + count_digits(exponent);
    }
    *number = strtod(*text, NULL);
    *text = at;
    return true;
}

static bool read_range(const char *text, double *first, double *last, double *step) {
    *step = 1.0;
    if (!read_number(&text, first) || strncmp(text, "..", 2) != 0) return false;
    text += 2;
    if (!read_number(&text, last)) return false;
    if (*text != ':') return !*text;
    text++;
    return read_number(&text, step) && !*text;
}

/* The numbers from first to last, a step over 0 apart. False when they are too many. */
static bool add_range(struct axis *axis, double first, double last, double step) {
    const double turns = floor(fabs(last - first) / step + 1e-9);
    if (!(turns < MAX_COMBINATIONS)) return false;
    for (double i = 0.0; i <= turns; i++)
        add_value(axis, say_text("%.12g", first < last ? first + i * step : first - i * step));
    return true;
}

/* ---- Lists ---- */

/* Where the item at `text` ends: at a comma that no bracket or quote encloses, or at the end. */
static const char *item_end(const char *text) {
    size_t depth = 0;
    char quote = 0;
    for (; *text; text++) {
        if (quote == '"' && *text == '\\' && text[1])
            text++;
        else if (quote)
            quote = *text == quote ? 0 : quote;
        else if (*text == '"' || *text == '\'')
            quote = *text;
        else if (strchr("[({", *text))
            depth++;
        else if (strchr("])}", *text) && depth > 0)
            depth--;
        else if (*text == ',' && depth == 0)
            return text;
    }
    return text;
}

static bool add_item(struct axis *axis, enum command_id command, const char *text, size_t length) {
    double first, last, step;
    char *item = say_text("%.*s", (int)length, text);
    if (!read_range(item, &first, &last, &step)) {
        add_value(axis, item);
        return true;
    }
    const bool good = step > 0.0 && add_range(axis, first, last, step);
    if (!(step > 0.0))
        say_usage(command, "-D %s: the step of `%s` must be over 0; 4..1 goes down", axis->name, item);
    else if (!good)
        say_usage(command, "-D %s: `%s` is no range of at most %d values", axis->name, item,
                  MAX_COMBINATIONS);
    free(item);
    return good;
}

static bool read_list(struct axis *axis, enum command_id command, const char *text) {
    const char *const whole = text;
    for (;; text++) {
        text += strspn(text, " ");
        const char *end = item_end(text);
        size_t length = (size_t)(end - text);
        while (length > 0 && text[length - 1] == ' ') length--;
        if (length == 0) {
            say_usage(command, *whole ? "-D %s: an empty value in `%s`" : "-D %s=: the value is empty",
                      axis->name, whole);
            return false;
        }
        if (!add_item(axis, command, text, length)) return false;
        text = end;
        if (!*text) return true;
    }
}

/* ---- All of -D ---- */

/* As the language has names. */
static bool is_name(const char *text, size_t length) {
    for (size_t i = 0; i < length; i++) {
        const unsigned char c = (unsigned char)text[i];
        if (!isalpha(c) && c != '_' && c < 0x80 && !(i > 0 && isdigit(c))) return false;
    }
    return length > 0;
}

static void free_axis(struct axis *axis) {
    for (size_t i = 0; i < axis->count; i++) free(axis->values[i]);
    free(axis->values);
    free(axis->name);
    *axis = (struct axis){0};
}

/* The axis of this name, without values: a new one, or that of an earlier -D, which counts no more. */
static struct axis *open_axis(struct sweep *sweep, char *name) {
    size_t i = 0;
    while (i < sweep->count && strcmp(sweep->axes[i].name, name) != 0) i++;
    if (i < sweep->count) {
        free_axis(&sweep->axes[i]);
        memmove(&sweep->axes[i], &sweep->axes[i + 1], (--sweep->count - i) * sizeof *sweep->axes);
    }
    sweep->axes = grow(sweep->axes, sweep->count + 1, sizeof *sweep->axes);
    sweep->axes[sweep->count] = (struct axis){.name = name};
    return &sweep->axes[sweep->count++];
}

static bool read_define(struct sweep *sweep, enum command_id command, const char *text) {
    const size_t length = strcspn(text, "=");
    if (is_name(text, length))
        return read_list(open_axis(sweep, say_text("%.*s", (int)length, text)), command, text + length + 1);
    say_usage(command, "-D %s: a parameter has letters, digits and _ in its name, the first no digit", text);
    return false;
}

bool sweep_read(const struct arguments *args, struct sweep *sweep) {
    *sweep = (struct sweep){.total = 1};
    for (size_t i = 0; i < args->pair_count; i++)
        if (args->pairs[i].option == OPTION_DEFINE && !read_define(sweep, args->command, args->pairs[i].text))
            return false;
    for (size_t i = 0; i < sweep->count; i++) {
        sweep->total *= sweep->axes[i].count;
        if (sweep->total <= MAX_COMBINATIONS) continue;
        say_usage(args->command, "-D: more than %d combinations", MAX_COMBINATIONS);
        return false;
    }
    return true;
}

/* The last one behind pair `i` that is of its parameter; NULL: there is none. */
static const char *find_later(const struct arguments *args, size_t i) {
    const char *text = args->pairs[i].text;
    const size_t length = strcspn(text, "=") + 1;
    for (size_t k = args->pair_count; --k > i;)
        if (args->pairs[k].option == OPTION_DEFINE && strncmp(args->pairs[k].text, text, length) == 0)
            return args->pairs[k].text;
    return NULL;
}

static void warn_of(const char *text, const char *later, const char *place, const struct report *report) {
    char *both = say_text("%s,%s", text, strchr(later, '=') + 1);
    char *quoted = word_quoted(text), *quoted_later = word_quoted(later), *quoted_both = word_quoted(both);
    report_warning(report, "given-twice",
                   "%s-D %s counts for nothing, -D %s is given later; -D %s gives both", place, quoted,
                   quoted_later, quoted_both);
    free(quoted_both);
    free(quoted_later);
    free(quoted);
    free(both);
}

void sweep_warn(const struct arguments *args, const char *place, const struct report *report) {
    for (size_t i = 0; i < args->pair_count; i++) {
        const char *text = args->pairs[i].text;
        const char *later = args->pairs[i].option == OPTION_DEFINE ? find_later(args, i) : NULL;
        if (later && strcmp(text, later) != 0) warn_of(text, later, place, report);
    }
}

void sweep_free(struct sweep *sweep) {
    for (size_t i = 0; i < sweep->count; i++) free_axis(&sweep->axes[i]);
    free(sweep->axes);
}

void sweep_combination(const struct sweep *sweep, size_t index, struct monge_define *defines) {
    for (size_t i = sweep->count; i-- > 0;) {
        const struct axis *axis = &sweep->axes[i];
        defines[i] = (struct monge_define){axis->name, axis->values[index % axis->count]};
        index /= axis->count;
    }
}

char *sweep_describe(const struct sweep *sweep, const struct monge_define *defines) {
    char *text = say_text("%s", "");
    for (size_t i = 0; i < sweep->count; i++) {
        if (sweep->axes[i].count == 1) continue;
        char *longer = say_text("%s%s%s=%s", text, *text ? ", " : "", defines[i].name, defines[i].value);
        free(text);
        text = longer;
    }
    return text;
}
