#include "base/elementary.h"

#include <math.h>
#include <sleef.h>

double elementary_pow(double base, double exponent) { return Sleef_cinz_powd1_u10purec(base, exponent); }

/* sin of quarter * 90 + rest degrees, |rest| <= 45. fmod and the subtractions are exact. */
static double sin_of_quarters(double angle_deg, int quarters_on) {
    const double turn = fmod(angle_deg, 360.0); /* -360 .. 360 */
    const double quarter = floor(turn / 90.0 + 0.5);
    const double rest = turn - 90.0 * quarter;
    const int which = ((int)quarter + quarters_on) & 3;
    const double half = which & 1 ? Sleef_cinz_cospid1_u05purec(rest / 180.0) : Sleef_cinz_sinpid1_u05purec(rest / 180.0);
    const double exact = !(which & 1) && fabs(rest) == 30.0 ? copysign(0.5, rest) : half;
    return which & 2 ? -exact : exact;
}

double elementary_sin_deg(double angle_deg) { return sin_of_quarters(angle_deg, 0); }
double elementary_cos_deg(double angle_deg) { return sin_of_quarters(angle_deg, 1); }

double elementary_tan_deg(double angle_deg) {
    return elementary_sin_deg(angle_deg) / elementary_cos_deg(angle_deg);
}

double elementary_atan_deg(double tangent) {
    const double degrees = 57.295779513082320877; /* 180 / pi */
    return Sleef_cinz_atand1_u10purec(tangent) * degrees;
}
