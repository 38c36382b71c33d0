/* FLIP beside a plain program in double precision, after the paper: filters in two dimensions, libm, no tricks. */
#include "pictures.h"

/* ---- The plain program ---- */

enum { MOST = 64 * 64 };
static const double pi = 3.14159265358979323846;

struct color {
    double v[3];
};

struct plane {
    int width, height;
    struct color at[MOST]; /* linear RGB, then what becomes of it */
};

/* The matrix of sRGB with the white point x = 0.3127, y = 0.3290. */
static const double to_xyz[3][3] = {
    {0.41239079926595934, 0.357584339383878, 0.1804807884018343},
    {0.21263900587151027, 0.715168678767756, 0.07219231536073371},
    {0.01933081871559182, 0.11919477979462598, 0.9505321522496607},
};

static struct color times(const double m[3][3], struct color c) {
    struct color out;
    for (int i = 0; i < 3; i++) out.v[i] = m[i][0] * c.v[0] + m[i][1] * c.v[1] + m[i][2] * c.v[2];
    return out;
}

/* X / Xn, Y / Yn, Z / Zn. */
static struct color over_white(struct color rgb) {
    const struct color white = times(to_xyz, (struct color){{1, 1, 1}});
    struct color xyz = times(to_xyz, rgb);
    for (int i = 0; i < 3; i++) xyz.v[i] /= white.v[i];
    return xyz;
}

/* The inverse, by Cramer's rule. */
static struct color rgb_of(struct color xyz) {
    double m[3][3], d[4];
    const struct color white = times(to_xyz, (struct color){{1, 1, 1}});
    struct color rgb;
    for (int k = 0; k < 4; k++) {
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) m[i][j] = j == k ? xyz.v[i] * white.v[i] : to_xyz[i][j];
        d[k] = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
               m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
               m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    }
    for (int k = 0; k < 3; k++) rgb.v[k] = d[k] / d[3];
    return rgb;
}

static struct color opponent_of(struct color rgb) {
    const struct color w = over_white(rgb);
    return (struct color){{116 * w.v[1] - 16, 500 * (w.v[0] - w.v[1]), 200 * (w.v[1] - w.v[2])}};
}

static struct color rgb_of_opponent(struct color o) {
    const double y = (o.v[0] + 16) / 116;
    return rgb_of((struct color){{y + o.v[1] / 500, y, y - o.v[2] / 200}});
}

static double curve(double t) { return t > 216.0 / 24389 ? cbrt(t) : t * 841 / 108 + 4.0 / 29; }

static struct color hunt_lab(struct color rgb) {
    const struct color w = over_white(rgb);
    const double l = 116 * curve(w.v[1]) - 16;
    return (struct color){{l, 0.01 * l * 500 * (curve(w.v[0]) - curve(w.v[1])),
                           0.01 * l * 200 * (curve(w.v[1]) - curve(w.v[2]))}};
}

static double hyab(struct color a, struct color b) {
    return fabs(a.v[0] - b.v[0]) + hypot(a.v[1] - b.v[1], a.v[2] - b.v[2]);
}

static struct color at_clamped(const struct plane *p, int x, int y) {
    x = x < 0 ? 0 : x >= p->width ? p->width - 1 : x;
    y = y < 0 ? 0 : y >= p->height ? p->height - 1 : y;
    return p->at[y * p->width + x];
}

static double contrast(int channel, double d2) {
    if (channel == 0) return exp(-pi * pi * d2 / 0.0047);
    if (channel == 1) return exp(-pi * pi * d2 / 0.0053);
    return 34.1 * sqrt(pi / 0.04) * exp(-pi * pi * d2 / 0.04) +
           13.5 * sqrt(pi / 0.025) * exp(-pi * pi * d2 / 0.025);
}

static struct color filtered(const struct plane *p, int x, int y, double ppd) {
    const int radius = (int)ceil(3 * sqrt(0.04 / (2 * pi * pi)) * ppd);
    struct color sum = {{0}}, weights = {{0}};
    for (int j = -radius; j <= radius; j++)
        for (int i = -radius; i <= radius; i++)
            for (int c = 0; c < 3; c++) {
                const double w = contrast(c, (i * i + j * j) / (ppd * ppd));
                sum.v[c] += w * at_clamped(p, x + i, y + j).v[c];
                weights.v[c] += w;
            }
    for (int c = 0; c < 3; c++) sum.v[c] /= weights.v[c];
    struct color rgb = rgb_of_opponent(sum);
    for (int c = 0; c < 3; c++) rgb.v[c] = fmin(fmax(rgb.v[c], 0), 1);
    return hunt_lab(rgb);
}

/* Order 1 is the edges, 2 the points: the length of the vector of the derivatives along x and y. */
static double feature(const struct plane *p, int x, int y, double ppd, int order) {
    const double s = 0.5 * 0.082 * ppd;
    const int radius = (int)ceil(3 * s);
    double along[2] = {0}, above = 0, below = 0;
    for (int pass = 0; pass < 2; pass++) /* the weights above and below zero are scaled each by itself */
        for (int j = -radius; j <= radius; j++)
            for (int i = -radius; i <= radius; i++)
                for (int axis = 0; axis < 2; axis++) {
                    const int k = axis ? j : i;
                    const double g = exp(-(i * i + j * j) / (2 * s * s));
                    const double w = order == 1 ? -k * g : (k * k / (s * s) - 1) * g;
                    const double luma = (at_clamped(p, x + i, y + j).v[0] + 16) / 116;
                    if (pass == 0 && axis == 0) *(w > 0 ? &above : &below) += fabs(w);
                    if (pass == 1) along[axis] += luma * w / (w > 0 ? above : below);
                }
    return hypot(along[0], along[1]);
}

static double plain_error(const struct plane *a, const struct plane *b, int x, int y, double ppd) {
    const struct color green = {{0, 1, 0}}, blue = {{0, 0, 1}};
    const double most = pow(hyab(hunt_lab(green), hunt_lab(blue)), 0.7);
    const double c = pow(hyab(filtered(a, x, y, ppd), filtered(b, x, y, ppd)), 0.7);
    const double color =
        c < 0.4 * most ? c * 0.95 / (0.4 * most) : 0.95 + (c - 0.4 * most) / (0.6 * most) * 0.05;
    const double edge = fabs(feature(a, x, y, ppd, 1) - feature(b, x, y, ppd, 1));
    const double point = fabs(feature(a, x, y, ppd, 2) - feature(b, x, y, ppd, 2));
    return pow(color, 1 - sqrt(fmax(edge, point) / sqrt(2)));
}

static double light(double number) {
    return number <= 0.04045 ? number / 12.92 : pow((number + 0.055) / 1.055, 2.4);
}

static struct plane make_plane(const struct sample *s) {
    struct plane p = {(int)s->width, (int)s->height, {{{0}}}};
    assert_in_range(s->width * s->height, 1, MOST);
    for (size_t y = 0; y < s->height; y++)
        for (size_t x = 0; x < s->width; x++) {
            struct color rgb;
            for (size_t c = 0; c < 3; c++) rgb.v[c] = light(s->byte(x, y, c) / 255.0);
            p.at[y * s->width + x] = opponent_of(rgb);
        }
    return p;
}

static double plain_mean(const struct sample *a, const struct sample *b, double ppd) {
    static struct plane of_a, of_b;
    of_a = make_plane(a);
    of_b = make_plane(b);
    double sum = 0;
    for (int y = 0; y < of_a.height; y++)
        for (int x = 0; x < of_a.width; x++) sum += plain_error(&of_a, &of_b, x, y, ppd);
    return sum / (of_a.width * of_a.height);
}

/* ---- Ours ---- */

static double our_mean(const struct sample *a, const struct sample *b, struct monge_compare how) {
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_difference d;
    how.metrics = 1 << MONGE_METRIC_FLIP;
    write_sample("a.png", a);
    write_sample("b.png", b);
    struct monge_picture *of_a = read_good("a.png"), *of_b = read_good("b.png");
    assert_true(monge_compare(of_a, of_b, &how, &d, diag));
    monge_picture_free(of_a);
    monge_picture_free(of_b);
    monge_diagnostics_free(diag);
    return d.flip;
}

/* ---- Pictures ---- */

static uint8_t noise(size_t x, size_t y, size_t i) {
    return (uint8_t)(sample_byte(x * 5, y * 3, i) * 37 + sample_byte(y, x, i));
}
static uint8_t shapes(size_t x, size_t y, size_t i) {
    const bool inside = (x - 15) * (x - 15) + (y - 15) * (y - 15) < 90, stripe = (x + 2 * y) % 13 < 3;
    return (uint8_t)(inside ? 200 + 20 * i : stripe ? 40 * i : 90 + x);
}
static uint8_t moved(size_t x, size_t y, size_t i) { return shapes(x + 1, y, i); }
static uint8_t tinted(size_t x, size_t y, size_t i) { return (uint8_t)(shapes(x, y, i) - (i == 2 ? 30 : 0)); }
static uint8_t green(size_t x, size_t y, size_t i) { return (void)x, (void)y, i == 1 ? 255 : 0; }
static uint8_t blue(size_t x, size_t y, size_t i) { return (void)x, (void)y, i == 2 ? 255 : 0; }
static uint8_t dark(size_t x, size_t y, size_t i) { return (uint8_t)((x + y + i) % 7); }
static uint8_t darker(size_t x, size_t y, size_t i) { return (uint8_t)((x + y + i) % 7 / 2); }
static uint8_t one_dot(size_t x, size_t y, size_t i) { return (void)i, x == 20 && y == 10 ? 255 : 0; }
static uint8_t black(size_t x, size_t y, size_t i) { return (void)x, (void)y, (void)i, 0; }

static void flip_is_as_the_paper_has_it(void **state) {
    (void)state;
    static const struct {
        const char *what;
        uint8_t (*a)(size_t, size_t, size_t), (*b)(size_t, size_t, size_t);
        double ppd;
    } rows[] = {
        {"moved", shapes, moved, 67},     {"tinted", shapes, tinted, 67},  {"noise", shapes, noise, 67},
        {"green, blue", green, blue, 67}, {"dark", dark, darker, 67},      {"a dot", one_dot, black, 67},
        {"near", shapes, moved, 15.5},    {"very near", shapes, noise, 1}, {"far", shapes, moved, 150},
    };
    for (size_t i = 0; i < COUNT(rows); i++) {
        const struct sample *a = SAMPLE(41, 30, .byte = rows[i].a), *b = SAMPLE(41, 30, .byte = rows[i].b);
        const double got = our_mean(a, b, (struct monge_compare){.ppd = rows[i].ppd});
        assert_near(got, plain_mean(a, b, rows[i].ppd), 2e-5, rows[i].what);
        assert_true(got > 0.0);
    }
}

/* What the authors' program tells of these pictures, at its 67.0206 pixels per degree. */
static void flip_is_as_the_published_program_has_it(void **state) {
    (void)state;
    static const struct {
        const char *what;
        uint8_t (*a)(size_t, size_t, size_t), (*b)(size_t, size_t, size_t);
        double mean;
    } rows[] = {
        {"moved", shapes, moved, 0.115538},
        {"tinted", shapes, tinted, 0.281659},
        {"noise", shapes, noise, 0.556642},
    };
    for (size_t i = 0; i < COUNT(rows); i++)
        assert_near(our_mean(SAMPLE(60, 60, .byte = rows[i].a), SAMPLE(60, 60, .byte = rows[i].b),
                             (struct monge_compare){0}),
                    rows[i].mean, 1e-4, rows[i].what);
}

/* Larger than a tile, so that there are seams, whose errors would show. */
static void threads_and_tiles_do_not_show(void **state) {
    (void)state;
    const struct sample *a = SAMPLE(530, 300, .byte = shapes), *b = SAMPLE(530, 300, .byte = moved);
    const double one = our_mean(a, b, (struct monge_compare){.threads = 1});
    for (unsigned threads = 2; threads < 6; threads++)
        if (our_mean(a, b, (struct monge_compare){.threads = threads}) != one)
            fail_msg("%u threads", threads);
    static const uint32_t sizes[][2] = {{300, 7}, {7, 300}, {1, 1}, {256, 2}, {3, 257}};
    for (size_t i = 0; i < COUNT(sizes); i++) {
        a = SAMPLE(sizes[i][0], sizes[i][1], .byte = shapes),
        b = SAMPLE(sizes[i][0], sizes[i][1], .byte = tinted);
        assert_near(our_mean(a, b, (struct monge_compare){0}), plain_mean(a, b, 67), 2e-5,
                    "more than a tile");
    }
}

static uint8_t corner(size_t x, size_t y, size_t i) { return (void)i, x == 0 && y == 29 ? 200 : 0; }
static uint8_t corner_and_dot(size_t x, size_t y, size_t i) {
    return (uint8_t)(corner(x, y, i) + one_dot(x, y, i));
}

/* The error about the corner is all there is. */
static void what_is_ignored_does_not_show_in_its_neighbours(void **state) {
    (void)state;
    const struct monge_region dot = {20, 10, 1, 1};
    const struct monge_compare how = {.ignore = &dot, .ignore_count = 1};
    const struct sample *empty = SAMPLE(41, 30, .byte = black);
    const double want = our_mean(SAMPLE(41, 30, .byte = corner), empty, (struct monge_compare){0}) *
                        (41 * 30) / (41 * 30 - 1);
    assert_near(our_mean(SAMPLE(41, 30, .byte = corner_and_dot), empty, how), want, 1e-12, "in a");
    assert_near(our_mean(empty, SAMPLE(41, 30, .byte = corner_and_dot), how), want, 1e-12, "in b");
    assert_true(want > 1e-4);
}

static uint8_t doubled(size_t x, size_t y, size_t i) { return shapes(x, y, i / 2); }
static uint8_t grey(size_t x, size_t y, size_t i) { return (void)i, shapes(x, y, 0); }

static void bits_and_channels_do_not_matter(void **state) {
    (void)state;
    const struct sample *deep = SAMPLE(41, 30, .type = PNG_COLOR_TYPE_RGB, .bits = 16, .byte = doubled);
    const struct sample *b = SAMPLE(41, 30, .byte = moved);
    assert_near(our_mean(deep, b, (struct monge_compare){0}),
                our_mean(SAMPLE(41, 30, .byte = shapes), b, (struct monge_compare){0}), 0.0, "16 bits");
    assert_near(our_mean(SAMPLE(41, 30, .type = PNG_COLOR_TYPE_GRAY, .bits = 8, .byte = grey), b,
                         (struct monge_compare){0}),
                our_mean(SAMPLE(41, 30, .byte = grey), b, (struct monge_compare){0}), 0.0, "grey");
}

/* Numbers that are light already: those of sRGB, made linear and 16 bits wide. */
static uint8_t linear_shapes(size_t x, size_t y, size_t i) {
    const unsigned number = (unsigned)(light(shapes(x, y, i / 2) / 255.0) * 65535 + 0.5);
    return (uint8_t)(i % 2 ? number : number >> 8);
}
static uint8_t linear_moved(size_t x, size_t y, size_t i) { return linear_shapes(x + 1, y, i); }

static void gamma_is_heeded(void **state) {
    (void)state;
    const double linear = our_mean(
        SAMPLE(41, 30, .type = PNG_COLOR_TYPE_RGB, .bits = 16, .gamma = 100000, .byte = linear_shapes),
        SAMPLE(41, 30, .type = PNG_COLOR_TYPE_RGB, .bits = 16, .gamma = 100000, .byte = linear_moved),
        (struct monge_compare){0});
    assert_near(
        linear,
        our_mean(SAMPLE(41, 30, .byte = shapes), SAMPLE(41, 30, .byte = moved), (struct monge_compare){0}),
        1e-4, "linear");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(flip_is_as_the_paper_has_it, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(flip_is_as_the_published_program_has_it, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(threads_and_tiles_do_not_show, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(what_is_ignored_does_not_show_in_its_neighbours, enter_folder,
                                        leave_folder),
        cmocka_unit_test_setup_teardown(bits_and_channels_do_not_matter, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(gamma_is_heeded, enter_folder, leave_folder),
    };
    return cmocka_run_group_tests_name("flip", tests, NULL, NULL);
}
