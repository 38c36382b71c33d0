#include "cli/room.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/say.h"

/* A file that no name leads to. Negative: errno says why. */
static int open_nameless(const char *folder) {
    const int fd = open(folder, O_WRONLY | O_TMPFILE | O_CLOEXEC, 0600);
    if (fd >= 0 || (errno != EOPNOTSUPP && errno != EISDIR)) return fd;
    char *path = say_text("%s/.room.XXXXXX.tmp", folder); /* here there are none */
    const int named = mkostemps(path, 4, O_CLOEXEC);
    const int reason = errno;
    if (named >= 0) unlink(path);
    free(path);
    errno = reason;
    return named;
}

/* Of the file that a link leads to, where there is one. To be freed. */
static char *folder_of(const char *path) {
    char *real = realpath(path, NULL);
    const char *file = real ? real : path, *slash = strrchr(file, '/');
    char *folder = slash ? say_text("%.*s", (int)(slash - file) + 1, file) : say_text(".");
    free(real);
    return folder;
}

bool room_for(const char *path, uint64_t bytes) {
    char *folder = folder_of(path);
    const int fd = open_nameless(folder);
    const int reason = fd < 0 ? errno : posix_fallocate(fd, 0, (off_t)bytes);
    if (fd >= 0) close(fd);
    free(folder);
    errno = reason;
    return reason != ENOSPC && reason != EDQUOT && reason != EROFS;
}
