/* FLIP and SSIM of pictures with alpha, beside those of pictures without it that were laid over a ground here. */
#include "pictures.h"

/* Compares a.png with b.png. */
static struct monge_difference compare_files(void) {
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_difference d;
    struct monge_picture *a = read_good("a.png"), *b = read_good("b.png");
    const struct monge_compare how = {.metrics = 1 << MONGE_METRIC_SSIM | 1 << MONGE_METRIC_FLIP};
    assert_true(monge_compare(a, b, &how, &d, diag));
    monge_picture_free(a);
    monge_picture_free(b);
    monge_diagnostics_free(diag);
    return d;
}

/* ---- Pictures: red, green, blue and alpha, one byte each ---- */

enum { WIDTH = 40, HEIGHT = 30 };

typedef uint8_t bytes(size_t x, size_t y, size_t i);

static uint8_t stripes(size_t x, size_t y, size_t i) {
    return (uint8_t)((x + 2 * y) % 13 < 4 ? 40 * i : 90 + x);
}
static uint8_t other(size_t x, size_t y, size_t i) { return (uint8_t)(stripes(x + 1, y, i) + x % 3 * 30); }
static uint8_t opaque(size_t x, size_t y, size_t i) { return i < 3 ? stripes(x, y, i) : 255; }
static uint8_t clear(size_t x, size_t y, size_t i) { return i < 3 ? stripes(x, y, i) : 0; }
static uint8_t half(size_t x, size_t y, size_t i) { return i < 3 ? stripes(x, y, i) : 128; }
static uint8_t sloped(size_t x, size_t y, size_t i) { return i < 3 ? other(x, y, i) : (uint8_t)(x * 6 + y); }

/* The same on the left, where alpha is 255; other colours on the right, under alpha 0. */
static uint8_t hidden(size_t x, size_t y, size_t i) { return i == 3 ? (x < 20 ? 255 : 0) : stripes(x, y, i); }
static uint8_t hidden_too(size_t x, size_t y, size_t i) {
    return x >= 20 && i < 3 ? other(x, y, i) : hidden(x, y, i);
}

/* Black and white, opaque; and not there, which shows of black over white alone, and the other way round. */
static uint8_t sides(size_t x, size_t y, size_t i) { return (void)y, i == 3 || x >= 20 ? 255 : 0; }
static uint8_t no_sides(size_t x, size_t y, size_t i) { return i == 3 ? 0 : sides(x, y, i); }

/* ---- The same laid over a ground ---- */

static bytes *laid;
static double ground;

static uint8_t lay(size_t x, size_t y, size_t i) {
    const double alpha = laid(x, y, 3) / 255.0;
    return (uint8_t)(laid(x, y, i) * alpha + ground * (1.0 - alpha) + 0.5);
}

static void write_laid(const char *path, bytes *byte, double over) {
    laid = byte;
    ground = over;
    write_sample(path, SAMPLE(WIDTH, HEIGHT, .byte = lay));
}

static struct monge_difference compare_over(bytes *a, bytes *b, double over) {
    write_laid("a.png", a, over);
    write_laid("b.png", b, over);
    return compare_files();
}

static void write_alpha(const char *path, bytes *byte) {
    write_sample(path, SAMPLE(WIDTH, HEIGHT, .type = PNG_COLOR_TYPE_RGB_ALPHA, .bits = 8, .byte = byte));
}

static struct monge_difference compare_alpha(bytes *a, bytes *b) {
    write_alpha("a.png", a);
    write_alpha("b.png", b);
    return compare_files();
}

/* ---- Tests ---- */

static void opaque_is_as_without_alpha(void **state) {
    (void)state;
    write_alpha("a.png", opaque);
    write_sample("b.png", SAMPLE(WIDTH, HEIGHT, .byte = other));
    const struct monge_difference with = compare_files();
    write_sample("a.png", SAMPLE(WIDTH, HEIGHT, .byte = stripes));
    const struct monge_difference without = compare_files();
    assert_near(with.ssim, without.ssim, 0.0, "ssim");
    assert_near(with.flip, without.flip, 1e-12, "flip");
    assert_true(with.flip > 0.1 && with.ssim < 0.9);
}

static void worse_of_both_grounds_counts(void **state) {
    (void)state;
    static const struct {
        const char *what;
        bytes *a, *b;
    } rows[] = {
        {"opaque and not there", opaque, clear},
        {"opaque and half", opaque, half},
        {"half and not there", half, clear},
        {"half and sloped", half, sloped},
        {"sides", sides, no_sides},
    };
    for (size_t i = 0; i < COUNT(rows); i++) {
        const struct monge_difference d = compare_alpha(rows[i].a, rows[i].b),
                                      black = compare_over(rows[i].a, rows[i].b, 0.0),
                                      white = compare_over(rows[i].a, rows[i].b, 255.0);
        assert_near(d.ssim, fmin(black.ssim, white.ssim), 1e-12, rows[i].what);
        assert_true(d.ssim < 0.99);
        if (!(d.flip >= fmax(black.flip, white.flip) - 1e-6 && d.flip <= black.flip + white.flip + 1e-6))
            fail_msg("%s: flip %g, of %g and %g", rows[i].what, d.flip, black.flip, white.flip);
        assert_true(d.flip > 0.05);
    }
}

/* Of pixels, not of pictures: each side shows over one of the grounds. */
static void errors_are_of_each_pixel(void **state) {
    (void)state;
    const struct monge_difference d = compare_alpha(sides, no_sides),
                                  black = compare_over(sides, no_sides, 0.0),
                                  white = compare_over(sides, no_sides, 255.0);
    assert_true(d.flip > 1.5 * fmax(black.flip, white.flip));
}

static uint8_t grey(size_t x, size_t y, size_t i) { return (void)x, (void)y, i < 3 ? 100 : 255; }
static uint8_t half_grey(size_t x, size_t y, size_t i) { return (void)x, (void)y, i < 3 ? 100 : 128; }
static uint8_t doubled(size_t x, size_t y, size_t i) { return half_grey(x, y, i / 2); }
static uint8_t half_single(size_t x, size_t y, size_t i) { return half_grey(x, y, i ? 3 : 0); }
static uint8_t flat_50(size_t x, size_t y, size_t i) { return (void)x, (void)y, (void)i, 50; }
static uint8_t flat_100(size_t x, size_t y, size_t i) { return (void)x, (void)y, (void)i, 100; }

/* Of flat pictures all pixels are alike. Grey 100 at 128 / 255 is 50 over black and 177 over white, nearer. */
static void half_transparent_is_known(void **state) {
    (void)state;
    write_sample("a.png", SAMPLE(WIDTH, HEIGHT, .byte = flat_100));
    write_sample("b.png", SAMPLE(WIDTH, HEIGHT, .byte = flat_50));
    const struct monge_difference black = compare_files();
    const struct monge_difference white = compare_over(grey, half_grey, 255.0);
    const struct monge_difference d = compare_alpha(grey, half_grey);
    const double flip = fmax(black.flip, white.flip), ssim = fmin(black.ssim, white.ssim);
    assert_near(d.flip, flip, 1e-6, "flip");
    assert_near(d.ssim, (2.0 * 100 * 50 / 65025 + 1e-4) / ((100.0 * 100 + 50 * 50) / 65025 + 1e-4), 1e-9,
                "ssim");
    write_sample("a.png", SAMPLE(WIDTH, HEIGHT, .byte = flat_100));
    write_sample("b.png",
                 SAMPLE(WIDTH, HEIGHT, .type = PNG_COLOR_TYPE_GRAY_ALPHA, .bits = 8, .byte = half_single));
    const struct monge_difference single = compare_files();
    assert_near(single.flip, flip, 1e-6, "flip of grey with alpha");
    assert_near(single.ssim, ssim, 1e-9, "ssim of grey with alpha");
    write_sample("b.png",
                 SAMPLE(WIDTH, HEIGHT, .type = PNG_COLOR_TYPE_RGB_ALPHA, .bits = 16, .byte = doubled));
    const struct monge_difference deep = compare_files();
    assert_near(deep.flip, flip, 0.01, "flip of 16 bits");
    assert_near(deep.ssim, ssim, 0.005, "ssim of 16 bits");
}

static void what_is_hidden_is_not_seen(void **state) {
    (void)state;
    const struct monge_difference d = compare_alpha(hidden, hidden_too);
    assert_true(d.different > 100 && d.max > 0.0);
    assert_near(d.flip, 0.0, 0.0, "flip");
    assert_near(d.ssim, 1.0, 0.0, "ssim");
}

/* The heat map is of the same errors: all grey where nothing is seen, none where all is. */
static size_t count_grey(bytes *a, bytes *b) {
    struct monge_diagnostics *diag = monge_diagnostics_new();
    const struct monge_compare how = {.metrics = 1 << MONGE_METRIC_FLIP};
    size_t count = 0;
    write_alpha("a.png", a);
    write_alpha("b.png", b);
    struct monge_picture *of_a = read_good("a.png"), *of_b = read_good("b.png");
    assert_true(monge_heat_map_write(of_a, of_b, &how, "heat.png", diag));
    struct monge_picture *heat = read_good("heat.png");
    assert_true(monge_picture_decode(heat, diag));
    for (uint32_t y = 0; y < HEIGHT; y++) {
        const uint8_t *row = monge_picture_row(heat, y);
        for (uint32_t x = 0; x < WIDTH; x++, row += 3) count += row[0] == row[1] && row[1] == row[2];
    }
    monge_picture_free(heat);
    monge_picture_free(of_a);
    monge_picture_free(of_b);
    monge_diagnostics_free(diag);
    return count;
}

static void heat_maps_are_of_what_is_seen(void **state) {
    (void)state;
    assert_int_equal(count_grey(hidden, hidden_too), WIDTH * HEIGHT);
    assert_int_equal(count_grey(opaque, clear), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(opaque_is_as_without_alpha, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(worse_of_both_grounds_counts, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(errors_are_of_each_pixel, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(half_transparent_is_known, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(what_is_hidden_is_not_seen, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(heat_maps_are_of_what_is_seen, enter_folder, leave_folder),
    };
    return cmocka_run_group_tests_name("seen", tests, NULL, NULL);
}
