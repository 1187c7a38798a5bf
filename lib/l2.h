#ifndef KOKSMA_L2_H
#define KOKSMA_L2_H

#include <stddef.h>

#include "num.h"
#include "points.h"

/* Discrepancies in the mean square of n points x_i in [0,1]^dim.  For a kernel K
 * that is a product over the coordinates, K(x,y) = k(x_1,y_1) ... k(x_dim,y_dim),
 *
 *     L2^2  =  c^dim  -  2/n sum_i h(x_i)  +  1/n^2 sum_i sum_j K(x_i,x_j)
 *
 * where h is the integral of K over one argument, itself a product, and c that of k
 * over both.  Of a single coordinate, with t = |x - 1/2|, t' = |y - 1/2|, s =
 * |x-y|:
 *
 *     kind        k(x,y)                               h                   c
 *     star        1 - max(x,y)                         (1 - x^2)/2         1/3
 *     extreme     min(x,y) - xy                        x(1 - x)/2          1/12
 *     periodic    1/2 - s + s^2                        1/3                 1/3
 *     centered    1 + (t + t' - s)/2                   1 + (t - t^2)/2     13/12
 *     wraparound  3/2 - s + s^2                        4/3                 4/3
 *     mixture     15/8 - (t + t' + 3s)/4 + s^2/2       5/3 - (t + t^2)/4   19/12
 *     symmetric   2 (1 - s)                            1 + 2x - 2x^2       4/3
 *
 * star is the root mean square over all c of vol[0,c) - open(c)/n [Warnock 1972];
 * extreme the same over all boxes [a,b), and periodic over those on the torus
 * [Hinrichs, Kritzinger, Pillichshammer 2021]; centered, wraparound, symmetric:
 * [Hickernell 1998a; 1998b]; mixture: [Zhou, Fang, Ning 2013].
 *
 * Faces do not count in a mean square: points on them, ties and repeated points
 * need no rule. */
typedef enum koksma_l2_kind {
    KOKSMA_L2_STAR,
    KOKSMA_L2_EXTREME,
    KOKSMA_L2_PERIODIC,
    KOKSMA_L2_CENTERED,
    KOKSMA_L2_WRAPAROUND,
    KOKSMA_L2_MIXTURE,
    KOKSMA_L2_SYMMETRIC,
    KOKSMA_L2_KINDS /* how many there are */
} koksma_l2_kind;

/* Their names, in the order of the kinds. */
extern const char *const koksma_l2_names[KOKSMA_L2_KINDS];

typedef enum koksma_l2_method {
    KOKSMA_L2_AUTO,  /* whichever is expected to be faster */
    KOKSMA_L2_PAIRS, /* the formula: every pair of points, in doubles */
    KOKSMA_L2_DIVIDE /* divide and conquer, in twice the precision: more accurate,
                      * and faster for many points in few dimensions */
} koksma_l2_method;

/* The most dimensions that KOKSMA_L2_DIVIDE takes, and for the kinds periodic,
 * wraparound, mixture and symmetric. */
#define KOKSMA_L2_DIVIDE_DIM 16
#define KOKSMA_L2_DIVIDE_DIM_TERMS 6

typedef struct koksma_l2_result {
    koksma_interval value;   /* L2 lies in [value.lower, value.upper] */
    koksma_interval squared; /* and L2^2 in this one */
    /* And the decimal logarithm of L2 in this one, also where L2 leaves the range
     * of a double; lower is -HUGE_VAL where nothing above 0 is proven. */
    koksma_interval log10;
    koksma_l2_method method; /* which one ran */
    double work; /* its steps: pairs of coordinates, or points in lists merged */
} koksma_l2_result;

typedef struct koksma_l2_opts {
    koksma_l2_kind kind;
    koksma_l2_method method;
    size_t threads; /* 0: one a processor; the result does not depend on it */
    /* Called after each of some hundred parts, by any thread, but by one at a time.
     * The interval that it is told is [0, HUGE_VAL].  NULL: never. */
    koksma_progress *progress;
    void *state; /* handed to progress */
} koksma_l2_opts;

#define KOKSMA_L2_DEFAULTS                                                         \
    {                                                                              \
        KOKSMA_L2_STAR, KOKSMA_L2_AUTO, 0, NULL, NULL                              \
    }

/* Bound a discrepancy of p in the mean square.
 *
 * Out:     out    intervals that contain the truth, every rounding counted.  By
 *                 divide squared is about 1e-22 wide for dim 2 and a million
 *                 points; by pairs some dim 1e-15 times the mean of K
 *          err    filled on failure; may be NULL
 * In:      p      n < 2^31 points in [0,1]^dim, ties allowed
 *          opts   NULL means KOKSMA_L2_DEFAULTS
 * Returns: KOKSMA_OK; KOKSMA_STOPPED when progress said so: the intervals are then
 *          [0, HUGE_VAL] and the like; KOKSMA_EINVAL or KOKSMA_EDOMAIN as
 *          koksma_points_check, and for options out of range; KOKSMA_ENOMEM
 * Cost:    pairs: dim n^2, memory n*dim; divide: n (log n)^(dim-1), and for
 *          symmetric, periodic, wraparound and mixture also n (log n)^(m-1) for
 *          each choice of m coordinates, times 2^(dim-m) or 3^(dim-m); memory
 *          n*dim times the threads
 * Source:  pairs: [Warnock 1972]; divide: after [Heinrich 1996], who cuts along
 *          one axis after the other; lib/l2_divide.c proves it */
koksma_status koksma_l2(koksma_l2_result *out, koksma_points p,
                        const koksma_l2_opts *opts, koksma_error *err);

#endif
