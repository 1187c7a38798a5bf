/* Products over the coordinates.  Mean, mean square and variation of a product
 * follow from those of its factors. */
#include <float.h>
#include <math.h>

#include "integrand_kernels.h"

enum { DIM_MOST = 50 };

static const double PI = 3.14159265358979323846;

/* Of a function on [0,1]. */
typedef struct factor {
    double mean;
    double square; /* the mean of the square */
    double at_one;
    double variation;
} factor;

/* ---- A product's facts ------------------------------------------------------- */

/* What is known of the product of the first coordinates. */
typedef struct tally {
    double mean, variance, at_one, variation;
} tally;

static const tally NO_FACTOR = {1.0, 0.0, 1.0, 0.0};

/* Variance: E(fg)^2 - (E fg)^2.  Variation: each face of the cube is a face for
 * the factors before and for this one, or for one of them with the other at 1. */
static void multiply(tally *t, factor g, size_t times)
{
    for (size_t k = 0; k < times; k++) {
        t->variance = t->variance * g.square +
                      t->mean * t->mean * (g.square - g.mean * g.mean);
        t->variation =
            t->variation * (g.at_one + g.variation) + t->at_one * g.variation;
        t->mean *= g.mean;
        t->at_one *= g.at_one;
    }
}

/* A factor's mean takes some ten roundings and calls of libm. */
static koksma_facts facts_of(tally t, size_t dim)
{
    koksma_facts out =
        ki_facts_smooth(t.mean, 16.0 * (double)dim * DBL_EPSILON * t.mean);

    out.variance = t.variance;
    out.variation = t.variation;
    return out;
}

static koksma_facts facts_power(factor g, size_t dim)
{
    tally t = NO_FACTOR;

    multiply(&t, g, dim);
    return facts_of(t, dim);
}

/* ---- x ----------------------------------------------------------------------- */

static double product(const koksma_integrand *f, const double *x)
{
    double v = 1.0;

    for (size_t k = 0; k < f->dim; k++)
        v *= x[k];
    return v;
}

/* Rounded products of numbers from [0,1] are monotone. */
static koksma_range product_range(const koksma_integrand *f, const double *lower,
                                  const double *upper)
{
    return (koksma_range){{product(f, lower), product(f, upper)}, false};
}

static void product_facts(koksma_facts *out, const koksma_integrand *f)
{
    *out = facts_power((factor){0.5, 1.0 / 3.0, 1.0, 1.0}, f->dim);
    out->error = 0.0;
}

/* ---- Peaks: c and w ---------------------------------------------------------- */

enum { C, W };

static double product_peak(const koksma_integrand *f, const double *x)
{
    double flat = 1.0 / (f->param[C] * f->param[C]), v = 1.0;

    for (size_t k = 0; k < f->dim; k++)
        v /= flat + (x[k] - f->param[W]) * (x[k] - f->param[W]);
    return v;
}

static double gaussian(const koksma_integrand *f, const double *x)
{
    double sum = 0.0;

    for (size_t k = 0; k < f->dim; k++)
        sum += (x[k] - f->param[W]) * (x[k] - f->param[W]);
    return exp(-f->param[C] * f->param[C] * sum);
}

static double continuous(const koksma_integrand *f, const double *x)
{
    double sum = 0.0;

    for (size_t k = 0; k < f->dim; k++)
        sum += fabs(x[k] - f->param[W]);
    return exp(-f->param[C] * sum);
}

/* A factor that rises to `peak` at w and falls again. */
static factor peaked(double mean, double square, double peak, double at_zero,
                     double at_one)
{
    return (factor){mean, square, at_one, (peak - at_zero) + (peak - at_one)};
}

/* With t = c (x - w) from -a to b the mean is c (atan b + atan a), and that of the
 * square c^3/2 times the values at b and a of t/(1 + t^2) + atan t. */
static void product_peak_facts(koksma_facts *out, const koksma_integrand *f)
{
    double c = f->param[C], a = c * f->param[W], b = c * (1.0 - f->param[W]);
    double angle = atan(a) + atan(b), low = 1.0 / (1.0 + a * a),
           high = 1.0 / (1.0 + b * b);

    *out = facts_power(peaked(c * angle,
                              c * c * c / 2.0 * (a * low + b * high + angle), c * c,
                              c * c * low, c * c * high),
                       f->dim);
}

static double gaussian_mean(double c, double w)
{
    return sqrt(PI) / (2.0 * c) * (erf(c * w) + erf(c * (1.0 - w)));
}

static void gaussian_facts(koksma_facts *out, const koksma_integrand *f)
{
    double c = f->param[C], w = f->param[W], a = c * w, b = c * (1.0 - w);

    *out = facts_power(peaked(gaussian_mean(c, w), gaussian_mean(sqrt(2.0) * c, w),
                              1.0, exp(-a * a), exp(-b * b)),
                       f->dim);
}

static double continuous_mean(double c, double w)
{
    return -(expm1(-c * w) + expm1(-c * (1.0 - w))) / c;
}

static void continuous_facts(koksma_facts *out, const koksma_integrand *f)
{
    double c = f->param[C], w = f->param[W];

    *out = facts_power(peaked(continuous_mean(c, w), continuous_mean(2.0 * c, w),
                              1.0, exp(-c * w), exp(-c * (1.0 - w))),
                       f->dim);
}

/* ---- exp(c x), cut off beyond w in the first two ----------------------------- */

static size_t cut_axes(const koksma_integrand *f)
{
    return f->dim < 2 ? f->dim : 2;
}

static double discontinuous(const koksma_integrand *f, const double *x)
{
    double sum = 0.0;

    for (size_t k = 0; k < cut_axes(f); k++)
        if (x[k] > f->param[W]) return 0.0;
    for (size_t k = 0; k < f->dim; k++)
        sum += x[k];
    return exp(f->param[C] * sum);
}

static koksma_meeting discontinuous_meets(const koksma_integrand *f,
                                          const koksma_cell_box *box)
{
    return ki_meets_corner(f->param[W], cut_axes(f), box);
}

/* exp(c x) on [0,w], and 0 beyond. */
static factor growth(double c, double w)
{
    double top = exp(c * w);

    return (factor){expm1(c * w) / c, expm1(2.0 * c * w) / (2.0 * c),
                    w < 1.0 ? 0.0 : top, expm1(c * w) + (w < 1.0 ? top : 0.0)};
}

/* Each cut face has the value at w of one cut factor times the other factors. */
static void discontinuous_facts(koksma_facts *out, const koksma_integrand *f)
{
    double c = f->param[C], w = f->param[W], top = exp(c * w);
    size_t cuts = cut_axes(f);
    factor cut = growth(c, w), rest = growth(c, 1.0);
    tally t = NO_FACTOR, face = NO_FACTOR;

    multiply(&t, cut, cuts);
    multiply(&t, rest, f->dim - cuts);
    *out = facts_of(t, f->dim);
    if (w <= 0.0 || w >= 1.0) return;
    multiply(&face, (factor){.mean = cut.square}, cuts - 1);
    multiply(&face, (factor){.mean = rest.square}, f->dim - cuts);
    out->area = out->extent = cuts == 2 ? 2.0 * w : 1.0;
    out->jump = pow(top, (double)cuts) * exp(c * (double)(f->dim - cuts));
    out->jump_rms = top * sqrt(face.mean / (cuts == 2 ? w : 1.0));
    out->axes = 1.0;
    out->box_dim = (double)(f->dim - 1);
    out->pieces = 2.0;
}

/* ---- Rows -------------------------------------------------------------------- */

const koksma_integrand_row ki_row_product = {
    .name = "product",
    .summary = "the product of the coordinates",
    .dim = 2,
    .dim_least = 1,
    .dim_most = DIM_MOST,
    .dim_step = 1,
    .functions = {.value = product,
                  .piece = ki_piece_only,
                  .range = product_range,
                  .meets = ki_meets_nothing},
    .facts = product_facts,
};

const koksma_integrand_row ki_row_product_peak = {
    .name = "product-peak",
    .summary = "the product of 1/(1/c^2 + (x-w)^2)",
    .dim = 2,
    .dim_least = 1,
    .dim_most = DIM_MOST,
    .dim_step = 1,
    .params = {{"c", 5.0, 0x1p-6, 0x1p6, KOKSMA_CLOSED},
               {"w", 0.3, 0.0, 1.0, KOKSMA_CLOSED}},
    .functions = {.value = product_peak,
                  .piece = ki_piece_only,
                  .meets = ki_meets_nothing},
    .facts = product_peak_facts,
};

const koksma_integrand_row ki_row_gaussian = {
    .name = "gaussian",
    .summary = "the product of exp(-c^2 (x-w)^2)",
    .dim = 2,
    .dim_least = 1,
    .dim_most = DIM_MOST,
    .dim_step = 1,
    .params = {{"c", 5.0, 0x1p-6, 0x1p6, KOKSMA_CLOSED},
               {"w", 0.3, 0.0, 1.0, KOKSMA_CLOSED}},
    .functions = {.value = gaussian,
                  .piece = ki_piece_only,
                  .meets = ki_meets_nothing},
    .facts = gaussian_facts,
};

const koksma_integrand_row ki_row_continuous = {
    .name = "continuous",
    .summary = "the product of exp(-c |x-w|)",
    .dim = 2,
    .dim_least = 1,
    .dim_most = DIM_MOST,
    .dim_step = 1,
    .params = {{"c", 2.0, 0x1p-6, 0x1p6, KOKSMA_CLOSED},
               {"w", 0.3, 0.0, 1.0, KOKSMA_CLOSED}},
    .functions = {.value = continuous,
                  .piece = ki_piece_only,
                  .meets = ki_meets_nothing},
    .facts = continuous_facts,
};

const koksma_integrand_row ki_row_discontinuous = {
    .name = "discontinuous",
    .summary = "the product of exp(cx), 0 where x or y is above w",
    .dim = 2,
    .dim_least = 1,
    .dim_most = DIM_MOST,
    .dim_step = 1,
    .params = {{"c", 2.0, 0x1p-6, 8.0, KOKSMA_CLOSED},
               {"w", 0.3, 0.0, 1.0, KOKSMA_CLOSED}},
    .functions = {.value = discontinuous,
                  .piece = ki_piece_by_value,
                  .meets = discontinuous_meets},
    .facts = discontinuous_facts,
};
