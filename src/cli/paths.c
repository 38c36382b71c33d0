#include "cli/paths.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "cli/say.h"

char *path_below(const char *folder, const char *name, const char *extension) {
    const size_t length = strlen(folder);
    const char *slash = length > 0 && folder[length - 1] == '/' ? "" : "/";
    return say_text("%s%s%s%s", folder, slash, name, extension);
}

bool path_is_file(const char *path) {
    struct stat status;
    return stat(path, &status) == 0 && S_ISREG(status.st_mode);
}

bool path_is_folder(const char *path) {
    struct stat status;
    return stat(path, &status) == 0 && S_ISDIR(status.st_mode);
}

bool path_is_link(const char *path) {
    struct stat status;
    return lstat(path, &status) == 0 && S_ISLNK(status.st_mode);
}

bool path_is_same(const char *a, const char *b) {
    struct stat of_a, of_b;
    return stat(a, &of_a) == 0 && stat(b, &of_b) == 0 && of_a.st_dev == of_b.st_dev &&
           of_a.st_ino == of_b.st_ino;
}

bool path_is_special(const char *path) {
    struct stat status;
    return stat(path, &status) == 0 && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode);
}

size_t path_folder_length(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash ? (size_t)(slash - path) + 1 : 0;
}

/* Extensions that stand for .png where a picture was meant; any other may be a part of the name, as in ball-0.5. */
static bool is_mistaken(const char *extension) {
    static const char *const others[] = {"jpg", "jpeg", "gif", "bmp", "tif", "tiff", "webp", "avif", "ppm",
                                         "exr", "hdr",  "tga", "svg", "pdf", "yaml", "yml",  "txt",  "json"};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (strcasecmp(extension, others[i]) == 0) return true;
    return false;
}

bool path_check_picture(enum command_id command, const char *option, const char *path) {
    const char *name = path + path_folder_length(path), *dot = strrchr(name, '.');
    if (!*name || path_is_folder(path) || path_is_special(path)) return true;
    const bool extended = dot && dot > name;
    if (extended && strcasecmp(dot, ".png") == 0) return true;
    const int length = extended && is_mistaken(dot + 1) ? (int)(dot - path) : (int)strlen(path);
    say_usage(command, "%s %s: pictures are PNG; did you mean %.*s.png?", option, path, length, path);
    return false;
}

const char *path_input_extension(const char *path) {
    static const char *const extensions[] = {".yaml", ".yml", ".png"};
    const char *dot = strrchr(path + path_folder_length(path), '.');
    for (size_t i = 0; dot && i < sizeof extensions / sizeof *extensions; i++)
        if (strcasecmp(dot, extensions[i]) == 0) return dot;
    return NULL;
}

bool path_make_folders(const char *path) {
    char *copy = say_text("%s", path);
    bool good = true;
    for (char *slash = strchr(copy + 1, '/'); good && slash; slash = strchr(slash + 1, '/')) {
        struct stat status;
        *slash = '\0';
        good = mkdir(copy, 0777) == 0 ||
               (errno == EEXIST && stat(copy, &status) == 0 && S_ISDIR(status.st_mode));
        if (!good) say_error("cannot make the folder %s: %s", copy, strerror(errno));
        *slash = '/';
    }
    free(copy);
    return good;
}
