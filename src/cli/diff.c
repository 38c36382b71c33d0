#include "cli/diff.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "cli/say.h"
#include "monge.h"

#define METRIC_BIT(metric) (1u << (metric))

/* What is compared, and how. */
struct diff {
    const struct arguments *args;
    struct monge_picture *a, *b, *mask;
    struct monge_region *ignore; /* owned */
    struct monge_compare how;
    unsigned metrics; /* to be told; a bit each */
};

static const char *const names[MONGE_METRICS] = {"exact", "max", "mae", "rmse", "psnr", "ssim", "flip"};

static bool is_stream(const char *path) { return strcmp(path, "-") == 0; }

static double measure(const struct monge_difference *d, enum monge_metric metric) {
    switch (metric) {
    case MONGE_METRIC_EXACT:
        if (isnan(d->max)) return NAN;
        return d->pixels > 0 ? (double)d->different / (double)d->pixels : 0.0;
    case MONGE_METRIC_MAX: return d->max;
    case MONGE_METRIC_MAE: return d->mae;
    case MONGE_METRIC_RMSE: return d->rmse;
    case MONGE_METRIC_PSNR: return d->psnr;
    case MONGE_METRIC_SSIM: return d->ssim;
    case MONGE_METRIC_FLIP: return d->flip;
    case MONGE_METRICS: break;
    }
    return NAN;
}

/* ---- Whether they pass ---- */

/* Whether --max-delta is a limit for means, not for channels. */
static bool limits_means(const struct diff *diff) {
    const unsigned pixelwise = METRIC_BIT(MONGE_METRIC_EXACT) | METRIC_BIT(MONGE_METRIC_MAX);
    return diff->args->option[OPTION_METRIC].given && !(diff->metrics & pixelwise);
}

/* A metric as an error: 0 for equal pictures. */
static double error_of(const struct monge_difference *d, enum monge_metric metric) {
    if (metric == MONGE_METRIC_PSNR) return d->rmse;
    return metric == MONGE_METRIC_SSIM ? 1.0 - d->ssim : measure(d, metric);
}

/* Each comparison is false of NaN. */
static bool means_pass(const struct diff *diff, const struct monge_difference *d) {
    for (enum monge_metric m = 0; m < MONGE_METRICS; m++)
        if (diff->metrics & METRIC_BIT(m) &&
            !(error_of(d, m) <= diff->args->option[OPTION_MAX_DELTA].fraction))
            return false;
    return true;
}

static bool pixels_pass(const struct diff *diff, const struct monge_difference *d) {
    const struct option_value *most = &diff->args->option[OPTION_MAX_PIXELS];
    return (double)d->beyond <= (most->percent ? most->fraction / 100.0 * (double)d->pixels : most->fraction);
}

static bool passes(const struct diff *diff, const struct monge_difference *d) {
    const bool delta = diff->args->option[OPTION_MAX_DELTA].given;
    const bool pixels = diff->args->option[OPTION_MAX_PIXELS].given;
    if (!delta && !pixels) return d->same;
    if (d->unlike == MONGE_UNLIKE_SIZE || d->unlike == MONGE_UNLIKE_COLOR_SPACE) return false;
    if (!delta || !limits_means(diff)) return pixels_pass(diff, d);
    return means_pass(diff, d) && (!pixels || pixels_pass(diff, d));
}

/* ---- For people ---- */

static void print_unlike(const struct diff *diff, const struct monge_difference *d) {
    const struct monge_picture *a = diff->a, *b = diff->b;
    if (d->unlike == MONGE_UNLIKE_SIZE)
        printf("their sizes are %u x %u and %u x %u pixels", monge_picture_width(a), monge_picture_height(a),
               monge_picture_width(b), monge_picture_height(b));
    else if (d->unlike == MONGE_UNLIKE_COLOR_SPACE)
        printf("their colour spaces are %s and %s", monge_picture_color_space(a),
               monge_picture_color_space(b));
    else
        printf("they have %u and %u bits a channel; ", monge_picture_bits(a), monge_picture_bits(b));
}

static void print_pixels(const struct monge_difference *d) {
    if (d->different == 0) {
        printf("all of %" PRIu64 " pixels are equal", d->pixels);
        return;
    }
    printf("%" PRIu64 " of %" PRIu64 " pixels (%.3g %%), largest difference %.4g at %u,%u", d->different,
           d->pixels, 100.0 * measure(d, MONGE_METRIC_EXACT), d->max, d->max_x, d->max_y);
    if (d->beyond < d->different) printf("; %" PRIu64 " beyond --max-delta", d->beyond);
}

static void print_text(const struct diff *diff, const struct monge_difference *d, bool passed) {
    printf("%s: ", d->same ? "same" : passed ? "within the limits" : "different");
    if (d->unlike != MONGE_UNLIKE_NOTHING) print_unlike(diff, d);
    if (!isnan(d->max)) print_pixels(d);
    printf("\n");
    for (enum monge_metric m = 0; m < MONGE_METRICS; m++)
        if (diff->args->option[OPTION_METRIC].given && diff->metrics & METRIC_BIT(m) && !isnan(measure(d, m)))
            printf("%-5s  %.6g\n", names[m], measure(d, m));
}

/* ---- For programs ---- */

static void print_side(const char *key, const char *path, const struct monge_picture *picture) {
    printf("  \"%s\": {\"file\": ", key);
    monge_write_json_string(path, stdout);
    printf(", \"width\": %u, \"height\": %u, \"bits\": %u, \"channels\": %u, \"colorSpace\": ",
           monge_picture_width(picture), monge_picture_height(picture), monge_picture_bits(picture),
           monge_picture_channels(picture));
    monge_write_json_string(monge_picture_color_space(picture), stdout);
    printf("},\n");
}

static const char *find_reason(const struct monge_difference *d) {
    static const char *const reasons[] = {
        [MONGE_UNLIKE_NOTHING] = "\"pixels\"",
        [MONGE_UNLIKE_SIZE] = "\"size\"",
        [MONGE_UNLIKE_COLOR_SPACE] = "\"color space\"",
        [MONGE_UNLIKE_BITS] = "\"bits\"",
    };
    return d->same ? "null" : reasons[d->unlike];
}

static void print_json(const struct diff *diff, const struct monge_difference *d, bool passed) {
    const struct monge_region *r = &d->bounds;
    printf("{\n  \"same\": %s,\n  \"why\": %s,\n", passed ? "true" : "false", find_reason(d));
    print_side("a", diff->args->operands[0], diff->a);
    print_side("b", diff->args->operands[1], diff->b);
    printf("  \"pixels\": %" PRIu64 ",\n  \"different\": %" PRIu64 ",\n  \"beyond\": %" PRIu64 ",\n",
           d->pixels, d->different, d->beyond);
    if (d->different > 0)
        printf("  \"bounds\": {\"x\": %u, \"y\": %u, \"width\": %u, \"height\": %u},\n  \"largest\": {\"x\": "
               "%u, "
               "\"y\": %u}",
               r->x, r->y, r->width, r->height, d->max_x, d->max_y);
    else
        printf("  \"bounds\": null,\n  \"largest\": null");
    for (enum monge_metric m = 0; m < MONGE_METRICS; m++) {
        const double value = measure(d, m);
        if (!(diff->metrics & METRIC_BIT(m))) continue;
        if (isfinite(value))
            printf(",\n  \"%s\": %.17g", names[m], value);
        else
            printf(",\n  \"%s\": null", names[m]);
    }
    printf("\n}\n");
}

/* ---- The way there ---- */

static bool same_file(const char *a, const char *b) {
    struct stat of_a, of_b;
    return stat(a, &of_a) == 0 && stat(b, &of_b) == 0 && of_a.st_dev == of_b.st_dev &&
           of_a.st_ino == of_b.st_ino;
}

/* The file of --mask, or the last one of --ignore. NULL: none. */
static const char *find_mask(const struct arguments *args, size_t *count) {
    const char *mask = args->option[OPTION_MASK].text;
    uint32_t number[4];
    *count = mask != NULL;
    for (size_t i = 0; i < args->pair_count; i++)
        if (!options_area(&args->pairs[i], number)) {
            mask = args->pairs[i].text;
            ++*count;
        }
    return mask;
}

static bool check_files(const struct arguments *args) {
    const char *out = args->option[OPTION_HEAT_MAP].text;
    size_t masks;
    const char *mask = find_mask(args, &masks);
    if (args->count != 2)
        say_usage(COMMAND_DIFF, "diff: expected two pictures, found %zu", args->count);
    else if (masks > 1)
        say_usage(COMMAND_DIFF, "diff: there can be only one mask");
    else if (is_stream(args->operands[0]) + is_stream(args->operands[1]) + (mask && is_stream(mask)) > 1)
        say_usage(COMMAND_DIFF, "standard input can be only one picture");
    else if (out && is_stream(out) && args->option[OPTION_DIFF_JSON].given)
        say_usage(COMMAND_DIFF, "--out -: standard output takes the JSON object");
    else if (out && !is_stream(out) &&
             (same_file(out, args->operands[0]) || same_file(out, args->operands[1])))
        say_usage(COMMAND_DIFF, "--out %s would write over a picture that is compared", out);
    else
        return true;
    return false;
}

static bool diff_begin(struct diff *diff, const struct arguments *args, struct monge_diagnostics *diag) {
    size_t masks;
    const char *mask = find_mask(args, &masks);
    diff->metrics = args->option[OPTION_METRIC].choices;
    if (!diff->metrics) diff->metrics = METRIC_BIT(MONGE_METRIC_EXACT) | METRIC_BIT(MONGE_METRIC_MAX);
    diff->ignore = calloc(args->pair_count + 1, sizeof *diff->ignore);
    diff->a = monge_picture_read(args->operands[0], diag);
    diff->b = monge_picture_read(args->operands[1], diag);
    if (mask) diff->mask = monge_picture_read(mask, diag);
    diff->how = (struct monge_compare){.metrics = diff->metrics,
                                       .max_delta =
                                           limits_means(diff) ? 0.0 : args->option[OPTION_MAX_DELTA].fraction,
                                       .ppd = args->option[OPTION_PPD].fraction,
                                       .ignore = diff->ignore,
                                       .mask = diff->mask,
                                       .threads = args->option[OPTION_THREADS].number[0]};
    if (!diff->ignore) say_error("out of memory");
    for (size_t i = 0; diff->ignore && i < args->pair_count; i++) {
        uint32_t n[4];
        if (options_area(&args->pairs[i], n))
            diff->ignore[diff->how.ignore_count++] = (struct monge_region){n[0], n[1], n[2], n[3]};
    }
    return diff->ignore && diff->a && diff->b && (!mask || diff->mask);
}

/* Writes the heat map, where one is asked for and can be. */
static bool write_heat_map(struct diff *diff, const struct monge_difference *d,
                           struct monge_diagnostics *diag) {
    const char *path = diff->args->option[OPTION_HEAT_MAP].text;
    if (!path) return true;
    if (d->unlike != MONGE_UNLIKE_SIZE) return monge_heat_map_write(diff->a, diff->b, &diff->how, path, diag);
    say_note("no heat map of pictures of different sizes");
    return true;
}

static enum status compare(struct diff *diff, struct monge_diagnostics *diag) {
    const struct arguments *args = diff->args;
    const char *out = args->option[OPTION_HEAT_MAP].text;
    struct monge_difference d;
    if (!diff_begin(diff, args, diag) || !monge_compare(diff->a, diff->b, &diff->how, &d, diag))
        return STATUS_TROUBLE;
    const bool passed = passes(diff, &d);
    if (args->option[OPTION_DIFF_JSON].given)
        print_json(diff, &d, passed);
    else if (!args->option[OPTION_QUIET].given && !(out && is_stream(out)))
        print_text(diff, &d, passed);
    if (!write_heat_map(diff, &d, diag)) return STATUS_TROUBLE;
    return passed ? STATUS_YES : STATUS_NO;
}

enum status diff_command(const struct arguments *args) {
    struct diff diff = {.args = args};
    if (!check_files(args)) return STATUS_TROUBLE;
    struct monge_diagnostics *diag = monge_diagnostics_new();
    if (!diag) {
        say_error("out of memory");
        return STATUS_TROUBLE;
    }
    const enum status status = compare(&diff, diag);
    streams_flush();
    monge_diagnostics_print(diag, stderr);
    monge_diagnostics_free(diag);
    monge_picture_free(diff.a);
    monge_picture_free(diff.b);
    monge_picture_free(diff.mask);
    free(diff.ignore);
    return status;
}
