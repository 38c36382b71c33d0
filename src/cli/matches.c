#include "cli/matches.h"

#include <dirent.h>
#include <errno.h>
#include <fnmatch.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/paths.h"
#include "cli/say.h"

bool is_pattern(const char *path) { return strpbrk(path, "*?[") != NULL; }

static int compare_texts(const void *a, const void *b) {
    return strcmp(*(char *const *)a, *(char *const *)b);
}

/* `all` with one more. */
static char **with_text(char **all, size_t count, const char *text) {
    all = realloc(all, (count + 2) * sizeof *all);
    if (!all) say_no_memory();
    all[count] = say_text("%s", text);
    all[count + 1] = NULL;
    return all;
}

/* ---- Folders ---- */

char **folder_names(const char *folder) {
    DIR *stream = opendir(*folder ? folder : ".");
    char **names = stream ? calloc(1, sizeof *names) : NULL;
    size_t count = 0;
    for (struct dirent *file; names && (file = readdir(stream));)
        if (file->d_name[0] != '.') names = with_text(names, count++, file->d_name);
    const int reason = errno;
    if (stream) closedir(stream);
    if (names && count > 1) qsort(names, count, sizeof *names, compare_texts);
    errno = reason;
    return names;
}

void folder_names_free(char **names) {
    for (char **name = names; name && *name; name++) free(*name);
    free(names);
}

/* ---- Patterns ---- */

static void add_match(struct matches *matches, const char *path) {
    matches->paths = with_text(matches->paths, matches->count++, path);
}

static void match(struct matches *matches, const char *folder, const char *pattern);

/* `path` is what the pattern stands for up to its `rest`. */
static void match_rest(struct matches *matches, const char *path, const char *rest) {
    if (!*rest) {
        if (access(path, F_OK) == 0) add_match(matches, path);
    } else if (path_is_folder(path)) {
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
        if (path_is_folder(path) && !path_is_link(path)) match_below(matches, inner, pattern);
        free(path);
        free(inner);
    }
    folder_names_free(names);
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
    if (names != plain) folder_names_free(names);
    free(part);
}

struct matches matches_find(const char *pattern) {
    struct matches matches = {NULL, 0};
    const size_t root = strspn(pattern, "/");
    match(&matches, root ? "/" : "", pattern + root);
    if (matches.count > 0) qsort(matches.paths, matches.count, sizeof *matches.paths, compare_texts);
    size_t kept = 0;
    for (size_t i = 0; i < matches.count; i++)
        if (i > 0 && strcmp(matches.paths[kept - 1], matches.paths[i]) == 0)
            free(matches.paths[i]);
        else
            matches.paths[kept++] = matches.paths[i];
    matches.count = kept;
    return matches;
}

void matches_free(struct matches *matches) {
    for (size_t i = 0; i < matches->count; i++) free(matches->paths[i]);
    free(matches->paths);
}

/* ---- What varies ---- */

/* Behind the part that `path` begins with, and the slashes after it. */
static const char *next_part(const char *path) {
    path += strcspn(path, "/");
    return path + strspn(path, "/");
}

/* Whether the part is `.` or `..`, which no name may have. */
static bool is_dots(const char *part) {
    const size_t length = strcspn(part, "/");
    return length > 0 && length <= 2 && strspn(part, ".") == length;
}

const char *matches_varying(const char *pattern, const char *path) {
    const char *part = pattern + strspn(pattern, "/"), *at = path + strspn(path, "/");
    for (; *at && strcspn(part, "*?[") > strcspn(part, "/"); part = next_part(part)) at = next_part(at);
    for (const char *behind = at; *behind;) {
        const bool dots = is_dots(behind);
        behind = next_part(behind);
        if (dots) at = behind;
    }
    return at;
}
