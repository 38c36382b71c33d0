#include "cli/asked.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/say.h"

static const enum option_id change_pixels[] = {OPTION_SIZE,    OPTION_SAMPLES, OPTION_REGION,
                                               OPTION_SHADING, OPTION_SHADOW,  OPTION_NO_SHADOWS,
                                               OPTION_DEPTH,   OPTION_BITS,    OPTION_ENCODING};

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
        fprintf(out, " -D %s=%s", next->name, next->value);
        last = next;
    }
}

char *asked_text(const struct option_value *option, const struct monge_define *defines, size_t define_count,
                 unsigned frame) {
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (!out) {
        say_error("out of memory");
        exit(STATUS_TROUBLE);
    }
    for (size_t i = 0; i < sizeof change_pixels / sizeof *change_pixels; i++) {
        const struct option_value *o = &option[change_pixels[i]];
        if (!o->given) continue;
        fprintf(out, " --%s",
                change_pixels[i] == OPTION_NO_SHADOWS ? "shadow 1" : OPTION_TABLE[change_pixels[i]].name);
        if (o->text) fprintf(out, " %s", o->text);
    }
    print_defines(out, defines, define_count);
    if (frame > 1) fprintf(out, " --frames %u", frame);
    fclose(out);
    char *asked = say_text("%s", *text ? text + 1 : "");
    free(text);
    return asked;
}
