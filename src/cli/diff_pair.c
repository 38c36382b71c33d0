#include "cli/diff_pair.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/paths.h"

#define METRIC_BIT(metric) (1u << (metric))

const char *const DIFF_VERDICT[] = {"same", "within the limits", "different"};

static const char *const names[MONGE_METRICS] = {"exact", "max", "mae", "rmse", "psnr", "ssim", "flip"};

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

bool diff_limits_means(const struct diff *diff) {
    const unsigned pixelwise = METRIC_BIT(MONGE_METRIC_EXACT) | METRIC_BIT(MONGE_METRIC_MAX);
    return diff->args->option[OPTION_METRIC].given && !(diff->metrics & pixelwise);
}

/* A metric as an error: 0 for equal pictures. */
static double error_of(const struct monge_difference *d, enum monge_metric metric) {
    if (metric == MONGE_METRIC_PSNR) return d->rmse;
    return metric == MONGE_METRIC_SSIM ? 1.0 - d->ssim : measure(d, metric);
}

/* The comparison is false of NaN. */
static bool mean_passes(const struct diff *diff, const struct monge_difference *d, enum monge_metric metric) {
    return error_of(d, metric) <= diff->args->option[OPTION_MAX_DELTA].fraction;
}

static bool means_pass(const struct diff *diff, const struct monge_difference *d) {
    for (enum monge_metric m = 0; m < MONGE_METRICS; m++)
        if (diff->metrics & METRIC_BIT(m) && !mean_passes(diff, d, m)) return false;
    return true;
}

static bool pixels_pass(const struct diff *diff, const struct monge_difference *d) {
    const struct option_value *most = &diff->args->option[OPTION_MAX_PIXELS];
    return (double)d->beyond <= (most->percent ? most->fraction / 100.0 * (double)d->pixels : most->fraction);
}

/* Then bits a channel may differ. */
static bool has_limits(const struct diff *diff) {
    return diff->args->option[OPTION_MAX_DELTA].given || diff->args->option[OPTION_MAX_PIXELS].given;
}

static bool passes(const struct diff *diff, const struct monge_difference *d) {
    const bool delta = diff->args->option[OPTION_MAX_DELTA].given;
    const bool pixels = diff->args->option[OPTION_MAX_PIXELS].given;
    if (!has_limits(diff)) return d->same;
    if (d->unlike == MONGE_UNLIKE_SIZE || d->unlike == MONGE_UNLIKE_COLOR_SPACE) return false;
    if (!delta || !diff_limits_means(diff)) return pixels_pass(diff, d);
    return means_pass(diff, d) && (!pixels || pixels_pass(diff, d));
}

/* ---- The comparison ---- */

const char *diff_overwritten(const struct diff *diff, const char *out, const char *a, const char *b) {
    if (path_is_same(out, a) || path_is_same(out, b)) return "a picture that is compared";
    return diff->mask_file && path_is_same(out, diff->mask_file) ? "the mask" : NULL;
}

static const char *shown(const char *path) { return strcmp(path, "-") == 0 ? "standard input" : path; }

/* What leaves out nothing, or all, is a slip of the pen: of a mask the wrong way round all pictures would be the same. */
static bool check_ignored(const struct diff_pair *pair) {
    const struct report *report = &pair->diff->report;
    const struct monge_compare *how = &pair->diff->how;
    const uint32_t width = monge_picture_width(pair->a), height = monge_picture_height(pair->a);
    for (size_t i = 0; i < how->ignore_count; i++) {
        const struct monge_region *r = &how->ignore[i];
        if (r->x < width && r->y < height) continue;
        report_failure(report, "outside-region", "--ignore %u,%u,%u,%u lies outside of %s, which is %ux%u",
                       r->x, r->y, r->width, r->height, shown(pair->path_a), width, height);
        return false;
    }
    if (pair->difference.pixels > 0) return true;
    report_failure(report, "nothing-compared", "nothing is left to compare in %s: all pixels are ignored%s",
                   shown(pair->path_a), how->mask ? "; a mask leaves out what is not black in it" : "");
    return false;
}

bool diff_pair_compare(struct diff_pair *pair, const struct diff *diff, const char *path_a,
                       const char *path_b, struct monge_diagnostics *diag) {
    *pair = (struct diff_pair){.diff = diff, .path_a = path_a, .path_b = path_b};
    const struct monge_difference *d = &pair->difference;
    if (!monge_picture_read_pair(path_a, path_b, &pair->a, &pair->b, diag) ||
        !monge_compare(pair->a, pair->b, &diff->how, &pair->difference, diag))
        return false;
    if (!isnan(d->max) && !check_ignored(pair)) return false;
    pair->verdict = d->same ? DIFF_SAME : passes(diff, d) ? DIFF_WITHIN : DIFF_DIFFERENT;
    return true;
}

void diff_pair_free(struct diff_pair *pair) {
    monge_picture_free(pair->a);
    monge_picture_free(pair->b);
}

bool diff_pair_write_heat_map(const struct diff_pair *pair, const char *path,
                              struct monge_diagnostics *diag) {
    return monge_heat_map_write(pair->a, pair->b, &pair->diff->how, path, diag);
}

/* ---- For people ---- */

/* With so many digits, or as many more as it takes that what is less than `most` is not shown as that. */
static void print_below(double value, int digits, double most, FILE *out) {
    char text[32];
    do snprintf(text, sizeof text, "%.*g", digits, value);
    while (value < most && strtod(text, NULL) >= most && digits++ < 17);
    fputs(text, out);
}

static void print_unlike(const struct diff_pair *pair, FILE *out) {
    const struct monge_picture *a = pair->a, *b = pair->b;
    const struct monge_difference *d = &pair->difference;
    if (d->unlike == MONGE_UNLIKE_SIZE)
        fprintf(out, "their sizes are %u x %u and %u x %u pixels", monge_picture_width(a),
                monge_picture_height(a), monge_picture_width(b), monge_picture_height(b));
    else if (strcmp(monge_picture_color_space(a), monge_picture_color_space(b)) == 0)
        fprintf(out, "their colour spaces are not the same, though both are called %s",
                monge_picture_color_space(a));
    else
        fprintf(out, "their colour spaces are %s and %s", monge_picture_color_space(a),
                monge_picture_color_space(b));
}

static void print_bits(const struct diff_pair *pair, const char *before, const char *behind, FILE *out) {
    if (pair->difference.unlike == MONGE_UNLIKE_BITS)
        fprintf(out, "%sthey have %u and %u bits a channel%s", before, monge_picture_bits(pair->a),
                monge_picture_bits(pair->b), behind);
}

/* 0 where nothing could be compared. */
static uint64_t count_ignored(const struct diff_pair *pair) {
    const uint64_t all = (uint64_t)monge_picture_width(pair->a) * monge_picture_height(pair->a);
    return isnan(pair->difference.max) ? 0 : all - pair->difference.pixels;
}

static void print_ignored(const struct diff_pair *pair, FILE *out) {
    const uint64_t ignored = count_ignored(pair);
    if (ignored > 0) fprintf(out, "; %" PRIu64 " ignored", ignored);
}

static void print_pixels(const struct diff_pair *pair, FILE *out) {
    const struct monge_difference *d = &pair->difference;
    if (d->different == 0) {
        fprintf(out, "all of %" PRIu64 " pixels are equal", d->pixels);
        print_ignored(pair, out);
        return;
    }
    const struct option_value *option = pair->diff->args->option;
    fprintf(out, "%" PRIu64 " of %" PRIu64 " pixels (", d->different, d->pixels);
    print_below(100.0 * measure(d, MONGE_METRIC_EXACT), 3, 100.0, out);
    fputs(" %), largest difference ", out);
    print_below(d->max, 4, 1.0, out);
    fprintf(out, " at %u,%u", d->max_x, d->max_y);
    if (option[OPTION_MAX_DELTA].given && !diff_limits_means(pair->diff))
        fprintf(out, "; %" PRIu64 " beyond --max-delta", d->beyond);
    if (option[OPTION_MAX_PIXELS].given && !pixels_pass(pair->diff, d))
        fputs("; more than --max-pixels", out);
    print_ignored(pair, out);
}

/* Of what --max-delta is a limit for: of channels that is the largest difference. */
static bool is_beyond(const struct diff_pair *pair, enum monge_metric metric) {
    if (!pair->diff->args->option[OPTION_MAX_DELTA].given) return false;
    if (diff_limits_means(pair->diff)) return !mean_passes(pair->diff, &pair->difference, metric);
    return metric == MONGE_METRIC_MAX && pair->difference.beyond > 0;
}

static void print_metric(const struct diff_pair *pair, enum monge_metric metric, const char *before,
                         FILE *out) {
    fprintf(out, "%s%-5s  ", before, names[metric]);
    print_below(measure(&pair->difference, metric), 6, 1.0, out);
    fputs(is_beyond(pair, metric) ? "  beyond --max-delta\n" : "\n", out);
}

void diff_pair_print(const struct diff_pair *pair, const char *before, FILE *out) {
    const struct monge_difference *d = &pair->difference;
    const unsigned metrics = pair->diff->args->option[OPTION_METRIC].given ? pair->diff->metrics : 0;
    if (isnan(d->max)) {
        print_unlike(pair, out);
    } else { /* first what the verdict is of */
        if (!has_limits(pair->diff)) print_bits(pair, "", "; ", out);
        print_pixels(pair, out);
        if (has_limits(pair->diff)) print_bits(pair, "; ", "", out);
    }
    fputc('\n', out);
    for (enum monge_metric m = 0; m < MONGE_METRICS; m++)
        if (metrics & METRIC_BIT(m) && !isnan(measure(d, m))) print_metric(pair, m, before, out);
}

/* ---- For programs ---- */

static void print_side(const char *key, const char *path, const struct monge_picture *picture, FILE *out) {
    fprintf(out, "  \"%s\": {\"file\": ", key);
    monge_write_json_string(path, out);
    fprintf(out, ", \"width\": %u, \"height\": %u, \"bits\": %u, \"channels\": %u, \"colorSpace\": ",
            monge_picture_width(picture), monge_picture_height(picture), monge_picture_bits(picture),
            monge_picture_channels(picture));
    monge_write_json_string(monge_picture_color_space(picture), out);
    fprintf(out, "},\n");
}

/* With limits bits decide nothing: they are the reason where there is no other difference. */
static const char *find_reason(const struct diff_pair *pair) {
    static const char *const reasons[] = {
        [MONGE_UNLIKE_NOTHING] = "pixels",
        [MONGE_UNLIKE_SIZE] = "size",
        [MONGE_UNLIKE_COLOR_SPACE] = "color space",
        [MONGE_UNLIKE_BITS] = "bits",
    };
    const struct monge_difference *d = &pair->difference;
    const bool of_pixels = d->different > 0 && has_limits(pair->diff);
    return d->same ? NULL : reasons[of_pixels ? MONGE_UNLIKE_NOTHING : d->unlike];
}

/* The beginning of an object. why NULL: they are the same in every respect. */
static void print_verdict(const char *name, bool same, const char *why, FILE *out) {
    fputs("{\n", out);
    if (name) fputs("  \"name\": ", out), monge_write_json_string(name, out), fputs(",\n", out);
    fprintf(out, "  \"same\": %s,\n  \"why\": ", same ? "true" : "false");
    why ? monge_write_json_string(why, out) : (void)fputs("null", out);
}

static void print_file(const char *key, const char *path, FILE *out) {
    fprintf(out, ",\n  \"%s\": %s", key, path ? "{\"file\": " : "null");
    if (path) monge_write_json_string(path, out), fputc('}', out);
}

void diff_print_json_none(const char *name, const char *why, const char *path_a, const char *path_b,
                          FILE *out) {
    print_verdict(name, false, why, out);
    print_file("a", path_a, out);
    print_file("b", path_b, out);
    fputs("\n}", out);
}

void diff_pair_print_json(const struct diff_pair *pair, const char *name, FILE *out) {
    const struct monge_difference *d = &pair->difference;
    const struct monge_region *r = &d->bounds;
    print_verdict(name, pair->verdict != DIFF_DIFFERENT, find_reason(pair), out);
    fputs(",\n", out);
    print_side("a", pair->path_a, pair->a, out);
    print_side("b", pair->path_b, pair->b, out);
    fprintf(out, "  \"pixels\": %" PRIu64 ",\n  \"ignored\": %" PRIu64 ",\n", d->pixels, count_ignored(pair));
    fprintf(out, "  \"different\": %" PRIu64 ",\n  \"beyond\": %" PRIu64 ",\n", d->different, d->beyond);
    if (d->different > 0)
        fprintf(
            out,
            "  \"bounds\": {\"x\": %u, \"y\": %u, \"width\": %u, \"height\": %u},\n  \"largest\": {\"x\": "
            "%u, "
            "\"y\": %u}",
            r->x, r->y, r->width, r->height, d->max_x, d->max_y);
    else
        fprintf(out, "  \"bounds\": null,\n  \"largest\": null");
    for (enum monge_metric m = 0; m < MONGE_METRICS; m++) {
        const double value = measure(d, m);
        if (!(pair->diff->metrics & METRIC_BIT(m))) continue;
        if (isfinite(value))
            fprintf(out, ",\n  \"%s\": %.17g", names[m], value);
        else
            fprintf(out, ",\n  \"%s\": null", names[m]);
    }
    fputs("\n}", out);
}
