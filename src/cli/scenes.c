#include "cli/scenes.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/matches.h"
#include "cli/paths.h"
#include "cli/say.h"
#include "cli/scene_path.h"

/* Files of folders and patterns that are not wanted, and are to be told. */
struct left_out {
    char *names;  /* "a.yaml, b.yaml"; NULL: none */
    size_t count; /* of more than a few the others are in this number alone */
};

/* What is under way. */
struct search {
    struct scenes *scenes;
    const struct arguments *args;
    const struct monge_limits *limits;
    struct report *report;
    enum scenes_wish wish;
    struct left_out no_scenes, special; /* special: pipes and devices, which may never end */
};

/* ---- Paths ---- */

static bool is_stream(const char *path) { return strcmp(path, "-") == 0; }
static bool is_there(const char *path) { return access(path, F_OK) == 0; }

/* ---- What is wrong ---- */

/* An operand, or a line of a list, stands for nothing. */
static void fail_operand(struct search *search, const char *path) {
    struct scenes *scenes = search->scenes;
    scenes->status = STATUS_TROUBLE;
    scenes->lost = realloc(scenes->lost, (scenes->missing + 1) * sizeof *scenes->lost);
    if (!scenes->lost) say_no_memory();
    scenes->lost[scenes->missing++] = say_text("%s", path);
}

static void report_trouble(struct search *search, const char *path, const char *what) {
    report_failure(search->report, "no-match", "%s: %s", path, what);
    fail_operand(search, path);
}

/* errno says why. */
static void fail_reading(struct search *search, const char *path) {
    report_failure(search->report, "cannot-read", "cannot read %s: %s", path, strerror(errno));
    fail_operand(search, path);
}

/* ---- Scenes ---- */

/* The name is the path from `name` on, without its extension. */
static void add_scene(struct search *search, const char *path, const char *name) {
    struct scenes *scenes = search->scenes;
    scenes->all = realloc(scenes->all, (scenes->count + 1) * sizeof *scenes->all);
    if (!scenes->all) say_no_memory();
    scenes->all[scenes->count++] = (struct scene_file){say_text("%s", path), scene_name(name)};
}

/* ---- Folders ---- */

static bool is_settings(const char *path) {
    const char *slash = strrchr(path, '/');
    return strcmp(slash ? slash + 1 : path, "golden.yaml") == 0;
}

enum { FEW = 10 }; /* names that are worth a line, but for `monge check`, which has all */

static bool tells_all(const struct search *search) { return search->args->command == COMMAND_CHECK; }

static void leave_out(const struct search *search, struct left_out *left_out, const char *path) {
    if (++left_out->count > FEW && !tells_all(search)) return;
    char *before = left_out->names;
    left_out->names = before ? say_text("%s, %s", before, path) : say_text("%s", path);
    free(before);
}

/* What is no scene as its author meant it, definitions and settings of goldens, is told by `monge check` alone. */
static void leave_out_kind(struct search *search, const char *path, enum monge_text_kind kind) {
    const bool meant = kind == MONGE_TEXT_DEFINITIONS || is_settings(path);
    if (!meant || tells_all(search)) leave_out(search, &search->no_scenes, path);
}

static bool is_quiet(const struct search *search) {
    return search->args->option[OPTION_QUIET].given || search->report->format != MONGE_FORMAT_TEXT;
}

static void mention(const struct search *search, const struct left_out *left_out, const char *one,
                    const char *many) {
    const size_t count = left_out->count;
    const bool more = count > FEW && !tells_all(search);
    if (count == 0 || is_quiet(search)) return;
    say_note("%zu %s left out: %s%s", count, count == 1 ? one : many, left_out->names, more ? ", ..." : "");
}

static void walk(struct search *search, const char *folder, size_t below);

/* Something in a folder; `below`: where in the path the name of a scene begins. */
static void walk_entry(struct search *search, const char *path, size_t below) {
    if (path_is_folder(path)) {
        if (!path_is_link(path)) walk(search, path, below);
        return;
    }
    if (!scene_extension(path)) return;
    if (path_is_special(path)) {
        leave_out(search, &search->special, path);
        return;
    }
    const enum monge_text_kind kind = scene_kind(path, search->limits);
    const bool definitions = kind == MONGE_TEXT_DEFINITIONS && search->wish == SCENES_AND_DEFINITIONS;
    if (kind == MONGE_TEXT_SCENE || definitions)
        add_scene(search, path, path + below);
    else
        leave_out_kind(search, path, kind);
}

static void walk(struct search *search, const char *folder, size_t below) {
    char **names = folder_names(folder);
    if (!names) {
        fail_reading(search, folder);
    }
    for (char **name = names; name && *name; name++) {
        char *path = say_text("%s%s%s", folder, strcmp(folder, "/") == 0 ? "" : "/", *name);
        walk_entry(search, path, below);
        free(path);
    }
    folder_names_free(names);
}

static int compare_scenes(const void *a, const void *b) {
    const struct scene_file *p = a, *q = b;
    const int order = strcmp(p->name, q->name);
    return order ? order : strcmp(p->path, q->path);
}

/* `below`: where in the path the names of its scenes begin; at its end, or beyond: behind it. */
static void add_folder(struct search *search, const char *path, size_t below) {
    size_t length = strlen(path);
    while (length > 1 && path[length - 1] == '/') length--;
    const size_t first = search->scenes->count;
    const enum status before = search->scenes->status;
    const size_t behind = length + (path[length - 1] != '/');
    search->scenes->several = true;
    char *folder = say_text("%.*s", (int)length, path);
    search->scenes->status = STATUS_YES;
    walk(search, folder, below < length ? below : behind);
    const size_t found = search->scenes->count - first;
    if (found > 0)
        qsort(search->scenes->all + first, found, sizeof *search->scenes->all, compare_scenes);
    else if (search->scenes->status == STATUS_YES)
        report_trouble(search, path, "there is no scene in this folder");
    if (before > search->scenes->status) search->scenes->status = before;
    free(folder);
}

/* ---- Lists ---- */

/* A text as a list, of lines; where it has a NUL, of what is between those. */
struct list {
    char *copy, *at, *end; /* copy: owned */
    char separator;
};

static struct list list_begin(const struct monge_text *text) {
    static const char mark[] = "\xEF\xBB\xBF"; /* of UTF-8, by some editors */
    struct list list = {.copy = malloc(text->size + 1)};
    if (!list.copy) say_no_memory();
    memcpy(list.copy, text->bytes, text->size + 1);
    list.separator = memchr(list.copy, '\0', text->size) ? '\0' : '\n';
    list.at = list.copy + (list.separator && strncmp(list.copy, mark, 3) == 0 ? 3 : 0);
    list.end = list.copy + text->size;
    return list;
}

static char *trimmed(char *line) {
    line += strspn(line, " \t\r");
    for (size_t i = strlen(line); i > 0 && strchr(" \t\r", line[i - 1]); i--) line[i - 1] = '\0';
    return *line == '#' ? line + strlen(line) : line;
}

/* The next entry that says something; NULL: there is none. What is between NULs is a name as it stands. */
static char *list_next(struct list *list) {
    while (list->at < list->end) {
        char *entry = list->at, *stop = memchr(entry, list->separator, (size_t)(list->end - entry));
        list->at = stop ? stop + 1 : list->end;
        if (stop) *stop = '\0';
        if (list->separator) entry = trimmed(entry);
        if (*entry) return entry;
    }
    return NULL;
}

static void add_name(struct search *search, const char *name);

/* `path` as the command line has it. */
static void add_entries(struct search *search, const struct monge_text *text, const char *path) {
    const size_t before = search->scenes->count;
    const enum status status = search->scenes->status;
    const char *called = is_stream(path) ? "standard input" : path;
    struct list list = list_begin(text);
    search->scenes->several = true;
    for (char *entry; (entry = list_next(&list));)
        if (list.separator && (*entry == '@' || is_stream(entry)))
            report_trouble(search, called, "a list cannot have a list in it");
        else
            add_name(search, entry);
    free(list.copy);
    if (search->scenes->count > before || search->scenes->status > status) return;
    if (!is_stream(path))
        report_trouble(search, called, "the list is empty");
    else if (!is_quiet(search))
        say_note("the list is empty: nothing to %s", COMMAND_TABLE[search->args->command].name);
}

static bool read_text(struct search *search, const char *path, struct monge_text *text) {
    struct monge_diagnostics *diag = report_open(search->report);
    const bool good = diag && monge_text_read(path, search->limits, text, diag);
    if (diag) report_close(search->report, diag, true);
    if (!good) fail_operand(search, path);
    return good;
}

/* Of which each NUL would end a name. */
static bool is_picture(const struct monge_text *text) {
    return text->size >= 8 && memcmp(text->bytes, "\x89PNG\r\n\x1a\n", 8) == 0;
}

/* Whether each entry is a path: no scene is so, whose `scene:` is neither there nor called .yaml. */
static bool is_list(const struct monge_text *text) {
    struct list list = list_begin(text);
    size_t count = 0;
    bool paths = true;
    for (char *entry; paths && (entry = list_next(&list)); count++)
        paths = is_there(entry) || scene_extension(entry);
    free(list.copy);
    return paths && count > 0;
}

static void note_list(struct scenes *scenes, const char *path) {
    scenes->lists = realloc(scenes->lists, (scenes->list_count + 1) * sizeof *scenes->lists);
    if (!scenes->lists) say_no_memory();
    scenes->lists[scenes->list_count++] = say_text("%s", path);
}

/* Whether every other byte from `first` on is NUL, and there are folders, extensions or lines in between: as names between NULs
 * these would be "/", "." and such. */
static bool is_every_other_nul(const struct monge_text *text, size_t first) {
    bool found = false;
    for (size_t i = 0; i + 1 < text->size; i += 2) {
        if (text->bytes[i + first] != '\0') return false;
        found |= strchr("/.\n", text->bytes[i + 1 - first]) != NULL && text->bytes[i + 1 - first];
    }
    return found;
}

/* By the mark at its beginning, or without one; every other byte of it would end a name. */
static bool is_utf16(const struct monge_text *text) {
    const bool marked = text->size >= 2 &&
                        (memcmp(text->bytes, "\xFF\xFE", 2) == 0 || memcmp(text->bytes, "\xFE\xFF", 2) == 0);
    return marked || is_every_other_nul(text, 0) || is_every_other_nul(text, 1);
}

/* NULL: it may be one. */
static const char *why_no_list(const char *path, const struct monge_text *text) {
    if (is_picture(text)) return "this is a picture, and no list of scenes";
    if (is_utf16(text)) return "this list is in UTF-16: save it as UTF-8";
    if (scene_extension(path) && !is_list(text)) return "this is a scene, and no list: give it without the @";
    return NULL;
}

static void read_list(struct search *search, const char *path) {
    struct monge_text text = {NULL, 0};
    if (!read_text(search, path, &text)) return;
    const char *wrong = why_no_list(path, &text);
    note_list(search->scenes, path);
    if (wrong)
        report_trouble(search, is_stream(path) ? "standard input" : path, wrong);
    else
        add_entries(search, &text, path);
    monge_text_free(&text);
}

static void add_list(struct search *search, const char *path) {
    if (*path)
        read_list(search, path);
    else
        report_trouble(search, "@", "a list has a name, or is @-, standard input");
}

static void add_input(struct search *search) {
    struct monge_text text = {NULL, 0};
    if (!read_text(search, "-", &text)) return;
    if (is_list(&text)) {
        note_list(search->scenes, "-");
        add_entries(search, &text, "-");
        monge_text_free(&text);
    } else {
        search->scenes->input = text;
        add_scene(search, "-", "stdin");
    }
}

/* Whether the @ before a list was forgotten. */
static bool is_list_file(const struct search *search, const char *path) {
    if (scene_extension(path) || !path_is_file(path)) return false;
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_text text = {NULL, 0};
    const bool list = diag && monge_text_read(path, search->limits, &text, diag) && is_list(&text);
    monge_text_free(&text);
    monge_diagnostics_free(diag);
    return list;
}

/* ---- Operands ---- */

static void add_file(struct search *search, const char *path) {
    const char *slash = strrchr(path, '/');
    if (!is_list_file(search, path)) {
        add_scene(search, path, slash && slash[1] ? slash + 1 : path);
        return;
    }
    say_error("%s: a list of scenes is given as @%s", path, path);
    search->scenes->status = STATUS_TROUBLE;
}

/* A path that a pattern stands for; its name is what is behind `name`. */
static void add_match(struct search *search, const char *path, const char *name) {
    if (path_is_folder(path))
        add_folder(search, path, (size_t)(name - path));
    else if (path_is_special(path))
        leave_out(search, &search->special, path);
    else if (scene_kind(path, search->limits) == MONGE_TEXT_EMPTY)
        leave_out(search, &search->no_scenes, path);
    else
        add_scene(search, path, name);
}

static void add_pattern(struct search *search, const char *pattern) {
    const size_t count = search->scenes->count, missing = search->scenes->missing;
    struct matches matches = matches_find(pattern);
    search->scenes->several = true;
    for (size_t i = 0; i < matches.count; i++)
        add_match(search, matches.paths[i], matches_varying(pattern, matches.paths[i]));
    if (search->scenes->count == count && search->scenes->missing == missing)
        report_trouble(search, pattern, matches.count == 0 ? "no file matches" : "no scene matches");
    matches_free(&matches);
}

static void add_name(struct search *search, const char *name) {
    if (path_is_folder(name))
        add_folder(search, name, strlen(name));
    else if (is_pattern(name) && !is_there(name))
        add_pattern(search, name);
    else
        add_file(search, name);
}

static void add_operand(struct search *search, const char *operand) {
    if (is_stream(operand))
        add_input(search);
    else if (*operand == '@')
        add_list(search, operand + 1);
    else
        add_name(search, operand);
}

/* ---- All of them ---- */

/* Leaves out those scenes whose name has gone. */
static void close_ranks(struct scenes *scenes) {
    size_t kept = 0;
    for (size_t i = 0; i < scenes->count; i++)
        if (scenes->all[i].name)
            scenes->all[kept++] = scenes->all[i];
        else
            free(scenes->all[i].path);
    scenes->count = kept;
}

static void forget_name(struct scene_file *scene) {
    free(scene->name);
    scene->name = NULL;
}

static void name_from(struct search *search, const char *root, struct scene_file *scene) {
    char *name = scene_name_below(root, scene->path, scene->name);
    if (!name && is_there(scene->path))
        report_trouble(search, scene->path, "it is not below the folder of --root");
    else if (!name)
        fail_reading(search, scene->path);
    free(scene->name);
    scene->name = name;
}

static void name_from_root(struct search *search) {
    const struct option_value *option = &search->args->option[OPTION_ROOT];
    if (!option->given) return;
    char *root = realpath(option->text, NULL);
    if (!root) {
        say_error("--root %s: %s", option->text, strerror(errno));
        search->scenes->status = STATUS_TROUBLE;
    }
    for (size_t i = 0; i < search->scenes->count; i++) {
        struct scene_file *scene = &search->scenes->all[i];
        if (!root)
            forget_name(scene);
        else if (!is_stream(scene->path))
            name_from(search, root, scene);
    }
    close_ranks(search->scenes);
    free(root);
}

/* By name; those of one name in their order. */
static int compare_places(const void *a, const void *b) {
    const struct scene_file *p = *(struct scene_file *const *)a, *q = *(struct scene_file *const *)b;
    const int order = strcmp(p->name, q->name);
    return order ? order : p < q ? -1 : p > q;
}

static bool is_same(const struct scene_file *a, const struct scene_file *b) {
    char *p = scene_place(a->path), *q = scene_place(b->path);
    const bool same = strcmp(a->path, b->path) == 0 || (p && q && strcmp(p, q) == 0);
    free(p);
    free(q);
    return same;
}

/* A file that is named twice counts once, if it would have the same name. */
static void drop_repeated(struct scenes *scenes) {
    struct scene_file **sorted = calloc(scenes->count + 1, sizeof *sorted);
    if (!sorted) say_no_memory();
    for (size_t i = 0; i < scenes->count; i++) sorted[i] = &scenes->all[i];
    if (scenes->count > 1) qsort(sorted, scenes->count, sizeof *sorted, compare_places);
    for (size_t i = 1, first = 0; i < scenes->count; i++)
        if (strcmp(sorted[first]->name, sorted[i]->name) != 0)
            first = i;
        else if (is_same(sorted[first], sorted[i]))
            forget_name(sorted[i]);
    free(sorted);
    close_ranks(scenes);
}

/* Standard input can be read once. */
static bool check_input(const struct arguments *args) {
    size_t count = 0;
    for (size_t i = 0; i < args->count; i++)
        count += is_stream(args->operands[i]) || strcmp(args->operands[i], "@-") == 0;
    if (count > 1) say_usage(args->command, "standard input can be only one scene, or one list");
    return count <= 1;
}

bool scenes_find(struct scenes *scenes, const struct arguments *args, enum scenes_wish wish,
                 const struct monge_limits *limits, struct report *report) {
    *scenes = (struct scenes){.status = STATUS_YES};
    struct search search = {.scenes = scenes, .args = args, .limits = limits, .report = report, .wish = wish};
    if (!check_input(args)) return false;
    for (size_t i = 0; i < args->count; i++) add_operand(&search, args->operands[i]);
    name_from_root(&search);
    drop_repeated(scenes);
    mention(&search, &search.no_scenes, "file without a `scene` is", "files without a `scene` are");
    mention(&search, &search.special, "pipe, socket or device is", "pipes, sockets or devices are");
    free(search.no_scenes.names);
    free(search.special.names);
    return true;
}

void scenes_free(struct scenes *scenes) {
    for (size_t i = 0; i < scenes->count; i++) {
        free(scenes->all[i].path);
        free(scenes->all[i].name);
    }
    for (size_t i = 0; i < scenes->missing; i++) free(scenes->lost[i]);
    for (size_t i = 0; i < scenes->list_count; i++) free(scenes->lists[i]);
    free(scenes->lists);
    free(scenes->lost);
    free(scenes->all);
    monge_text_free(&scenes->input);
}
