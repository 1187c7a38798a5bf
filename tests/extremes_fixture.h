#ifndef KOKSMA_TESTS_EXTREMES_FIXTURE_H
#define KOKSMA_TESTS_EXTREMES_FIXTURE_H

#include <math.h>
#include <stdlib.h>

#include "oracle.h"

/* What the tests at the extremes share: true values that need not be doubles, and
 * sets of points whose discrepancies have a closed form. */

/* ---- Truths ------------------------------------------------------------------ */

/* The double `near` itself (side 0), or a number strictly between it and the next
 * double above (1) or below it (-1). */
typedef struct truth {
    double near;
    int side;
} truth;

static inline bool truth_inside(truth t, koksma_interval v)
{
    return (v.lower < t.near || (v.lower == t.near && t.side >= 0)) &&
           (v.upper > t.near || (v.upper == t.near && t.side <= 0));
}

static inline truth truth_exact(double v) { return (truth){v, 0}; }

static inline int truth_sign(double v) { return (v > 0.0) - (v < 0.0); }

/* a - c^dim, a >= c^dim.  The power is a sum of two doubles: exact where it has at
 * most 106 digits, else to dim 2^-98 of itself, and where that is too little to
 * tell the side this fails. */
static inline truth truth_less_power(double a, double c, size_t dim)
{
    int e, digits = 0;
    double hi = 1.0, lo = 0.0, near, rest, sum;

    for (double m = frexp(c, &e); m != floor(m); m *= 2.0)
        digits++;
    for (size_t k = 0; k < dim; k++) {
        near = hi * c;
        rest = fma(hi, c, -near) + lo * c;
        hi = near + rest;
        lo = (near - hi) + rest;
    }
    if (hi < 0x1p-200) return (truth){a, hi > 0.0 || c > 0.0 ? -1 : 0};
    near = a - hi;
    rest = ((a - near) - hi) - lo;
    sum = near + rest;
    rest = (near - sum) + rest;
    if ((size_t)digits * dim > 106 && fabs(rest) <= (double)dim * 0x1p-98 * hi)
        ck_abort_msg("%g - %g^%zu: too little is known", a, c, dim);
    return (truth){sum, truth_sign(rest)};
}

static inline truth truth_max(truth a, truth b)
{
    return a.near > b.near || (a.near == b.near && a.side > b.side) ? a : b;
}

/* ---- Sets of points ---------------------------------------------------------- */

#define ULP 0x1p-53     /* between the doubles of [1/2,1) */
#define LEAST 0x1p-1074 /* the least double above 0 */
#define BELOW (1.0 - ULP)

/* Coordinate k of point i of n in dim dimensions. */
typedef double place_of(size_t i, size_t n, size_t dim);

static inline double at_0(size_t i, size_t n, size_t dim)
{
    return (void)i, (void)n, (void)dim, 0.0;
}
static inline double at_1(size_t i, size_t n, size_t dim)
{
    return (void)i, (void)n, (void)dim, 1.0;
}
static inline double below_1(size_t i, size_t n, size_t dim)
{
    return (void)i, (void)n, (void)dim, BELOW;
}
static inline double least(size_t i, size_t n, size_t dim)
{
    return (void)i, (void)n, (void)dim, LEAST;
}
static inline double halves(size_t i, size_t n, size_t dim)
{
    return (void)i, (void)n, (void)dim, 0.5;
}
/* Half of them, rounded down, an ulp higher. */
static inline double two_doubles(size_t i, size_t n, size_t dim)
{
    return (void)n, (void)dim, i % 2 == 1 ? 0.5 + ULP : 0.5;
}
static inline double two_places(size_t i, size_t n, size_t dim)
{
    return (void)n, (void)dim, i % 4 == 3 ? 0.75 : 0.25;
}
static inline double diagonal(size_t i, size_t n, size_t dim)
{
    return (void)dim, (double)i / (double)n;
}

static inline koksma_points points_at(place_of *place, size_t n, size_t dim)
{
    double *x = malloc(n * dim * sizeof *x);

    ck_assert_ptr_nonnull(x);
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < dim; k++)
            x[i * dim + k] = place(i, n, dim);
    return (koksma_points){x, n, dim};
}

static inline void points_free(koksma_points p) { free((void *)(uintptr_t)p.x); }

/* m points an axis, m = 2^bits: (j + shift)/m, r times each. */
static inline koksma_points points_grid(unsigned bits, double shift, size_t dim,
                                        size_t r)
{
    size_t cells = (size_t)1 << bits * dim;
    double *x = malloc(r * cells * dim * sizeof *x), *at = x;

    ck_assert_ptr_nonnull(x);
    for (size_t i = 0; i < r * cells; i++)
        for (size_t k = 0; k < dim; k++)
            *at++ =
                ldexp((double)(i % cells >> k * bits & ((1u << bits) - 1)) + shift,
                      -(int)bits);
    return (koksma_points){x, r * cells, dim};
}

#endif
