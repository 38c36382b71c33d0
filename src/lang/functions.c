#include "lang/functions.h"

#include <math.h>

#include "base/elementary.h"
#include "lang/checker.h"

/* ---- Of numbers: they go through vectors part by part. NaN: no value there. ---- */

static double sign_of(double x) { return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : 0.0; }
static double logarithm(double x) { return x > 0.0 ? elementary_log(x) : NAN; }
static double logarithm2(double x) { return x > 0.0 ? elementary_log2(x) : NAN; }
static double logarithm10(double x) { return x > 0.0 ? elementary_log10(x) : NAN; }
static double arcsine(double x) { return fabs(x) <= 1.0 ? elementary_asin_deg(x) : NAN; }
static double arccosine(double x) { return fabs(x) <= 1.0 ? elementary_acos_deg(x) : NAN; }
static double tangent(double x) { return elementary_cos_deg(x) == 0.0 ? NAN : elementary_tan_deg(x); }
static double step_at(double edge, double x) { return x < edge ? 0.0 : 1.0; }
static double least(double a, double b) { return b < a ? b : a; }
static double greatest(double a, double b) { return b > a ? b : a; }

double function_modulo(double a, double b) {
    if (b == 0.0) return NAN;
    double rest = fmod(a, b);
    if (rest != 0.0 && (rest < 0.0) != (b < 0.0)) rest += b;
    return rest == b ? 0.0 : rest + 0.0; /* rounded up to b; and of -0 makes 0 */
}

double function_power(double x, double y) {
    if (x == 0.0 && y < 0.0) return NAN;
    if (x < 0.0 && y != floor(y)) return NAN;
    if (y == 2.0) return x * x;
    if (y == 0.5) return sqrt(x);
    return elementary_pow(x, y);
}

static double clamp(double x, double low, double high) {
    if (low > high) return NAN;
    return x < low ? low : x > high ? high : x;
}

/* Exact at both ends. */
static double mix(double a, double b, double t) { return t == 1.0 ? b : a + (b - a) * t; }

static double smoothstep(double low, double high, double x) {
    if (low == high) return NAN;
    const double t = clamp((x - low) / (high - low), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

static double fold(double (*two)(double, double), const double *v, unsigned count) {
    double result = v[0];
    for (unsigned i = 1; i < count; i++) result = two(result, v[i]);
    return result;
}

/* ---- Of vectors ---- */

static double dot(const struct quantity *a, const struct quantity *b) {
    double sum = 0.0;
    for (unsigned i = 0; i < a->count; i++) sum += a->v[i] * b->v[i];
    return sum;
}

/* Multiplied by a power of two, which is exact, so that squares neither overflow nor vanish; gives the power that
 * undoes it. The null vector stays as it is. */
static int make_plain(struct quantity *a) {
    if (vec3_is_plain(dot(a, a))) return 0;
    double big = 0.0;
    int power;
    for (unsigned i = 0; i < a->count; i++) big = greatest(big, fabs(a->v[i]));
    frexp(big, &power);
    for (unsigned i = 0; i < a->count; i++) a->v[i] = ldexp(a->v[i], -power);
    return power;
}

static double length(const struct quantity *a) {
    struct quantity plain = *a;
    const int power = make_plain(&plain);
    return ldexp(sqrt(dot(&plain, &plain)), power);
}

static enum function_result call_length(const struct quantity *args, unsigned count, struct quantity *out) {
    (void)count;
    *out = (struct quantity){1, {length(args)}};
    return FUNCTION_DONE;
}

static enum function_result call_distance(const struct quantity *args, unsigned count, struct quantity *out) {
    (void)count;
    if (args[0].count != args[1].count) return FUNCTION_DIFFERENT;
    struct quantity way = args[0];
    for (unsigned i = 0; i < way.count; i++) way.v[i] -= args[1].v[i];
    return call_length(&way, 1, out);
}

static enum function_result call_dot(const struct quantity *args, unsigned count, struct quantity *out) {
    (void)count;
    if (args[0].count != args[1].count) return FUNCTION_DIFFERENT;
    *out = (struct quantity){1, {dot(&args[0], &args[1])}};
    return FUNCTION_DONE;
}

static enum function_result call_cross(const struct quantity *args, unsigned count, struct quantity *out) {
    (void)count;
    if (args[0].count != 3 || args[1].count != 3) return FUNCTION_COUNTS;
    const double *a = args[0].v, *b = args[1].v;
    *out = (struct quantity){
        3, {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
    return FUNCTION_DONE;
}

static enum function_result call_normalize(const struct quantity *args, unsigned count,
                                           struct quantity *out) {
    (void)count;
    if (args->count < 2) return FUNCTION_COUNTS;
    struct quantity way = *args;
    make_plain(&way);
    const double far = sqrt(dot(&way, &way));
    if (far == 0.0) return FUNCTION_OUTSIDE;
    for (unsigned i = 0; i < way.count; i++) way.v[i] /= far;
    *out = way;
    return FUNCTION_DONE;
}

static enum function_result call_random(const struct quantity *args, unsigned count, struct quantity *out) {
    uint64_t bits = 0;
    for (unsigned i = 0; i < count; i++) bits = random_bits_of(bits, args[i].v, args[i].count);
    *out = (struct quantity){1, {(double)(bits >> 11) * 0x1p-53}};
    return FUNCTION_DONE;
}

static enum function_result call_noise(const struct quantity *args, unsigned count, struct quantity *out) {
    double at[3];
    for (unsigned i = 0; i < count; i++) {
        if (count > 1 && args[i].count != 1) return FUNCTION_COUNTS;
        at[i] = args[i].v[0];
    }
    if (args->count > 3) return FUNCTION_COUNTS;
    *out = (struct quantity){1, {count == 1 ? noise_at(args->v, args->count) : noise_at(at, count)}};
    return FUNCTION_DONE;
}

static enum function_result call_rgb(const struct quantity *args, unsigned count, struct quantity *out) {
    struct quantity color = {count, {0}};
    for (unsigned i = 0; i < count; i++) {
        if (args[i].count != 1) return FUNCTION_COUNTS;
        if (!(args[i].v[0] >= 0.0 && args[i].v[0] <= 255.0)) return FUNCTION_OUTSIDE;
        color.v[i] = linear_from_srgb(args[i].v[0] / 255.0);
    }
    *out = color;
    return FUNCTION_DONE;
}

/* A. R. Smith, "Color gamut transform pairs", 1978; here part k is v - v s clamp(min(p, 4 - p), 0, 1) of
 * p = k + h / 60 mod 6, for k = 5, 3, 1. */
static enum function_result call_hsv(const struct quantity *args, unsigned count, struct quantity *out) {
    for (unsigned i = 0; i < count; i++)
        if (args[i].count != 1) return FUNCTION_COUNTS;
    const double h = function_modulo(args[0].v[0], 360.0) / 60.0, s = args[1].v[0], v = args[2].v[0];
    if (!(s >= 0.0 && s <= 1.0 && v >= 0.0 && v <= 1.0)) return FUNCTION_OUTSIDE;
    struct quantity color = {3, {0}};
    for (unsigned i = 0; i < 3; i++) {
        const double p = fmod(5.0 - 2.0 * i + h, 6.0);
        color.v[i] = linear_from_srgb(v - v * s * clamp(least(p, 4.0 - p), 0.0, 1.0));
    }
    *out = color;
    return FUNCTION_DONE;
}

/* ---- All of them ---- */

static const struct implementation {
    double (*one)(double);
    double (*two)(double, double);
    double (*three)(double, double, double);
    double (*folded)(double, double); /* over all arguments */
    enum function_result (*whole)(const struct quantity *args, unsigned count, struct quantity *out);
} implementations[FUNCTIONS] = {
    [FUNCTION_ABS] = {.one = fabs},
    [FUNCTION_SIGN] = {.one = sign_of},
    [FUNCTION_FLOOR] = {.one = floor},
    [FUNCTION_CEIL] = {.one = ceil},
    [FUNCTION_ROUND] = {.one = round},
    [FUNCTION_TRUNC] = {.one = trunc},
    [FUNCTION_MIN] = {.folded = least},
    [FUNCTION_MAX] = {.folded = greatest},
    [FUNCTION_CLAMP] = {.three = clamp},
    [FUNCTION_MIX] = {.three = mix},
    [FUNCTION_STEP] = {.two = step_at},
    [FUNCTION_SMOOTHSTEP] = {.three = smoothstep},
    [FUNCTION_MOD] = {.two = function_modulo},
    [FUNCTION_SQRT] = {.one = sqrt},
    [FUNCTION_POW] = {.two = function_power},
    [FUNCTION_EXP] = {.one = elementary_exp},
    [FUNCTION_LOG] = {.one = logarithm},
    [FUNCTION_LOG2] = {.one = logarithm2},
    [FUNCTION_LOG10] = {.one = logarithm10},
    [FUNCTION_SIN] = {.one = elementary_sin_deg},
    [FUNCTION_COS] = {.one = elementary_cos_deg},
    [FUNCTION_TAN] = {.one = tangent},
    [FUNCTION_ASIN] = {.one = arcsine},
    [FUNCTION_ACOS] = {.one = arccosine},
    [FUNCTION_ATAN] = {.one = elementary_atan_deg},
    [FUNCTION_ATAN2] = {.two = elementary_atan2_deg},
    [FUNCTION_LENGTH] = {.whole = call_length},
    [FUNCTION_DISTANCE] = {.whole = call_distance},
    [FUNCTION_DOT] = {.whole = call_dot},
    [FUNCTION_CROSS] = {.whole = call_cross},
    [FUNCTION_NORMALIZE] = {.whole = call_normalize},
    [FUNCTION_RANDOM] = {.whole = call_random},
    [FUNCTION_NOISE] = {.whole = call_noise},
    [FUNCTION_RGB] = {.whole = call_rgb},
    [FUNCTION_HSV] = {.whole = call_hsv},
};

static double call_part(const struct implementation *f, const double *v, unsigned count) {
    if (f->one) return f->one(v[0]);
    if (f->two) return f->two(v[0], v[1]);
    if (f->three) return f->three(v[0], v[1], v[2]);
    return fold(f->folded, v, count);
}

enum function_result function_call(int function, const struct quantity *args, unsigned count,
                                   struct quantity *out) {
    const struct implementation *f = &implementations[function];
    if (f->whole) return f->whole(args, count, out);
    struct quantity result = {.count = args[0].count};
    for (unsigned i = 1; i < count; i++) {
        result.count = quantity_join(&result, &args[i]);
        if (result.count == 0) return FUNCTION_DIFFERENT;
    }
    for (unsigned i = 0; i < result.count; i++) {
        double v[FUNCTION_ARGUMENTS];
        for (unsigned j = 0; j < count; j++) v[j] = quantity_part(&args[j], i);
        result.v[i] = call_part(f, v, count);
        if (isnan(result.v[i])) return FUNCTION_OUTSIDE;
    }
    *out = result;
    return FUNCTION_DONE;
}
