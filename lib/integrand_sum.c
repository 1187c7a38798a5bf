/* Functions of the sum s of the coordinates: base + slope s + jump [s > threshold],
 * these four being what the rows prepare. */
#include <float.h>
#include <math.h>

#include "integrand_kernels.h"
#include "num_kernels.h"
#include "num_wide.h"

enum { SLOPE, JUMP, THRESHOLD, BASE };

static double sum_of(const double *x, size_t dim)
{
    double sum = 0.0;

    for (size_t k = 0; k < dim; k++)
        sum += x[k];
    return sum;
}

/* The sign of s - threshold, exactly.  The sum in doubles decides unless it is
 * within its own rounding, 30 half-ulps of 31 at most, of the threshold. */
static int side_of(const koksma_integrand *f, const double *x, double sum)
{
    double term[KI_SIGN_TERMS], apart = sum - f->derived[THRESHOLD];

    if (fabs(apart) > 0x1p-43) return apart > 0.0 ? 1 : -1;
    for (size_t k = 0; k < f->dim; k++)
        term[k] = x[k];
    term[f->dim] = -f->derived[THRESHOLD];
    return ki_sum_sign(term, f->dim + 1);
}

static double value_on(const koksma_integrand *f, double sum, double jump)
{
    return f->derived[BASE] + f->derived[SLOPE] * sum + jump;
}

static double value(const koksma_integrand *f, const double *x)
{
    double sum = sum_of(x, f->dim);

    return value_on(f, sum, side_of(f, x, sum) > 0 ? f->derived[JUMP] : 0.0);
}

static size_t piece(const koksma_integrand *f, const double *x)
{
    return f->derived[JUMP] != 0.0 && side_of(f, x, sum_of(x, f->dim)) > 0;
}

/* The slopes are not negative, and rounded operations are monotone as the exact
 * ones are: so the corners bound what value returns, to the last bit. */
static koksma_range range(const koksma_integrand *f, const double *lower,
                          const double *upper)
{
    double low = sum_of(lower, f->dim), high = sum_of(upper, f->dim);
    bool some_above = side_of(f, upper, high) > 0;
    bool all_above = side_of(f, lower, low) >= 0;
    double jump = f->derived[JUMP];
    double least = all_above || (some_above && jump < 0.0) ? jump : 0.0;
    double most = all_above || (some_above && jump > 0.0) ? jump : 0.0;

    return (koksma_range){{value_on(f, low, least), value_on(f, high, most)},
                          jump != 0.0 && some_above && !all_above};
}

/* Sums of whole numbers, the threshold being the third.  No branch depends on
 * where the box lies. */
static koksma_meeting compare(ki_u128 low, ki_u128 high, ki_multiple at)
{
    bool reaches = (low <= at.floor) & (high >= at.floor + !at.whole);
    bool edge = at.whole & ((low == at.floor) | (high == at.floor));

    return (koksma_meeting)(reaches + (reaches & !edge));
}

/* The sums of the corners in the common unit: in cubes that of one axis, and 64
 * bits are enough. */
static koksma_meeting meets(const koksma_integrand *f, const koksma_cell_box *box)
{
    uint64_t unit = ki_common_unit(box, f->dim), low = 0, high = 0;
    ki_multiple at = ki_times(f->derived[THRESHOLD], unit);
    ki_u128 lows = 0, highs = 0;

    if (f->derived[JUMP] == 0.0 || f->derived[THRESHOLD] <= 0.0 ||
        f->derived[THRESHOLD] >= (double)f->dim)
        return KOKSMA_APART;
    if (ki_cubes(box, f->dim) && unit < (uint64_t)1 << 58) {
        for (size_t k = 0; k < f->dim; k++) {
            low += box->lower[k];
            high += box->upper[k];
        }
        return compare(low, high, at);
    }
    for (size_t k = 0; k < f->dim; k++) {
        uint64_t weight = unit / box->cells[k];

        lows += (ki_u128)box->lower[k] * weight;
        highs += (ki_u128)box->upper[k] * weight;
    }
    return compare(lows, highs, at);
}

/* ---- Facts ------------------------------------------------------------------- */

/* The area is |grad s| times the density of s, and each projected area is that
 * density. */
static void facts(koksma_facts *out, const koksma_integrand *f)
{
    double dim = (double)f->dim, t = f->derived[THRESHOLD], jump = f->derived[JUMP];
    double slope = f->derived[SLOPE], above = ki_sum_share_above(t, f->dim);
    double integral = f->derived[BASE] + slope * dim / 2.0 + jump * above;
    double error = 8.0 * (dim + 2.0) * DBL_EPSILON *
                   (fabs(f->derived[BASE]) + slope * dim + fabs(jump) * above);
    double b[KI_SUM_DIM_MOST + 1];

    ki_sum_densities(b, t, f->dim);
    *out = ki_facts_smooth(integral, error);
    if (jump != 0.0 && t > 0.0 && t < dim) {
        *out = ki_facts_indicator(integral, error, sqrt(dim) * b[0], dim * b[0],
                                  f->dim);
        out->jump = out->jump_rms = fabs(jump);
    } else
        out->variation = slope * dim;
    out->variance =
        slope * slope * dim / 12.0 + jump * jump * above * (1.0 - above);
    if (slope != 0.0 && jump != 0.0)
        out->variance += 2.0 * slope * jump * ki_sum_covariance(t, f->dim);
}

/* Where the integral is known beforehand. */
static void facts_exact(koksma_facts *out, const koksma_integrand *f,
                        double integral)
{
    facts(out, f);
    out->integral = integral;
    out->error = 0.0;
}

static void facts_half(koksma_facts *out, const koksma_integrand *f)
{
    facts_exact(out, f, 0.5);
}

static void facts_one(koksma_facts *out, const koksma_integrand *f)
{
    facts_exact(out, f, 1.0);
}

static void facts_sum(koksma_facts *out, const koksma_integrand *f)
{
    facts_exact(out, f, (double)f->dim / 2.0);
}

static void facts_halfspace(koksma_facts *out, const koksma_integrand *f)
{
    facts(out, f);
    if (f->param[0] == 0.5) out->error = 0.0;
}

/* 1/dim!, rounded once while dim! is a double, and as 22! is. */
static void facts_simplex(koksma_facts *out, const koksma_integrand *f)
{
    double product = 1.0;

    for (size_t k = 2; k <= f->dim; k++)
        product *= (double)k;
    facts_exact(out, f, 1.0 / product);
    out->error = (f->dim <= 22 ? 0.5 : 8.0) * DBL_EPSILON * out->integral;
    out->variance = out->integral * (1.0 - out->integral);
}

/* Without a slope all belongs to the jump, a constant too. */
static void split(koksma_integrand *f, koksma_facts *out, koksma_part part)
{
    double *d = f->derived;
    bool slopes = d[SLOPE] != 0.0;

    if (part == KOKSMA_PART_SMOOTH) {
        d[JUMP] = 0.0;
        if (!slopes) d[BASE] = 0.0;
    } else if (slopes)
        d[SLOPE] = d[BASE] = 0.0;
    facts(out, f);
}

/* ---- Rows -------------------------------------------------------------------- */

static void set(koksma_integrand *f, double slope, double jump, double threshold)
{
    f->derived[SLOPE] = slope;
    f->derived[JUMP] = jump;
    f->derived[THRESHOLD] = threshold;
    f->derived[BASE] = 0.0;
}

static void prepare_f2(koksma_integrand *f)
{
    set(f, f->param[0], 1.0 - 2.0 * f->param[0], 1.0);
}

static void prepare_f3(koksma_integrand *f)
{
    set(f, f->param[0], 0.6 - 1.8 * f->param[0], 1.0);
}

static void prepare_halfspace(koksma_integrand *f)
{
    set(f, 0.0, 1.0, f->param[0] * (double)f->dim);
}

static void prepare_simplex(koksma_integrand *f)
{
    set(f, 0.0, -1.0, 1.0);
    f->derived[BASE] = 1.0;
}

static void prepare_mixture(koksma_integrand *f)
{
    set(f, 2.0 * f->param[0] / (double)f->dim, 2.0 - 2.0 * f->param[0],
        (double)f->dim / 2.0);
}

static void prepare_sum(koksma_integrand *f) { set(f, 1.0, 0.0, (double)f->dim); }

#define FUNCTIONS                                                                  \
    {                                                                              \
        .value = value, .piece = piece, .range = range, .meets = meets             \
    }

const koksma_integrand_row ki_row_f2 = {
    .name = "f2",
    .summary = "a(x+y), and 1-2a more where x+y > 1",
    .dim = 2,
    .dim_least = 2,
    .dim_most = 2,
    .dim_step = 1,
    .params = {{"a", 0.0, 0.0, 0.5, KOKSMA_CLOSED}},
    .functions = FUNCTIONS,
    .prepare = prepare_f2,
    .facts = facts_half,
    .split = split,
};

const koksma_integrand_row ki_row_f3 = {
    .name = "f3",
    .summary = "a(x+y+z), and 0.6-1.8a more where x+y+z > 1",
    .dim = 3,
    .dim_least = 3,
    .dim_most = 3,
    .dim_step = 1,
    .params = {{"a", 0.0, 0.0, 1.0 / 3.0, KOKSMA_CLOSED}},
    .functions = FUNCTIONS,
    .prepare = prepare_f3,
    .facts = facts_half,
    .split = split,
};

const koksma_integrand_row ki_row_halfspace = {
    .name = "halfspace",
    .summary = "1 where the mean of the coordinates is above c",
    .dim = 2,
    .dim_least = 2,
    .dim_most = KI_SUM_DIM_MOST,
    .dim_step = 1,
    .params = {{"c", 0.5, 0.0, 1.0, KOKSMA_CLOSED}},
    .functions = FUNCTIONS,
    .prepare = prepare_halfspace,
    .facts = facts_halfspace,
    .split = split,
};

const koksma_integrand_row ki_row_simplex = {
    .name = "simplex",
    .summary = "1 where the coordinates add up to 1 or less",
    .dim = 2,
    .dim_least = 2,
    .dim_most = KI_SUM_DIM_MOST,
    .dim_step = 1,
    .functions = FUNCTIONS,
    .prepare = prepare_simplex,
    .facts = facts_simplex,
    .split = split,
};

const koksma_integrand_row ki_row_mixture = {
    .name = "mixture",
    .summary = "2a times their mean, and 2-2a more where that is above 1/2",
    .dim = 2,
    .dim_least = 2,
    .dim_most = KI_SUM_DIM_MOST,
    .dim_step = 1,
    .params = {{"a", 0.5, 0.0, 1.0, KOKSMA_CLOSED}},
    .functions = FUNCTIONS,
    .prepare = prepare_mixture,
    .facts = facts_one,
    .split = split,
};

const koksma_integrand_row ki_row_sum = {
    .name = "sum",
    .summary = "the sum of the coordinates",
    .dim = 2,
    .dim_least = 1,
    .dim_most = KI_SUM_DIM_MOST,
    .dim_step = 1,
    .functions = FUNCTIONS,
    .prepare = prepare_sum,
    .facts = facts_sum,
    .split = split,
};
