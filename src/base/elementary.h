/* The transcendental functions that reach a pixel, with the same bits on every machine: SLEEF's
 * deterministic cinz_ functions (error at most 1 ulp). libm's differ between versions and machines,
 * so nothing under src/ calls them; sqrt, floor, fabs and fmod are exact and may be used freely. */
#ifndef MONGE_BASE_ELEMENTARY_H
#define MONGE_BASE_ELEMENTARY_H

double elementary_pow(double base, double exponent);

/* Of an angle in degrees, any finite one; exact at the multiples of 90 (and sine at 30, cosine at 60).
 * Elsewhere the quotient angle / 180 adds half an ulp: sine and cosine are within 1.5, the tangent within 3.5. */
double elementary_sin_deg(double angle_deg);
double elementary_cos_deg(double angle_deg);
double elementary_tan_deg(double angle_deg);

/* The angle -90 .. 90 degrees of a tangent, within 3 ulp. */
double elementary_atan_deg(double tangent);

#endif
