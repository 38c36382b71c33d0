/* What a picture says it was made from: the text chunks, read back by libpng, against hashes made here. */
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <png.h>

#include "base/hash.h"
#include "folder.h"
#include "monge.h"
#include "near.h"

static void write_text(const char *path, const char *text) {
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

/* A scene in a folder of its own, with two files that it includes, the second from the first. */
static void write_scene(void) {
    assert_int_equal(mkdir("s", 0777), 0);
    assert_int_equal(mkdir("s/more", 0777), 0);
    write_text("s/scene.yaml",
               "include: more/a.yaml\nimage: {size: [7, 5]}\nscene: [{sphere: {}, material: m}]\n");
    write_text("s/more/a.yaml", "include: ünder.yaml\n");
    write_text("s/more/ünder.yaml", "materials: {m: {diffuse: [0.2, 0.4, 0.6]}}\n");
}

static void render(const char *scene_path, const char *path, unsigned bits, const char *options,
                   char film_hash[MONGE_HASH_SIZE]) {
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_scene *scene = monge_load_file(scene_path, NULL, diag);
    monge_diagnostics_print(diag, stderr);
    assert_non_null(scene);
    struct monge_settings settings = monge_scene_settings(scene);
    settings.bits = bits;
    const struct monge_job job = {.threads = 1, .options = options};
    struct monge_film *film = monge_render(scene, &settings, NULL, &job, NULL);
    assert_non_null(film);
    assert_true(monge_film_hash(film, film_hash));
    assert_true(monge_film_write_png(film, path, diag));
    monge_film_free(film);
    monge_scene_free(scene);
    monge_diagnostics_free(diag);
}

/* A text chunk of a picture and a hash of its pixels, both as libpng has them; the text is to be freed. */
static char *read_chunk(const char *path, const char *key, char pixels[MONGE_HASH_SIZE]) {
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, file);
    png_read_png(png, info, PNG_TRANSFORM_IDENTITY, NULL);
    fclose(file);
    struct hash hash;
    hash_begin(&hash);
    hash_integer(&hash, png_get_image_width(png, info));
    hash_integer(&hash, png_get_image_height(png, info));
    hash_integer(&hash, png_get_bit_depth(png, info));
    hash_integer(&hash, 0); /* sRGB */
    for (uint32_t y = 0; y < png_get_image_height(png, info); y++)
        hash_bulk(&hash, png_get_rows(png, info)[y], png_get_rowbytes(png, info));
    hash_text(&hash, pixels);
    png_textp texts;
    int count = 0;
    char *found = NULL;
    png_get_text(png, info, &texts, &count);
    for (int i = 0; i < count; i++)
        if (strcmp(texts[i].key, key) == 0) found = strdup(texts[i].text);
    png_destroy_read_struct(&png, &info, NULL);
    return found;
}

static void assert_chunk(const char *path, const char *key, const char *want) {
    char pixels[MONGE_HASH_SIZE], *text = read_chunk(path, key, pixels);
    if (!want)
        assert_null(text);
    else
        assert_string_equal(text, want);
    free(text);
}

static void pixels_are_those_of_the_file(void **state) {
    (void)state;
    write_scene();
    for (unsigned bits = 8; bits <= 16; bits += 8) {
        char film[MONGE_HASH_SIZE], pixels[MONGE_HASH_SIZE];
        render("s/scene.yaml", "a.png", bits, NULL, film);
        char *chunk = read_chunk("a.png", "monge:pixels", pixels);
        assert_string_equal(chunk, pixels);
        assert_string_equal(film, pixels);
        free(chunk);
    }
}

static void options_and_files_are_told(void **state) {
    (void)state;
    char film[MONGE_HASH_SIZE];
    write_scene();
    write_text("plain.yaml", "scene: [{sphere: {}}]\nimage: {size: [4, 3]}\n");
    render("s/scene.yaml", "a.png", 8, "--bits 8 -D ä=1", film);
    assert_chunk("a.png", "monge:options", "--bits 8 -D ä=1");
    assert_chunk("a.png", "monge:files", "more/a.yaml\nmore/ünder.yaml");
    assert_chunk("a.png", "monge:program", monge_program());
    render("plain.yaml", "b.png", 8, NULL, film);
    assert_chunk("b.png", "monge:options", NULL);
    assert_chunk("b.png", "monge:files", NULL);
}

static void passes_are_told_and_change_no_pixel(void **state) {
    (void)state;
    char with[MONGE_HASH_SIZE], without[MONGE_HASH_SIZE];
    write_text("plain.yaml", "scene: [{sphere: {}}]\nimage: {size: [4, 3]}\n");
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_scene *scene = monge_load_file("plain.yaml", NULL, diag);
    const struct monge_settings settings = monge_scene_settings(scene);
    struct monge_film *film = monge_render(scene, &settings, NULL, NULL, NULL);
    assert_true(monge_film_write_png(film, "a.png", diag));
    assert_true(monge_film_note_passes(film, "depth 0"));
    assert_true(monge_film_note_passes(film, "object 1\ndepth 2"));
    assert_true(monge_film_write_png(film, "b.png", diag));
    assert_chunk("a.png", "monge:passes", NULL);
    assert_chunk("b.png", "monge:passes", "object 1\ndepth 2");
    free(read_chunk("a.png", "monge:pixels", without));
    free(read_chunk("b.png", "monge:pixels", with));
    assert_string_equal(with, without);
    monge_film_free(film);
    monge_scene_free(scene);
    monge_diagnostics_free(diag);
}

static void assert_files_hash(const char *path, const char *want, bool equal) {
    struct monge_diagnostics *diag = monge_diagnostics_new();
    char hash[MONGE_HASH_SIZE];
    assert_true(monge_files_hash(path, "more/a.yaml\nmore/ünder.yaml", NULL, diag, hash));
    assert_int_equal(strcmp(hash, want) == 0, equal);
    monge_diagnostics_free(diag);
}

static void the_text_changes_with_every_file(void **state) {
    (void)state;
    char film[MONGE_HASH_SIZE], pixels[MONGE_HASH_SIZE];
    write_scene();
    render("s/scene.yaml", "a.png", 8, NULL, film);
    char *text = read_chunk("a.png", "monge:text", pixels);
    assert_files_hash("s/scene.yaml", text, true);
    assert_int_equal(rename("s", "elsewhere"), 0);
    assert_files_hash("elsewhere/scene.yaml", text, true);
    write_text("elsewhere/more/ünder.yaml", "materials: {m: {diffuse: [0.2, 0.4, 0.7]}}\n");
    assert_files_hash("elsewhere/scene.yaml", text, false);
    write_text("elsewhere/more/ünder.yaml", "materials: {m: {diffuse: [0.2, 0.4, 0.6]}}\n");
    assert_files_hash("elsewhere/scene.yaml", text, true);
    write_text("elsewhere/more/a.yaml", "include: ünder.yaml\n\n");
    assert_files_hash("elsewhere/scene.yaml", text, false);
    free(text);
}

static void a_missing_file_is_a_failure(void **state) {
    (void)state;
    char hash[MONGE_HASH_SIZE];
    struct monge_diagnostics *diag = monge_diagnostics_new();
    write_scene();
    assert_false(monge_files_hash("s/scene.yaml", "more/b.yaml", NULL, diag, hash));
    assert_int_equal(monge_diagnostics_failures(diag), 1);
    assert_false(monge_files_hash("s/none.yaml", "", NULL, diag, hash));
    assert_int_equal(monge_diagnostics_failures(diag), 2);
    monge_diagnostics_free(diag);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(pixels_are_those_of_the_file, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(options_and_files_are_told, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(passes_are_told_and_change_no_pixel, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(the_text_changes_with_every_file, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(a_missing_file_is_a_failure, enter_folder, leave_folder),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
