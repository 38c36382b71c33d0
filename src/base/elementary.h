/* The transcendental functions that reach a pixel, with the same bits on every machine: SLEEF's
 * deterministic cinz_ functions (error at most 1 ulp). libm's differ between versions and machines,
 * so nothing under src/ calls them; sqrt, floor, fabs and fmod are exact and may be used freely. */
#ifndef MONGE_BASE_ELEMENTARY_H
#define MONGE_BASE_ELEMENTARY_H

#include <stddef.h>

double elementary_pow(double base, double exponent);
/* out[i] = base[i] ^ exponent[i] in single precision, for many at once; base >= 0. out may be either of them. */
void elementary_powf(size_t count, const float *base, const float *exponent, float *out);

double elementary_exp(double x);
double elementary_log(double x); /* to base e */
double elementary_log2(double x);
double elementary_log10(double x);

/* Of an angle in degrees, any finite one; exact at the multiples of 90 (sine also at 30, cosine at 60, the
 * tangent at 45). Elsewhere the quotient angle / 180 adds half an ulp: sine and cosine are within 1.5, the
 * tangent within 3.5. The tangent of 90 is infinite. */
double elementary_sin_deg(double angle_deg);
double elementary_cos_deg(double angle_deg);
double elementary_tan_deg(double angle_deg);

/* Angles in degrees, within 2.5 ulp; exact at the multiples of 45, and where the sine or cosine is a half. */
double elementary_asin_deg(double sine);
double elementary_acos_deg(double cosine);
double elementary_atan_deg(double tangent);
double elementary_atan2_deg(double y,
                            double x); /* over -180 up to 180; -0 counts as 0; 0 for a null vector */

#endif
