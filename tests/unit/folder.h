/* A test, or a group of them, in a folder of its own: as setup and teardown. */
#ifndef MONGE_TESTS_FOLDER_H
#define MONGE_TESTS_FOLDER_H

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

static inline int enter_folder(void **state) {
    (void)state;
    char folder[] = "/tmp/monge-test.XXXXXX";
    return mkdtemp(folder) && chdir(folder) == 0 ? 0 : -1;
}

/* With all that is in it. */
static inline int leave_folder(void **state) {
    (void)state;
    char folder[PATH_MAX], command[PATH_MAX + 16];
    if (!getcwd(folder, sizeof folder) || chdir("/") != 0) return -1;
    snprintf(command, sizeof command, "rm -rf '%s'", folder);
    return system(command);
}

#endif
