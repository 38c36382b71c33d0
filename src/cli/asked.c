#include "cli/asked.h"

#include <stdio.h>
#include <stdlib.h>

#include "cli/say.h"

static const enum option_id change_pixels[] = {OPTION_SIZE,    OPTION_SAMPLES, OPTION_REGION,
                                               OPTION_SHADING, OPTION_SHADOW,  OPTION_NO_SHADOWS,
                                               OPTION_DEPTH,   OPTION_BITS,    OPTION_ENCODING};

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
        fprintf(out, " --%s", OPTION_TABLE[change_pixels[i]].name);
        if (o->text) fprintf(out, " %s", o->text);
    }
    for (size_t i = 0; i < define_count; i++) fprintf(out, " -D %s=%s", defines[i].name, defines[i].value);
    if (frame) fprintf(out, " --frames %u", frame);
    fclose(out);
    char *asked = say_text("%s", *text ? text + 1 : "");
    free(text);
    return asked;
}
