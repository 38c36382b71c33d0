#include "cli/golden/targets.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "cli/golden/folder.h"
#include "cli/paths.h"
#include "cli/say.h"

/* Whether the path is the folder, or is below it; of what is not there (yet), too. */
static bool is_within(const char *path, const char *folder) {
    char *real = golden_real_path(path), *real_folder = golden_real_path(folder);
    const size_t length = strcmp(real_folder, "/") == 0 ? 0 : strlen(real_folder);
    const bool within =
        strncmp(real, real_folder, length) == 0 && (real[length] == '/' || real[length] == '\0');
    free(real_folder);
    free(real);
    return within;
}

/* ---- Folders ---- */

static bool keeps_out(const struct golden_run *run, const char *option, const char *path) {
    if (!is_within(path, run->folder)) return true;
    say_error("--%s %s would write into the folder of the goldens, %s", option, path, run->folder);
    return false;
}

/* The run writes into new/ and old/ of its folder, and removes what is there: goldens must not be. */
static bool part_keeps_out(const struct golden_run *run, const char *part) {
    char *path = path_below(run->output, part, "");
    const bool good = !is_within(run->folder, path) && !is_within(path, run->folder);
    free(path);
    return good;
}

static bool output_keeps_out(const struct golden_run *run, bool given) {
    if (!is_within(run->output, run->folder) && part_keeps_out(run, "new") && part_keeps_out(run, "old"))
        return true;
    if (given)
        say_error("--output %s would write into the folder of the goldens, %s", run->output, run->folder);
    else
        say_error("the run would write into the folder of the goldens, %s, as its own is %s: --output names "
                  "another",
                  run->folder, run->output);
    return false;
}

/* ---- Files ---- */

/* A file that the run writes. */
struct target {
    const char *option, *path; /* the path NULL: none; "-" is standard output */
};

static bool is_file_target(const struct target *target) {
    return target->path && strcmp(target->path, "-") != 0 && !path_is_special(target->path);
}

/* What scenes, their includes, and goldens are called: none of the documents is that. */
static bool has_ending_of_input(const char *path) {
    const char *dot = strrchr(path, '.');
    return path_input_extension(path) || (dot && strcasecmp(dot, ".lock") == 0);
}

static bool spares_inputs(const struct golden_run *run, const struct target *target) {
    if (!is_file_target(target)) return true;
    if (path_is_folder(target->path)) {
        say_error("--%s %s: it is a folder", target->option, target->path);
        return false;
    }
    if (!keeps_out(run, target->option, target->path)) return false;
    for (size_t i = 0; i < run->count; i++)
        if (path_is_same(run->scenes[i].path, target->path)) {
            say_error("--%s %s would write over a scene of the run", target->option, target->path);
            return false;
        }
    if (!has_ending_of_input(target->path)) return true;
    say_error("--%s %s: the name ends as those of scenes and goldens do: choose another", target->option,
              target->path);
    return false;
}

static bool are_apart(const struct target *a, const struct target *b) {
    if (!is_file_target(a) || !is_file_target(b)) return true;
    char *p = golden_real_path(a->path), *q = golden_real_path(b->path);
    const bool apart = strcmp(p, q) != 0 && !path_is_same(p, q);
    if (!apart) say_error("--%s and --%s would write the same file, %s", a->option, b->option, b->path);
    free(q);
    free(p);
    return apart;
}

/* The document of --json is that of the results: they may be one file. */
static bool check_files(const struct golden_run *run, const struct option_value *option) {
    const char *report = option[OPTION_REPORT].text;
    char *results = path_below(run->output, "results.json", ""),
         *page = report ? path_below(report, "index.html", "") : NULL;
    const struct target json = {"json", option[OPTION_TEST_JSON].text},
                        junit = {"junit", option[OPTION_JUNIT].text};
    const bool good = spares_inputs(run, &json) && spares_inputs(run, &junit) && are_apart(&json, &junit) &&
                      are_apart(&(struct target){"output", results}, &junit) &&
                      are_apart(&(struct target){"report", page}, &json) &&
                      are_apart(&(struct target){"report", page}, &junit);
    free(page);
    free(results);
    return good;
}

bool golden_check_targets(const struct golden_run *run, const struct option_value *option) {
    const char *report = option[OPTION_REPORT].text;
    return golden_check_output("output", run->output) && (!report || golden_check_output("report", report)) &&
           output_keeps_out(run, option[OPTION_TEST_OUTPUT].given) &&
           (!report || keeps_out(run, "report", report)) && check_files(run, option);
}
