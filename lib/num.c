#include "num.h"

#include <float.h>
#include <math.h>

#include "num_kernels.h"

/* FLT_EVAL_METHOD 1, of s390, concerns float alone. */
#if FLT_RADIX != 2 || DBL_MANT_DIG != 53 || DBL_MAX_EXP != 1024 ||                 \
    (FLT_EVAL_METHOD != 0 && FLT_EVAL_METHOD != 1)
#error "Koksma needs IEEE 754 doubles, each operation rounded to one"
#endif

int ki_sum_sign(const double *terms, size_t n)
{
    double part[KI_SIGN_TERMS]; /* nonoverlapping, of increasing magnitude */
    size_t parts = 0;

    for (size_t i = 0; i < n; i++) {
        double carry = terms[i];
        size_t kept = 0;

        for (size_t j = 0; j < parts; j++) {
            double rest;

            carry = ki_two_sum(carry, part[j], &rest);
            if (rest != 0.0) part[kept++] = rest;
        }
        if (carry != 0.0) part[kept++] = carry;
        parts = kept;
    }
    if (parts == 0) return 0;
    return part[parts - 1] > 0.0 ? 1 : -1;
}

/* What a step of a product may lose, and the products that are charged for it
 * unseen, since fma's error term is itself exact unless it underflows: vastly more
 * than they can lose. */
static const double STEP = 0x1p-104, TINY = 0x1p-960;

/* One step multiplies (hi, lo) by c in [0,1].  hi*c = p + e exactly, by fma.
 * lo*c and the sum with e round; |lo| <= 2^-54 since hi <= 1, so both errors
 * are below 2^-106, and STEP covers them and the final renormalisation, which
 * is exact.  When both roundings are seen to be exact nothing is added, so
 * that products of short dyadic numbers come out exact. */
static ki_twofold times(ki_twofold v, double c)
{
    double p = v.hi * c;
    double e = fma(v.hi, c, -p), q = v.lo * c, rest;
    double low = ki_two_sum(e, q, &rest);

    if (rest != 0.0 || fma(v.lo, c, -q) != 0.0 ||
        (c != 0.0 && (p < TINY || (v.lo != 0.0 && fabs(q) < TINY))))
        v.err += STEP;
    v.hi = ki_two_sum(p, low, &v.lo);
    return v;
}

/* The same by c + rest, |rest| <= 2^-54: that adds hi*rest to the low part, at most
 * 2^-54, rounded by 2^-108; to add it rounds by 2^-106 more; and lo*rest, at most
 * 2^-108, is left out. */
static ki_twofold times_width(ki_twofold v, double c, double rest)
{
    double more = v.hi * rest;

    v = times(v, c);
    if (rest == 0.0) return v;
    v.err += STEP;
    v.hi = ki_two_sum(v.hi, v.lo + more, &v.lo);
    return v;
}

ki_twofold ki_volume(const double *corner, size_t dim)
{
    ki_twofold v = {corner[0], 0.0, 0.0};

    for (size_t k = 1; k < dim && v.hi != 0.0; k++)
        v = times(v, corner[k]);
    return v;
}

/* A width b - a is a double and a rest, exactly. */
ki_twofold ki_volume_between(const double *a, const double *b, size_t dim)
{
    ki_twofold v = {0.0, 0.0, 0.0};

    v.hi = ki_two_sum(b[0], -a[0], &v.lo);
    for (size_t k = 1; k < dim && v.hi != 0.0; k++) {
        double rest, width = ki_two_sum(b[k], -a[k], &rest);

        v = times_width(v, width, rest);
    }
    return v;
}

/* Whether q*n <= a, an uncertainty a.err counting against it.  With q within two
 * ulps of a/n and n < 2^51, a.hi - q*n is a multiple of the last place of q and
 * less than 2^53 of them: the fma is exact, and the sum has the sign of the exact
 * one.  Where a.err is not 0, q may be further off; the two roundings are then
 * counted too. */
static int below(double q, double n, ki_twofold a)
{
    double r = fma(-q, n, a.hi), s = r + a.lo;
    double slack = a.err > 0.0 ? a.err + (fabs(r) + fabs(s)) * DBL_EPSILON : 0.0;

    return s >= slack;
}

/* The greatest double that is surely not above a/n.  Where a.err is far below
 * an ulp, as it is but for a of nearly 0, the search takes a step or two. */
static double divide_down(ki_twofold a, double n)
{
    double q = a.hi / n, up = nextafter(q, HUGE_VAL);

    if (below(q, n, a)) return below(up, n, a) ? up : q;
    q -= 2.0 * a.err / n;
    do
        q = nextafter(q, -HUGE_VAL);
    while (!below(q, n, a));
    return q;
}

ki_twofold ki_excess(double sign, size_t inside, size_t n, ki_twofold vol)
{
    /* a = sign * (inside - n*vol).  n*hi = p + e exactly; n*lo rounds by at most
     * n 2^-107.  e and the rests are at most n 2^-53, so the two sums of low
     * parts round by at most n 2^-105 and n 2^-104: together below n 2^-103. */
    double m = (double)n, p = m * vol.hi, e = fma(m, vol.hi, -p), q = m * vol.lo;
    double rest, rest2, rest3;
    double high = ki_two_sum((double)inside, -p, &rest);
    double low = ki_two_sum(-e, -q, &rest2);
    double lows = ki_two_sum(rest, low, &rest3);
    ki_twofold a = {0.0, 0.0, m * vol.err * (1.0 + DBL_EPSILON)};

    if (rest2 != 0.0 || rest3 != 0.0 || fma(m, vol.lo, -q) != 0.0)
        a.err += m * 0x1p-103;
    a.hi = ki_two_sum(high, lows, &a.lo);
    a.hi *= sign;
    a.lo *= sign;
    return a;
}

koksma_interval ki_divide(ki_twofold a, size_t n)
{
    koksma_interval v = {divide_down(a, (double)n), 0.0};

    a.hi = -a.hi;
    a.lo = -a.lo;
    v.upper = -divide_down(a, (double)n);
    return v;
}

koksma_interval ki_deviation(double sign, size_t inside, size_t n, ki_twofold vol)
{
    return ki_divide(ki_excess(sign, inside, n, vol), n);
}
