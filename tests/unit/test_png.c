#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>
#include <png.h>

#include "folder.h"
#include "image/encode.h"
#include "image/png.h"

static int count_entries(void) {
    int count = 0;
    DIR *folder = opendir(".");
    while (readdir(folder)) count++;
    closedir(folder);
    return count - 2; /* . and .. */
}

static mode_t mode_of(const char *path) {
    struct stat status;
    assert_int_equal(stat(path, &status), 0);
    return status.st_mode & 0777;
}

static size_t read_bytes(const char *path, uint8_t *bytes, size_t size) {
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    const size_t count = fread(bytes, 1, size, file);
    fclose(file);
    return count;
}

static bool open_for_writing(const char *path) {
    const int fd = open(path, O_WRONLY);
    if (fd >= 0) close(fd);
    return fd >= 0;
}

/* Makes `name` a device like /dev/full or /dev/null; not those themselves, which a test that fails would
 * replace by a file where it runs as root. */
static void make_device(const char *name, unsigned minor_number, const char *system_name) {
    if (geteuid() == 0 && mknod(name, S_IFCHR | 0666, makedev(1, minor_number)) == 0 &&
        open_for_writing(name))
        return;
    unlink(name);
    if (geteuid() == 0) skip();
    assert_int_equal(symlink(system_name, name), 0);
}

static void write_text(const char *path, const char *text) {
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

/* ---- Films ---- */

enum { WIDTH = 5, HEIGHT = 3, CHANNELS = WIDTH * HEIGHT * 3 };

static float colours[CHANNELS];

static struct monge_film make_film(enum monge_encoding encoding, unsigned bits) {
    for (int i = 0; i < CHANNELS; i++)
        colours[i] = (float)(i - 2) / (CHANNELS - 6); /* from below 0 to over 1 */
    struct monge_film film = {
        .settings = {.width = WIDTH, .height = HEIGHT, .samples = 1, .bits = bits, .encoding = encoding},
        .region = {0, 0, WIDTH, HEIGHT},
        .rgb = colours,
    };
    hash_begin(&film.scene);
    return film;
}

static void write_film(const struct monge_film *film, const char *path) {
    char message[300] = "";
    if (!png_write_film(film, path, message, sizeof message)) fail_msg("%s", message);
}

/* ---- What a file says, by libpng and by its chunks ---- */

struct picture {
    png_structp png;
    png_infop info;
    png_bytepp rows;
};

static struct picture picture_read(const char *path) {
    struct picture p = {.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL)};
    p.info = png_create_info_struct(p.png);
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    png_init_io(p.png, file);
    png_read_png(p.png, p.info, PNG_TRANSFORM_IDENTITY, NULL);
    fclose(file);
    p.rows = png_get_rows(p.png, p.info);
    return p;
}

static const char *picture_text(const struct picture *p, const char *key) {
    png_textp texts;
    int count = 0;
    png_get_text(p->png, p->info, &texts, &count);
    for (int i = 0; i < count; i++)
        if (strcmp(texts[i].key, key) == 0) return texts[i].text;
    return NULL;
}

static void picture_free(struct picture *p) { png_destroy_read_struct(&p->png, &p->info, NULL); }

/* The names of the chunks, in order, with repeated ones once: "IHDR sRGB tEXt IDAT tEXt IEND". */
static void list_chunks(const char *path, char *names, size_t size) {
    uint8_t bytes[8192];
    const size_t end = read_bytes(path, bytes, sizeof bytes);
    const char *last = "";
    names[0] = '\0';
    for (size_t at = 8; at + 12 <= end;) {
        const char *name = (const char *)bytes + at + 4;
        if (strncmp(name, last, 4) != 0)
            snprintf(names + strlen(names), size - strlen(names), "%s%.4s", *names ? " " : "", name);
        last = name;
        at += 12 + ((size_t)bytes[at + 1] << 16 | (size_t)bytes[at + 2] << 8 | bytes[at + 3]);
    }
}

static struct format {
    const char *name;
    enum monge_encoding encoding;
    unsigned bits;
    const char *chunks;
} formats[] = {
    {"sRGB, 8 bits", MONGE_ENCODING_SRGB, 8, "IHDR sRGB tEXt IDAT tEXt IEND"},
    {"sRGB, 16 bits", MONGE_ENCODING_SRGB, 16, "IHDR sRGB tEXt IDAT tEXt IEND"},
    {"linear, 8 bits", MONGE_ENCODING_LINEAR, 8, "IHDR gAMA tEXt IDAT tEXt IEND"},
    {"linear, 16 bits", MONGE_ENCODING_LINEAR, 16, "IHDR gAMA tEXt IDAT tEXt IEND"},
};

static unsigned channel_of(const struct picture *p, unsigned bits, size_t i) {
    const uint8_t *row = p->rows[i / (3 * WIDTH)];
    const size_t at = i % (3 * WIDTH);
    return bits == 8 ? row[at] : (unsigned)(row[2 * at] << 8 | row[2 * at + 1]);
}

static void check_format(void **state) {
    const struct format *format = *state;
    const struct monge_film film = make_film(format->encoding, format->bits);
    write_film(&film, "a.png");
    struct picture p = picture_read("a.png");
    assert_int_equal(png_get_image_width(p.png, p.info), WIDTH);
    assert_int_equal(png_get_image_height(p.png, p.info), HEIGHT);
    assert_int_equal(png_get_bit_depth(p.png, p.info), format->bits);
    assert_int_equal(png_get_color_type(p.png, p.info), PNG_COLOR_TYPE_RGB);
    for (size_t i = 0; i < CHANNELS; i++)
        assert_int_equal(channel_of(&p, format->bits, i),
                         encode_channel(film.rgb[i], format->encoding, format->bits));
    png_fixed_point gamma = 0;
    png_get_gAMA_fixed(p.png, p.info, &gamma);
    assert_int_equal(gamma, format->encoding == MONGE_ENCODING_LINEAR ? 100000 : 45455);
    picture_free(&p);

    char chunks[200];
    list_chunks("a.png", chunks, sizeof chunks);
    assert_string_equal(chunks, format->chunks);
}

static void texts_name_program_and_scene(void **state) {
    (void)state;
    struct monge_film film = make_film(MONGE_ENCODING_SRGB, 8);
    hash_integer(&film.scene, 42);
    write_film(&film, "a.png");
    struct picture p = picture_read("a.png");
    char software[64], scene[HASH_TEXT_SIZE];
    snprintf(software, sizeof software, "Monge %s", monge_version());
    hash_text(&film.scene, scene);
    assert_string_equal(picture_text(&p, "Software"), software);
    assert_string_equal(picture_text(&p, "monge:scene"), scene);
    assert_null(picture_text(&p, "monge:region"));
    picture_free(&p);
}

static void texts_name_a_region(void **state) {
    (void)state;
    struct monge_film film = make_film(MONGE_ENCODING_SRGB, 8);
    film.settings.width = 640;
    film.settings.height = 480;
    film.region.x = 17;
    film.region.y = 4;
    write_film(&film, "a.png");
    struct picture p = picture_read("a.png");
    assert_string_equal(picture_text(&p, "monge:region"), "17,4,5,3 of 640x480");
    assert_int_equal(png_get_image_width(p.png, p.info), WIDTH);
    picture_free(&p);
}

static void the_same_film_gives_the_same_bytes(void **state) {
    (void)state;
    const struct monge_film film = make_film(MONGE_ENCODING_SRGB, 16);
    uint8_t first[8192], second[8192];
    write_film(&film, "a.png");
    write_film(&film, "b.png");
    const size_t size = read_bytes("a.png", first, sizeof first);
    assert_int_equal(read_bytes("b.png", second, sizeof second), size);
    assert_memory_equal(first, second, size);
}

/* ---- How the file comes to its place ---- */

static void a_new_file_has_the_permissions_of_new_files(void **state) {
    (void)state;
    const struct monge_film film = make_film(MONGE_ENCODING_SRGB, 8);
    const mode_t before = umask(027);
    write_film(&film, "a.png");
    umask(before);
    assert_int_equal(mode_of("a.png"), 0640);
    assert_int_equal(count_entries(), 1);
}

static void an_old_file_keeps_its_permissions(void **state) {
    (void)state;
    const struct monge_film film = make_film(MONGE_ENCODING_SRGB, 8);
    write_text("a.png", "old");
    chmod("a.png", 0604);
    write_film(&film, "a.png");
    struct picture p = picture_read("a.png");
    picture_free(&p);
    assert_int_equal(mode_of("a.png"), 0604);
    assert_int_equal(count_entries(), 1);
}

static void a_reader_of_the_old_file_keeps_it(void **state) {
    (void)state;
    const struct monge_film film = make_film(MONGE_ENCODING_SRGB, 8);
    write_text("a.png", "old");
    FILE *old = fopen("a.png", "rb");
    write_film(&film, "a.png");
    char text[8] = "";
    assert_int_equal(fread(text, 1, 7, old), 3); /* in-place writing would show through */
    assert_string_equal(text, "old");
    fclose(old);
}

static void a_link_stays_and_its_end_is_replaced(void **state) {
    (void)state;
    const struct monge_film film = make_film(MONGE_ENCODING_SRGB, 8);
    struct stat status;
    assert_int_equal(mkdir("deep", 0777), 0);
    write_text("deep/real.png", "old");
    assert_int_equal(symlink("deep/middle.png", "a.png"), 0);
    assert_int_equal(symlink("real.png", "deep/middle.png"), 0);
    assert_int_equal(symlink("deep/none.png", "b.png"), 0);
    write_film(&film, "a.png");
    write_film(&film, "b.png");
    assert_true(lstat("a.png", &status) == 0 && S_ISLNK(status.st_mode));
    assert_true(lstat("deep/real.png", &status) == 0 && S_ISREG(status.st_mode) && status.st_size > 3);
    assert_true(lstat("b.png", &status) == 0 && S_ISLNK(status.st_mode));
    assert_true(lstat("deep/none.png", &status) == 0 && S_ISREG(status.st_mode));
    assert_int_equal(count_entries(), 3);
}

static void a_long_name_still_fits(void **state) {
    (void)state;
    const struct monge_film film = make_film(MONGE_ENCODING_SRGB, 8);
    char name[256];
    memset(name, 'x', 255);
    name[255] = '\0';
    write_film(&film, name);
    assert_int_equal(count_entries(), 1);
}

static void a_pipe_is_written_directly(void **state) {
    (void)state;
    const struct monge_film film = make_film(MONGE_ENCODING_SRGB, 8);
    struct stat status;
    assert_int_equal(mkfifo("pipe", 0666), 0);
    const pid_t reader = fork();
    if (reader == 0) execlp("cp", "cp", "pipe", "copy.png", (char *)NULL);
    write_film(&film, "pipe");
    int end = 0;
    waitpid(reader, &end, 0);
    assert_true(stat("pipe", &status) == 0 && S_ISFIFO(status.st_mode));
    struct picture p = picture_read("copy.png");
    picture_free(&p);
}

static void a_device_is_written_directly(void **state) {
    (void)state;
    const struct monge_film film = make_film(MONGE_ENCODING_SRGB, 8);
    struct stat status;
    make_device("null", 3, "/dev/null");
    write_film(&film, "null");
    assert_true(stat("null", &status) == 0 && S_ISCHR(status.st_mode));
    assert_int_equal(count_entries(), 1);
}

static void a_full_device_is_seen(void **state) {
    (void)state;
    const struct monge_film film = make_film(MONGE_ENCODING_SRGB, 8);
    char message[300] = "";
    make_device("full", 7, "/dev/full");
    assert_false(png_write_film(&film, "full", message, sizeof message));
    assert_string_equal(message, "cannot write full: No space left on device");
    assert_int_equal(count_entries(), 1);
}

/* ---- Failures ---- */

static struct failure {
    const char *name, *path, *want;
} failures[] = {
    {"no such folder", "none/a.png", "cannot write none/a.png: No such file or directory"},
    {"a file as a folder", "file/a.png", "cannot write file/a.png: Not a directory"},
    {"a folder as the file", "folder", "cannot write folder: Is a directory"},
    {"links in a circle", "circle", "cannot write circle: Too many levels of symbolic links"},
    {"no name", "", "cannot write : No such file or directory"},
};

static void check_failure(void **state) {
    const struct failure *row = *state;
    const struct monge_film film = make_film(MONGE_ENCODING_SRGB, 8);
    char message[300] = "";
    write_text("file", "old");
    assert_int_equal(mkdir("folder", 0777), 0);
    assert_int_equal(symlink("circle", "circle"), 0);
    assert_false(png_write_film(&film, row->path, message, sizeof message));
    assert_string_equal(message, row->want);
    assert_int_equal(count_entries(), 3);
}

static void a_protected_file_is_refused(void **state) {
    (void)state;
    const struct monge_film film = make_film(MONGE_ENCODING_SRGB, 8);
    char message[300] = "";
    if (geteuid() == 0) skip(); /* may write everything */
    write_text("a.png", "old");
    chmod("a.png", 0444);
    assert_false(png_write_film(&film, "a.png", message, sizeof message));
    assert_string_equal(message, "cannot write a.png: Permission denied");
    assert_int_equal(count_entries(), 1);
}

/* A limit on the size of files stands for a disk that fills up while a picture is written. */
static void check_disk_full(rlim_t size) {
    const struct monge_film film = make_film(MONGE_ENCODING_SRGB, 16);
    struct rlimit before, limit;
    char message[300] = "";
    write_text("a.png", "old");
    signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before);
    limit = (struct rlimit){size, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
    const bool written = png_write_film(&film, "a.png", message, sizeof message);
    setrlimit(RLIMIT_FSIZE, &before);
    signal(SIGXFSZ, SIG_DFL);
    assert_false(written);
    assert_string_equal(message, "cannot write a.png: File too large");
    char old[8] = "";
    assert_int_equal(read_bytes("a.png", (uint8_t *)old, 7), 3);
    assert_string_equal(old, "old");
    assert_int_equal(count_entries(), 1);
}

static void a_full_disk_is_seen_at_once(void **state) {
    (void)state;
    check_disk_full(0);
}

static void a_full_disk_is_seen_at_the_last_byte(void **state) {
    (void)state;
    const struct monge_film film = make_film(MONGE_ENCODING_SRGB, 16);
    struct stat status;
    write_film(&film, "whole.png");
    assert_int_equal(stat("whole.png", &status), 0);
    assert_int_equal(unlink("whole.png"), 0);
    check_disk_full((rlim_t)status.st_size - 1);
}

#define IN_FOLDER(function)                                                                                  \
    { #function, function, enter_folder, leave_folder, NULL }

int main(void) {
    enum { FORMATS = sizeof formats / sizeof *formats, FAILURES = sizeof failures / sizeof *failures };
    const struct CMUnitTest single[] = {
        IN_FOLDER(texts_name_program_and_scene),
        IN_FOLDER(texts_name_a_region),
        IN_FOLDER(the_same_film_gives_the_same_bytes),
        IN_FOLDER(a_new_file_has_the_permissions_of_new_files),
        IN_FOLDER(an_old_file_keeps_its_permissions),
        IN_FOLDER(a_reader_of_the_old_file_keeps_it),
        IN_FOLDER(a_link_stays_and_its_end_is_replaced),
        IN_FOLDER(a_long_name_still_fits),
        IN_FOLDER(a_pipe_is_written_directly),
        IN_FOLDER(a_device_is_written_directly),
        IN_FOLDER(a_full_device_is_seen),
        IN_FOLDER(a_protected_file_is_refused),
        IN_FOLDER(a_full_disk_is_seen_at_once),
        IN_FOLDER(a_full_disk_is_seen_at_the_last_byte),
    };
    enum { SINGLE = sizeof single / sizeof *single };
    struct CMUnitTest tests[FORMATS + FAILURES + SINGLE];
    size_t n = 0;
    for (size_t i = 0; i < FORMATS; i++)
        tests[n++] =
            (struct CMUnitTest){formats[i].name, check_format, enter_folder, leave_folder, &formats[i]};
    for (size_t i = 0; i < FAILURES; i++)
        tests[n++] =
            (struct CMUnitTest){failures[i].name, check_failure, enter_folder, leave_folder, &failures[i]};
    memcpy(tests + n, single, sizeof single);
    return cmocka_run_group_tests_name("png", tests, NULL, NULL);
}
