#ifndef KOKSMA_FIT_H
#define KOKSMA_FIT_H

#include <stddef.h>

#include "num.h"
#include "points.h"

/* The empirical exponent s of an error that falls like N^s, from replicates.
 *
 * With errors e_r(N) of R replicates, s is the least-squares slope of
 * ln sqrt(1/R sum_r e_r(N)^2) against ln N, every N with equal weight.  The errors
 * of one replicate at different N hang together, so the residuals of that line
 * say nothing about s: intervals made of them miss the truth in up to half of
 * all cases.  Replicates do not hang together: deleting them one at a time gives
 * the jackknife's standard error, and s +- t se, with Student's t of R - 1
 * degrees of freedom, covers as it should.  One path alone gets no interval. */

typedef struct koksma_fit_data {
    const double *x;   /* N > 0 */
    const double *y;   /* the error, or any quantity: its absolute value counts */
    const size_t *set; /* which replicate a row belongs to, below sets */
    size_t rows, sets;
} koksma_fit_data;

typedef struct koksma_fit_opts {
    double level; /* of the intervals; 0: 0.95 */
    double from;  /* smallest N used; 0: 8 */
    double to;    /* largest N used; 0: all */
} koksma_fit_opts;

#define KOKSMA_FIT_DEFAULTS                                                        \
    {                                                                              \
        0.0, 0.0, 0.0                                                              \
    }

typedef struct koksma_fit_result {
    koksma_estimate exponent;
    koksma_estimate
        curvature;   /* q of ln rms = c + s u + q u^2, u = ln N centred: 0
                      * for a power law; negative when the fall steepens */
    double constant; /* rms is about constant * N^exponent */
    double exponent_se, curvature_se; /* NaN for one path */
    size_t sets;
    size_t used;     /* N's in the line */
    size_t dropped;  /* N's in [from, to] left out: see koksma_fit */
    double from, to; /* the smallest and the largest used */
} koksma_fit_result;

/* Fit the exponent.
 *
 * An N in [from, to] is left out when a replicate has no error there, when fewer
 * than half of the replicates have one that is not 0, when all but one are 0, or
 * when the root mean square is below 2^-50 of the largest error in the window,
 * where rounding speaks.
 *
 * Returns: KOKSMA_OK; KOKSMA_EINVAL: options out of range, or fewer than 3 N's
 *          left or too close to each other for a slope; KOKSMA_EDOMAIN: an N not
 *          above 0, a number that is not finite, or two errors of one replicate at
 *          one N of the window; KOKSMA_ENOMEM
 * Cost:    rows log rows + used*sets^2; memory rows + used*sets
 * Source:  jackknife: [Efron 1982, ch. 3] */
koksma_status koksma_fit(koksma_fit_result *out, koksma_fit_data data,
                         const koksma_fit_opts *opts, koksma_error *err);

/* Is the exponent the candidate's?  A test that merely fails to reject would say
 * so of every candidate when data are few, and of none when they are many; so
 * "equivalent" means that two one-sided tests at 5 % place the exponent within
 * `margin` of the candidate [Schuirmann 1987], "different" that its interval
 * excludes the candidate, and otherwise it is undecided. */
typedef enum koksma_verdict {
    KOKSMA_NO_VERDICT, /* one path: no interval, no verdict */
    KOKSMA_EQUIVALENT,
    KOKSMA_DIFFERENT,
    KOKSMA_UNDECIDED
} koksma_verdict;

typedef struct koksma_comparison {
    double t; /* (exponent - candidate)/se; NaN for one path */
    koksma_verdict verdict;
} koksma_comparison;

koksma_comparison koksma_fit_compare(const koksma_fit_result *fit, double candidate,
                                     double margin);

/* -(dim+1)/(2 dim): the exponent for an integrand that jumps across a surface of
 * dim - 1 dimensions, askew to the axes [Szirmay-Kalos, Purgathofer 1998, (12)];
 * its order is that of [Mitchell 1996]. */
double koksma_fit_theory(size_t dim);

#endif
