#include "cli/fmt.h"

#include <stdio.h>
#include <string.h>

#include "cli/say.h"
#include "cli/scenes.h"
#include "monge.h"

static bool is_standard(const char *path) { return strcmp(path, "-") == 0; }

/* Deals with a text and its formatted form. */
static enum status settle(const struct arguments *args, const char *path, const struct monge_text *text,
                          const struct monge_text *formatted, struct monge_diagnostics *diag) {
    const bool same = text->size == formatted->size && memcmp(text->bytes, formatted->bytes, text->size) == 0;
    if (args->option[OPTION_CHECK_ONLY].given) {
        if (!same) say_line(stdout, "%s", path);
        return same ? STATUS_YES : STATUS_NO;
    }
    if (same && !is_standard(path)) return STATUS_YES;
    if (!monge_text_write(path, formatted, diag)) return STATUS_TROUBLE;
    if (!is_standard(path) && !args->option[OPTION_QUIET].given) say_note("formatted %s", path);
    return STATUS_YES;
}

static enum status format_text(const struct arguments *args, const char *path, const struct monge_text *text,
                               struct monge_diagnostics *diag) {
    struct monge_text formatted = {NULL, 0};
    enum status status = STATUS_TROUBLE;
    if (monge_format(is_standard(path) ? "<stdin>" : path, text, NULL, &formatted, diag))
        status = settle(args, path, text, &formatted, diag);
    monge_text_free(&formatted);
    return status;
}

static enum status format_scene(const struct arguments *args, const char *path,
                                const struct monge_text *input, struct monge_diagnostics *diag) {
    struct monge_text text = {NULL, 0};
    if (is_standard(path)) return format_text(args, path, input, diag);
    const bool read = monge_text_read(path, NULL, &text, diag);
    const enum status status = read ? format_text(args, path, &text, diag) : STATUS_TROUBLE;
    monge_text_free(&text);
    return status;
}

static enum status format_scenes(const struct arguments *args, const struct scenes *scenes,
                                 struct report *report) {
    enum status worst = scenes->status;
    for (size_t i = 0; i < scenes->count; i++) {
        struct monge_diagnostics *diag = report_open(report);
        const enum status status =
            diag ? format_scene(args, scenes->all[i].path, &scenes->input, diag) : STATUS_TROUBLE;
        streams_flush();
        if (diag) report_close(report, diag, true);
        if (status > worst) worst = status;
    }
    return worst;
}

enum status fmt_command(const struct arguments *args) {
    struct report report = {.format = MONGE_FORMAT_TEXT};
    struct scenes scenes;
    const bool good = scenes_find(&scenes, args, SCENES_AND_DEFINITIONS, NULL, &report);
    const enum status status = good ? format_scenes(args, &scenes, &report) : STATUS_TROUBLE;
    scenes_free(&scenes);
    return status;
}
