#include "cli/golden/files.h"

#include <stdlib.h>
#include <string.h>

#include "cli/aov.h"
#include "cli/golden/folder.h"
#include "cli/golden/page.h"
#include "cli/golden/tell.h"
#include "cli/paths.h"
#include "cli/say.h"

struct paths {
    char **all;
    size_t count;
};

static bool write_file(const char *path, const char *content) {
    const struct monge_text text = {(char *)content, strlen(content)};
    if (strcmp(path, "-") != 0) return golden_write(path, &text);
    fputs(content, stdout);
    return true;
}

static void add_path(struct paths *paths, char *path) {
    char **all = path_is_file(path) ? realloc(paths->all, (paths->count + 1) * sizeof *all) : NULL;
    if (all) {
        paths->all = all;
        paths->all[paths->count++] = path;
    } else {
        free(path);
    }
}

static void add_pictures(struct paths *paths, const char *picture) {
    if (!picture) return;
    add_path(paths, say_text("%s", picture));
    for (enum monge_layer layer = 0; layer < MONGE_LAYERS; layer++) add_path(paths, aov_path(layer, picture));
}

static bool write_report(const struct golden_results *results, const char *folder, const char *json) {
    struct paths paths = {NULL, 0};
    char *page = path_below(folder, "index.html", "");
    for (size_t i = 0; i < results->count; i++) {
        add_pictures(&paths, results->cases[i].golden_path);
        add_pictures(&paths, results->cases[i].new_path);
    }
    const bool good = path_make_folders(page) && page_write(page, json, paths.all, paths.count);
    for (size_t i = 0; i < paths.count; i++) free(paths.all[i]);
    free(paths.all);
    free(page);
    return good;
}

bool golden_files_write(const struct golden_results *results, const char *output,
                        const struct option_value *option) {
    char *json = golden_results_text(results), *path = path_below(output, "results.json", "");
    bool good = write_file(path, json);
    if (option[OPTION_TEST_JSON].given) good &= write_file(option[OPTION_TEST_JSON].text, json);
    if (option[OPTION_JUNIT].given) {
        char *xml = golden_junit_text(results);
        good &= write_file(option[OPTION_JUNIT].text, xml);
        free(xml);
    }
    if (option[OPTION_REPORT].given) good &= write_report(results, option[OPTION_REPORT].text, json);
    free(path);
    free(json);
    return good;
}
