#include "cli/golden/settings.h"

#include <errno.h>
#include <fnmatch.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/asked.h"
#include "cli/golden/folder.h"
#include "cli/paths.h"
#include "cli/say.h"
#include "cli/scene_path.h"
#include "cli/words.h"

/* ---- Options ---- */

/* False: a quote is not closed. */
static bool split_words(struct golden_rule *rule, int *count) {
    bool open = false;
    char *at = rule->text = say_text("%s", rule->rule->options);
    rule->words = calloc(strlen(at) + 2, sizeof *rule->words);
    if (!rule->words) say_no_memory();
    for (*count = 0; (rule->words[*count] = word_next(&at, &open)); ++*count) continue;
    if (open) say_error("a quote is not closed");
    return !open;
}

/* Only what changes pixels: the rest is for the test to decide. */
static bool check_options(const struct arguments *args) {
    for (enum option_id o = 0; o < OPTIONS; o++) {
        if (!args->option[o].given || asked_makes_picture(o)) continue;
        say_error("--%s does not change pixels", OPTION_TABLE[o].name);
        return false;
    }
    if (args->count > 0) say_error("expected options alone, found `%s`", args->operands[0]);
    if (args->option[OPTION_SHADOW].given && args->option[OPTION_NO_SHADOWS].given) {
        say_error("--shadow and --no-shadows: give one of them");
        return false;
    }
    return args->count == 0;
}

static bool read_options(struct golden_settings *settings, struct golden_rule *rule,
                         const struct loader *loader) {
    int count = 0;
    rule->loader =
        (struct loader){.limits = loader->limits, .untrusted = loader->untrusted, .report = loader->report};
    char *place = say_text("%s:%u: options", settings->path, rule->rule->line),
         *begin = say_text("%s: ", place);
    say_of(place);
    const bool good = split_words(rule, &count) &&
                      options_parse(COMMAND_RENDER, count, rule->words, &rule->args) &&
                      check_options(&rule->args) && sweep_read(&rule->args, &rule->loader.sweep);
    say_of(NULL);
    if (good) sweep_warn(&rule->args, begin, &loader->report);
    free(begin);
    free(place);
    return good;
}

/* ---- The file ---- */

static void warn_of_other_name(const char *folder) {
    char *other = path_below(folder, "golden.yml", "");
    if (path_is_file(other)) say_error("warning: %s is not read: it must be called golden.yaml", other);
    free(other);
}

static bool read_file(struct golden_settings *settings, const struct loader *loader) {
    if (access(settings->path, F_OK) != 0 && errno == ENOENT) return true;
    if (!golden_check_file(settings->path)) return false;
    struct monge_diagnostics *diag = monge_diagnostics_new();
    settings->file = diag ? monge_goldens_read(settings->path, &loader->limits.load, diag) : NULL;
    if (diag) monge_diagnostics_print(diag, say_stream());
    monge_diagnostics_free(diag);
    return settings->file;
}

static bool find_root(struct golden_settings *settings, const char *folder,
                      const struct option_value *given) {
    const char *root = settings->file ? settings->file->root : NULL;
    char *path = !root ? NULL : *root == '/' ? say_text("%s", root) : path_below(folder, root, "");
    char *own = path ? realpath(path, NULL) : NULL;
    if (path && !own && !(given && given->given))
        say_error("%s: `root`: %s: %s", settings->path, path, strerror(errno));
    free(path);
    settings->root = own;
    if (!given || !given->given) return !root || own;
    settings->root = realpath(given->text, NULL); /* where there is none, scenes_find has told so */
    settings->other_root = root && settings->root && (!own || strcmp(own, settings->root) != 0);
    free(own);
    return settings->root;
}

bool golden_settings_read(struct golden_settings *settings, const char *folder,
                          const enum monge_golden_kind *kind, const struct option_value *root,
                          const struct loader *loader) {
    *settings = (struct golden_settings){.path = path_below(folder, "golden.yaml", "")};
    warn_of_other_name(folder);
    if (!read_file(settings, loader) || !find_root(settings, folder, root)) return false;
    const struct monge_goldens *file = settings->file;
    settings->other = (struct monge_golden_rule){.options = "", .kind = file ? file->kind : MONGE_GOLDEN_PNG};
    settings->count = (file ? file->count : 0) + 1;
    settings->rules = calloc(settings->count, sizeof *settings->rules);
    if (!settings->rules) say_error("out of memory");
    for (size_t i = 0; settings->rules && i < settings->count; i++) {
        settings->rules[i].rule = i + 1 < settings->count ? &file->rules[i] : &settings->other;
        if (kind) ((struct monge_golden_rule *)settings->rules[i].rule)->kind = *kind;
    }
    for (size_t i = 0; settings->rules && i < settings->count; i++)
        if (!read_options(settings, &settings->rules[i], loader)) return false;
    return settings->rules;
}

void golden_settings_free(struct golden_settings *settings) {
    for (size_t i = 0; settings->rules && i < settings->count; i++) {
        struct golden_rule *rule = &settings->rules[i];
        free(rule->text);
        free(rule->words);
        options_free(&rule->args);
        sweep_free(&rule->loader.sweep);
    }
    free(settings->rules);
    monge_goldens_free(settings->file);
    free(settings->root);
    free(settings->path);
}

/* ---- Scenes ---- */

static bool matches(const struct monge_golden_rule *rule, const char *name) {
    for (const char *const *pattern = rule->scenes; pattern && *pattern; pattern++)
        if (fnmatch(*pattern, name, 0) == 0) return true;
    return false;
}

struct golden_rule *golden_settings_find(const struct golden_settings *settings, const char *name) {
    size_t i = 0;
    while (i + 1 < settings->count && !matches(settings->rules[i].rule, name)) i++;
    return &settings->rules[i];
}

char *golden_settings_name(const struct golden_settings *settings, const struct scene_file *scene) {
    if (!settings->root) return say_text("%s", scene->name);
    return scene_name_below(settings->root, scene->path, scene->name);
}

char *golden_settings_root(const struct golden_settings *settings) {
    const char *root = settings->root;
    if (!root) return NULL;
    char *here = getcwd(NULL, 0);
    const size_t length = here ? strlen(here) : 0;
    const bool below =
        length > 1 && strncmp(root, here, length) == 0 && (root[length] == '/' || !root[length]);
    char *path = !below ? say_text("%s", root) : say_text("%s", root[length] ? root + length + 1 : ".");
    free(here);
    return path;
}
