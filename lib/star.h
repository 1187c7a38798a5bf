#ifndef KOKSMA_STAR_H
#define KOKSMA_STAR_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

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

/* All find the same value and witness, to the last bit. */
typedef enum koksma_star_method {
    KOKSMA_STAR_AUTO, /* the sweep for dim 1 and for few corners (2^16 for dim 2 and
                       * 3, else 2^20), or else lines for dim 2 and 3 and the tree
                       * above */
    KOKSMA_STAR_SWEEP, /* visit every corner that a point can hold up */
    KOKSMA_STAR_TREE,  /* branch and bound */
    KOKSMA_STAR_LINES, /* divide and conquer with filtered lines, dim 2 and 3 */
    KOKSMA_STAR_DEM,   /* Dobkin, Eppstein and Mitchell: a second opinion */
    KOKSMA_STAR_SEARCH /* a heuristic: good boxes, until none better is found for
                        * long; no upper bound but 1 */
} koksma_star_method;

typedef struct koksma_star_result {
    koksma_interval value;     /* D* lies in [value.lower, value.upper] */
    koksma_box witness;        /* its local discrepancy is at least value.lower */
    koksma_star_method method; /* which one ran */
    double work; /* its steps: corners for the sweep, entries of lists of
                  * points for the tree, lines of cells for lines, products of
                  * sides for dem, points looked at for the search */
} koksma_star_result;

typedef struct koksma_star_opts {
    koksma_star_method method;
    /* The tree and the lines stop at upper <= (1 + tolerance) lower; 0: exact. */
    double tolerance;
    /* They work towards that in stages, which takes two to three times as long in
     * all, but has an upper bound when it is stopped. */
    bool anytime;
    size_t threads;     /* of the tree and the lines; 0: one a processor */
    size_t part, parts; /* 1 <= part <= parts: they do this share of the work,
                         * and find a part_lower and a part_upper, whose maxima
                         * over all parts are value, if one build on one kind of
                         * processor does all; parts 0 or 1: all of it */
    double work;   /* stop after about so many steps; 0: after KOKSMA_STAR_WORK for
                    * the sweep, never for the others */
    uint64_t seed; /* of the search: it fixes every bit of the result */
    /* Called a few times a second, by these two also when value improves; by any
     * thread, but by one at a time.  NULL: never. */
    koksma_progress *progress;
    void *state; /* handed to progress */
} koksma_star_opts;

/* Corners that the sweep visits unless told otherwise, 2^36: a minute or so. */
#define KOKSMA_STAR_WORK 68719476736.0

#define KOKSMA_STAR_DEFAULTS                                                       \
    {                                                                              \
        KOKSMA_STAR_AUTO, 0.0, false, 0, 1, 1, 0.0, 1, NULL, NULL                  \
    }

/* Bound the star discrepancy of p.
 *
 * Out:     out    value: exact but for rounding, one or two units in the last
 *                 place wide, unless a tolerance is given; witness: the best
 *                 box, of equally good ones that with the lexicographically
 *                 least corner, compared with twice the precision of a double
 *                 (with a tolerance: some box).  By the search: [found, 1] and
 *                 the box found.  out->witness.corner is an input too: NULL, or
 *                 room for dim doubles
 *          err    filled on failure; may be NULL
 * In:      p      n < 2^31 points in [0,1]^dim, ties allowed
 *          opts   NULL means KOKSMA_STAR_DEFAULTS
 * Returns: KOKSMA_OK; KOKSMA_STOPPED when progress said so or the work ran out:
 *          value is then true, but wider; KOKSMA_EINVAL or KOKSMA_EDOMAIN as
 *          koksma_points_check, and for options out of range; KOKSMA_ENOMEM
 * Cost:    as follows; memory grows like n*dim
 *
 *     sweep   n log n for dim 1, n^2 for dim 2, below n^dim above
 *     tree    no useful bound; measured on Halton points about n^1.5 for dim 3, n^2
 *             for dim 4 and n^2.7 for dim 8; memory times the depth of the search
 *             at worst, for each thread
 *     lines   n^dim at worst; measured about n log n for dim 2, where 10^6 points
 *             take a second or less, and n^1.7 for dim 3; 200 n bytes
 *     dem     n^(1+dim/2) for a given dim >= 2, and more only where many boxes tie
 *             for the best
 *     search  measured, 2 n*dim^2 microseconds
 *
 * Source:  critical corners: [Niederreiter 1992, thm 2.6] for dim 1, [Bundschuh,
 *          Zhu 1993] above; dem: [Dobkin, Eppstein, Mitchell 1996]; the tree, the
 *          lines and the search are Koksma's own, proven in lib/star_bound.c and
 *          lib/star_lines_thin.c */
koksma_status koksma_star(koksma_star_result *out, koksma_points p,
                          const koksma_star_opts *opts, koksma_error *err);

/* Recount a box: the interval, at most two units in the last place wide or dim
 * 2^-97, of vol - open/n or of closed/n - vol, by box->closed.  box->inside is not
 * read.
 * p must have passed koksma_points_check and box->corner hold dim numbers.
 *
 * Cost: n*dim */
koksma_interval koksma_box_local(const koksma_box *box, koksma_points p);

#endif
