/* The two of Genz's families that are no products: a plane wave and a peak in a
 * corner. */
#include <float.h>
#include <math.h>

#include "integrand_kernels.h"

enum { C, W };
enum { DIM_MOST = 50 };

static const double PI = 3.14159265358979323846;

static double sum_of(const koksma_integrand *f, const double *x)
{
    double sum = 0.0;

    for (size_t k = 0; k < f->dim; k++)
        sum += x[k];
    return sum;
}

/* ---- cos(2 pi w + c s) ------------------------------------------------------- */

static double oscillatory(const koksma_integrand *f, const double *x)
{
    return cos(2.0 * PI * f->param[W] + f->param[C] * sum_of(f, x));
}

/* The real part of e^(i phase) times the integral of e^(i c x), dim times. */
static double wave_mean(double phase, double c, size_t dim)
{
    double half = c / 2.0;

    return cos(phase + (double)dim * half) * pow(sin(half) / half, (double)dim);
}

static void oscillatory_facts(koksma_facts *out, const koksma_integrand *f)
{
    double c = f->param[C], phase = 2.0 * PI * f->param[W], dim = (double)f->dim;
    double mean = wave_mean(phase, c, f->dim);
    double size = pow(fabs(sin(c / 2.0) / (c / 2.0)), dim - 1.0);

    /* The phase is rounded, and so is the sine next to a zero of it. */
    *out =
        ki_facts_smooth(mean, 8.0 * (phase + dim * (c + 1.0)) * DBL_EPSILON * size);
    out->variance =
        0.5 + 0.5 * wave_mean(2.0 * phase, 2.0 * c, f->dim) - mean * mean;
}

/* ---- (1 + c s)^-(dim+1) ------------------------------------------------------ */

static double corner_peak(const koksma_integrand *f, const double *x)
{
    return pow(1.0 + f->param[C] * sum_of(f, x), -(double)(f->dim + 1));
}

/* Integrating (1 + c s)^-p over the cube gives an alternating sum of powers at
 * t_j = 1 + cj, a divided difference of t^(dim-p): (-1)^dim times the product of
 * the 1/t_j and their complete homogeneous polynomial of degree p - dim - 1.  No
 * term of that is negative.  Degree 0 is the mean, and dim + 1 the mean square,
 * with a factor dim! (dim+1)! / (2 dim + 1)!. */
static void corner_peak_facts(koksma_facts *out, const koksma_integrand *f)
{
    double h[DIM_MOST + 2] = {1.0}, mean = 1.0, factor = 1.0, c = f->param[C];
    size_t dim = f->dim;

    for (size_t j = 0; j <= dim; j++) {
        double root = 1.0 / (1.0 + c * (double)j);

        mean *= root;
        for (size_t degree = 1; degree <= dim + 1; degree++)
            h[degree] += root * h[degree - 1];
        if (j > 0) factor *= (double)j / (double)(dim + 1 + j);
    }
    *out = ki_facts_smooth(mean, 4.0 * (double)(dim + 1) * DBL_EPSILON * mean);
    out->variance = factor * mean * h[dim + 1] - mean * mean;

    /* Every mixed derivative has the sign of (-1)^order, so the variations of the
     * faces add up to f(0) - f(1) [Owen 2005]. */
    out->variation = -expm1(-(double)(dim + 1) * log1p(c * (double)dim));
}

/* ---- Rows -------------------------------------------------------------------- */

const koksma_integrand_row ki_row_oscillatory = {
    .name = "oscillatory",
    .summary = "cos(2 pi w + c times the sum)",
    .dim = 2,
    .dim_least = 1,
    .dim_most = DIM_MOST,
    .dim_step = 1,
    .params = {{"c", 3.0, 0x1p-6, 0x1p6, KOKSMA_CLOSED},
               {"w", 0.3, 0.0, 1.0, KOKSMA_CLOSED}},
    .functions = {.value = oscillatory,
                  .piece = ki_piece_only,
                  .meets = ki_meets_nothing},
    .facts = oscillatory_facts,
};

const koksma_integrand_row ki_row_corner_peak = {
    .name = "corner-peak",
    .summary = "(1 + c times the sum)^-(dim+1)",
    .dim = 2,
    .dim_least = 1,
    .dim_most = DIM_MOST,
    .dim_step = 1,
    .params = {{"c", 2.0, 0x1p-6, 0x1p6, KOKSMA_CLOSED}},
    .functions = {.value = corner_peak,
                  .piece = ki_piece_only,
                  .meets = ki_meets_nothing},
    .facts = corner_peak_facts,
};
