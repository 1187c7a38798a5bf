#ifndef KOKSMA_STAR_H
#define KOKSMA_STAR_H

#include <stdbool.h>
#include <stddef.h>

#include "num.h"
#include "points.h"

/* The star discrepancy of n points x_i in [0,1]^dim is
 *
 *     D*  =  sup over c in [0,1]^dim of
 *            max( vol[0,c) - open(c)/n ,  closed(c)/n - vol[0,c] )
 *
 * where open(c) counts the points strictly below c in every coordinate and
 * closed(c) those below c or on it.  It has no unit and lies in (0,1].  For
 * points in [0,1)^dim this is [Niederreiter 1992, def. 2.1].  A coordinate
 * equal to 1 is inside closed boxes only, and there the two definitions part:
 * the points (0,0), (0,1) have D* = 1 here, and 1/2 with half-open boxes alone. */

/* A box [0,corner) or [0,corner] and the points in it: the evidence for a lower
 * bound.  Anyone can recount it: koksma_box_local does. */
typedef struct koksma_box {
    double *corner; /* dim numbers, room given by the caller; NULL: not wanted */
    size_t inside;  /* points in the box */
    bool closed;    /* whether the box includes its upper faces */
} koksma_box;

typedef struct koksma_star_result {
    koksma_interval value; /* D* lies in [value.lower, value.upper] */
    koksma_box witness;    /* its local discrepancy is at least value.lower */
    double work;           /* corners visited */
} koksma_star_result;

typedef struct koksma_star_opts {
    double work; /* stop after about so many corners; 0: KOKSMA_STAR_WORK */
    koksma_progress *progress; /* called every 2^20 corners or so; NULL: never */
    void *state;               /* handed to progress */
} koksma_star_opts;

/* Corners visited before koksma_star gives up unless told otherwise, 2^36: a
 * minute or so. */
#define KOKSMA_STAR_WORK 68719476736.0

#define KOKSMA_STAR_DEFAULTS                                                       \
    {                                                                              \
        0.0, NULL, NULL                                                            \
    }

/* Bound the star discrepancy of p.
 *
 * Out:     out    value: exact but for rounding, one or two units in the last
 *                 place wide; witness: of the boxes whose deviation, rounded to
 *                 such an interval, is the best the one with the lexicographically
 *                 least corner.  out->witness.corner
 *                 is an input too: NULL, or room for dim doubles
 *          err    filled on failure; may be NULL
 * In:      p      n points in [0,1]^dim, ties allowed
 *          opts   NULL means KOKSMA_STAR_DEFAULTS
 * Returns: KOKSMA_OK; KOKSMA_STOPPED when progress said so or the work ran out:
 *          value is then [found, 1]; KOKSMA_EINVAL or KOKSMA_EDOMAIN as
 *          koksma_points_check, and when opts->work is not >= 0; KOKSMA_ENOMEM
 * Cost:    n log n for dim 1, n^2 for dim 2, below n^dim above (every corner that
 *          a point can hold up is visited); memory n*dim
 * Source:  the critical corners: [Niederreiter 1992, thm 2.6] for dim 1,
 *          [Bundschuh, Zhu 1993] for dim 2 and 3 */
koksma_status koksma_star(koksma_star_result *out, koksma_points p,
                          const koksma_star_opts *opts, koksma_error *err);

/* Recount a box: the interval, at most two units in the last place wide, of
 * vol - open/n or of closed/n - vol, by box->closed.  box->inside is not read.
 * p must have passed koksma_points_check and box->corner hold dim numbers.
 *
 * Cost: n*dim */
koksma_interval koksma_box_local(const koksma_box *box, koksma_points p);

#endif
