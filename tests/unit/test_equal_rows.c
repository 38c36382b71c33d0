/* Rows that are equal in two pictures need not be decoded to see so, and nobody sees whether they are. */
#include "comparing.h"

enum { WIDTH = 70, HEIGHT = 40 };

static struct monge_region changed;

/* By the same everywhere, so that below the first row the filter that looks up has what it had. */
static uint8_t byte_changed(size_t x, size_t y, size_t i) {
    const bool within = x - changed.x < changed.width && y - changed.y < changed.height;
    return (uint8_t)(sample_byte(x, y, i) + (within ? 21 : 0));
}

static void check_changed(struct monge_picture *a, struct monge_picture *b) {
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_difference d;
    assert_true(monge_compare(a, b, &(struct monge_compare){0}, &d, diag));
    double sum = 0.0;
    const unsigned bytes = monge_picture_bits(a) / 8, step = monge_picture_channels(a) * bytes;
    for (uint32_t y = changed.y; y < changed.y + changed.height; y++)
        for (uint32_t x = changed.x; x < changed.x + changed.width; x++)
            for (unsigned i = 0; i < step; i++) {
                const int by = abs(sample_byte(x, y, i) - byte_changed(x, y, i));
                sum += bytes == 1 ? by : 0; /* of 16 bits, the places and the number are enough */
            }
    assert_int_equal(d.different, changed.width * changed.height);
    assert_true(memcmp(&d.bounds, &changed, sizeof changed) == 0);
    if (bytes == 1) assert_near(d.mae, sum / 255 / (WIDTH * HEIGHT * step), 1e-15, "mae");
    monge_diagnostics_free(diag);
}

static void check_whole(struct monge_picture *picture, uint8_t (*byte)(size_t, size_t, size_t)) {
    struct monge_diagnostics *diag = monge_diagnostics_new();
    assert_true(monge_picture_decode(picture, diag));
    const size_t step = monge_picture_channels(picture) * monge_picture_bits(picture) / 8;
    for (size_t y = 0; y < HEIGHT; y++)
        for (size_t i = 0; i < WIDTH * step; i++)
            assert_int_equal(monge_picture_row(picture, (uint32_t)y)[i], byte(i / step, y, i % step));
    monge_diagnostics_free(diag);
}

/* Compared, compared with another when some of it is decoded, and decoded then: always as the pixels are. */
static void check_undone(const struct sample *kind) {
    struct sample a = *kind, b = *kind;
    b.byte = byte_changed;
    write_sample("a.png", &a);
    write_sample("b.png", &b);
    struct monge_picture *of_a = read_good("a.png"), *of_b = read_good("b.png"), *again = read_good("b.png");
    check_changed(of_a, of_b);
    check_changed(of_a, again);
    check_whole(of_a, sample_byte);
    check_whole(of_b, byte_changed);
    check_whole(again, byte_changed);
    monge_picture_free(of_a);
    monge_picture_free(of_b);
    monge_picture_free(again);
}

static void rows_are_decoded_where_they_differ(void **state) {
    (void)state;
    static const struct monge_region regions[] = {{10, 0, 3, 1},  {30, 15, 2, 25},  {0, 7, WIDTH, 2},
                                                  {69, 39, 1, 1}, {20, 19, 30, 11}, {0, 0, WIDTH, HEIGHT}};
    static const int filters[] = {PNG_FILTER_NONE, PNG_FILTER_SUB,   PNG_FILTER_UP,
                                  PNG_FILTER_AVG,  PNG_FILTER_PAETH, PNG_ALL_FILTERS};
    for (size_t r = 0; r < COUNT(regions); r++)
        for (size_t f = 0; f < COUNT(filters); f++)
            for (int bits = 8; bits <= 16; bits += 8)
                for (int passes = 0; passes < 2; passes++) {
                    changed = regions[r];
                    check_undone(SAMPLE(WIDTH, HEIGHT, .bits = bits, .type = PNG_COLOR_TYPE_RGB,
                                        .filters = filters[f], .interlaced = passes));
                }
}

/* One row is even, or as the one above it: its filter is Sub or Up. */
static uint8_t even_row(size_t x, size_t y, size_t i) { return y == 20 ? 77 : sample_byte(x, y, i); }
static uint8_t doubled_row(size_t x, size_t y, size_t i) { return sample_byte(x, y == 20 ? 19 : y, i); }

static void either_of_two_filters_may_look_up(void **state) {
    (void)state;
    const struct sample *even = SAMPLE(WIDTH, HEIGHT, .byte = even_row);
    const struct sample *doubled = SAMPLE(WIDTH, HEIGHT, .byte = doubled_row);
    double sum = 0.0;
    for (size_t x = 0; x < WIDTH; x++)
        for (size_t i = 0; i < 3; i++) sum += abs(even_row(x, 20, i) - doubled_row(x, 20, i));
    for (int turned = 0; turned < 2; turned++) {
        const struct monge_difference d = compare(turned ? doubled : even, turned ? even : doubled);
        assert_near(d.mae, sum / 255 / (WIDTH * HEIGHT * 3), 1e-15, "mae");
    }
}

struct two {
    struct monge_picture *picture[2];
};

static struct two read_two(bool decode, struct monge_diagnostics *diag) {
    const struct two two = {{read_good("a.png"), read_good("b.png")}};
    for (int i = 0; i < 2; i++) assert_true(!decode || monge_picture_decode(two.picture[i], diag));
    return two;
}

static void free_two(const struct two *two) {
    for (int i = 0; i < 2; i++) monge_picture_free(two->picture[i]);
}

static struct monge_difference see(bool decode, const char *heat_map) {
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_difference d;
    const struct two mapped = read_two(decode, diag), seen = read_two(decode, diag);
    const struct monge_compare exactly = {0},
                               how = {.metrics = 1 << MONGE_METRIC_SSIM | 1 << MONGE_METRIC_FLIP};
    assert_true(monge_heat_map_write(mapped.picture[0], mapped.picture[1], &exactly, heat_map, diag));
    assert_true(monge_compare(seen.picture[0], seen.picture[1], &how, &d, diag));
    free_two(&mapped);
    free_two(&seen);
    monge_diagnostics_free(diag);
    return d;
}

/* What looks around differences, and heat maps, are the same of pictures that have been decoded before. */
static void what_is_seen_is_decoded(void **state) {
    (void)state;
    changed = (struct monge_region){20, 19, 30, 11};
    write_sample("a.png", SAMPLE(WIDTH, HEIGHT, .filters = PNG_FILTER_SUB));
    write_sample("b.png", SAMPLE(WIDTH, HEIGHT, .filters = PNG_FILTER_SUB, .byte = byte_changed));
    const struct monge_difference whole = see(true, "whole.png"), part = see(false, "part.png");
    assert_near(part.ssim, whole.ssim, 0.0, "ssim");
    assert_near(part.flip, whole.flip, 0.0, "flip");
    assert_true(part.ssim < 1.0 && part.flip > 0.0);
    assert_true(compare_files("whole.png", "part.png", (struct monge_compare){0}).same);
}

static uint8_t even(size_t x, size_t y, size_t i) { return (void)x, (void)y, (void)i, 100; }
static uint8_t dotted(size_t x, size_t y, size_t i) { return x == 5 && y == 3 && i == 0 ? 151 : 100; }

/* What is equal is looked at all the same where it is the mask. */
static void a_picture_can_be_the_mask(void **state) {
    (void)state;
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_difference d;
    write_sample("a.png", SAMPLE(WIDTH, HEIGHT, .filters = PNG_FILTER_SUB, .byte = even));
    write_sample("b.png", SAMPLE(WIDTH, HEIGHT, .filters = PNG_FILTER_SUB, .byte = dotted));
    struct monge_picture *a = read_good("a.png"), *b = read_good("b.png");
    assert_true(monge_compare(a, b, &(struct monge_compare){.mask = a}, &d, diag));
    assert_int_equal(d.pixels, 0);
    monge_picture_free(a);
    monge_picture_free(b);
    monge_diagnostics_free(diag);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(rows_are_decoded_where_they_differ, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(either_of_two_filters_may_look_up, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(what_is_seen_is_decoded, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(a_picture_can_be_the_mask, enter_folder, leave_folder),
    };
    return cmocka_run_group_tests_name("equal_rows", tests, NULL, NULL);
}
