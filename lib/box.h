#ifndef KOKSMA_BOX_H
#define KOKSMA_BOX_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "num.h"
#include "points.h"

/* The box discrepancy (extreme, or unanchored discrepancy) of n points x_i in
 * [0,1]^dim is
 *
 *     E  =  sup over 0 <= a_k <= b_k <= 1, k = 1, ..., dim, of
 *           max( vol(a,b) - open(a,b)/n ,  closed(a,b)/n - vol(a,b) )
 *
 * where vol is the product of the b_k - a_k, open(a,b) counts the points with
 * a_k < x_k < b_k for every k, and closed(a,b) those with a_k <= x_k <= b_k.  It
 * has no unit, lies in (0,1], and D* <= E <= 2^dim D* for the star discrepancy D*
 * [Niederreiter 1992, prop. 2.4].  [Dobkin, Eppstein, Mitchell 1996] measure
 * patterns of samples by it.
 *
 * A point on a face of a box, be it a face of the cube too, is inside the closed
 * box and outside the open one.  For points in [0,1)^dim this is the textbook's
 * supremum over half-open boxes [a,b), which come as near as one likes to open
 * ones and to closed ones.  Where a coordinate is 1 the two definitions part: the
 * points (0,0), (0,1) have E = 1 here, by the closed box [0,0] x [0,1]. */

/* A box and the points in it: the evidence for a lower bound.  Anyone can recount
 * it: koksma_box_between does. */
typedef struct koksma_box_witness {
    double *corners; /* 2*dim numbers, a and then b, room given by the caller; NULL:
                      * not wanted */
    size_t inside;   /* points in the box */
    bool closed;     /* whether it includes its faces */
} koksma_box_witness;

/* All find the same value and witness, to the last bit. */
typedef enum koksma_box_method {
    KOKSMA_BOX_AUTO,  /* the sweep for dim 1, and for dim 2 where n E is small or n
                       * is; else the tree */
    KOKSMA_BOX_SWEEP, /* of the plane, and of the line: every left side, skipping
                       * what a neighbour shows to be in vain; dim 1 and 2 */
    KOKSMA_BOX_TREE,  /* branch and bound */
    KOKSMA_BOX_SEARCH /* a heuristic: good boxes, until none better is found for
                       * long; no upper bound but 1 */
} koksma_box_method;

typedef struct koksma_box_result {
    koksma_interval value;      /* E lies in [value.lower, value.upper] */
    koksma_box_witness witness; /* its local discrepancy is at least value.lower */
    koksma_box_method method;   /* which one ran; the search, where it was stopped
                                 * before there was another */
    double work; /* its steps: nodes for the sweep, entries of lists of points for
                  * the tree, points looked at for the search */
} koksma_box_result;

typedef struct koksma_box_opts {
    koksma_box_method method;
    /* The sweep and the tree stop at upper <= (1 + tolerance) lower; 0: exact. */
    double tolerance;
    /* The tree works towards that in stages, which takes two to three times as long
     * in all, but has an upper bound when it is stopped. */
    bool anytime;
    size_t threads;     /* of the sweep and the tree; 0: one a processor */
    size_t part, parts; /* 1 <= part <= parts: they do this share of the work, and
                         * find a part_lower and a part_upper, whose maxima over all
                         * parts are value, if one build on one kind of processor
                         * does all; parts 0 or 1: all of it */
    double work;        /* stop after about so many steps; 0: never */
    uint64_t seed;      /* of the search: it fixes every bit of the result */
    /* Called a few times a second, by the first two also when value improves; by
     * any thread, but by one at a time.  NULL: never. */
    koksma_progress *progress;
    void *state; /* handed to progress */
} koksma_box_opts;

#define KOKSMA_BOX_DEFAULTS                                                        \
    {                                                                              \
        KOKSMA_BOX_AUTO, 0.0, false, 0, 1, 1, 0.0, 1, NULL, NULL                   \
    }

/* Bound the box discrepancy of p.
 *
 * Out:     out    value: exact but for rounding, one or two units in the last
 *                 place wide, unless a tolerance is given; witness: the best
 *                 box, if closed with a point of its own on each side, of equally
 *                 good ones that with the lexicographically least corners,
 *                 compared with twice the precision of a double (with a
 *                 tolerance: some box).  By the search: [found, 1] and
 *                 the box found.  out->witness.corners is an input too: NULL, or
 *                 room for 2*dim doubles
 *          err    filled on failure; may be NULL
 * In:      p      n < 2^31 points in [0,1]^dim, ties allowed
 *          opts   NULL means KOKSMA_BOX_DEFAULTS
 * Returns: KOKSMA_OK; KOKSMA_STOPPED when progress said so or the work ran out:
 *          value is then true, but wider; KOKSMA_EINVAL or KOKSMA_EDOMAIN as
 *          koksma_points_check, and for options out of range; KOKSMA_ENOMEM
 * Cost:    as follows; memory grows like n*dim
 *
 *     sweep   n log n for dim 1; about n^2 log n for dim 2 where nothing is skipped
 *     tree    no useful bound: about that of the star discrepancy in 2*dim
 *             dimensions; measured on Halton points about n^2 for dim 2 and n^2.2
 *             for dim 3
 *     search  about that of koksma_star's in 2*dim dimensions
 *
 * Source:  the definition: [Dobkin, Eppstein, Mitchell 1996]; the methods are
 *          Koksma's own, proven in lib/box_bound.c and lib/box_sweep.c */
koksma_status koksma_box_discrepancy(koksma_box_result *out, koksma_points p,
                                     const koksma_box_opts *opts,
                                     koksma_error *err);

/* Recount a box: the interval, at most two units in the last place wide or dim
 * 2^-97, of vol - open/n or of closed/n - vol, by w->closed.  w->inside is not
 * read. p must have passed koksma_points_check and w->corners hold 2*dim numbers of
 * [0,1] with a_k <= b_k.
 *
 * Cost: n*dim */
koksma_interval koksma_box_between(const koksma_box_witness *w, koksma_points p);

#endif
