#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

#include "image/encode.h"

static float float_from_bits(uint32_t bits) {
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* encoder_bytes of one value, as a number. */
static uint16_t quick_code(const struct encoder *encoder, float linear) {
    uint8_t bytes[2] = {0, 0};
    encoder_bytes(encoder, &linear, 1, bytes);
    return (uint16_t)(encoder->bits == 8 ? bytes[0] : bytes[0] << 8 | bytes[1]);
}

/* ---- Single values, by encode_channel and by an encoder ---- */

#define SRGB   MONGE_ENCODING_SRGB
#define LINEAR MONGE_ENCODING_LINEAR

static struct row {
    const char *name;
    float linear;
    enum monge_encoding encoding;
    unsigned bits;
    uint16_t want;
} rows[] = {
    {"nothing", 0.0f, SRGB, 8, 0},
    {"minus zero", -0.0f, SRGB, 16, 0},
    {"less than nothing", -0.25f, SRGB, 8, 0},
    {"less than nothing, linear", -0.25f, LINEAR, 16, 0},
    {"not a number", NAN, SRGB, 8, 0},
    {"not a number, linear", NAN, LINEAR, 8, 0},
    {"minus infinity", -INFINITY, SRGB, 8, 0},
    {"infinity", INFINITY, SRGB, 16, 65535},
    {"infinity, linear", INFINITY, LINEAR, 8, 255},
    {"the smallest number", 1e-45f, SRGB, 16, 0},
    {"one", 1.0f, SRGB, 8, 255},
    {"one, 16 bits", 1.0f, SRGB, 16, 65535},
    {"one, linear", 1.0f, LINEAR, 16, 65535},
    {"just under one", 0x1.fffffep-1f, SRGB, 16, 65535},
    {"over one", 7.0f, SRGB, 8, 255},
    {"half", 0.5f, SRGB, 8, 188},
    {"half, linear: a tie goes up", 0.5f, LINEAR, 8, 128},
    {"half, linear, 16 bits", 0.5f, LINEAR, 16, 32768},
    {"middle grey", 0.18f, SRGB, 8, 118},
    {"middle grey, 16 bits", 0.18f, SRGB, 16, 30235},
    {"on the line", 0.002f, SRGB, 8, 7},
    {"on the line, 16 bits", 0.002f, SRGB, 16, 1693},
    {"at the knee", 0.0031308f, SRGB, 16, 2651},
    {"a tenth, linear", 0.1f, LINEAR, 8, 26},
};

static void check_row(void **state) {
    const struct row *row = *state;
    struct encoder encoder;
    encoder_init(&encoder, row->encoding, row->bits);
    assert_int_equal(encode_channel(row->linear, row->encoding, row->bits), row->want);
    assert_int_equal(quick_code(&encoder, row->linear), row->want);
}

/* ---- Each step from one number to the next ---- */

/* The smallest float that becomes `code` or more. */
static uint32_t threshold_bits(uint16_t code, enum monge_encoding encoding, unsigned bits) {
    uint32_t low = 0, high = 0x3f800000; /* 0 and 1: encode_channel(low) < code <= encode_channel(high) */
    while (high - low > 1) {
        const uint32_t middle = low + (high - low) / 2;
        if (encode_channel(float_from_bits(middle), encoding, bits) < code)
            low = middle;
        else
            high = middle;
    }
    return high;
}

/* IEC 61966-2-1 from the file's side, in another precision and by another pow. */
static long double srgb_decode(long double encoded) {
    return encoded <= 0.04045L ? encoded / 12.92L : powl((encoded + 0.055L) / 1.055L, 2.4L);
}

static struct format {
    const char *name;
    enum monge_encoding encoding;
    unsigned bits;
} formats[] = {
    {"sRGB, 8 bits", SRGB, 8},
    {"sRGB, 16 bits", SRGB, 16},
    {"linear, 8 bits", LINEAR, 8},
    {"linear, 16 bits", LINEAR, 16},
};

static void check_steps(void **state) {
    const struct format *format = *state;
    const unsigned max = (1u << format->bits) - 1;
    struct encoder encoder;
    encoder_init(&encoder, format->encoding, format->bits);
    for (unsigned code = 1; code <= max; code++) {
        const uint32_t at = threshold_bits((uint16_t)code, format->encoding, format->bits);
        const uint16_t below = encode_channel(float_from_bits(at - 1), format->encoding, format->bits);
        assert_int_equal(below, code - 1); /* no number is left out */
        for (uint32_t bits = at - 2; bits <= at + 1; bits++)
            assert_int_equal(quick_code(&encoder, float_from_bits(bits)),
                             encode_channel(float_from_bits(bits), format->encoding, format->bits));

        const long double encoded = ((long double)code - 0.5L) / max;
        const long double want = format->encoding == SRGB ? srgb_decode(encoded) : encoded;
        if (fabsl(encoded - 0.04045L) < 1e-6L)
            continue; /* the standard's two pieces miss each other by 1e-8 */
        assert_true(fabsl((long double)float_from_bits(at) - want) <= 1.2e-7L * want);
    }
}

static void check_random(void **state) {
    const struct format *format = *state;
    uint64_t seed = (uint64_t)time(NULL);
    print_message("seed %llu\n", (unsigned long long)seed);
    struct encoder encoder;
    encoder_init(&encoder, format->encoding, format->bits);
    for (int i = 0; i < 300000; i++) {
        seed = seed * 6364136223846793005u + 1442695040888963407u;
        const uint32_t any = (uint32_t)(seed >> 32);
        const float linear = i & 1 ? float_from_bits(any) : (float)any * 0x1p-32f;
        assert_int_equal(quick_code(&encoder, linear),
                         encode_channel(linear, format->encoding, format->bits));
    }
}

/* ---- What makes it quick ---- */

static void the_knots_are_on_the_curve(void **state) {
    (void)state;
    struct {
        struct encoder encoder;
        double beyond;
    } all = {.beyond = 7};
    encoder_init(&all.encoder, SRGB, 8);
    for (int i = 0; i < ENCODER_KNOTS; i++) {
        const long double linear = ldexpl(1 + (i % 512) / 512.0L, i / 512 - 9);
        const long double want = 1.055L * powl(linear, 1 / 2.4L) - 0.055L;
        assert_true(fabsl((long double)all.encoder.knot[i] - want) < 1e-15L);
    }
    assert_true(all.beyond == 7);
}

/* An encoder that takes the curve for flat, behind the last knot as well. */
struct flat_curve {
    struct encoder encoder;
    double beyond;
};

static void flatten(struct flat_curve *flat, unsigned bits, double value) {
    encoder_init(&flat->encoder, SRGB, bits);
    for (int i = 0; i < ENCODER_KNOTS; i++) flat->encoder.knot[i] = value;
    flat->beyond = value;
}

/* So what is false is believed, but where the true curve, at most 1.23e-7 above its chord, could be on the other side of
 * a step. */
static void the_knots_decide_but_next_to_a_step(void **state) {
    (void)state;
    static struct flat_curve inside, next;
    for (unsigned bits = 8; bits <= 16; bits += 8)
        for (int code = 40; code < 200; code += 53)
            for (int side = -1; side <= 1; side += 2) {
                const double step = (code + 0.5 * side) / ((1u << bits) - 1);
                flatten(&inside, bits, step - side * 1.6e-7);
                flatten(&next, bits, step - side * 1.23e-7);
                for (int i = 2; i < 512; i++) {
                    const float linear = (float)i / 512;
                    assert_int_equal(quick_code(&inside.encoder, linear), code);
                    assert_int_equal(quick_code(&next.encoder, linear), encode_channel(linear, SRGB, bits));
                }
            }
}

static void the_knots_are_not_asked_below_the_knee_nor_from_one(void **state) {
    (void)state;
    static struct flat_curve flat;
    flatten(&flat, 16, 77 / 65535.0);
    assert_int_equal(quick_code(&flat.encoder, 0.0031307f), 2651);
    assert_int_equal(quick_code(&flat.encoder, 0.0031309f), 77);
    assert_int_equal(quick_code(&flat.encoder, 0x1.fffffep-1f), 77);
    assert_int_equal(quick_code(&flat.encoder, 1.0f), 65535);
}

/* ---- Rows of bytes ---- */

static void sixteen_bits_have_the_high_byte_first(void **state) {
    (void)state;
    struct encoder encoder;
    encoder_init(&encoder, LINEAR, 16);
    const float linear[3] = {0.0f, 0x1.02p-8f, 1.0f}; /* 0x1.02p-8 * 65535 = 257.99 */
    uint8_t bytes[7] = {9, 9, 9, 9, 9, 9, 9};
    encoder_bytes(&encoder, linear, 3, bytes);
    assert_memory_equal(bytes, ((uint8_t[]){0, 0, 1, 2, 255, 255, 9}), 7);
}

static void eight_bits_have_one_byte_each(void **state) {
    (void)state;
    struct encoder encoder;
    encoder_init(&encoder, SRGB, 8);
    const float linear[3] = {0.5f, 0.0f, 1.0f};
    uint8_t bytes[4] = {9, 9, 9, 9};
    encoder_bytes(&encoder, linear, 3, bytes);
    assert_memory_equal(bytes, ((uint8_t[]){188, 0, 255, 9}), 4);
}

enum { ROWS = sizeof rows / sizeof *rows, FORMATS = sizeof formats / sizeof *formats };

int main(void) {
    struct CMUnitTest tests[ROWS + 2 * FORMATS + 5];
    size_t n = 0;
    for (size_t i = 0; i < ROWS; i++)
        tests[n++] = (struct CMUnitTest){rows[i].name, check_row, NULL, NULL, &rows[i]};
    char names[2 * FORMATS][64];
    for (size_t i = 0; i < FORMATS; i++) {
        snprintf(names[2 * i], sizeof *names, "every step: %s", formats[i].name);
        tests[n++] = (struct CMUnitTest){names[2 * i], check_steps, NULL, NULL, &formats[i]};
        snprintf(names[2 * i + 1], sizeof *names, "random values: %s", formats[i].name);
        tests[n++] = (struct CMUnitTest){names[2 * i + 1], check_random, NULL, NULL, &formats[i]};
    }
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(the_knots_are_on_the_curve);
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(the_knots_decide_but_next_to_a_step);
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(the_knots_are_not_asked_below_the_knee_nor_from_one);
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(sixteen_bits_have_the_high_byte_first);
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(eight_bits_have_one_byte_each);
    return cmocka_run_group_tests_name("encode", tests, NULL, NULL);
}
