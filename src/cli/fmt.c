#include "cli/fmt.h"

#include <stdio.h>
#include <string.h>

#include "cli/say.h"
#include "monge.h"

static bool is_standard(const char *path) { return strcmp(path, "-") == 0; }

/* Deals with a text and its formatted form. */
static enum status settle(const struct arguments *args, const char *path, const struct monge_text *text,
                          const struct monge_text *formatted, struct monge_diagnostics *diag) {
    const bool same = text->size == formatted->size && memcmp(text->bytes, formatted->bytes, text->size) == 0;
    if (args->option[OPTION_CHECK_ONLY].given) {
        if (!same) printf("%s\n", path);
        return same ? STATUS_YES : STATUS_NO;
    }
    if (same && !is_standard(path)) return STATUS_YES;
    if (!monge_text_write(path, formatted, diag)) return STATUS_TROUBLE;
    if (!is_standard(path) && !args->option[OPTION_QUIET].given) say_note("formatted %s", path);
    return STATUS_YES;
}

static enum status format_scene(const struct arguments *args, const char *path,
                                struct monge_diagnostics *diag) {
    struct monge_text text = {NULL, 0}, formatted = {NULL, 0};
    enum status status = STATUS_TROUBLE;
    if (monge_text_read(path, NULL, &text, diag) &&
        monge_format(is_standard(path) ? "<stdin>" : path, &text, NULL, &formatted, diag))
        status = settle(args, path, &text, &formatted, diag);
    monge_text_free(&text);
    monge_text_free(&formatted);
    return status;
}

enum status fmt_command(const struct arguments *args) {
    enum status worst = STATUS_YES;
    for (size_t i = 0; i < args->count; i++) {
        struct monge_diagnostics *diag = monge_diagnostics_new();
        if (!diag) {
            say_error("out of memory");
            return STATUS_TROUBLE;
        }
        const enum status status = format_scene(args, args->operands[i], diag);
        streams_flush();
        monge_diagnostics_print(diag, stderr);
        monge_diagnostics_free(diag);
        if (status > worst) worst = status;
    }
    return worst;
}
