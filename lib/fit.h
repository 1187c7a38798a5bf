#ifndef KOKSMA_FIT_H
#define KOKSMA_FIT_H

#include <stdbool.h>
#include <stddef.h>

#include "num.h"
#include "points.h"

/* The empirical exponent s of an error that falls like N^s, from replicates.
 *
 * With errors e_r(N) of R replicates, s is the least-squares slope of
 * ln rms(N) = ln sqrt(1/R sum_r e_r(N)^2) against ln N, every N with equal weight.
 * The errors of one replicate at different N hang together, so the residuals of
 * that line say nothing about s: intervals made of them miss the truth in up to
 * half of all cases.  Replicates do not hang together: deleting them one at a time
 * gives the jackknife's standard error, and s +- t se, with Student's t of R - 1
 * degrees of freedom, covers as it should.  One path alone gets no interval.
 *
 * Where the line bends there are other models, each with its own jackknife:
 *
 *     rms^2  =  A N^(2s) + B N^-2 ln N     A, B >= 0, -1 <= s <= 0     it flattens
 *     rms^2  =  A N^(2s) + B N^-2
 *     rms    =  C N^-1 (ln N)^k                                        it steepens
 *
 * the first two for a jump beside a smooth part, the last for a smooth part alone.
 * A smooth part that grows more slowly than its ln N makes the s of the first model
 * too large, one that grows at all makes that of the second too small. */

typedef struct koksma_fit_data {
    const double *x;   /* N > 0 */
    const double *y;   /* the error, or any quantity: its absolute value counts */
    const size_t *set; /* which replicate a row belongs to, below sets */
    size_t rows, sets;
} koksma_fit_data;

typedef enum koksma_fit_model {
    KOKSMA_FIT_AUTO, /* two terms where the line flattens and
                      * koksma_fit_can_part holds, else one power */
    KOKSMA_FIT_POWER,
    KOKSMA_FIT_TWO_TERMS, /* beside N^-2 ln N */
    KOKSMA_FIT_TWO_POWERS /* beside N^-2 alone */
} koksma_fit_model;

typedef struct koksma_fit_opts {
    double level; /* of the intervals; 0: 0.95 */
    double from;  /* smallest N used; 0: the smallest there is */
    double to;    /* largest N used; 0: the largest there is */
    double scale; /* of the values whose error this is, max |f|, for the floor; 0:
                   * the largest error in the window */
    koksma_fit_model model;
    double saturation; /* the N up to which nearly every cell meets the jump, so
                        * that the points do as random ones: l^D, l the extent; 0:
                        * not known */
} koksma_fit_opts;

#define KOKSMA_FIT_DEFAULTS                                                        \
    {                                                                              \
        0.0, 0.0, 0.0, 0.0, KOKSMA_FIT_AUTO, 0.0                                   \
    }

/* An exponent, a coefficient, and how well it is known. */
typedef struct koksma_fit_term {
    koksma_estimate value;
    double se;     /* NaN for one path */
    size_t groups; /* deleted in turn: groups - 1 degrees of freedom */
} koksma_fit_term;

/* Whether |t| of the curvature is above 2.6, which one power law in a hundred
 * exceeds by chance. */
typedef enum koksma_fit_shape {
    KOKSMA_SHAPE_UNKNOWN, /* one path */
    KOKSMA_STRAIGHT,
    KOKSMA_FLATTENS,
    KOKSMA_STEEPENS
} koksma_fit_shape;

typedef struct koksma_fit_result {
    koksma_fit_model model;    /* never KOKSMA_FIT_AUTO */
    koksma_fit_term exponent;  /* s of that model */
    double constant;           /* C: rms, or its first term, is about C N^s */
    koksma_fit_term slope;     /* s of one power, whatever the model */
    koksma_fit_term curvature; /* q of ln rms = c + s u + q u^2, u = ln N centred: 0
                    * for a power law; negative when the fall steepens */
    koksma_fit_shape shape;
    koksma_fit_term log_power; /* k; NaN when an N is below 3 */
    double smooth;             /* two terms: sqrt B, else NaN */
    double cross; /* two terms: the N from which on the first is the larger, 0 when
                   * it always is, HUGE_VAL when it never is; else NaN */
    size_t sets;
    size_t used;                       /* N's in the fit */
    size_t missing, zero, below_floor; /* N's in [from, to] left out: koksma_fit */
    double from, to;                   /* the smallest and the largest used */
    double saturation;                 /* as told */
} koksma_fit_result;

/* Fit the exponent.
 *
 * An N in [from, to] is left out when a replicate has no error there (missing),
 * when fewer than half of the replicates have one that is not 0 or all but one are
 * 0 (zero), or when rms(N) is below 2^-50 of the scale, where rounding speaks
 * (below_floor).
 *
 * The two terms are fitted by least squares in ln rms, and their standard error is
 * that of 16 groups of replicates deleted in turn (or of single replicates, where
 * they are fewer).
 *
 * Returns: KOKSMA_OK; KOKSMA_EINVAL: options out of range, or fewer than 3 N's
 *          left (4 for two terms, all above 1), or too close to each other for a
 *          slope; KOKSMA_EDOMAIN: an N not above 0, a number that is not finite, or
 *          two errors of one replicate at one N of the window; KOKSMA_ENOMEM
 * Cost:    rows log rows + used*sets; memory rows + used*sets
 * Source:  jackknife: [Efron 1982, ch. 3] */
koksma_status koksma_fit(koksma_fit_result *out, koksma_fit_data data,
                         const koksma_fit_opts *opts, koksma_error *err);

/* Whether two terms can be told apart: at least 64 replicates and 16 octaves.  With
 * less the exponent of the first is found, but its interval promises too much. */
bool koksma_fit_can_part(const koksma_fit_result *fit);

/* ---- Candidates ------------------------------------------------------------- */

/* One candidate against the exponent.  A test that merely fails to reject would
 * say yes to every candidate when data are few, and to none when they are many; so
 * there are two: the interval may exclude it (rejected), and two one-sided tests
 * at 5 % may place the exponent within `margin` of it (near) [Schuirmann 1987].
 * Both can hold. */
typedef struct koksma_fit_test {
    double z; /* (exponent - candidate)/se; NaN for one path */
    bool rejected, near;
} koksma_fit_test;

koksma_fit_test koksma_fit_try(const koksma_fit_result *fit, double candidate,
                               double margin);

/* Is the exponent the one claimed?
 *   equivalent  it is near, and every rival is rejected
 *   different   otherwise, if the claim is rejected
 *   undecided   otherwise; and always where the window ends below the saturation
 *               and the claim is below -1/2, since that begins above it; and when
 * the curve bends and no model that fits has the data it takes: an exponent that is
 *               nobody's proves nothing */
typedef enum koksma_verdict {
    KOKSMA_NO_VERDICT, /* one path: no interval, no verdict */
    KOKSMA_EQUIVALENT,
    KOKSMA_DIFFERENT,
    KOKSMA_UNDECIDED
} koksma_verdict;

/* Why there is no decision. */
typedef enum koksma_doubt {
    KOKSMA_NO_DOUBT,
    KOKSMA_DOUBT_PATH,     /* one path */
    KOKSMA_DOUBT_BENT,     /* one power, and the line bends */
    KOKSMA_DOUBT_FEW,      /* two terms, and not koksma_fit_can_part */
    KOKSMA_DOUBT_WIDE,     /* the interval is too wide for the margin */
    KOKSMA_DOUBT_RIVAL,    /* near, but a rival is not rejected */
    KOKSMA_DOUBT_SATURATED /* all N are below the saturation */
} koksma_doubt;

typedef struct koksma_judgement {
    koksma_verdict verdict;
    koksma_doubt doubt;
} koksma_judgement;

/* Rivals within 1e-9 of the claim are the claim. */
koksma_judgement koksma_fit_judge(const koksma_fit_result *fit, double claim,
                                  const double *rivals, size_t count,
                                  double margin);

/* -(dim+1)/(2 dim): the exponent for an integrand that jumps across a surface of
 * dim - 1 dimensions, askew to the axes [Szirmay-Kalos, Purgathofer 1998, (12)];
 * its order is that of [Mitchell 1996]. */
double koksma_fit_theory(size_t dim);

/* beta/(2 dim) - 1: the same across a set of box dimension beta, dim - 1 <= beta
 * <= dim, since N^(beta/dim) of N cells meet it. */
double koksma_fit_theory_box(size_t dim, double beta);

/* The N from which on an error of sqrt(S/6) J N^(-(D+1)/2D), as a point in each of
 * N cells makes it across a jump J on an area S, is below sigma/sqrt(N), that of
 * random points:
 *
 *     (S J^2 / (6 sigma^2))^D                        infinite where that overflows
 */
double koksma_fit_break_even(size_t dim, double area, double jump, double sigma);

#endif
