#include "cli/pattern.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "cli/say.h"
#include "cli/suggest.h"

/* ---- Pieces ---- */

struct piece {
    enum { PIECE_END, PIECE_TEXT, PIECE_WORD /* {word} */, PIECE_NUMBER /* %04d */, PIECE_WRONG } kind;
    const char *text; /* of a word: behind the brace */
    int length;       /* of the text, or the word */
    int digits;       /* of a number: at least */
};

/* %d, %04d, or %% as the text of the second %. */
static struct piece take_percent(const char **at) {
    const char *begin = *at, *end = begin + 1;
    if (*end == '%') {
        *at = end + 1;
        return (struct piece){PIECE_TEXT, end, 1, 0};
    }
    int digits = 0;
    if (end[0] == '0' && isdigit((unsigned char)end[1]) && end[1] != '0') {
        digits = end[1] - '0';
        end += 2;
    }
    if (*end != 'd') return (struct piece){PIECE_WRONG, begin, (int)strlen(begin), 0};
    *at = end + 1;
    return (struct piece){PIECE_NUMBER, begin, (int)(*at - begin), digits};
}

/* {word}, or {{ and }} as the text of the second one. A } alone is itself. */
static struct piece take_brace(const char **at) {
    const char *begin = *at, *end = *begin == '{' ? strchr(begin, '}') : begin;
    if (begin[1] == *begin || *begin == '}') {
        *at = begin + (begin[1] == *begin ? 2 : 1);
        return (struct piece){PIECE_TEXT, begin, 1, 0};
    }
    if (!end) return (struct piece){PIECE_WRONG, begin, (int)strlen(begin), 0};
    *at = end + 1;
    return (struct piece){PIECE_WORD, begin + 1, (int)(end - begin - 1), 0};
}

/* The next piece, behind which *at moves. */
static struct piece take_piece(const char **at, bool frames) {
    const char *begin = *at;
    if (!*begin) return (struct piece){.kind = PIECE_END};
    if (*begin == '%' && frames) return take_percent(at);
    if (*begin == '{' || *begin == '}') return take_brace(at);
    const int length = (int)strcspn(begin, frames ? "{}%" : "{}");
    *at = begin + length;
    return (struct piece){PIECE_TEXT, begin, length, 0};
}

static bool is_word(const struct piece *piece, const char *word) {
    return piece->kind == PIECE_WORD && (size_t)piece->length == strlen(word) &&
           strncmp(piece->text, word, (size_t)piece->length) == 0;
}

/* ---- Questions ---- */

bool pattern_has(const char *pattern, const char *word) {
    struct piece p;
    while ((p = take_piece(&pattern, false)).kind != PIECE_END && p.kind != PIECE_WRONG)
        if (is_word(&p, word)) return true;
    return false;
}

bool pattern_has_frame(const char *pattern) {
    struct piece p;
    while ((p = take_piece(&pattern, true)).kind != PIECE_END && p.kind != PIECE_WRONG)
        if (p.kind == PIECE_NUMBER || is_word(&p, "frame")) return true;
    return false;
}

bool pattern_is_plain(const char *pattern, bool frames) {
    struct piece p;
    while ((p = take_piece(&pattern, frames)).kind == PIECE_TEXT) continue;
    return p.kind == PIECE_END;
}

/* ---- What is wrong ---- */

static bool is_known(const struct piece *word, const struct sweep *sweep, bool frames) {
    if (is_word(word, "name") || (frames && is_word(word, "frame"))) return true;
    for (size_t i = 0; i < sweep->count; i++)
        if (is_word(word, sweep->axes[i].name)) return true;
    return false;
}

static void report_unknown(const char *found, const char *word, const struct sweep *sweep, bool frames) {
    struct suggestion nearest = {.word = word};
    char *all = say_text("{name}, {frame}%s", frames ? "" : " with --frames");
    suggestion_try(&nearest, "name");
    if (frames) suggestion_try(&nearest, "frame");
    for (size_t i = 0; i < sweep->count; i++) {
        suggestion_try(&nearest, sweep->axes[i].name);
        char *longer = say_text("%s, {%s}", all, sweep->axes[i].name);
        free(all);
        all = longer;
    }
    const char *best = suggestion_best(&nearest), *own = sweep->count ? "" : ", {NAME} with -D NAME=VALUE";
    if (strcmp(word, "frame") == 0)
        say_usage(COMMAND_RENDER, "-o: {frame} is for --frames");
    else if (best)
        say_usage(COMMAND_RENDER, "-o: expected %s%s, found `%s`; did you mean {%s}?", all, own, found, best);
    else
        say_usage(COMMAND_RENDER, "-o: expected %s%s, or {{ for a {, found `%s`", all, own, found);
    free(all);
}

static bool check_piece(const struct piece *p, const struct sweep *sweep, bool frames) {
    if (p->kind == PIECE_WRONG && *p->text == '%') {
        say_usage(COMMAND_RENDER,
                  "-o: with --frames, expected %%d, %%04d or the like, or %%%% for a %%, found `%s`",
                  p->text);
        return false;
    }
    if (p->kind == PIECE_WRONG) report_unknown(p->text, "", sweep, frames);
    if (p->kind != PIECE_WORD || is_known(p, sweep, frames)) return p->kind != PIECE_WRONG;
    char *word = say_text("%.*s", p->length, p->text), *found = say_text("{%s}", word);
    report_unknown(found, word, sweep, frames);
    free(word);
    free(found);
    return false;
}

bool pattern_check(const char *pattern, const struct sweep *sweep, bool frames) {
    const char *at = pattern;
    int numbers = 0;
    for (struct piece p; (p = take_piece(&at, frames)).kind != PIECE_END; numbers += p.kind == PIECE_NUMBER)
        if (!check_piece(&p, sweep, frames)) return false;
    if (numbers <= 1) return true;
    say_usage(COMMAND_RENDER, "-o %s: one %%d is enough", pattern);
    return false;
}

/* ---- Expansion ---- */

char *pattern_safe(const char *value) {
    char *safe = say_text("%s", value), *to = safe;
    bool good = false; /* something besides dots, which alone would name a folder */
    for (; *value; value++) {
        const bool plain = isalnum((unsigned char)*value) || strchr("._+-", *value);
        if (plain)
            *to++ = *value;
        else if (to > safe && to[-1] != '_')
            *to++ = '_';
        good |= plain && *value != '.';
    }
    while (to > safe && to[-1] == '_') to--;
    *to = '\0';
    if (good && *safe) return safe;
    free(safe);
    return say_text("_");
}

static char *frame_text(const struct pattern_values *values, int digits) {
    return values->frame ? say_text("%0*u", digits, values->frame) : say_text("{frame}");
}

static char *word_text(const struct piece *p, const struct pattern_values *values) {
    if (is_word(p, "name")) return say_text("%s", values->name);
    for (size_t i = 0; i < values->define_count; i++)
        if (is_word(p, values->defines[i].name)) return pattern_safe(values->defines[i].value);
    return frame_text(values, values->digits);
}

static char *piece_text(const struct piece *p, const struct pattern_values *values) {
    if (p->kind == PIECE_WORD) return word_text(p, values);
    if (p->kind == PIECE_NUMBER) return frame_text(values, p->digits);
    return say_text("%.*s", p->length, p->text);
}

char *pattern_expand(const char *pattern, const struct pattern_values *values) {
    char *text = say_text("%s", "");
    for (struct piece p; (p = take_piece(&pattern, values->frames)).kind != PIECE_END;) {
        char *part = piece_text(&p, values), *longer = say_text("%s%s", text, part);
        free(part);
        free(text);
        text = longer;
    }
    return text;
}

char *pattern_of(const char *text, bool frames) {
    char *pattern = malloc(2 * strlen(text) + 1), *to = pattern;
    if (!pattern) say_no_memory();
    for (; *text; *to++ = *text++)
        if (strchr(frames ? "{}%" : "{}", *text)) *to++ = *text;
    *to = '\0';
    return pattern;
}

/* ---- Without a pattern ---- */

int pattern_digits(unsigned number) {
    int digits = 1;
    while (number /= 10) digits++;
    return digits;
}

char *pattern_usual(const struct sweep *sweep, const struct pattern_values *values) {
    char *text = say_text("%s", values->name), *longer;
    for (size_t i = 0; i < sweep->count; i++) {
        if (sweep->axes[i].count == 1) continue;
        char *safe = pattern_safe(values->defines[i].value);
        longer = say_text("%s-%s=%s", text, values->defines[i].name, safe);
        free(safe);
        free(text);
        text = longer;
    }
    if (!values->frames) return text;
    char *frame = frame_text(values, values->digits < 4 ? 4 : values->digits);
    longer = say_text("%s-%s", text, frame);
    free(frame);
    free(text);
    return longer;
}
