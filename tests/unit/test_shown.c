/* The pictures in tests/golden/ are there to be looked at: each is the one that the lock there has the hash of. */
#include <dirent.h>
#include <stdlib.h>
#include <string.h>

#include "monge.h"
#include "near.h"

static char *read_lock(void) {
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_text text;
    assert_true(monge_text_read("tests/golden/golden.lock", NULL, &text, diag));
    monge_diagnostics_free(diag);
    return text.bytes;
}

/* Whether the lock has a line for DIR/NAME or NAME with these pixels. */
static bool has_line(const char *lock, const char *name, const char *pixels) {
    char begin[320], hash[80];
    snprintf(begin, sizeof begin, "%s ", name);
    snprintf(hash, sizeof hash, " pixels=%s ", pixels);
    for (const char *line = lock; line && *line; line = strchr(line, '\n'), line += line != NULL) {
        const char *end = strchr(line, ' '), *at = strstr(line, begin), *found = strstr(line, hash);
        const char *stop = strchr(line, '\n');
        if (end && at && found && stop && at < end && found < stop && (at == line || at[-1] == '/'))
            return true;
    }
    return false;
}

static void check_picture(const char *lock, const char *file) {
    char path[300], name[300], pixels[MONGE_HASH_SIZE];
    struct monge_diagnostics *diag = monge_diagnostics_new();
    snprintf(path, sizeof path, "tests/golden/%s", file);
    snprintf(name, sizeof name, "%.*s", (int)strlen(file) - 4, file);
    struct monge_picture *picture = monge_picture_read(path, diag);
    assert_non_null(picture);
    assert_true(monge_picture_hash(picture, diag, pixels));
    if (!has_line(lock, name, pixels))
        fail_msg("%s is not the picture of tests/golden/golden.lock: tests/goldens.sh --update renews both",
                 path);
    monge_picture_free(picture);
    monge_diagnostics_free(diag);
}

static void pictures_are_those_of_the_lock(void **state) {
    (void)state;
    char *lock = read_lock();
    DIR *folder = opendir("tests/golden");
    size_t count = 0;
    assert_non_null(folder);
    for (struct dirent *file; (file = readdir(folder));) {
        const size_t length = strlen(file->d_name);
        if (length < 5 || strcmp(file->d_name + length - 4, ".png") != 0) continue;
        check_picture(lock, file->d_name);
        count++;
    }
    closedir(folder);
    free(lock);
    assert_true(count > 20);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(pictures_are_those_of_the_lock)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
