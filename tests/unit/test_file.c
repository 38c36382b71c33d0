/* Texts from files, pipes and memory. */
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "folder.h"
#include "lang/file.h"
#include "near.h"

static void write_file(const char *path, const char *bytes, size_t size) {
    FILE *out = fopen(path, "wb");
    assert_non_null(out);
    assert_int_equal(fwrite(bytes, 1, size, out), size);
    fclose(out);
}

/* ---- What is read ---- */

static struct row {
    const char *name, *bytes, *want;
    size_t size, limit;
    const char *failure; /* NULL: it is read */
} rows[] = {
    {"a text", "abc\n", "abc\n", 4, 100, NULL},
    {"an empty file", "", "", 0, 100, NULL},
    {"a byte order mark",
     "\xef\xbb\xbf"
     "abc",
     "abc", 6, 100, NULL},
    {"nothing but a byte order mark", "\xef\xbb\xbf", "", 3, 100, NULL},
    {"half a byte order mark", "\xef\xbb", "\xef\xbb", 2, 100, NULL},
    {"zero bytes", "a\0b", "a\0b", 3, 100, NULL},
    {"as long as the limit", "abc\n", "abc\n", 4, 4, NULL},
    {"longer than the limit", "abcd\n", "", 5, 4, "f: longer than 4 bytes (the limit `file_bytes`)"},
};

static void check_source(const struct source *source, const struct diagnostics *diag, const struct row *row,
                         const char *name) {
    if (row->failure) {
        assert_null(source);
        assert_int_equal(diag->failures, 1);
        assert_non_null(strstr(diag->first->message, strstr(row->failure, ":")));
        return;
    }
    assert_non_null(source);
    assert_string_equal(source->name, name);
    assert_memory_equal(source->text, row->want, source->size);
    assert_int_equal(source->size, row->size - (strncmp(row->bytes, "\xef\xbb\xbf", 3) == 0 ? 3 : 0));
    assert_int_equal(diag->failures, 0);
}

static void check_row(void **state) {
    const struct row *row = *state;
    struct arena arena = {0};
    struct diagnostics diag = {0};
    write_file("f", row->bytes, row->size);
    check_source(file_read(&arena, &diag, "f", row->limit), &diag, row, "f");
    if (!row->failure) check_source(file_from_memory(&arena, "m", row->bytes, row->size), &diag, row, "m");
    diag_free(&diag);

    /* The same through a pipe, whose length nobody knows before. */
    assert_int_equal(mkfifo("pipe", 0666), 0);
    const pid_t writer = fork();
    if (writer == 0) {
        execlp("cp", "cp", "f", "pipe", (char *)NULL);
        _exit(127);
    }
    check_source(file_read(&arena, &diag, "pipe", row->limit), &diag, row, "pipe");
    waitpid(writer, NULL, 0);
    unlink("pipe");
    diag_free(&diag);
    arena_free(&arena);
}

static void standard_input_in_many_pieces(void **state) {
    (void)state;
    enum { SIZE = 1000001 };
    char *bytes = malloc(SIZE);
    struct random r = random_begin();
    for (size_t i = 0; i < SIZE; i++) bytes[i] = (char)random_bits(&r);
    write_file("long", bytes, SIZE);
    struct arena arena = {0};
    struct diagnostics diag = {0};
    FILE *in = popen("cat long", "r");
    assert_non_null(in);
    const int keep = dup(0);
    assert_int_equal(dup2(fileno(in), 0), 0);
    const struct source *source = file_read(&arena, &diag, "-", SIZE);
    assert_int_equal(dup2(keep, 0), 0);
    close(keep);
    pclose(in);
    assert_non_null(source);
    assert_string_equal(source->name, "<stdin>");
    assert_int_equal(source->size, SIZE);
    assert_memory_equal(source->text, bytes, SIZE);
    arena_free(&arena);
    diag_free(&diag);
    free(bytes);
}

/* ---- What cannot be read ---- */

static struct failure {
    const char *path, *want;
} failures[] = {
    {"none", "cannot read none: No such file or directory"},
    {"folder", "cannot read folder: Is a directory"},
    {"", "cannot read : No such file or directory"},
    {"/dev/zero", "/dev/zero: longer than 1000000 bytes (the limit `file_bytes`)"},
};

static void check_failure(void **state) {
    const struct failure *row = *state;
    struct arena arena = {0};
    struct diagnostics diag = {0};
    assert_null(file_read(&arena, &diag, row->path, 1000000));
    assert_int_equal(diag.failures, 1);
    assert_string_equal(diag.first->message, row->want);
    assert_true(arena.total < 8000000);
    arena_free(&arena);
    diag_free(&diag);
}

static int enter_with_folder(void **state) {
    return enter_folder(state) || mkdir("folder", 0777) != 0 ? -1 : 0;
}

int main(void) {
    struct CMUnitTest tests[COUNT(rows) + COUNT(failures) + 1];
    size_t n = 0;
    for (size_t i = 0; i < COUNT(rows); i++)
        tests[n++] = (struct CMUnitTest){rows[i].name, check_row, NULL, NULL, &rows[i]};
    for (size_t i = 0; i < COUNT(failures); i++)
        tests[n++] = (struct CMUnitTest){failures[i].want, check_failure, NULL, NULL, &failures[i]};
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(standard_input_in_many_pieces);
    return cmocka_run_group_tests_name("file", tests, enter_with_folder, leave_folder);
}
