/* What counts as a difference, and how much of one it is. */
#include "comparing.h"

/* ---- Pixels of which a few are known ---- */

enum { WIDTH = 70, HEIGHT = 40 };

static uint8_t flat(size_t x, size_t y, size_t i) {
    (void)x, (void)y, (void)i;
    return 100;
}

/* Differs from it at 5,3 by 51 in red, at 69,39 by 102 in blue, at 7,3 by 102 in green. */
static uint8_t dotted(size_t x, size_t y, size_t i) {
    if (x == 5 && y == 3 && i == 0) return 151;
    if (x == 69 && y == 39 && i == 2) return 202;
    if (x == 7 && y == 3 && i == 1) return 202;
    return 100;
}

static void check_dots(const struct monge_difference *d) {
    const double numbers = WIDTH * HEIGHT * 3;
    assert_false(d->same);
    assert_int_equal(d->unlike, MONGE_UNLIKE_NOTHING);
    assert_int_equal(d->pixels, WIDTH * HEIGHT);
    assert_int_equal(d->different, 3);
    assert_near(d->max, 0.4, 0.0, "max");
    assert_int_equal(d->max_x, 7);
    assert_int_equal(d->max_y, 3);
    assert_near(d->mae, (0.2 + 0.4 + 0.4) / numbers, 1e-16, "mae");
    assert_near(d->rmse, sqrt((0.04 + 0.16 + 0.16) / numbers), 1e-15, "rmse");
    assert_near(d->psnr, -10.0 * log10((0.04 + 0.16 + 0.16) / numbers), 1e-12, "psnr");
    assert_true(isnan(d->ssim) && isnan(d->flip));
    assert_int_equal(d->bounds.x, 5);
    assert_int_equal(d->bounds.y, 3);
    assert_int_equal(d->bounds.width, 65);
    assert_int_equal(d->bounds.height, 37);
}

static void differences_are_counted(void **state) {
    (void)state;
    for (unsigned threads = 1; threads <= 5; threads++) {
        const struct monge_difference d =
            compare_with(SAMPLE(WIDTH, HEIGHT, .byte = flat), SAMPLE(WIDTH, HEIGHT, .byte = dotted),
                         (struct monge_compare){.threads = threads});
        check_dots(&d);
    }
}

static void beyond_is_by_more_than_max_delta(void **state) {
    (void)state;
    static const struct {
        double max_delta;
        unsigned beyond;
    } rows[] = {{0, 3}, {0.1999999, 3}, {0.2, 2}, {0.3999, 2}, {0.4, 0}, {1, 0}};
    for (size_t i = 0; i < COUNT(rows); i++) {
        const struct monge_difference d =
            compare_with(SAMPLE(WIDTH, HEIGHT, .byte = flat), SAMPLE(WIDTH, HEIGHT, .byte = dotted),
                         (struct monge_compare){.max_delta = rows[i].max_delta});
        assert_int_equal(d.beyond, rows[i].beyond);
        assert_int_equal(d.different, 3);
    }
}

static uint8_t step_up(size_t x, size_t y, size_t i) { return (uint8_t)(i == 0 ? x + y * 16 : 0); }
static uint8_t all_black(size_t x, size_t y, size_t i) { return (void)x, (void)y, (void)i, 0; }

/* Each of the differences k / 255, written as a decimal number, is not beyond itself. */
static void limits_are_exact(void **state) {
    (void)state;
    for (unsigned k = 0; k < 256; k++) {
        char text[32];
        snprintf(text, sizeof text, "%.17g", k / 255.0);
        const struct monge_difference d =
            compare_with(SAMPLE(16, 16, .byte = step_up), SAMPLE(16, 16, .byte = all_black),
                         (struct monge_compare){.max_delta = strtod(text, NULL)});
        assert_int_equal(d.beyond, 255 - k);
    }
}

/* Each row that differs does so farther to the left. */
static uint8_t slanted(size_t x, size_t y, size_t i) {
    return (uint8_t)(flat(x, y, i) + (y > 2 && y < 9 && x + 7 * y == 62 ? 1 : 0));
}

static void bounds_hold_all(void **state) {
    (void)state;
    for (unsigned threads = 1; threads < 4; threads++) {
        const struct monge_difference d =
            compare_with(SAMPLE(WIDTH, HEIGHT, .byte = slanted), SAMPLE(WIDTH, HEIGHT, .byte = flat),
                         (struct monge_compare){.threads = threads});
        assert_int_equal(d.different, 6);
        assert_int_equal(d.bounds.x, 62 - 7 * 8);
        assert_int_equal(d.bounds.y, 3);
        assert_int_equal(d.bounds.width, 7 * 5 + 1);
        assert_int_equal(d.bounds.height, 6);
        assert_int_equal(d.max_x, 62 - 7 * 3);
        assert_int_equal(d.max_y, 3);
    }
}

/* ---- What is ignored ---- */

static uint8_t mask_byte(size_t x, size_t y, size_t i) {
    return (uint8_t)(x == 69 && y == 39 && i == 1 ? 1 : 0);
}

static void regions_are_ignored(void **state) {
    (void)state;
    const struct monge_region regions[] = {{7, 3, 1, 1}, {60, 30, 1000, 1000}, {500, 500, 1, 1}};
    const struct monge_difference d =
        compare_with(SAMPLE(WIDTH, HEIGHT, .byte = flat), SAMPLE(WIDTH, HEIGHT, .byte = dotted),
                     (struct monge_compare){.ignore = regions, .ignore_count = COUNT(regions)});
    assert_int_equal(d.pixels, WIDTH * HEIGHT - 1 - 100);
    assert_int_equal(d.different, 1);
    assert_near(d.max, 0.2, 0.0, "max");
    assert_near(d.mae, 0.2 / (3.0 * (WIDTH * HEIGHT - 101)), 1e-16, "mae");
}

static void masks_are_ignored(void **state) {
    (void)state;
    write_sample("mask.png", SAMPLE(WIDTH, HEIGHT, .byte = mask_byte));
    struct monge_picture *mask = read_good("mask.png");
    const struct monge_difference d =
        compare_with(SAMPLE(WIDTH, HEIGHT, .byte = flat), SAMPLE(WIDTH, HEIGHT, .byte = dotted),
                     (struct monge_compare){.mask = mask});
    assert_int_equal(d.pixels, WIDTH * HEIGHT - 1);
    assert_int_equal(d.different, 2);
    monge_picture_free(mask);
}

static void masks_must_be_of_the_size(void **state) {
    (void)state;
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_difference d;
    write_sample("mask.png", SAMPLE(WIDTH, HEIGHT - 1, .byte = mask_byte));
    write_sample("a.png", SAMPLE(WIDTH, HEIGHT, .byte = flat));
    struct monge_picture *mask = read_good("mask.png"), *a = read_good("a.png"), *b = read_good("a.png");
    assert_false(monge_compare(a, b, &(struct monge_compare){.mask = mask}, &d, diag));
    assert_int_equal(monge_diagnostics_failures(diag), 1);
    monge_picture_free(mask);
    monge_picture_free(a);
    monge_picture_free(b);
    monge_diagnostics_free(diag);
}

static void all_may_be_ignored(void **state) {
    (void)state;
    const struct monge_region whole = {0, 0, WIDTH, HEIGHT};
    const struct monge_difference d = compare_with(
        SAMPLE(WIDTH, HEIGHT, .byte = flat), SAMPLE(WIDTH, HEIGHT, .byte = dotted),
        (struct monge_compare){
            .ignore = &whole, .ignore_count = 1, .metrics = 1 << MONGE_METRIC_SSIM | 1 << MONGE_METRIC_FLIP});
    assert_true(d.same);
    assert_int_equal(d.pixels, 0);
    assert_near(d.mae + d.rmse + d.max + d.flip, 0.0, 0.0, "errors");
    assert_near(d.ssim, 1.0, 0.0, "ssim");
}

/* ---- What is the same in another form ---- */

static uint8_t grey_ramp(size_t x, size_t y, size_t i) { return (void)i, (uint8_t)(3 * x + y); }
static uint8_t grey_opaque(size_t x, size_t y, size_t i) { return i % 2 ? 255 : grey_ramp(x, y, 0); }
static uint8_t color_opaque(size_t x, size_t y, size_t i) { return i == 3 ? 255 : grey_ramp(x, y, 0); }
static uint8_t nearly_opaque(size_t x, size_t y, size_t i) {
    return i == 3 && x == 9 && y == 8 ? 254 : color_opaque(x, y, i);
}

static void forms_do_not_count(void **state) {
    (void)state;
    const struct sample *grey = SAMPLE(30, 20, .type = PNG_COLOR_TYPE_GRAY, .bits = 8, .byte = grey_ramp);
    const struct sample *color = SAMPLE(30, 20, .byte = grey_ramp);
    assert_true(compare(grey, color).same);
    assert_true(compare(color, SAMPLE(30, 20, .byte = grey_ramp, .interlaced = true)).same);
    assert_true(compare(color, SAMPLE(30, 20, .byte = grey_ramp, .before = "text")).same);
    assert_true(compare(color, SAMPLE(30, 20, .byte = grey_ramp, .srgb = true)).same);
    assert_true(
        compare(grey, SAMPLE(30, 20, .type = PNG_COLOR_TYPE_GRAY_ALPHA, .bits = 8, .byte = grey_opaque))
            .same);
    assert_true(
        compare(grey, SAMPLE(30, 20, .type = PNG_COLOR_TYPE_RGB_ALPHA, .bits = 8, .byte = color_opaque))
            .same);
    const struct monge_difference d =
        compare(color, SAMPLE(30, 20, .type = PNG_COLOR_TYPE_RGB_ALPHA, .bits = 8, .byte = nearly_opaque));
    assert_int_equal(d.different, 1);
    assert_int_equal(d.max_x, 9);
    assert_near(d.max, 1.0 / 255.0, 0.0, "alpha");
}

static uint8_t in_palette(size_t x, size_t y, size_t i) { return (void)i, (uint8_t)((x + y) % 16); }
static uint8_t looked_up(size_t x, size_t y, size_t i) {
    const size_t k = (x + y) % 16;
    return (uint8_t)(i == 0 ? k * 5 : i == 1 ? 255 - k : k ^ 85);
}

static void palettes_are_looked_up(void **state) {
    (void)state;
    assert_true(compare(SAMPLE(30, 20, .type = PNG_COLOR_TYPE_PALETTE, .bits = 8, .byte = in_palette),
                        SAMPLE(30, 20, .byte = looked_up))
                    .same);
}

/* 16 bits, each channel the same byte twice: v * 257. */
static uint8_t doubled(size_t x, size_t y, size_t i) { return dotted(x, y, i / 2); }
static uint8_t doubled_and_one(size_t x, size_t y, size_t i) {
    return (uint8_t)(doubled(x, y, i) + (x == 2 && y == 2 && i == 5));
}

static void bits_count(void **state) {
    (void)state;
    const struct sample *deep =
        SAMPLE(WIDTH, HEIGHT, .type = PNG_COLOR_TYPE_RGB, .bits = 16, .byte = doubled);
    struct monge_difference d = compare(SAMPLE(WIDTH, HEIGHT, .byte = dotted), deep);
    assert_false(d.same);
    assert_int_equal(d.unlike, MONGE_UNLIKE_BITS);
    assert_int_equal(d.different, 0);
    d = compare(deep, SAMPLE(WIDTH, HEIGHT, .type = PNG_COLOR_TYPE_RGB, .bits = 16, .byte = doubled_and_one));
    assert_int_equal(d.different, 1);
    assert_near(d.max, 1.0 / 65535.0, 0.0, "one of 16 bits");
}

static uint8_t rough_grey(size_t x, size_t y, size_t i) { return sample_byte(x, y, i / 3); }
static uint8_t other_grey(size_t x, size_t y, size_t i) {
    return (uint8_t)(rough_grey(x, y, i) ^ (x + y) % 7);
}
static uint8_t rough_pair(size_t x, size_t y, size_t i) { return rough_grey(x, y, 3 * i); }
static uint8_t other_pair(size_t x, size_t y, size_t i) { return other_grey(x, y, 3 * i); }

/* Grey with alpha, and the same as colours. */
static void means_do_not_depend_on_how_it_is_stored(void **state) {
    (void)state;
    static const int types[] = {PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB_ALPHA};
    struct monge_difference d[2][2];
    for (int a = 0; a < 2; a++)
        for (int b = 0; b < 2; b++)
            d[a][b] =
                compare(SAMPLE(50, 40, .type = types[a], .bits = 8, .byte = a ? rough_grey : rough_pair),
                        SAMPLE(50, 40, .type = types[b], .bits = 8, .byte = b ? other_grey : other_pair));
    for (int i = 0; i < 3; i++) {
        const struct monge_difference *one = &d[i / 2][i % 2], *other = &d[1][1];
        assert_true(one->different == other->different && one->mae > 0.0);
        assert_near(one->mae, other->mae, 0.0, "mae");
        assert_near(one->rmse, other->rmse, 0.0, "rmse");
    }
}

static uint8_t dots(size_t x, size_t y, size_t i) {
    static const struct {
        size_t x;
        uint8_t by;
    } rows[] = {{5, 9}, {40, 5}, {45, 3}, {90, 1}, {42, 90}}; /* a row each */
    return (uint8_t)(flat(x, y, i) + (y < COUNT(rows) && i == 1 && x == rows[y].x ? rows[y].by : 0));
}

/* Beside those before, in one that they lie around: one further to the right that differs by less, one that differs by most. */
static void each_of_neighbors_counts(void **state) {
    (void)state;
    struct monge_difference d = compare(SAMPLE(100, 3, .byte = flat), SAMPLE(100, 3, .byte = dots));
    assert_true(d.different == 3 && d.bounds.x == 5 && d.bounds.width == 41);
    d = compare(SAMPLE(100, 5, .byte = flat), SAMPLE(100, 5, .byte = dots));
    assert_true(d.different == 5 && d.bounds.x == 5 && d.bounds.width == 86 && d.bounds.height == 5);
    assert_near(d.max, 90 / 255.0, 1e-15, "the largest");
    assert_true(d.max_x == 42 && d.max_y == 4);
}

static uint8_t black(size_t x, size_t y, size_t i) { return (void)x, (void)y, (void)i, 0; }
static uint8_t white(size_t x, size_t y, size_t i) { return (void)x, (void)y, (void)i, 255; }

static void nothing_is_worse_than_black_and_white(void **state) {
    (void)state;
    const struct monge_difference d =
        compare(SAMPLE(WIDTH, HEIGHT, .byte = black), SAMPLE(WIDTH, HEIGHT, .byte = white));
    assert_int_equal(d.different, d.pixels);
    assert_true(d.max == 1.0 && d.mae == 1.0 && d.rmse == 1.0);
    assert_true(d.psnr == 0.0 && !signbit(d.psnr)); /* else it is printed as -0 */
}

static void spaces_and_sizes_count(void **state) {
    (void)state;
    const struct sample *plain = SAMPLE(30, 20, .byte = flat);
    struct monge_difference d = compare(plain, SAMPLE(30, 20, .byte = flat, .gamma = 100000));
    assert_int_equal(d.unlike, MONGE_UNLIKE_COLOR_SPACE);
    assert_true(!d.same && isnan(d.max) && isnan(d.psnr));
    d = compare(plain, SAMPLE(30, 21, .byte = flat));
    assert_int_equal(d.unlike, MONGE_UNLIKE_SIZE);
    assert_true(!d.same && isnan(d.mae) && d.pixels == 0);
    assert_true(compare(SAMPLE(30, 20, .byte = flat, .gamma = 50000),
                        SAMPLE(30, 20, .byte = flat, .gamma = 50000, .before = "x"))
                    .same);
}

static void equal_files_are_the_same(void **state) {
    (void)state;
    const struct monge_difference d =
        compare_with(SAMPLE(30, 20, .byte = flat), SAMPLE(30, 20, .byte = flat),
                     (struct monge_compare){.metrics = 1 << MONGE_METRIC_SSIM | 1 << MONGE_METRIC_FLIP});
    assert_true(d.same && isinf(d.psnr) && d.psnr > 0);
    assert_int_equal(d.pixels, 600);
    assert_near(d.max + d.mae + d.rmse + d.flip, 0.0, 0.0, "errors");
    assert_near(d.ssim, 1.0, 0.0, "ssim");
}

/* ---- SSIM, by its definition ---- */

static uint8_t other_byte(size_t x, size_t y, size_t i) {
    return (uint8_t)(sample_byte(x, y, i) / 2 + sample_byte(y, x + 3, i) / 3);
}

static double luma(uint8_t (*byte)(size_t, size_t, size_t), size_t x, size_t y) {
    return (0.299 * byte(x, y, 0) + 0.587 * byte(x, y, 1) + 0.114 * byte(x, y, 2)) / 255.0;
}

static size_t clamped(int value, size_t size) {
    return value < 0 ? 0 : (size_t)value < size ? (size_t)value : size - 1;
}

/* Of the window around a pixel, in two passes: first the means, then what is about them. ignored NULL: nothing is. */
static double window_ssim(int cx, int cy, const struct monge_region *ignored) {
    double weights = 0, ma = 0, mb = 0, va = 0, vb = 0, cov = 0;
    for (int pass = 0; pass < 2; pass++)
        for (int dy = -5; dy <= 5; dy++)
            for (int dx = -5; dx <= 5; dx++) {
                const size_t x = clamped(cx + dx, 60), y = clamped(cy + dy, 50);
                const bool skip =
                    ignored && x - ignored->x < ignored->width && y - ignored->y < ignored->height;
                const double w = exp(-(dx * dx + dy * dy) / 4.5);
                const double a = luma(sample_byte, x, y), b = skip ? a : luma(other_byte, x, y);
                if (pass == 0) weights += w, ma += w * a, mb += w * b;
                if (pass == 1) {
                    va += w * (a - ma / weights) * (a - ma / weights) / weights;
                    vb += w * (b - mb / weights) * (b - mb / weights) / weights;
                    cov += w * (a - ma / weights) * (b - mb / weights) / weights;
                }
            }
    ma /= weights, mb /= weights;
    return (2 * ma * mb + 1e-4) * (2 * cov + 9e-4) / ((ma * ma + mb * mb + 1e-4) * (va + vb + 9e-4));
}

static void ssim_is_as_defined(void **state) {
    (void)state;
    double sum = 0;
    for (int y = 5; y < 45; y++)
        for (int x = 5; x < 55; x++) sum += window_ssim(x, y, NULL);
    for (unsigned threads = 1; threads < 4; threads++) {
        const struct monge_difference d =
            compare_with(SAMPLE(60, 50, .byte = sample_byte), SAMPLE(60, 50, .byte = other_byte),
                         (struct monge_compare){.metrics = 1 << MONGE_METRIC_SSIM, .threads = threads});
        assert_near(d.ssim, sum / 2000.0, 1e-10, "ssim");
    }
}

/* Be it at the edge: two columns at the right, and two rows at the bottom. */
static void ssim_is_of_all_that_is_not_ignored(void **state) {
    (void)state;
    const struct monge_region ignored = {0, 0, 58, 48};
    double sum = 0;
    for (int y = 0; y < 50; y++)
        for (int x = y < 48 ? 58 : 0; x < 60; x++) sum += window_ssim(x, y, &ignored);
    const struct monge_difference d = compare_with(
        SAMPLE(60, 50, .byte = sample_byte), SAMPLE(60, 50, .byte = other_byte),
        (struct monge_compare){.metrics = 1 << MONGE_METRIC_SSIM, .ignore = &ignored, .ignore_count = 1});
    assert_int_equal(d.pixels, 2 * 48 + 2 * 60);
    assert_near(d.ssim, sum / (double)d.pixels, 1e-10, "ssim");
}

static void ssim_of_small_pictures_is_a_number(void **state) {
    (void)state;
    for (uint32_t width = 1; width < 14; width += 4)
        for (uint32_t height = 1; height < 14; height += 4) {
            const struct monge_difference d = compare_with(
                SAMPLE(width, height, .byte = sample_byte), SAMPLE(width, height, .byte = other_byte),
                (struct monge_compare){.metrics = 1 << MONGE_METRIC_SSIM});
            assert_true(d.ssim > -1.0 && d.ssim < 1.0);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(differences_are_counted, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(beyond_is_by_more_than_max_delta, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(limits_are_exact, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(bounds_hold_all, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(regions_are_ignored, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(masks_are_ignored, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(masks_must_be_of_the_size, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(all_may_be_ignored, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(forms_do_not_count, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(palettes_are_looked_up, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(bits_count, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(means_do_not_depend_on_how_it_is_stored, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(each_of_neighbors_counts, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(nothing_is_worse_than_black_and_white, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(spaces_and_sizes_count, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(equal_files_are_the_same, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(ssim_is_as_defined, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(ssim_is_of_all_that_is_not_ignored, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(ssim_of_small_pictures_is_a_number, enter_folder, leave_folder),
    };
    return cmocka_run_group_tests_name("compare", tests, NULL, NULL);
}
