#include "bound.h"

#include <math.h>
#include <stdbool.h>

#include "error.h"

const char *const koksma_bound_names[KOKSMA_BOUND_TERMS] = {
    "koksma-hlawka", "smooth", "paper", "jump", "rms", "reach", "random"};

koksma_bound_facts koksma_bound_no_facts(size_t dim)
{
    const double no = (double)NAN;

    return (koksma_bound_facts){.dim = dim,
                                .vhk = no,
                                .smooth_vhk = no,
                                .smooth = no,
                                .jump = no,
                                .jump_rms = no,
                                .area = no,
                                .extent = no,
                                .axes = no,
                                .sigma = no};
}

/* ---- What follows from the facts --------------------------------------------- */

static double axes_of(const koksma_bound_facts *f)
{
    return f->axes >= 1.0 ? f->axes : (double)f->dim;
}

/* Of a unit vector with all directions alike |n|_1 has the mean
 * d Gamma(d/2) / (sqrt(pi) Gamma((d+1)/2)). */
static double area_of(const koksma_bound_facts *f)
{
    double d = axes_of(f);

    if (!isnan(f->area)) return f->area;
    return f->extent * sqrt(acos(-1.0)) / d *
           exp(lgamma((d + 1.0) / 2.0) - lgamma(d / 2.0));
}

/* sqrt(S/6) J, the jump's error at N = 1. */
static double jump_constant(const koksma_bound_facts *f)
{
    double jump = isnan(f->jump_rms) ? f->jump : f->jump_rms;

    if (f->jump == 0.0) return 0.0;
    return sqrt(area_of(f) / 6.0) * jump;
}

/* N^(-(d+1)/2d) */
static double rate(double n, double d) { return pow(n, -(d + 1.0) / (2.0 * d)); }

static bool below(double v, double least) { return !isnan(v) && !(v >= least); }

static koksma_status check(const koksma_bound_facts *f, double n, double star,
                           double z, koksma_error *err)
{
    const struct {
        const char *name;
        double value, least;
    } all[] = {{"N", n, 1.0},
               {"D*", star, 0.0},
               {"z", z, 0.0},
               {"the variation", f->vhk, 0.0},
               {"the variation of the smooth part", f->smooth_vhk, 0.0},
               {"the smooth part", f->smooth, 0.0},
               {"the jump", f->jump, 0.0},
               {"the mean jump", f->jump_rms, 0.0},
               {"the area", f->area, 0.0},
               {"the extent", f->extent, 0.0},
               {"the standard deviation", f->sigma, 0.0},
               {"the number of axes", f->axes, 0.0}};

    if (f->dim == 0 || isnan(n) || isnan(z))
        return ki_fail(err, KOKSMA_EINVAL, 0, "a bound takes a dimension, N and z");
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        if (below(all[i].value, all[i].least))
            return ki_fail(err, KOKSMA_EINVAL, 0, "%s is %g, below %g", all[i].name,
                           all[i].value, all[i].least);
    if (f->axes > (double)f->dim || (f->axes < 1.0 && f->jump > 0.0))
        return ki_fail(err, KOKSMA_EINVAL, 0,
                       "the surface depends on %g axes, and there are %zu", f->axes,
                       f->dim);
    return KOKSMA_OK;
}

/* ---- The terms --------------------------------------------------------------- */

static koksma_bound_term term_of(double value, koksma_bound_kind kind)
{
    return (koksma_bound_term){value, isnan(value) ? KOKSMA_BOUND_UNKNOWN : kind};
}

/* v * star, not rounded down: the bound stays one.  0 times what is not known is 0. */
static double times(double v, double star)
{
    double product = v * star;

    if (v == 0.0) return 0.0;
    /* Below that the residual may underflow. */
    if (fma(v, star, -product) > 0.0 || product < 0x1p-960)
        product = nextafter(product, HUGE_VAL);
    return product;
}

static koksma_bound_term hlawka(const koksma_bound_facts *f, double star)
{
    switch (f->vhk_from) {
    case KOKSMA_VHK_CLOSED:
        return term_of(isinf(f->vhk) ? f->vhk : times(f->vhk, star),
                       KOKSMA_BOUND_PROVED);
    case KOKSMA_VHK_GRID: return term_of(f->vhk * star, KOKSMA_BOUND_ESTIMATE);
    case KOKSMA_VHK_GROWS:
        return (koksma_bound_term){(double)NAN, KOKSMA_BOUND_DIVERGING};
    default: return term_of((double)NAN, KOKSMA_BOUND_UNKNOWN);
    }
}

/* The mean of the smooth part is below its bound. */
static koksma_bound_term smooth(const koksma_bound_facts *f, double n, double star)
{
    if (!isnan(f->smooth)) return term_of(f->smooth / n, KOKSMA_BOUND_ONE_SIGMA);
    return term_of(times(f->smooth_vhk, star), KOKSMA_BOUND_PROVED);
}

static koksma_bound_term jump(const koksma_bound_facts *f, double n)
{
    double value = jump_constant(f) * rate(n, axes_of(f));

    if (f->sigma / sqrt(n) < value) value = f->sigma / sqrt(n);
    return term_of(value, isnan(f->area) && f->jump > 0.0 ? KOKSMA_BOUND_ESTIMATE
                                                          : KOKSMA_BOUND_ONE_SIGMA);
}

static double paper(const koksma_bound_facts *f, double n, double star)
{
    double across =
        f->jump == 0.0 ? 0.0 : sqrt(f->extent) * f->jump * rate(n, (double)f->dim);

    return times(f->smooth_vhk, star) + across;
}

koksma_status koksma_bound(koksma_bound_term *term, const koksma_bound_facts *facts,
                           double n, double star, double z, koksma_error *err)
{
    koksma_status status = check(facts, n, star, z, err);
    koksma_bound_term s, j;
    double rms;
    bool shaky;

    if (status != KOKSMA_OK) return status;
    s = smooth(facts, n, star);
    j = jump(facts, n);
    rms = hypot(s.value, j.value);
    /* With a bound in place of a root mean square it is too large. */
    shaky = j.kind == KOKSMA_BOUND_ESTIMATE ||
            (s.kind == KOKSMA_BOUND_PROVED && s.value > 0.0);
    term[KOKSMA_BOUND_HLAWKA] = hlawka(facts, star);
    term[KOKSMA_BOUND_SMOOTH] = s;
    term[KOKSMA_BOUND_PAPER] =
        term_of(paper(facts, n, star), KOKSMA_BOUND_ONE_SIGMA);
    term[KOKSMA_BOUND_JUMP] = j;
    term[KOKSMA_BOUND_RMS] =
        term_of(rms, shaky ? KOKSMA_BOUND_ESTIMATE : KOKSMA_BOUND_ONE_SIGMA);
    term[KOKSMA_BOUND_REACH] = term_of(z * rms, KOKSMA_BOUND_ESTIMATE);
    term[KOKSMA_BOUND_RANDOM] =
        term_of(facts->sigma / sqrt(n), KOKSMA_BOUND_ONE_SIGMA);
    return KOKSMA_OK;
}

/* ---- Where things turn ------------------------------------------------------- */

koksma_bound_turns koksma_bound_turning(const koksma_bound_facts *f)
{
    double d = axes_of(f), constant = jump_constant(f);
    koksma_bound_turns t = {(double)NAN, (double)NAN, (double)NAN};

    if (!(f->jump > 0.0)) return t;
    t.saturation = pow(f->extent, d);
    t.even = pow(constant * constant / (f->sigma * f->sigma), d);
    if (d > 1.0) t.cross = pow(f->smooth / constant, 2.0 * d / (d - 1.0));
    return t;
}

koksma_pay koksma_bound_pays(const koksma_bound_facts *f, double n)
{
    koksma_bound_turns t = koksma_bound_turning(f);

    if (f->jump == 0.0 && f->vhk_from == KOKSMA_VHK_CLOSED && isfinite(f->vhk))
        return KOKSMA_PAY_SMOOTH;
    if (!(f->jump > 0.0)) return KOKSMA_PAY_UNKNOWN;
    if (n < t.saturation && axes_of(f) > 1.0) return KOKSMA_PAY_SATURATED;
    if (n < t.even) return KOKSMA_PAY_NOT_YET;
    return isnan(t.even) ? KOKSMA_PAY_UNKNOWN : KOKSMA_PAY_JUMP;
}
