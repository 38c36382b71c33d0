#include "cli/golden/rules.h"

#include <fnmatch.h>

#include "cli/matches.h"
#include "cli/say.h"
#include "cli/suggest.h"

void golden_warn_of_tolerances(const struct golden_run *run) {
    for (size_t i = 0; i < run->settings.count; i++) {
        const struct monge_golden_rule *rule = run->settings.rules[i].rule;
        if (rule->tolerance && !golden_knows_tolerance(run, rule->kind))
            say_error("warning: %s:%u: the tolerance of this rule counts for nothing: goldens that are "
                      "hashes have no "
                      "pixels to compare, which `kind: png` keeps",
                      run->settings.path, rule->line);
    }
}

/* ---- Rules without scenes ---- */

static bool matches_any(const struct golden_run *run, const char *pattern) {
    for (size_t i = 0; i < run->count; i++)
        if (fnmatch(pattern, run->scenes[i].name, 0) == 0) return true;
    return false;
}

static bool has_scene(const struct golden_run *run, const struct golden_rule *rule) {
    for (size_t i = 0; i < run->count; i++)
        if (run->scenes[i].rule == rule) return true;
    return false;
}

static void warn_of_pattern(const struct golden_run *run, const struct monge_golden_rule *rule,
                            const char *pattern) {
    struct suggestion nearest = {.word = pattern};
    for (size_t i = 0; i < run->count && !is_pattern(pattern); i++)
        suggestion_try(&nearest, run->scenes[i].name);
    const char *best = suggestion_best(&nearest);
    say_error("warning: %s:%u: no scene matches `%s`%s%s%s", run->settings.path, rule->line, pattern,
              best ? "; did you mean `" : "", best ? best : "", best ? "`?" : "");
}

void golden_warn_of_unused(const struct golden_run *run) {
    const struct golden_settings *settings = &run->settings;
    for (size_t i = 0; i + 1 < settings->count; i++) { /* the last is for the rest */
        const struct monge_golden_rule *rule = settings->rules[i].rule;
        bool matches = false;
        for (const char *const *pattern = rule->scenes; pattern && *pattern; pattern++)
            if (matches_any(run, *pattern))
                matches = true;
            else
                warn_of_pattern(run, rule, *pattern);
        if (matches && !has_scene(run, &settings->rules[i]))
            say_error("warning: %s:%u: earlier rules match all its scenes", settings->path, rule->line);
    }
}
