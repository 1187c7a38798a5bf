/* Sums of uniform numbers: their densities are B-splines. */
#include "integrand_kernels.h"

/* f_{m+1}(y) = (y f_m(y) + (m+1 - y) f_m(y - 1)) / m: no cancellation, and y = x -
 * i is exact where it is not below 0. */
void ki_sum_densities(double *b, double x, size_t n)
{
    for (size_t i = 0; i <= n; i++)
        b[i] = x - (double)i >= 0.0 && x - (double)i < 1.0;
    for (size_t m = 1; m < n; m++)
        for (size_t i = 0; i <= n; i++) {
            double y = x - (double)i, next = i < n ? b[i + 1] : 0.0;

            b[i] = y > 0.0 ? (y * b[i] + ((double)(m + 1) - y) * next) / (double)m
                           : 0.0;
        }
}

/* P(s < t) and E max(t - s, 0): the density of more terms, summed over its
 * translates once and twice. */
static double share_below(double t, size_t dim)
{
    double b[KI_SUM_DIM_MOST + 2], sum = 0.0;

    ki_sum_densities(b, t, dim + 1);
    for (size_t i = 0; i <= dim + 1; i++)
        sum += b[i];
    return sum;
}

static double mean_below(double t, size_t dim)
{
    double b[KI_SUM_DIM_MOST + 3], sum = 0.0;

    ki_sum_densities(b, t, dim + 2);
    for (size_t i = 0; i <= dim + 2; i++)
        sum += (double)(i + 1) * b[i];
    return sum;
}

/* dim - t is rounded for t below the middle alone, where P(s > t) is no less than
 * 1/2, and by no more than dim half-ulps. */
double ki_sum_share_above(double t, size_t dim)
{
    return t == (double)dim / 2.0 ? 0.5 : share_below((double)dim - t, dim);
}

double ki_sum_covariance(double t, size_t dim)
{
    double middle = (double)dim / 2.0, far = t > middle ? (double)dim - t : t;

    /* E max(t - s, 0) + (dim/2 - t) P(s <= t), and the same at dim - t. */
    return mean_below(far, dim) + (middle - far) * share_below(far, dim);
}
