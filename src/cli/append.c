#include "cli/append.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Takes the last `size` bytes off again, unless another program has written behind them. */
static void take_back(int fd, size_t size) {
    struct stat status;
    const off_t end = lseek(fd, 0, SEEK_CUR); /* behind what was written last */
    if (size > 0 && fstat(fd, &status) == 0 && S_ISREG(status.st_mode) && status.st_size == end)
        (void)!ftruncate(fd, end - (off_t)size);
}

/* One write for all, unless it is a pipe that takes less, the disk is full or a signal comes. */
bool append_whole(int fd, const char *text) {
    const size_t size = strlen(text);
    for (size_t done = 0; done < size;) {
        const ssize_t written = write(fd, text + done, size - done);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) {
            const int reason = errno;
            take_back(fd, done);
            errno = reason;
            return false;
        }
        done += (size_t)written;
    }
    return true;
}
