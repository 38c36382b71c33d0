#include "base/elementary.h"

#include <math.h>
#include <sleef.h>
#include <string.h>

static const double degrees_per_radian = 57.29577951308232; /* 180 / pi */

double elementary_pow(double base, double exponent) { return Sleef_cinz_powd1_u10purec(base, exponent); }

#ifdef __x86_64__
/* Of the deterministic functions those for four or eight numbers give the bits of those for one.
 * sleef.h has this one only for those who compile for AVX altogether. */
__attribute__((target("avx"))) __m256 Sleef_cinz_powf8_u10avx(__m256, __m256);

/* How many are done: all but the last few. */
__attribute__((target("avx"))) static size_t powers_by_8(size_t count, const float *base,
                                                         const float *exponent, float *out) {
    size_t i = 0;
    for (; i + 8 <= count; i += 8)
        _mm256_storeu_ps(out + i,
                         Sleef_cinz_powf8_u10avx(_mm256_loadu_ps(base + i), _mm256_loadu_ps(exponent + i)));
    return i;
}

static size_t powers_by_4(size_t count, const float *base, const float *exponent, float *out) {
    size_t i = 0;
    for (; i + 4 <= count; i += 4)
        _mm_storeu_ps(out + i, Sleef_cinz_powf4_u10sse2(_mm_loadu_ps(base + i), _mm_loadu_ps(exponent + i)));
    return i;
}

void elementary_powf(size_t count, const float *base, const float *exponent, float *out) {
    size_t (*const powers)(size_t, const float *, const float *, float *) =
        __builtin_cpu_supports("avx") ? powers_by_8 : powers_by_4;
    const size_t done = powers(count, base, exponent, out);
    const size_t bytes = (count - done) * sizeof *out;
    float last[2][8] = {0};
    if (done == count) return;
    memcpy(last[0], base + done, bytes);
    memcpy(last[1], exponent + done, bytes);
    powers_by_4(8, last[0], last[1], last[0]);
    memcpy(out + done, last[0], bytes);
}
#else
void elementary_powf(size_t count, const float *base, const float *exponent, float *out) {
    for (size_t i = 0; i < count; i++) out[i] = Sleef_cinz_powf1_u10purec(base[i], exponent[i]);
}
#endif

double elementary_exp(double x) { return Sleef_cinz_expd1_u10purec(x); }
double elementary_log(double x) { return Sleef_cinz_logd1_u10purec(x); }
double elementary_log2(double x) { return Sleef_cinz_log2d1_u10purec(x); }
double elementary_log10(double x) { return Sleef_cinz_log10d1_u10purec(x); }

/* sin of quarter * 90 + rest degrees, |rest| <= 45. fmod and the subtractions are exact. */
static double sin_of_quarters(double angle_deg, int quarters_on) {
    const double turn = fmod(angle_deg, 360.0); /* -360 .. 360 */
    const double quarter = floor(turn / 90.0 + 0.5);
    const double rest = turn - 90.0 * quarter;
    const int which = ((int)quarter + quarters_on) & 3;
    const double sine =
        which & 1 ? Sleef_cinz_cospid1_u05purec(rest / 180.0) : Sleef_cinz_sinpid1_u05purec(rest / 180.0);
    return which & 2 ? -sine : sine;
}

double elementary_sin_deg(double angle_deg) { return sin_of_quarters(angle_deg, 0); }
double elementary_cos_deg(double angle_deg) { return sin_of_quarters(angle_deg, 1); }

double elementary_tan_deg(double angle_deg) {
    return elementary_sin_deg(angle_deg) / elementary_cos_deg(angle_deg);
}

double elementary_asin_deg(double sine) {
    if (fabs(sine) == 0.5) return copysign(30.0, sine);
    return Sleef_cinz_asind1_u10purec(sine) * degrees_per_radian;
}

double elementary_acos_deg(double cosine) {
    if (fabs(cosine) == 0.5) return cosine > 0.0 ? 60.0 : 120.0;
    return Sleef_cinz_acosd1_u10purec(cosine) * degrees_per_radian;
}

double elementary_atan_deg(double tangent) { return elementary_atan2_deg(tangent, 1.0); }

double elementary_atan2_deg(double y, double x) {
    if (y == 0.0 && x == 0.0) return 0.0;
    return Sleef_cinz_atan2d1_u10purec(y + 0.0, x) * degrees_per_radian; /* + 0.0: of -0 makes 0 */
}
