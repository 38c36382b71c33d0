#include "cli/asked.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/say.h"
#include "cli/words.h"

static const enum option_id change_pixels[] = {OPTION_SIZE,    OPTION_SAMPLES, OPTION_REGION,
                                               OPTION_SHADING, OPTION_SHADOW,  OPTION_NO_SHADOWS,
                                               OPTION_DEPTH,   OPTION_BITS,    OPTION_ENCODING};

enum { CHANGE_PIXELS = sizeof change_pixels / sizeof *change_pixels };

bool asked_changes_pixels(enum option_id option) {
    for (size_t i = 0; i < CHANGE_PIXELS; i++)
        if (change_pixels[i] == option) return true;
    return false;
}

bool asked_makes_picture(enum option_id option) {
    return asked_changes_pixels(option) || option == OPTION_DEFINE || option == OPTION_FRAMES;
}

/* ---- As a text, the same for the same values ---- */

/* In as few digits as give the same number again. */
static void print_number(FILE *out, double number) {
    char text[32];
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, number);
        if (strtod(text, NULL) == number) break;
    }
    fputs(text, out);
}

static void print_value(FILE *out, enum option_id id, const struct option_value *value) {
    const uint32_t *n = value->number;
    switch (OPTION_TABLE[id].kind) {
    case VALUE_WHOLE: fprintf(out, " %u", n[0]); break;
    case VALUE_SIZE: fprintf(out, " %ux%u", n[0], n[1]); break;
    case VALUE_REGION: fprintf(out, " %u,%u,%u,%u", n[0], n[1], n[2], n[3]); break;
    case VALUE_FRACTION: fputc(' ', out), print_number(out, value->fraction); break;
    default:
        if (value->text) fprintf(out, " %s", value->text);
    }
}

/* Bytes of a parameter's value without zeros that say nothing: those at the end of 0.10 and of 1.0. */
static size_t value_length(const char *value) {
    const char *digits = value + (*value == '-'), *point = digits + strspn(digits, "0123456789");
    size_t length = strlen(value);
    const bool decimal =
        point > digits && *point == '.' && point[1] && !point[1 + strspn(point + 1, "0123456789")];
    while (decimal && value[length - 1] == '0') length--;
    return decimal && value[length - 1] == '.' ? length - 1 : length;
}

static void print_define(FILE *out, const struct monge_define *define) {
    char *text = say_text("%s=%.*s", define->name, (int)value_length(define->value), define->value),
         *word = word_quoted(text);
    fprintf(out, " -D %s", word);
    free(word);
    free(text);
}

/* By their names, of which each is there once. */
static void print_defines(FILE *out, const struct monge_define *defines, size_t count) {
    const struct monge_define *last = NULL;
    for (size_t printed = 0; printed < count; printed++) {
        const struct monge_define *next = NULL;
        for (size_t i = 0; i < count; i++) {
            const struct monge_define *d = &defines[i];
            if ((!last || strcmp(d->name, last->name) > 0) && (!next || strcmp(d->name, next->name) < 0))
                next = d;
        }
        print_define(out, next);
        last = next;
    }
}

char *asked_text(const struct option_value *option, const struct monge_define *defines, size_t define_count,
                 unsigned frame) {
    char *text = NULL;
    size_t size = 0;
    FILE *out = say_text_begin(&text, &size);
    for (size_t i = 0; i < CHANGE_PIXELS; i++) {
        const struct option_value *o = &option[change_pixels[i]];
        if (!o->given) continue;
        fprintf(out, " --%s",
                change_pixels[i] == OPTION_NO_SHADOWS ? "shadow 1" : OPTION_TABLE[change_pixels[i]].name);
        print_value(out, change_pixels[i], o);
    }
    print_defines(out, defines, define_count);
    if (frame > 1) fprintf(out, " --frames %u", frame);
    say_text_end(out);
    char *asked = say_text("%s", *text ? text + 1 : "");
    free(text);
    return asked;
}

/* ---- What it means for a scene ---- */

void asked_settings(const struct option_value *option, struct monge_settings *settings) {
    if (option[OPTION_SIZE].given) {
        settings->width = option[OPTION_SIZE].number[0];
        settings->height = option[OPTION_SIZE].number[1];
    }
    if (option[OPTION_SAMPLES].given) settings->samples = option[OPTION_SAMPLES].number[0];
    if (option[OPTION_DEPTH].given) settings->depth = option[OPTION_DEPTH].number[0];
    if (option[OPTION_BITS].given) settings->bits = option[OPTION_BITS].choice == 0 ? 8 : 16;
    if (option[OPTION_SHADOW].given) settings->shadow = option[OPTION_SHADOW].fraction;
    if (option[OPTION_NO_SHADOWS].given) settings->shadow = 1.0;
    if (option[OPTION_SHADING].given) settings->shading = (enum monge_shading)option[OPTION_SHADING].choice;
    if (option[OPTION_ENCODING].given)
        settings->encoding = (enum monge_encoding)option[OPTION_ENCODING].choice;
}

bool asked_region(const struct option_value *option, const char *scene, const struct monge_settings *settings,
                  const struct report *report, struct monge_region *region) {
    *region = (struct monge_region){0, 0, settings->width, settings->height};
    if (!option->given) return true;
    const uint32_t *n = option->number;
    *region = (struct monge_region){n[0], n[1], n[2], n[3]};
    if ((uint64_t)n[0] + n[2] <= settings->width && (uint64_t)n[1] + n[3] <= settings->height) return true;
    report_failure(report, "outside-region",
                   "--region %s does not lie within the picture of %s, which is %ux%u", option->text, scene,
                   settings->width, settings->height);
    return false;
}

/* Where the range begins within the animation, that to its end is what may be meant. */
static void report_beyond(const struct option_value *option, const char *scene, unsigned total,
                          const struct report *report) {
    const unsigned first = option->number[0], step = option->number[2];
    char *every = step > 1 ? say_text(":%u", step) : say_text("%s", "");
    char *hint = first <= total ? say_text("; %u-%s goes to the last", first, every) : say_text("%s", "");
    report_failure(report, "no-frame", "--frames %s: %s has %u frame%s%s", option->text, scene, total,
                   total == 1 ? "" : "s", hint);
    free(hint);
    free(every);
}

unsigned *asked_frames(const struct option_value *option, const char *scene, unsigned total,
                       const struct report *report, size_t *count) {
    const unsigned first = option->given ? option->number[0] : 1,
                   step = option->given ? option->number[2] : 1;
    const bool all = option->given && first == 1 && option->number[1] == 0, still = total == 0;
    const unsigned last = !option->given || (all && still) ? 1
                          : option->number[1]              ? option->number[1]
                                                           : total;
    if (option->given && still && !all) {
        report_failure(report, "no-frame",
                       "--frames %s: %s has no animation; `animation: {frames: 48}` makes one", option->text,
                       scene);
        return NULL;
    }
    if (option->given && !still && (first > total || last > total)) {
        report_beyond(option, scene, total, report);
        return NULL;
    }
    *count = (last - first) / step + 1;
    unsigned *frames = calloc(*count, sizeof *frames);
    for (size_t i = 0; frames && i < *count; i++) frames[i] = first + (unsigned)i * step;
    if (!frames) say_error("out of memory");
    return frames;
}
