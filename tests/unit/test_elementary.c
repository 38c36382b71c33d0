/* Against long double functions, and exact where the exact answer is a double. */
#include <string.h>

#include "base/elementary.h"
#include "near.h"

/* The distance in units of the last place of the double that is nearest to the truth. */
static double error_ulp(double got, long double want) {
    const double nearest = (double)want, ulp = nextafter(fabs(nearest), INFINITY) - fabs(nearest);
    return (double)(fabsl((long double)got - want) / ulp);
}

static void assert_ulp(double got, long double want, double most, const char *what, double x) {
    if (!(error_ulp(got, want) <= most)) fail_msg("%s(%.17g): got %.17g, want %.17Lg", what, x, got, want);
}

/* Reduced exactly before pi comes in. */
static long double sin_deg_long(double x) {
    const long double pi = 3.14159265358979323846264338327950288L;
    const long double turn = fmodl(x, 360.0L), quarter = floorl(turn / 90.0L + 0.5L),
                      rest = (turn - 90.0L * quarter) * pi / 180.0L;
    switch ((int)quarter & 3) {
    case 0: return sinl(rest);
    case 1: return cosl(rest);
    case 2: return -sinl(rest);
    default: return -cosl(rest);
    }
}

static long double cos_deg_long(double x) {
    const long double pi = 3.14159265358979323846264338327950288L;
    const long double turn = fmodl(x, 360.0L), quarter = floorl(turn / 90.0L + 0.5L),
                      rest = (turn - 90.0L * quarter) * pi / 180.0L;
    switch ((int)quarter & 3) {
    case 0: return cosl(rest);
    case 1: return -sinl(rest);
    case 2: return -cosl(rest);
    default: return sinl(rest);
    }
}

static double random_angle(struct random *r) {
    static const double ranges[] = {45, 90, 360, 1e4, 1e-3, 1e-12, 1e15};
    return random_between(r, -1, 1) * ranges[random_below(r, COUNT(ranges))];
}

enum { RANDOM_ANGLES = 300000 };

static void sine_and_cosine(void **state) {
    (void)state;
    struct random r = random_begin();
    for (int i = 0; i < RANDOM_ANGLES; i++) {
        const double x = random_angle(&r);
        assert_ulp(elementary_sin_deg(x), sin_deg_long(x), 1.5, "sin", x);
        assert_ulp(elementary_cos_deg(x), cos_deg_long(x), 1.5, "cos", x);
    }
}

static void tangent(void **state) {
    (void)state;
    struct random r = random_begin();
    for (int i = 0; i < RANDOM_ANGLES; i++) {
        const double x = random_angle(&r);
        if (elementary_cos_deg(x) == 0) continue;
        assert_ulp(elementary_tan_deg(x), sin_deg_long(x) / cos_deg_long(x), 3.5, "tan", x);
    }
}

static void power(void **state) {
    (void)state;
    struct random r = random_begin();
    for (int i = 0; i < RANDOM_ANGLES; i++) {
        const double x = random_between(&r, 0, i & 1 ? 1 : 100), y = random_between(&r, 0, i & 2 ? 3 : 200);
        const long double want = powl(x, y);
        if (want > 1e-300L && want < 1e300L) assert_ulp(elementary_pow(x, y), want, 1, "pow", x);
    }
}

static void exponentials_and_logarithms(void **state) {
    (void)state;
    struct random r = random_begin();
    for (int i = 0; i < RANDOM_ANGLES; i++) {
        const double y = random_between(&r, -700, 700), x = random_between(&r, 0, i & 1 ? 2 : 1e6);
        assert_ulp(elementary_exp(y), expl(y), 1, "exp", y);
        assert_ulp(elementary_log(x), logl(x), 1, "log", x);
        assert_ulp(elementary_log2(x), log2l(x), 1, "log2", x);
        assert_ulp(elementary_log10(x), log10l(x), 1, "log10", x);
    }
}

static void whole_powers_and_their_logarithms_are_exact(void **state) {
    (void)state;
    for (int base = 2; base < 1000; base++) {
        double want = 1;
        for (int exponent = 0; want <= 0x1p53; exponent++, want *= base)
            assert_true(elementary_pow(base, exponent) == want);
    }
    for (int i = -1000; i <= 1000; i++) assert_true(elementary_log2(ldexp(1, i)) == i);
    double ten = 1;
    for (int i = 0; i <= 22; i++, ten *= 10) assert_true(elementary_log10(ten) == i);
}

static void inverses(void **state) {
    (void)state;
    const long double degrees = 180 / 3.14159265358979323846264338327950288L;
    struct random r = random_begin();
    for (int i = 0; i < RANDOM_ANGLES; i++) {
        const double x = random_between(&r, -1, 1), y = random_between(&r, -1, 1), scale = i & 1 ? 1 : 1e-6;
        assert_ulp(elementary_asin_deg(x * scale), asinl(x * scale) * degrees, 2.5, "asin", x);
        assert_ulp(elementary_acos_deg(x), acosl(x) * degrees, 2.5, "acos", x);
        assert_ulp(elementary_atan_deg(x / scale), atanl(x / scale) * degrees, 2.5, "atan", x);
        assert_ulp(elementary_atan2_deg(y, x * scale), atan2l(y, x * scale) * degrees, 2.5, "atan2", x);
    }
}

static void angles_of_whole_degrees(void **state) {
    (void)state;
    static const double sines[][2] = {{-1, -90}, {-0.5, -30}, {0, 0}, {0.5, 30}, {1, 90}};
    for (size_t i = 0; i < COUNT(sines); i++) {
        assert_true(elementary_asin_deg(sines[i][0]) == sines[i][1]);
        assert_true(elementary_acos_deg(sines[i][0]) == 90 - sines[i][1]);
    }
    for (int i = -3; i <= 4; i++) {
        static const int at[] = {0, 1,  1,  1,
                                 0, -1, -1, -1}; /* the sine of i eighths of a turn, but for its length */
        static const double sizes[] = {1e-300, 0.1, 7, 1e300};
        for (size_t k = 0; k < COUNT(sizes); k++)
            assert_true(elementary_atan2_deg(at[i & 7] * sizes[k], at[(i + 2) & 7] * sizes[k]) == 45 * i);
    }
    assert_true(elementary_atan2_deg(-0.0, -1) == 180 && elementary_atan2_deg(-0.0, 0) == 0 &&
                elementary_atan2_deg(0, -0.0) == 0);
    assert_true(elementary_atan_deg(1) == 45 && elementary_atan_deg(-1) == -45);
}

static struct exact {
    const char *name;
    double angle_deg, sine, cosine;
} exacts[] = {
    {"0", 0, 0, 1},          {"90", 90, 1, 0},
    {"180", 180, 0, -1},     {"270", 270, -1, 0},
    {"360", 360, 0, 1},      {"-90", -90, -1, 0},
    {"-180", -180, 0, -1},   {"450", 450, 1, 0},
    {"-270", -270, 1, 0},    {"1e15 turns of 360", 360e15, 0, 1},
    {"30", 30, 0.5, NAN},    {"150", 150, 0.5, NAN},
    {"210", 210, -0.5, NAN}, {"330", 330, -0.5, NAN},
    {"-30", -30, -0.5, NAN}, {"390", 390, 0.5, NAN},
    {"60", 60, NAN, 0.5},    {"120", 120, NAN, -0.5},
    {"240", 240, NAN, -0.5}, {"300", 300, NAN, 0.5},
    {"-60", -60, NAN, 0.5},  {"420", 420, NAN, 0.5},
};

static void check_exact(void **state) {
    const struct exact *row = *state;
    if (!isnan(row->sine)) assert_true(elementary_sin_deg(row->angle_deg) == row->sine);
    if (!isnan(row->cosine)) assert_true(elementary_cos_deg(row->angle_deg) == row->cosine);
}

static void symmetries_hold_exactly(void **state) {
    (void)state;
    struct random r = random_begin();
    for (int i = 0; i < 10000; i++) {
        const double x = random_between(&r, 0, 90);
        assert_true(elementary_sin_deg(-x) == -elementary_sin_deg(x));
        assert_true(elementary_cos_deg(-x) == elementary_cos_deg(x));
        assert_true(elementary_sin_deg(x + 360) == elementary_sin_deg((x + 360) - 360));
    }
}

static void tangents_of_45(void **state) {
    (void)state;
    for (int i = -7; i <= 7; i += 2) assert_true(elementary_tan_deg(45 * i) == ((i & 3) == 1 ? 1 : -1));
    assert_true(elementary_tan_deg(0) == 0);
    assert_true(elementary_tan_deg(180) == 0);
}

static void powers_at_the_ends(void **state) {
    (void)state;
    assert_true(elementary_pow(0, 0) == 1);
    assert_true(elementary_pow(0, 2) == 0);
    assert_true(elementary_pow(1, 1e6) == 1);
    assert_true(elementary_pow(0.5, 1e6) == 0);
    assert_true(elementary_pow(2, 10) == 1024);
}

static void arctangent(void **state) {
    (void)state;
    const long double pi = 3.14159265358979323846264338327950288L;
    struct random r = random_begin();
    for (int i = 0; i < RANDOM_ANGLES; i++) {
        const double x = random_between(&r, -1, 1) * pow(10, random_between(&r, -8, 8));
        assert_ulp(elementary_atan_deg(x), atanl(x) * 180.0L / pi, 3.0, "atan", x);
    }
    assert_true(elementary_atan_deg(0) == 0);
}

/* In single precision, near enough; and the same bits whether many are asked for at once or one. */
static void powers_of_many(void **state) {
    (void)state;
    enum { COUNTED = 1003 };
    static float base[COUNTED], exponent[COUNTED], many[COUNTED];
    struct random r = random_begin();
    for (int i = 0; i < COUNTED; i++) {
        base[i] = i == 5 ? 0.0f : (float)random_between(&r, 0.0, i % 2 ? 1.0 : 100.0);
        exponent[i] = (float)random_between(&r, 0.0, 1.0);
    }
    elementary_powf(COUNTED, base, exponent, many);
    for (int i = 0; i < COUNTED; i++) {
        float one;
        elementary_powf(1, base + i, exponent + i, &one);
        if (memcmp(&one, &many[i], sizeof one) != 0)
            fail_msg("%a ^ %a: %a or %a", base[i], exponent[i], one, many[i]);
        const double want = elementary_pow((double)base[i], (double)exponent[i]);
        assert_near((double)one, want, 1.2e-7 * want, "power");
    }
    for (size_t count = 0; count < 40;
         count++) { /* however many are left over by those for several; beyond, nothing */
        float few[41];
        for (int i = 0; i < 41; i++) few[i] = -7;
        elementary_powf(count, base, exponent, few);
        assert_memory_equal(few, many, count * sizeof *few);
        for (size_t i = count; i < 41; i++) assert_true(few[i] == -7);
    }
}

int main(void) {
    struct CMUnitTest tests[COUNT(exacts)];
    for (size_t i = 0; i < COUNT(exacts); i++)
        tests[i] = (struct CMUnitTest){exacts[i].name, check_exact, NULL, NULL, &exacts[i]};
    const struct CMUnitTest others[] = {
        cmocka_unit_test(sine_and_cosine),
        cmocka_unit_test(tangent),
        cmocka_unit_test(arctangent),
        cmocka_unit_test(power),
        cmocka_unit_test(symmetries_hold_exactly),
        cmocka_unit_test(tangents_of_45),
        cmocka_unit_test(powers_at_the_ends),
        cmocka_unit_test(exponentials_and_logarithms),
        cmocka_unit_test(whole_powers_and_their_logarithms_are_exact),
        cmocka_unit_test(inverses),
        cmocka_unit_test(angles_of_whole_degrees),
        cmocka_unit_test(powers_of_many),
    };
    return cmocka_run_group_tests_name("exact", tests, NULL, NULL) +
           cmocka_run_group_tests_name("elementary", others, NULL, NULL);
}
