#ifndef KI_NUM_KERNELS_H
#define KI_NUM_KERNELS_H

#include <stddef.h>

#include "num.h"

/* Private: arithmetic with known errors.  All of it assumes IEEE doubles,
 * round to nearest, and one rounding an operation (-ffp-contract=off). */
#ifdef __FAST_MATH__
#error "Koksma's bounds count roundings: build it without -ffast-math"
#endif

/* Two doubles that stand for their sum, |lo| at most half an ulp of hi, and a
 * bound of the error made on the way: the true value is hi + lo up to err. */
typedef struct ki_twofold {
    double hi, lo, err;
} ki_twofold;

/* s + *rest = a + b exactly [Knuth 1997, 4.2.2 thm B]. */
static inline double ki_two_sum(double a, double b, double *rest)
{
    double s = a + b, bb = s - a;

    *rest = (a - (s - bb)) + (b - bb);
    return s;
}

/* A running sum, compensated: after m additions the total is off by less than
 * 2^-53 |sum| + m 2^-105 sum|terms|  [Neumaier 1974]. */
typedef struct ki_sum {
    double sum, rest;
} ki_sum;

static inline void ki_sum_add(ki_sum *s, double term)
{
    double rest;

    s->sum = ki_two_sum(s->sum, term, &rest);
    s->rest += rest;
}

static inline double ki_sum_value(ki_sum s) { return s.sum + s.rest; }

/* The sign, -1, 0 or 1, of the exact sum of n <= KI_SIGN_TERMS finite doubles
 * whose sums do not overflow [Shewchuk 1997, Grow-Expansion]. */
#define KI_SIGN_TERMS 144
int ki_sum_sign(const double *terms, size_t n);

/* vol: the product of dim numbers in [0,1]. */
ki_twofold ki_volume(const double *corner, size_t dim);

/* vol: the product of the dim widths b_k - a_k, 0 <= a_k <= b_k <= 1. */
ki_twofold ki_volume_between(const double *a, const double *b, size_t dim);

/* sign * (inside - n*vol), 0 <= inside <= n < 2^51: how many points too many. */
ki_twofold ki_excess(double sign, size_t inside, size_t n, ki_twofold vol);

/* The interval of a/n, rounded outward: at most two ulps wide, or 36 a.err/n where
 * a is so nearly 0 that an ulp is below 8 a.err/n, and a single number when that is
 * exact and a.err is 0. */
koksma_interval ki_divide(ki_twofold a, size_t n);

/* The interval of sign * (inside/n - vol): both of the above. */
koksma_interval ki_deviation(double sign, size_t inside, size_t n, ki_twofold vol);

/* The t such that a Student variable with nu degrees of freedom lies in
 * [-t, t] with probability level, 0 < level < 1, nu >= 1. */
double ki_student_quantile(double level, size_t nu);

#endif
