/* The library's face: what a scene, or the settings of goldens, say of how they are tested. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "face.h"
#include "lang/file.h"

/* ---- Tolerances ---- */

/* Digits, perhaps with a point and more digits; *text moves behind them. */
static bool read_decimal(const char **text, double *value) {
    const char *begin = *text;
    double unit = 1.0;
    *value = 0.0;
    for (; (unsigned)(**text - '0') < 10; ++*text) *value = 10.0 * *value + (**text - '0');
    if (*text == begin || **text != '.') return *text > begin;
    for (++*text; (unsigned)(**text - '0') < 10; ++*text) *value += (unit /= 10.0) * (**text - '0');
    return true;
}

static bool read_pixels(struct diagnostics *diag, const struct object_value *object,
                        struct monge_tolerance *out) {
    const char *text = object_text(object, KEY_TOLERANCE_PIXELS), *at = text;
    if (!text) return true;
    const bool number = read_decimal(&at, &out->pixels);
    out->percent = *at == '%';
    const bool whole = out->pixels == floor(out->pixels), all = out->pixels <= 100.0;
    if (number && !at[out->percent] && (out->percent ? all : whole)) return true;
    const struct span span = object_span(object, KEY_TOLERANCE_PIXELS);
    if (number && out->percent && !at[1]) {
        diag_error(diag, span, "out-of-range", "`pixels`: must be 100%% or less, found `%.40s`", text);
        return false;
    }
    struct diagnostic *d =
        diag_error(diag, span, "not-a-number", "`pixels`: expected a number of pixels, found `%.40s`", text);
    if (number && strcmp(at, " %") == 0)
        diag_help(diag, d, "did you mean %g%%?", out->pixels);
    else
        diag_help(diag, d, "a part of all is written with %%, as 0.1%%");
    return false;
}

static double bound(const struct object_value *object, int key) {
    return object_has(object, key) ? object_number(object, key) : (double)NAN;
}

static bool states_nothing(const struct monge_tolerance *t) {
    return isnan(t->max) && isnan(t->mae) && isnan(t->rmse) && isnan(t->flip) && isnan(t->psnr) &&
           isnan(t->ssim);
}

bool face_tolerance(struct diagnostics *diag, const struct object_value *object,
                    struct monge_tolerance *out) {
    *out = (struct monge_tolerance){.max = bound(object, KEY_TOLERANCE_MAX),
                                    .mae = bound(object, KEY_TOLERANCE_MAE),
                                    .rmse = bound(object, KEY_TOLERANCE_RMSE),
                                    .flip = bound(object, KEY_TOLERANCE_FLIP),
                                    .psnr = bound(object, KEY_TOLERANCE_PSNR),
                                    .ssim = bound(object, KEY_TOLERANCE_SSIM),
                                    .reason = object_text(object, KEY_TOLERANCE_REASON)};
    if (object->failed || !read_pixels(diag, object, out)) return false;
    if (object_has(object, KEY_TOLERANCE_PIXELS) && isnan(out->max)) out->max = 0.0;
    if (!states_nothing(out)) return true;
    struct diagnostic *d =
        diag_error(diag, object->span, "missing-key", "a tolerance states at least one bound");
    diag_help(diag, d, "one of max, pixels, mae, rmse, psnr, ssim, flip");
    return false;
}

const struct monge_tolerance *monge_scene_tolerance(const struct monge_scene *scene) {
    return scene->tolerance.reason ? &scene->tolerance : NULL;
}

/* ---- golden.yaml ---- */

struct settings_file {
    struct monge_goldens goldens; /* first: what the caller has of it */
    struct lang_memory memory;
};

static void read_rule(struct arena *arena, struct diagnostics *diag, const struct object_value *object,
                      enum monge_golden_kind kind, struct monge_golden_rule *rule) {
    const struct object_value *tolerance = object_object(object, KEY_GOLDEN_RULE_TOLERANCE);
    const char *options = object_text(object, KEY_GOLDEN_RULE_OPTIONS);
    *rule = (struct monge_golden_rule){.scenes = object_texts(arena, object, KEY_GOLDEN_RULE_SCENES),
                                       .options = options ? options : "",
                                       .kind = kind,
                                       .aov = object_choice(object, KEY_GOLDEN_RULE_AOV),
                                       .line = object->span.line + 1};
    if (object_has(object, KEY_GOLDEN_RULE_KIND))
        rule->kind = (enum monge_golden_kind)object_choice(object, KEY_GOLDEN_RULE_KIND);
    if (object_has(object, KEY_GOLDEN_RULE_SCENES) && !rule->scenes)
        diag_error(diag, object_span(object, KEY_GOLDEN_RULE_SCENES), "not-a-text",
                   "`scenes`: expected the name of a scene, or a list of names");
    if (!tolerance) return;
    struct monge_tolerance *read = arena_alloc(arena, sizeof *read);
    rule->tolerance = read;
    face_tolerance(diag, tolerance, read);
}

static void read_rules(struct settings_file *file, struct diagnostics *diag,
                       const struct object_value *object) {
    const struct object_list list = object_list(object, KEY_GOLDENS_RULES);
    struct arena *arena = &file->memory.kept;
    struct monge_golden_rule *rules = arena_array(arena, list.count + 1, sizeof *rules);
    const enum monge_golden_kind kind = (enum monge_golden_kind)object_choice(object, KEY_GOLDENS_KIND);
    for (uint32_t i = 0; i < list.count; i++) read_rule(arena, diag, list.items[i], kind, &rules[i]);
    file->goldens = (struct monge_goldens){
        .root = object_text(object, KEY_GOLDENS_ROOT), .kind = kind, .rules = rules, .count = list.count};
}

/* Nothing but blanks, comments, and `---` at the beginning of a line: that is as `{}`, without rules. */
static bool is_empty(const struct source *source) {
    const char *at = source->text, *end = at + source->size;
    bool comment = false, line_begins = true;
    for (; at < end; at++) {
        if (line_begins && end - at >= 3 && memcmp(at, "---", 3) == 0) at += 3;
        if (at == end) break;
        line_begins = *at == '\n' || *at == '\r';
        comment = !line_begins && (comment || *at == '#');
        if (!comment && !line_begins && *at != ' ' && *at != '\t') return false;
    }
    return true;
}

static bool read_settings(struct settings_file *file, const char *path, const struct monge_limits *limits,
                          struct diagnostics *diag) {
    const unsigned errors = diag->errors, failures = diag->failures;
    const struct source *source = file_read(&file->memory.nodes, diag, path, limits->file_bytes);
    if (!source) return false;
    if (is_empty(source)) return true;
    const struct lang_input input = {.source = source, .path = path, .limits = face_lang_limits(limits)};
    const struct object_value *object = lang_read_goldens(&file->memory, diag, &input);
    if (object) read_rules(file, diag, object);
    return object && diag->errors == errors && diag->failures == failures;
}

struct monge_goldens *monge_goldens_read(const char *path, const struct monge_limits *given,
                                         struct monge_diagnostics *diag) {
    const struct monge_limits limits = face_limits(given);
    struct settings_file *file = calloc(1, sizeof *file);
    jmp_buf full;
    volatile bool good = false;
    diag_begin(&diag->list);
    if (file) {
        file->memory.nodes.limit = limits.memory_bytes;
        file->memory.nodes.on_full = &full;
    }
    if (file && setjmp(full) == 0)
        good = read_settings(file, path, &limits, &diag->list);
    else
        face_report_full(&diag->list, path, limits.memory_bytes);
    if (good) return &file->goldens;
    if (file) monge_goldens_free(&file->goldens);
    return NULL;
}

void monge_goldens_free(struct monge_goldens *goldens) {
    struct settings_file *file = (struct settings_file *)goldens; /* its first member */
    if (file) lang_memory_free(&file->memory);
    free(file);
}
