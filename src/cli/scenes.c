#include "cli/scenes.h"

#include <dirent.h>
#include <errno.h>
#include <fnmatch.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/say.h"

/* What is under way. */
struct search {
    struct scenes *scenes;
    const struct arguments *args;
    const struct monge_limits *limits;
    struct report *report;
    enum scenes_wish wish;
    size_t left_out; /* files below folders that are not wanted */
    bool input_read;
};

static void add_operand(struct search *search, const char *operand);

/* ---- Paths ---- */

static bool is_stream(const char *path) { return strcmp(path, "-") == 0; }
static bool is_there(const char *path) { return access(path, F_OK) == 0; }

static bool is_folder(const char *path) {
    struct stat status;
    return stat(path, &status) == 0 && S_ISDIR(status.st_mode);
}

static bool is_link(const char *path) {
    struct stat status;
    return lstat(path, &status) == 0 && S_ISLNK(status.st_mode);
}

/* Where .yaml or .yml begins at the end of the path; NULL: it ends otherwise. */
static const char *extension(const char *path) {
    const char *slash = strrchr(path, '/'), *base = slash ? slash + 1 : path, *dot = strrchr(base, '.');
    const bool yaml = dot && dot > base && (strcmp(dot, ".yaml") == 0 || strcmp(dot, ".yml") == 0);
    return yaml ? dot : NULL;
}

static bool is_pattern(const char *path) { return strpbrk(path, "*?[") != NULL; }

/* ---- What is wrong ---- */

/* An operand, or a line of a list, stands for nothing. */
static void fail_operand(struct search *search) {
    search->scenes->status = STATUS_TROUBLE;
    search->scenes->missing++;
}

static void report_trouble(struct search *search, const char *path, const char *what) {
    report_failure(search->report, "no-match", "%s: %s", path, what);
    fail_operand(search);
}

static void *no_memory(void) {
    say_error("out of memory");
    exit(STATUS_TROUBLE);
}

/* ---- Scenes ---- */

/* The name is the path from `name` on, without its extension. */
static void add_scene(struct search *search, const char *path, const char *name) {
    struct scenes *scenes = search->scenes;
    const char *end = extension(name);
    scenes->all = realloc(scenes->all, (scenes->count + 1) * sizeof *scenes->all);
    if (!scenes->all) no_memory();
    scenes->all[scenes->count++] = (struct scene_file){
        say_text("%s", path), say_text("%.*s", (int)(end ? (size_t)(end - name) : strlen(name)), name)};
}

static void add_file(struct search *search, const char *path) {
    const char *slash = strrchr(path, '/');
    add_scene(search, path, slash && slash[1] ? slash + 1 : path);
}

/* ---- Folders ---- */

/* The names of what is in a folder ("": the current one), but for the hidden, sorted, up to a NULL. To be freed with
 * its texts. NULL: errno says why. */
static char **folder_names(const char *folder) {
    DIR *stream = opendir(*folder ? folder : ".");
    char **names = stream ? calloc(1, sizeof *names) : NULL;
    size_t count = 0;
    for (struct dirent *file; names && (file = readdir(stream));) {
        if (file->d_name[0] == '.') continue;
        names = realloc(names, (count + 2) * sizeof *names);
        if (!names) no_memory();
        names[count++] = say_text("%s", file->d_name);
        names[count] = NULL;
    }
    const int reason = errno;
    if (stream) closedir(stream);
    errno = reason;
    return names;
}

static void free_names(char **names) {
    for (char **name = names; name && *name; name++) free(*name);
    free(names);
}

/* A file that cannot be read is wanted: so that its reading is what tells. */
static bool is_wanted(const struct search *search, const char *path) {
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_text text = {NULL, 0};
    enum monge_text_kind kind = MONGE_TEXT_SCENE;
    if (diag && monge_text_read(path, search->limits, &text, diag))
        kind = monge_text_kind(&text, search->limits);
    monge_text_free(&text);
    monge_diagnostics_free(diag);
    return kind == MONGE_TEXT_SCENE ||
           (kind == MONGE_TEXT_DEFINITIONS && search->wish == SCENES_AND_DEFINITIONS);
}

static void walk(struct search *search, const char *folder, size_t below);

/* Something in a folder; `below`: where in the path the name of a scene begins. */
static void walk_entry(struct search *search, const char *path, size_t below) {
    if (is_folder(path)) {
        if (!is_link(path)) walk(search, path, below);
    } else if (extension(path)) {
        if (is_wanted(search, path))
            add_scene(search, path, path + below);
        else
            search->left_out++;
    }
}

static void walk(struct search *search, const char *folder, size_t below) {
    char **names = folder_names(folder);
    if (!names) {
        report_failure(search->report, "cannot-read", "cannot read %s: %s", folder, strerror(errno));
        fail_operand(search);
    }
    for (char **name = names; name && *name; name++) {
        char *path = say_text("%s/%s", folder, *name);
        walk_entry(search, path, below);
        free(path);
    }
    free_names(names);
}

static int compare_scenes(const void *a, const void *b) {
    const struct scene_file *p = a, *q = b;
    const int order = strcmp(p->name, q->name);
    return order ? order : strcmp(p->path, q->path);
}

static void add_folder(struct search *search, const char *path) {
    size_t length = strlen(path);
    while (length > 1 && path[length - 1] == '/') length--;
    const size_t first = search->scenes->count;
    const enum status before = search->scenes->status;
    char *folder = say_text("%.*s", (int)length, path);
    search->scenes->status = STATUS_YES;
    walk(search, folder, strlen(folder) + 1);
    const size_t found = search->scenes->count - first;
    if (found > 0)
        qsort(search->scenes->all + first, found, sizeof *search->scenes->all, compare_scenes);
    else if (search->scenes->status == STATUS_YES)
        report_trouble(search, path, "there is no scene in this folder");
    if (before > search->scenes->status) search->scenes->status = before;
    free(folder);
}

/* ---- Patterns ---- */

/* Paths that a pattern stands for. */
struct matches {
    char **paths;
    size_t count;
};

static void add_match(struct matches *matches, const char *path) {
    matches->paths = realloc(matches->paths, (matches->count + 1) * sizeof *matches->paths);
    if (!matches->paths) no_memory();
    matches->paths[matches->count++] = say_text("%s", path);
}

static void match(struct matches *matches, const char *folder, const char *pattern);

/* `path` is what the pattern stands for up to its `rest`. */
static void match_rest(struct matches *matches, const char *path, const char *rest) {
    if (!*rest) {
        if (is_there(path)) add_match(matches, path);
    } else if (is_folder(path)) {
        char *folder = say_text("%s/", path);
        match(matches, folder, rest + strspn(rest, "/"));
        free(folder);
    }
}

/* `**` and what follows it, in this folder and in all below. */
static void match_below(struct matches *matches, const char *folder, const char *pattern) {
    char **names = folder_names(folder);
    const char *rest = pattern + 2;
    if (*rest)
        match(matches, folder, rest + strspn(rest, "/"));
    else
        add_match(matches, *folder ? folder : ".");
    for (char **name = names; *rest && name && *name; name++) {
        char *path = say_text("%s%s", folder, *name), *inner = say_text("%s/", path);
        if (is_folder(path) && !is_link(path)) match_below(matches, inner, pattern);
        free(path);
        free(inner);
    }
    free_names(names);
}

/* `folder` ends in a slash, or is empty: the current one. */
static void match(struct matches *matches, const char *folder, const char *pattern) {
    const size_t length = strcspn(pattern, "/");
    const char *rest = pattern + length;
    if (length == 2 && strncmp(pattern, "**", 2) == 0) {
        match_below(matches, folder, pattern);
        return;
    }
    char *part = say_text("%.*s", (int)length, pattern);
    char *plain[] = {part, NULL}, **names = is_pattern(part) ? folder_names(folder) : plain;
    for (char **name = names; name && *name; name++) {
        if (names != plain && fnmatch(part, *name, FNM_PERIOD) != 0) continue;
        char *path = say_text("%s%s", folder, *name);
        match_rest(matches, path, rest);
        free(path);
    }
    if (names != plain) free_names(names);
    free(part);
}

static int compare_paths(const void *a, const void *b) {
    return strcmp(*(char *const *)a, *(char *const *)b);
}

static void add_pattern(struct search *search, const char *pattern) {
    struct matches matches = {NULL, 0};
    const size_t root = strspn(pattern, "/");
    match(&matches, root ? "/" : "", pattern + root);
    if (matches.count == 0) report_trouble(search, pattern, "no file matches");
    if (matches.count > 0) qsort(matches.paths, matches.count, sizeof *matches.paths, compare_paths);
    for (size_t i = 0; i < matches.count; i++)
        if (i == 0 || strcmp(matches.paths[i - 1], matches.paths[i]) != 0)
            is_folder(matches.paths[i]) ? add_folder(search, matches.paths[i])
                                        : add_file(search, matches.paths[i]);
    for (size_t i = 0; i < matches.count; i++) free(matches.paths[i]);
    free(matches.paths);
}

/* ---- Lists ---- */

/* The next line that says something, made a text of its own; NULL: there is none. */
static char *next_line(char **at) {
    while (**at) {
        char *line = *at;
        const size_t length = strcspn(line, "\n");
        *at = line + length + (line[length] == '\n');
        line[length] = '\0';
        for (size_t i = strlen(line); i > 0 && strchr(" \t\r", line[i - 1]); i--) line[i - 1] = '\0';
        if (*line && *line != '#') return line;
    }
    return NULL;
}

static void add_lines(struct search *search, const struct monge_text *text, const char *name) {
    const size_t before = search->scenes->count;
    const enum status status = search->scenes->status;
    char *copy = say_text("%s", text->bytes), *at = copy;
    for (char *line; (line = next_line(&at));) {
        if (*line == '@' || is_stream(line))
            report_trouble(search, name, "a list cannot have a list in it");
        else
            add_operand(search, line);
    }
    if (search->scenes->count == before && search->scenes->status == status)
        report_trouble(search, name, "the list is empty");
    free(copy);
}

static bool read_text(struct search *search, const char *path, struct monge_text *text) {
    if (is_stream(path) && search->input_read) {
        say_usage(search->args->command, "standard input can be only one scene, or one list");
        search->scenes->status = STATUS_TROUBLE;
        return false;
    }
    search->input_read |= is_stream(path);
    struct monge_diagnostics *diag = report_open(search->report);
    const bool good = diag && monge_text_read(path, search->limits, text, diag);
    if (diag) report_close(search->report, diag, true);
    if (!good) fail_operand(search);
    return good;
}

static void add_list(struct search *search, const char *path) {
    struct monge_text text = {NULL, 0};
    if (read_text(search, path, &text)) add_lines(search, &text, is_stream(path) ? "standard input" : path);
    monge_text_free(&text);
}

/* Whether each line is a path: no scene is so, whose `scene:` is neither there nor called .yaml. */
static bool is_list(const struct monge_text *text) {
    char *copy = say_text("%s", text->bytes), *at = copy;
    size_t count = 0;
    bool paths = strlen(copy) == text->size;
    for (char *line; paths && (line = next_line(&at)); count++) paths = is_there(line) || extension(line);
    free(copy);
    return paths && count > 0;
}

static void add_input(struct search *search) {
    struct monge_text text = {NULL, 0};
    if (!read_text(search, "-", &text)) return;
    if (is_list(&text)) {
        add_lines(search, &text, "standard input");
        monge_text_free(&text);
    } else {
        search->scenes->input = text;
        add_scene(search, "-", "stdin");
    }
}

/* ---- Operands ---- */

static void add_operand(struct search *search, const char *operand) {
    if (is_stream(operand))
        add_input(search);
    else if (*operand == '@')
        add_list(search, operand + 1);
    else if (is_folder(operand))
        add_folder(search, operand);
    else if (is_pattern(operand) && !is_there(operand))
        add_pattern(search, operand);
    else
        add_file(search, operand);
}

void scenes_find(struct scenes *scenes, const struct arguments *args, enum scenes_wish wish,
                 const struct monge_limits *limits, struct report *report) {
    *scenes = (struct scenes){.status = STATUS_YES};
    struct search search = {.scenes = scenes, .args = args, .limits = limits, .report = report, .wish = wish};
    for (size_t i = 0; i < args->count; i++) add_operand(&search, args->operands[i]);
    if (search.left_out > 0 && !args->option[OPTION_QUIET].given && report->format == MONGE_FORMAT_TEXT)
        say_note("%zu file%s without a `scene` %s left out", search.left_out, search.left_out == 1 ? "" : "s",
                 search.left_out == 1 ? "is" : "are");
}

void scenes_free(struct scenes *scenes) {
    for (size_t i = 0; i < scenes->count; i++) {
        free(scenes->all[i].path);
        free(scenes->all[i].name);
    }
    free(scenes->all);
    monge_text_free(&scenes->input);
}
