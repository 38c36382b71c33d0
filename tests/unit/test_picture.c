/* Reading PNG files: every kind of them as libpng has it, and what is broken never as a picture. */
#include "pictures.h"

#include <libdeflate.h>
#include <sys/stat.h>

/* ---- Pixels ---- */

/* Every row is that of libpng, which is the oracle. */
static void check_rows(const char *path, struct monge_picture *picture) {
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    FILE *file = fopen(path, "rb");
    png_init_io(png, file);
    png_read_png(png, info, PNG_TRANSFORM_EXPAND, NULL);
    fclose(file);
    assert_int_equal(monge_picture_width(picture), png_get_image_width(png, info));
    assert_int_equal(monge_picture_height(picture), png_get_image_height(png, info));
    assert_int_equal(monge_picture_channels(picture), png_get_channels(png, info));
    assert_int_equal(monge_picture_bits(picture), png_get_bit_depth(png, info));
    for (uint32_t y = 0; y < monge_picture_height(picture); y++)
        if (memcmp(monge_picture_row(picture, y), png_get_rows(png, info)[y], png_get_rowbytes(png, info)) !=
            0)
            fail_msg("%s: row %u", path, y);
    png_destroy_read_struct(&png, &info, NULL);
}

static void check_sample(const struct sample *sample) {
    struct monge_diagnostics *diag = monge_diagnostics_new();
    write_sample("a.png", sample);
    struct monge_picture *picture = read_good("a.png");
    assert_true(monge_picture_decode(picture, diag));
    check_rows("a.png", picture);
    monge_picture_free(picture);
    monge_diagnostics_free(diag);
}

static void all_kinds_are_read(void **state) {
    (void)state;
    static const struct {
        int type, bits;
    } kinds[] = {
        {PNG_COLOR_TYPE_GRAY, 1},      {PNG_COLOR_TYPE_GRAY, 2},        {PNG_COLOR_TYPE_GRAY, 4},
        {PNG_COLOR_TYPE_GRAY, 8},      {PNG_COLOR_TYPE_GRAY, 16},       {PNG_COLOR_TYPE_RGB, 8},
        {PNG_COLOR_TYPE_RGB, 16},      {PNG_COLOR_TYPE_PALETTE, 1},     {PNG_COLOR_TYPE_PALETTE, 2},
        {PNG_COLOR_TYPE_PALETTE, 4},   {PNG_COLOR_TYPE_PALETTE, 8},     {PNG_COLOR_TYPE_GRAY_ALPHA, 8},
        {PNG_COLOR_TYPE_RGB_ALPHA, 8}, {PNG_COLOR_TYPE_GRAY_ALPHA, 16}, {PNG_COLOR_TYPE_RGB_ALPHA, 16},
    };
    for (size_t k = 0; k < COUNT(kinds); k++)
        for (int more = 0; more < 8; more++) {
            const bool keyed = more & 1 && !(kinds[k].type & PNG_COLOR_MASK_ALPHA);
            check_sample(SAMPLE(37, 23, .type = kinds[k].type, .bits = kinds[k].bits, .interlaced = more & 2,
                                .keyed = keyed, .pieces = more & 4 ? 50 : 0));
        }
}

static void all_filters_are_undone(void **state) {
    (void)state;
    static const int types[] = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                                PNG_COLOR_TYPE_RGB_ALPHA};
    static const int filters[] = {PNG_FILTER_NONE, PNG_FILTER_SUB,   PNG_FILTER_UP,
                                  PNG_FILTER_AVG,  PNG_FILTER_PAETH, PNG_ALL_FILTERS};
    static const uint32_t widths[] = {1, 2, 3, 4, 5, 8, 61};
    for (size_t t = 0; t < COUNT(types); t++)
        for (int bits = 8; bits <= 16; bits += 8)
            for (size_t f = 0; f < COUNT(filters); f++)
                for (size_t w = 0; w < COUNT(widths); w++)
                    check_sample(SAMPLE(widths[w], 9, .type = types[t], .bits = bits, .filters = filters[f]));
}

/* Two rows of pairs: of each the corner and what is above, and below them what is to the left, and 0, which is to be
 * found whatever is predicted from the three. All 256 are above, and of the others every fifth, which makes all ties. */
static uint8_t neighbors(size_t x, size_t y, size_t i) {
    (void)i;
    const size_t corner = y / 2 / 52 * 5, left = y / 2 % 52 * 5;
    if (y % 2 == 0) return (uint8_t)(x % 2 == 0 ? corner : x / 2);
    return (uint8_t)(x % 2 == 0 ? left : 0);
}

static void all_neighbors_are_told_apart(void **state) {
    (void)state;
    check_sample(SAMPLE(512, 2 * 52 * 52, .type = PNG_COLOR_TYPE_GRAY, .bits = 8, .filters = PNG_FILTER_PAETH,
                        .byte = neighbors));
}

static uint8_t key_8(size_t x, size_t y, size_t i) {
    return (uint8_t)(10 + 10 * i + (x % 5 == i + 1) + (y % 7 == 6));
}
static uint8_t key_16(size_t x, size_t y, size_t i) {
    return (uint8_t)(i % 2 == 0 ? y % 7 == 6 : key_8(x, y, i / 2));
}
static uint8_t key_grey_8(size_t x, size_t y, size_t i) {
    return (uint8_t)(x % 5 == 1 ? x : i + (y % 7 == 6 ? 2 : 1));
}
static uint8_t key_grey_16(size_t x, size_t y, size_t i) {
    return (uint8_t)(i == 0 ? x % 5 == 1 : key_grey_8(x, y, 0));
}

/* Pixels of the transparent colour, beside others that are not it in one channel alone. */
static void one_color_is_transparent(void **state) {
    (void)state;
    static const struct {
        int type, bits;
        uint8_t (*byte)(size_t, size_t, size_t);
    } kinds[] = {{PNG_COLOR_TYPE_RGB, 8, key_8},        {PNG_COLOR_TYPE_RGB, 16, key_16},
                 {PNG_COLOR_TYPE_GRAY, 8, key_grey_8},  {PNG_COLOR_TYPE_GRAY, 16, key_grey_16},
                 {PNG_COLOR_TYPE_GRAY, 4, sample_byte}, {PNG_COLOR_TYPE_GRAY, 2, sample_byte},
                 {PNG_COLOR_TYPE_GRAY, 1, sample_byte}};
    for (size_t k = 0; k < COUNT(kinds); k++)
        for (int interlaced = 0; interlaced < 2; interlaced++)
            check_sample(SAMPLE(43, 21, .type = kinds[k].type, .bits = kinds[k].bits, .byte = kinds[k].byte,
                                .keyed = true, .interlaced = interlaced));
}

/* Interlaced: of small pictures some passes have no pixels, and of others each has one more or less. */
static void passes_are_put_together(void **state) {
    (void)state;
    static const struct {
        int type, bits;
    } kinds[] = {{PNG_COLOR_TYPE_GRAY, 8},   {PNG_COLOR_TYPE_GRAY_ALPHA, 8},
                 {PNG_COLOR_TYPE_RGB, 8},    {PNG_COLOR_TYPE_RGB_ALPHA, 8},
                 {PNG_COLOR_TYPE_RGB, 16},   {PNG_COLOR_TYPE_RGB_ALPHA, 16},
                 {PNG_COLOR_TYPE_PALETTE, 8}};
    for (size_t k = 0; k < COUNT(kinds); k++)
        for (uint32_t width = 1; width <= 17; width++)
            for (uint32_t height = 1; height <= 17; height += width > 9 ? 4 : 1)
                check_sample(
                    SAMPLE(width, height, .type = kinds[k].type, .bits = kinds[k].bits, .interlaced = true));
}

static void pixels_may_be_in_many_chunks(void **state) {
    (void)state;
    check_sample(SAMPLE(200, 100, .pieces = 64));
    check_sample(SAMPLE(1, 1, .bits = 0));
}

/* ---- What is said about them ---- */

static void texts_are_found(void **state) {
    (void)state;
    write_sample("a.png", SAMPLE(4, 4, .before = "one", .behind = "two"));
    write_sample("b.png", SAMPLE(4, 4, .behind = "two"));
    write_sample("c.png", SAMPLE(4, 4, .bits = 0));
    struct monge_picture *a = read_good("a.png"), *b = read_good("b.png"), *c = read_good("c.png");
    assert_string_equal(monge_picture_text(a, "monge:scene"), "one");
    assert_string_equal(monge_picture_text(a, "Comment"), "one");
    assert_string_equal(monge_picture_text(b, "monge:scene"), "two");
    assert_string_equal(monge_picture_text(b, "Comment"), "two");
    assert_null(monge_picture_text(a, "Author"));
    assert_null(monge_picture_text(c, "Comment"));
    monge_picture_free(a);
    monge_picture_free(b);
    monge_picture_free(c);
}

static void color_spaces_are_told(void **state) {
    (void)state;
    static const struct {
        struct sample sample;
        const char *name;
    } rows[] = {
        {{2, 2, .bits = 0}, "sRGB"},
        {{2, 2, .srgb = true, .gamma = 45455}, "sRGB"},
        {{2, 2, .gamma = 45455}, "sRGB"},
        {{2, 2, .gamma = 100000}, "gamma 1"},
        {{2, 2, .gamma = 55556}, "gamma 0.55556"},
    };
    for (size_t i = 0; i < COUNT(rows); i++) {
        write_sample("a.png", &rows[i].sample);
        struct monge_picture *picture = read_good("a.png");
        assert_string_equal(monge_picture_color_space(picture), rows[i].name);
        monge_picture_free(picture);
    }
}

/* ---- What is broken ---- */

enum { MOST = 1 << 17 };

struct file {
    uint8_t byte[MOST];
    size_t size;
};

static struct file load_file(const char *path) {
    struct file file = {.size = 0};
    FILE *stream = fopen(path, "rb");
    file.size = fread(file.byte, 1, MOST, stream);
    fclose(stream);
    assert_in_range(file.size, 1, MOST - 1);
    return file;
}

static void save_file(const char *path, const uint8_t *byte, size_t size) {
    FILE *stream = fopen(path, "wb");
    fwrite(byte, 1, size, stream);
    fclose(stream);
}

/* Whether the file can be read and decoded; if not, a reason must have been told. */
static bool is_good(const char *path) {
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_picture *picture = monge_picture_read(path, diag);
    const bool good = picture && monge_picture_decode(picture, diag);
    assert_int_equal(monge_diagnostics_failures(diag), good ? 0 : 1);
    monge_picture_free(picture);
    monge_diagnostics_free(diag);
    return good;
}

static void cut_off_files_are_refused(void **state) {
    (void)state;
    for (int type = 0; type < 2; type++) {
        write_sample("a.png",
                     SAMPLE(9, 7, .type = type ? PNG_COLOR_TYPE_PALETTE : PNG_COLOR_TYPE_RGB, .bits = 8));
        const struct file file = load_file("a.png");
        for (size_t size = 0; size < file.size; size++) {
            save_file("b.png", file.byte, size);
            if (is_good("b.png")) fail_msg("the first %zu bytes of %zu", size, file.size);
        }
        assert_true(is_good("a.png"));
    }
}

static void changed_bytes_are_noticed(void **state) {
    (void)state;
    write_sample("a.png", SAMPLE(5, 4, .before = "text", .pieces = 40));
    const struct file file = load_file("a.png");
    for (size_t i = 0; i < file.size; i++)
        for (int bit = 0; bit < 8; bit++) {
            struct file broken = file;
            broken.byte[i] ^= (uint8_t)(1 << bit);
            save_file("b.png", broken.byte, broken.size);
            if (is_good("b.png")) fail_msg("bit %d of byte %zu", bit, i);
        }
}

/* A chunk with the right check sum, whatever is in it; returns its bytes. */
static size_t make_chunk(uint8_t *at, const char *type, const void *data, size_t size) {
    for (int i = 0; i < 4; i++) at[i] = (uint8_t)(size >> (24 - 8 * i));
    memcpy(at + 4, type, 4);
    if (size > 0) memcpy(at + 8, data, size);
    const uint32_t sum = libdeflate_crc32(0, at + 4, size + 4);
    for (int i = 0; i < 4; i++) at[8 + size + (size_t)i] = (uint8_t)(sum >> (24 - 8 * i));
    return size + 12;
}

static void add_chunk(struct file *file, const char *type, const void *data, size_t size) {
    file->size += make_chunk(file->byte + file->size, type, data, size);
}

static struct file begin_file(uint32_t width, uint32_t height, int type, int bits) {
    struct file file = {.byte = "\x89PNG\r\n\x1a\n", .size = 8};
    uint8_t header[13] = {0};
    for (int i = 0; i < 4; i++) {
        header[i] = (uint8_t)(width >> (24 - 8 * i));
        header[4 + i] = (uint8_t)(height >> (24 - 8 * i));
    }
    header[8] = (uint8_t)bits;
    header[9] = (uint8_t)type;
    add_chunk(&file, "IHDR", header, sizeof header);
    return file;
}

static size_t compress_bytes(const uint8_t *bytes, size_t size, uint8_t *out, size_t room) {
    struct libdeflate_compressor *deflater = libdeflate_alloc_compressor(6);
    const size_t length = libdeflate_zlib_compress(deflater, bytes, size, out, room);
    libdeflate_free_compressor(deflater);
    assert_true(length > 0);
    return length;
}

/* The rows, with the numbers of their filters, as the pixels of a grey picture of 3 x 2. */
static bool rows_are_good(const uint8_t *rows, size_t size) {
    uint8_t data[200];
    struct file file = begin_file(3, 2, PNG_COLOR_TYPE_GRAY, 8);
    const size_t length = compress_bytes(rows, size, data, sizeof data);
    add_chunk(&file, "IDAT", data, length);
    add_chunk(&file, "IEND", NULL, 0);
    save_file("a.png", file.byte, file.size);
    return is_good("a.png");
}

static void rows_must_be_whole_and_of_known_filters(void **state) {
    (void)state;
    assert_true(rows_are_good((const uint8_t[]){0, 1, 2, 3, 4, 5, 6, 7}, 8));
    assert_false(rows_are_good((const uint8_t[]){0, 1, 2, 3, 5, 5, 6, 7}, 8));
    assert_false(rows_are_good((const uint8_t[]){0, 1, 2, 3, 4, 5, 6}, 7));
    assert_true(rows_are_good((const uint8_t[]){0, 1, 2, 3, 4, 5, 6, 7, 0}, 9)); /* as libpng has it */
}

/* Whatever a stream is made of: a million stored blocks of no bytes, and then the pixel. */
static void pixels_may_be_of_many_blocks(void **state) {
    (void)state;
    enum { BLOCKS = 2000000, SIZE = 2 + 5 * BLOCKS + 7 + 4 };
    uint8_t *data = malloc(SIZE), *chunk = malloc(SIZE + 12);
    assert_true(data && chunk);
    memcpy(data, "\x78\x01", 2);
    for (int i = 0; i < BLOCKS; i++) memcpy(data + 2 + 5 * i, "\0\0\0\xff\xff", 5);
    memcpy(data + 2 + 5 * BLOCKS, "\1\2\0\xfd\xff\0\x70", 7); /* the last: a filter's number and a byte */
    memcpy(data + SIZE - 4, "\0\x72\0\x71", 4);               /* Adler's sum */
    struct file begin = begin_file(2, 1, PNG_COLOR_TYPE_GRAY, 4), end = {.size = 0};
    add_chunk(&end, "IEND", NULL, 0);
    FILE *stream = fopen("a.png", "wb");
    fwrite(begin.byte, 1, begin.size, stream);
    fwrite(chunk, 1, make_chunk(chunk, "IDAT", data, SIZE / 2), stream);
    fwrite(chunk, 1, make_chunk(chunk, "IDAT", data + SIZE / 2, SIZE - SIZE / 2), stream);
    fwrite(end.byte, 1, end.size, stream);
    fclose(stream);
    assert_true(is_good("a.png"));
    free(data);
    free(chunk);
}

static void colors_beyond_the_palette_are_black(void **state) {
    (void)state;
    uint8_t data[100];
    struct file file = begin_file(4, 1, PNG_COLOR_TYPE_PALETTE, 8);
    add_chunk(&file, "PLTE", "\1\2\3\4\5\6", 6);
    add_chunk(&file, "tRNS", "\7", 1);
    add_chunk(&file, "IDAT", data, compress_bytes((const uint8_t[]){0, 0, 1, 2, 255}, 5, data, sizeof data));
    add_chunk(&file, "IEND", NULL, 0);
    save_file("a.png", file.byte, file.size);
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_picture *picture = read_good("a.png");
    assert_true(monge_picture_decode(picture, diag));
    static const uint8_t expected[] = {1, 2, 3, 7, 4, 5, 6, 255, 0, 0, 0, 255, 0, 0, 0, 255};
    assert_memory_equal(monge_picture_row(picture, 0), expected, sizeof expected);
    monge_picture_free(picture);
    monge_diagnostics_free(diag);
}

static void long_compressed_texts_are_left_out(void **state) {
    (void)state;
    enum { TEXT = 1 << 22, TEXTS = 20 };
    static uint8_t packed[1 << 13];
    char *text = malloc(TEXT), key[] = "key ?";
    struct file *file = malloc(sizeof *file);
    assert_true(text && file);
    memset(text, 'a', TEXT);
    *file = begin_file(1, 1, PNG_COLOR_TYPE_GRAY, 8);
    for (int i = 0; i < TEXTS; i++) { /* in turn zTXt and iTXt, behind their keys */
        const size_t before = i % 2 ? sizeof key + 4 : sizeof key + 1;
        key[4] = (char)('a' + i);
        memset(packed, 0, before);
        memcpy(packed, key, sizeof key);
        packed[sizeof key] = (uint8_t)(i % 2);
        const size_t size = compress_bytes((uint8_t *)text, TEXT, packed + before, sizeof packed - before);
        add_chunk(file, i % 2 ? "iTXt" : "zTXt", packed, before + size);
    }
    add_chunk(file, "tEXt", "Comment\0short", 13);
    add_chunk(file, "IDAT", packed, compress_bytes((const uint8_t[]){0, 1}, 2, packed, sizeof packed));
    add_chunk(file, "IEND", NULL, 0);
    save_file("a.png", file->byte, file->size);
    struct monge_picture *picture = read_good("a.png");
    assert_int_equal(strlen(monge_picture_text(picture, "key a")), TEXT);
    assert_int_equal(strlen(monge_picture_text(picture, "key b")), TEXT);
    assert_null(monge_picture_text(picture, "key s"));
    assert_null(monge_picture_text(picture, "key t"));
    assert_string_equal(monge_picture_text(picture, "Comment"), "short");
    monge_picture_free(picture);
    free(file);
    free(text);
}

static bool chunks_are_good(uint32_t width, uint32_t height, const char *types) {
    struct file file = begin_file(width, height, PNG_COLOR_TYPE_GRAY, 8);
    uint8_t data[200];
    const size_t length = compress_bytes((const uint8_t[]){0, 1, 0, 2}, 4, data, sizeof data);
    for (; *types; types += 4) {
        const bool pixels = strncmp(types, "IDAT", 4) == 0;
        add_chunk(&file, types, data, pixels ? length : 0);
    }
    save_file("a.png", file.byte, file.size);
    return is_good("a.png");
}

static void chunks_must_be_in_order(void **state) {
    (void)state;
    assert_true(chunks_are_good(1, 2, "IDATIEND"));
    assert_false(chunks_are_good(1, 2, "IEND"));
    assert_false(chunks_are_good(1, 2, "IDAT"));
    assert_false(chunks_are_good(1, 2, "IDATtEXtIDATIEND"));
    assert_false(chunks_are_good(1, 2, "ABCDIDATIEND")); /* nobody knows it, and it is critical */
}

static void sizes_out_of_reach_are_refused(void **state) {
    (void)state;
    assert_false(chunks_are_good(0, 2, "IDATIEND"));
    assert_false(chunks_are_good(60000, 60000, "IDATIEND"));
    assert_false(chunks_are_good(0x7fffffff, 0x7fffffff, "IDATIEND"));
    assert_false(chunks_are_good(0xffffffff, 1, "IDATIEND"));
    assert_false(chunks_are_good(16384, 16384, "IDATIEND")); /* allowed, but not by so few data */
}

static void what_is_no_picture_is_refused(void **state) {
    (void)state;
    mkdir("folder", 0777);
    save_file("empty.png", (const uint8_t *)"", 0);
    save_file("text.png", (const uint8_t *)"scene: []\n", 10);
    assert_false(is_good("folder"));
    assert_false(is_good("empty.png"));
    assert_false(is_good("text.png"));
    assert_false(is_good("absent.png"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(all_kinds_are_read, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(all_filters_are_undone, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(all_neighbors_are_told_apart, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(one_color_is_transparent, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(passes_are_put_together, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(pixels_may_be_in_many_chunks, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(texts_are_found, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(color_spaces_are_told, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(cut_off_files_are_refused, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(changed_bytes_are_noticed, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(rows_must_be_whole_and_of_known_filters, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(pixels_may_be_of_many_blocks, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(colors_beyond_the_palette_are_black, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(long_compressed_texts_are_left_out, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(chunks_must_be_in_order, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(sizes_out_of_reach_are_refused, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(what_is_no_picture_is_refused, enter_folder, leave_folder),
    };
    return cmocka_run_group_tests_name("picture", tests, NULL, NULL);
}
