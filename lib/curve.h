#ifndef KOKSMA_CURVE_H
#define KOKSMA_CURVE_H

#include <stddef.h>
#include <stdint.h>

#include "num.h"
#include "points.h"

/* Error curves: the running error of a sequence of values f_0, f_1, ...
 *
 *     e(N)  =  1/N sum over i < N of (f_i - I)        I the exact integral
 *     E(N)  =  max over n >= N of |e(n)|              n up to the last value
 *
 * at N = 1, 2, 3, 4, 6, 8, 11, 16, ...: 2^(i/steps) rounded, `steps` to the
 * octave, and at the last value; or at N's that are given.  E is the "maximum error
 * after N samples" of [Szirmay-Kalos, Purgathofer 1998]; near the last value it is
 * too small, since it cannot see further. */

typedef struct koksma_curve_row {
    uint64_t n;
    double error; /* e(n), signed */
    double tail;  /* E(n) */
    double least,
        most; /* of all e(m), m >= n; tail is the larger of -least, most */
} koksma_curve_row;

/* What is known of all values so far. */
typedef struct koksma_curve_total {
    uint64_t n;
    double error;   /* e(n); 0 without values */
    double square;  /* 1/n sum (f_i - I)^2: for random points, the variance */
    double largest; /* |f_i| */
} koksma_curve_total;

typedef struct koksma_curve koksma_curve;

/* Returns: KOKSMA_OK; KOKSMA_EINVAL: steps not in 1..64; KOKSMA_ENOMEM */
koksma_status koksma_curve_open(koksma_curve **out, unsigned steps,
                                koksma_error *err);
/* The same with rows at the `count` given N alone, as far as the values reach.
 *
 * Returns: KOKSMA_OK; KOKSMA_EINVAL: no N, an N of 0, or one not above that before
 *          it; KOKSMA_ENOMEM */
koksma_status koksma_curve_open_at(koksma_curve **out, const uint64_t *n,
                                   size_t count, koksma_error *err);
void koksma_curve_close(koksma_curve *c); /* c may be NULL */

/* Begin a curve; I is exact. */
void koksma_curve_begin(koksma_curve *c, double exact);

/* Go on with `count` values: f[0], f[stride], ...  Deviations are summed with
 * compensation: the sum is off by less than an ulp of itself and count 2^-105 of
 * the sum of their absolute values. */
void koksma_curve_add(koksma_curve *c, const double *f, size_t stride,
                      size_t count);

/* The rows of the curve so far, in the curve's own memory: valid until the next
 * call on c.  No more values can be added to this curve.
 *
 * Returns: KOKSMA_OK; KOKSMA_EDOMAIN: the sum left the range of a double */
koksma_status koksma_curve_rows(koksma_curve *c, const koksma_curve_row **rows,
                                size_t *count, koksma_error *err);

koksma_curve_total koksma_curve_so_far(const koksma_curve *c);

/* The same row had I been greater by `shift`. */
koksma_curve_row koksma_curve_shifted(koksma_curve_row row, double shift);

/* The root of the mean square of `count` errors, one a replicate, with a
 * delete-one jackknife interval of its logarithm (Student's t, count - 1 degrees
 * of freedom).  There is none for one error, or when all but one are 0. */
koksma_estimate koksma_curve_rms(const double *errors, size_t count, double level);

#endif
