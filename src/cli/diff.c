#include "cli/diff.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/diff_folders.h"
#include "cli/paths.h"
#include "cli/say.h"

static bool is_stream(const char *path) { return strcmp(path, "-") == 0; }

/* Whether it is a file, not an area of that many numbers. */
static bool is_mask(const struct option_pair *ignored, uint32_t number[4]) {
    return ignored->option == OPTION_MASK || !options_area(ignored, number);
}

/* The last file of --mask and --ignore, and how many there are. NULL: none. */
static const char *find_mask(const struct arguments *args, size_t *count) {
    const char *mask = NULL;
    uint32_t number[4];
    *count = 0;
    for (size_t i = 0; i < args->pair_count; i++)
        if (is_mask(&args->pairs[i], number)) {
            mask = args->pairs[i].text;
            ++*count;
        }
    return mask;
}

static bool check_inputs(const struct arguments *args) {
    size_t masks;
    const char *mask = find_mask(args, &masks);
    if (args->count != 2)
        say_usage(COMMAND_DIFF, "diff: expected two pictures, found %zu", args->count);
    else if (masks > 1)
        say_usage(COMMAND_DIFF, "there can be only one mask");
    else if (is_stream(args->operands[0]) + is_stream(args->operands[1]) + (mask && is_stream(mask)) > 1)
        say_usage(COMMAND_DIFF, "standard input can be only one picture");
    else
        return true;
    return false;
}

/* Reads what all comparisons share. */
static bool diff_begin(struct diff *diff, const struct arguments *args, struct monge_diagnostics *diag) {
    size_t masks;
    const char *mask = find_mask(args, &masks);
    *diff = (struct diff){.args = args, .metrics = args->option[OPTION_METRIC].choices};
    if (!diff->metrics) diff->metrics = 1u << MONGE_METRIC_EXACT | 1u << MONGE_METRIC_MAX;
    diff->ignore = calloc(args->pair_count + 1, sizeof *diff->ignore);
    if (!diff->ignore) say_error("out of memory");
    diff->mask_file = mask;
    if (mask) diff->mask = monge_picture_read(mask, diag);
    const double delta = diff_limits_means(diff) ? 0.0 : args->option[OPTION_MAX_DELTA].fraction;
    diff->how = (struct monge_compare){.metrics = diff->metrics,
                                       .max_delta = delta,
                                       .ppd = args->option[OPTION_PPD].fraction,
                                       .ignore = diff->ignore,
                                       .mask = diff->mask,
                                       .threads = args->option[OPTION_THREADS].number[0]};
    for (size_t i = 0; diff->ignore && i < args->pair_count; i++) {
        uint32_t n[4];
        if (!is_mask(&args->pairs[i], n))
            diff->ignore[diff->how.ignore_count++] = (struct monge_region){n[0], n[1], n[2], n[3]};
    }
    return diff->ignore && (!mask || diff->mask);
}

/* ---- Two pictures ---- */

static bool check_heat_map(const struct diff *diff, const char *a, const char *b) {
    const struct arguments *args = diff->args;
    const char *out = args->option[OPTION_HEAT_MAP].text;
    if (!out) return true;
    const char *lost = is_stream(out) ? NULL : diff_overwritten(diff, out, a, b);
    if (is_stream(out) && args->option[OPTION_DIFF_JSON].given)
        say_usage(COMMAND_DIFF, "--out -: standard output takes the JSON object");
    else if (lost)
        say_usage(COMMAND_DIFF, "--out %s would write over %s", out, lost);
    else
        return is_stream(out) || path_check_picture(COMMAND_DIFF, "--out", out);
    return false;
}

static void tell_pair(const struct diff_pair *pair, bool compared) {
    const struct option_value *option = pair->diff->args->option;
    const char *out = option[OPTION_HEAT_MAP].text;
    if (option[OPTION_DIFF_JSON].given) {
        if (compared)
            diff_pair_print_json(pair, NULL, stdout);
        else
            diff_print_json_none(NULL, "trouble", pair->path_a, pair->path_b, stdout);
        putchar('\n');
    } else if (compared && !option[OPTION_QUIET].given && !(out && is_stream(out))) {
        printf("%s: ", DIFF_VERDICT[pair->verdict]);
        diff_pair_print(pair, "", stdout);
    }
}

/* Writes the heat map, where one is asked for and can be. */
static bool write_heat_map(const struct diff_pair *pair, struct monge_diagnostics *diag) {
    const char *path = pair->diff->args->option[OPTION_HEAT_MAP].text;
    if (!path) return true;
    if (pair->difference.unlike != MONGE_UNLIKE_SIZE) return diff_pair_write_heat_map(pair, path, diag);
    say_note("no heat map of pictures of different sizes");
    return true;
}

static enum status diff_files(const struct diff *diff, const char *a, const char *b,
                              struct monge_diagnostics *diag) {
    struct diff_pair pair;
    bool good = diff_pair_compare(&pair, diff, a, b, diag);
    tell_pair(&pair, good);
    good = good && write_heat_map(&pair, diag);
    diff_pair_free(&pair);
    return !good ? STATUS_TROUBLE : pair.verdict == DIFF_DIFFERENT ? STATUS_NO : STATUS_YES;
}

/* ---- What the operands are ---- */

/* The operand, or the file in that folder which is called as the other operand. To be freed. NULL: told, of an operand
 * that is not there this alone. */
static char *find_file(const struct diff *diff, const char *operand, const char *other) {
    const char *slash = strrchr(other, '/');
    if (!path_is_folder(operand)) return say_text("%s", operand);
    if (!is_stream(other) && access(other, F_OK) != 0) {
        report_failure(&diff->report, "cannot-read", "cannot read %s: %s", other, strerror(errno));
        return NULL;
    }
    if (!is_stream(other)) return diff_path(operand, slash ? slash + 1 : other);
    say_usage(COMMAND_DIFF, "standard input has no name to look for in %s", operand);
    return NULL;
}

static enum status compare(const struct diff *diff, struct monge_diagnostics *diag) {
    char *const *operands = diff->args->operands;
    if (path_is_folder(operands[0]) && path_is_folder(operands[1]))
        return !diff->mask || monge_picture_decode(diff->mask, diag) ? diff_folders(diff) : STATUS_TROUBLE;
    char *a = find_file(diff, operands[0], operands[1]), *b = find_file(diff, operands[1], operands[0]);
    const enum status status =
        a && b && check_heat_map(diff, a, b) ? diff_files(diff, a, b, diag) : STATUS_TROUBLE;
    free(a);
    free(b);
    return status;
}

enum status diff_command(const struct arguments *args) {
    struct diff diff = {.args = args};
    if (!check_inputs(args)) return STATUS_TROUBLE;
    struct monge_diagnostics *diag = monge_diagnostics_new();
    if (!diag) {
        say_error("out of memory");
        return STATUS_TROUBLE;
    }
    const enum status status = diff_begin(&diff, args, diag) ? compare(&diff, diag) : STATUS_TROUBLE;
    streams_flush();
    monge_diagnostics_print(diag, stderr);
    monge_diagnostics_free(diag);
    monge_picture_free(diff.mask);
    free(diff.ignore);
    return status;
}
