#include "cli/paths.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
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
