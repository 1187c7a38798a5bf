#include <math.h>

#include "num_kernels.h"

static const double PI = 3.14159265358979323846;

/* P(|T| <= t) for nu degrees of freedom: a finite sum for whole nu
 * [Abramowitz, Stegun 1964, 26.7.3 and 26.7.4].  Every term is positive, so
 * nothing cancels. */
static double two_sided(double t, size_t nu)
{
    double theta = atan(t / sqrt((double)nu)), s = sin(theta), c = cos(theta);
    double term = nu % 2 ? c : 1.0, sum = nu == 1 ? 0.0 : term;

    for (size_t m = nu % 2 ? 3 : 2; m + 2 <= nu; m += 2) {
        term *= c * c * (double)(m - 1) / (double)m;
        sum += term;
    }
    if (nu % 2) return 2.0 / PI * (theta + s * sum);
    return s * sum;
}

double ki_student_quantile(double level, size_t nu)
{
    double low = 0.0, high = 1.0;

    while (two_sided(high, nu) < level && high < 1e300)
        high *= 2.0;
    for (int step = 0; step < 100 && low < high; step++) {
        double mid = low + (high - low) / 2.0;

        if (mid == low || mid == high) break;
        if (two_sided(mid, nu) < level)
            low = mid;
        else
            high = mid;
    }
    return high;
}
