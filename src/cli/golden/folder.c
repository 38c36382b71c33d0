#include "cli/golden/folder.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/aov.h"
#include "cli/paths.h"
#include "cli/say.h"

/* ---- Names and paths ---- */

bool golden_name_is_safe(const char *name) {
    if (!*name) return false;
    for (const char *part = name;; part++) {
        const size_t length = strcspn(part, "/");
        if (length == 0 || (length == 1 && *part == '.') || (length == 2 && strncmp(part, "..", 2) == 0))
            return false;
        part += length;
        if (!*part) return true;
    }
}

bool golden_is_there(const char *path) {
    struct stat status;
    return lstat(path, &status) == 0;
}

bool golden_check_file(const char *path) {
    struct stat status;
    if (stat(path, &status) != 0)
        say_error("cannot read %s: %s", path, strerror(errno));
    else if (!S_ISREG(status.st_mode))
        say_error("%s is not a file", path);
    else
        return true;
    return false;
}

bool golden_check_folder(const char *folder) {
    if (path_is_folder(folder) || !golden_is_there(folder)) return true;
    const char *slash = strrchr(folder, '/'), *file = slash ? slash + 1 : folder;
    const int length = slash ? (int)(slash - folder) : 1;
    if (strcmp(file, "golden.yaml") == 0 || strcmp(file, "golden.lock") == 0)
        say_error("--golden %s: it takes the folder, %.*s", folder, length, slash ? folder : ".");
    else
        say_error("--golden %s: it takes a folder", folder);
    return false;
}

bool golden_check_output(const char *option, const char *path) {
    char *at = say_text("%s", path);
    for (char *slash; !golden_is_there(at) && (slash = strrchr(at, '/')) && slash > at;) *slash = '\0';
    const bool good = path_is_folder(at) || !golden_is_there(at);
    if (!good) say_error("--%s %s: %s is no folder", option, path, at);
    free(at);
    return good;
}

void golden_hold(const char *folder) {
    const int fd = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC); /* stays open */
    while (fd >= 0 && flock(fd, LOCK_EX) != 0 && errno == EINTR) continue;
}

/* The path `part` below the real path `from`. */
static char *step(const char *from, const char *part) {
    char *path = path_below(from, part, ""), *real = realpath(path, NULL);
    if (!real && strcmp(part, ".") == 0) real = say_text("%s", from);
    if (!real && strcmp(part, "..") == 0) real = say_text("%.*s", (int)(strrchr(from, '/') - from), from);
    if (!real) return path;
    free(path);
    return real;
}

char *golden_real_path(const char *path) {
    char *real = realpath(*path == '/' ? "/" : ".", NULL), *copy = say_text("%s", path), *at = copy;
    for (char *part; real && (part = strsep(&at, "/"));) {
        char *next = step(real, *part ? part : ".");
        free(real);
        real = next;
    }
    free(copy);
    return real ? real : say_text("%s", path);
}

/* ---- Writing ---- */

bool golden_write(const char *path, const struct monge_text *text) {
    struct monge_diagnostics *diag = monge_diagnostics_new();
    const bool good = diag && path_make_folders(path) && monge_text_write(path, text, diag);
    if (diag && !good) monge_diagnostics_print(diag, say_stream());
    monge_diagnostics_free(diag);
    return good;
}

static bool has_bytes(const char *path, const struct monge_text *text) {
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_text there = {NULL, 0};
    const bool read = diag && path_is_file(path) && monge_text_read(path, NULL, &there, diag);
    const bool same = read && there.size == text->size && memcmp(there.bytes, text->bytes, text->size) == 0;
    monge_text_free(&there);
    monge_diagnostics_free(diag);
    return same;
}

bool golden_update(const char *path, const struct monge_text *text) {
    return has_bytes(path, text) || golden_write(path, text);
}

bool golden_copy(const char *from, const char *to) {
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_text text = {NULL, 0};
    const bool read = diag && monge_text_read(from, NULL, &text, diag);
    if (diag && !read) monge_diagnostics_print(diag, say_stream());
    const bool good = read && golden_update(to, &text);
    monge_text_free(&text);
    monge_diagnostics_free(diag);
    return good;
}

bool golden_check_inside(const char *folder, const char *path) {
    char *copy = say_text("%s", path);
    bool inside = true;
    for (char *at = copy + strlen(folder); inside && at;) {
        struct stat status;
        char *slash = strchr(at + 1, '/');
        if (slash) *slash = '\0';
        inside = lstat(copy, &status) != 0 || !S_ISLNK(status.st_mode);
        if (!inside) say_error("%s is a link: goldens are files in their folder", copy);
        if (slash) *slash = '/';
        at = slash;
    }
    free(copy);
    return inside;
}

bool golden_remove(const char *folder, const char *path) {
    if (unlink(path) != 0) {
        if (errno == ENOENT) return true;
        say_error("cannot remove %s: %s", path, strerror(errno));
        return false;
    }
    char *copy = say_text("%s", path);
    for (char *slash; folder && (slash = strrchr(copy, '/')) && (size_t)(slash - copy) > strlen(folder);) {
        *slash = '\0';
        if (rmdir(copy) != 0) break; /* something else is in it */
    }
    free(copy);
    return true;
}

bool golden_has_passes(const char *picture) {
    char *depth = aov_path(MONGE_LAYER_DEPTH, picture);
    const bool there = path_is_file(depth);
    free(depth);
    return there;
}

bool golden_remove_picture(const char *folder, const char *path) {
    bool good = true;
    for (enum monge_layer layer = 0; layer < MONGE_LAYERS; layer++) {
        char *beside = aov_path(layer, path);
        good &= golden_remove(folder, beside);
        free(beside);
    }
    return golden_remove(folder, path) && good;
}

bool golden_clear(const char *output, const char *name) {
    static const char *const folders[] = {"new", "old"};
    bool good = true;
    for (size_t i = 0; i < 2 && golden_name_is_safe(name); i++) {
        char *folder = path_below(output, folders[i], ""), *path = path_below(folder, name, ".png");
        good &= golden_remove_picture(output, path);
        free(path);
        free(folder);
    }
    return good;
}

/* ---- What is there ---- */

struct names {
    char **all; /* up to a NULL */
    size_t count;
};

static void add_name(struct names *names, const char *name) {
    names->all = realloc(names->all, (names->count + 2) * sizeof *names->all);
    if (!names->all) say_no_memory();
    names->all[names->count++] = say_text("%s", name);
    names->all[names->count] = NULL;
}

/* The length of the name of a picture, without its extension; 0: it is none. */
static size_t picture_length(const char *file) {
    const size_t length = strlen(file);
    return length > 4 && strcmp(file + length - 4, ".png") == 0 ? length - 4 : 0;
}

/* Whether it is NAME.object.png or so, beside a NAME.png. */
static bool is_layer(const char *path) {
    for (enum monge_layer layer = 0; layer < MONGE_LAYERS; layer++) {
        char *file = aov_path(layer, "x.png");
        const char *ending = file + 1; /* what all of them end in */
        const size_t all = strlen(path), length = strlen(ending);
        const bool ends = all > length && strcmp(path + all - length, ending) == 0;
        char *picture = ends ? say_text("%.*s.png", (int)(all - length), path) : NULL;
        const bool found = picture && path_is_file(picture);
        free(picture);
        free(file);
        if (found) return true;
    }
    return false;
}

/* `below` is "" or ends in a slash. */
static void walk(struct names *names, const char *folder, const char *below) {
    char *path = path_below(folder, below, "");
    DIR *stream = opendir(path);
    for (struct dirent *file; stream && (file = readdir(stream));) {
        struct stat status;
        char *full = say_text("%s%s", path, file->d_name), *name = say_text("%s%s", below, file->d_name);
        if (file->d_name[0] != '.' && lstat(full, &status) == 0) {
            char *inner = say_text("%s/", name);
            if (S_ISDIR(status.st_mode)) walk(names, folder, inner);
            free(inner);
            name[picture_length(name)] = '\0';
            const bool plain = S_ISREG(status.st_mode) || S_ISLNK(status.st_mode);
            if (plain && *name && !is_layer(full)) add_name(names, name);
        }
        free(full);
        free(name);
    }
    if (stream) closedir(stream);
    free(path);
}

static int compare_names(const void *a, const void *b) {
    return strcmp(*(char *const *)a, *(char *const *)b);
}

char **golden_names(const char *folder) {
    struct names names = {calloc(1, sizeof(char *)), 0};
    walk(&names, folder, "");
    if (names.count > 0) qsort(names.all, names.count, sizeof *names.all, compare_names);
    return names.all;
}

void golden_names_free(char **names) {
    for (char **name = names; name && *name; name++) free(*name);
    free(names);
}
