#ifndef KOKSMA_EDGE_H
#define KOKSMA_EDGE_H

#include <stdbool.h>
#include <stddef.h>

#include "num.h"
#include "points.h"

/* The half-plane discrepancy of n points in the unit square is
 *
 *     D  =  sup over closed half-planes H of
 *           #{ i : x_i in H }/n  -  area of H within the square
 *
 * It has no unit and lies in (0,1].  Half-planes with too few points need no
 * mention: an open half-plane lacks exactly what its complement, a closed one, has
 * too many.  So D is also the supremum of |count/n - area| over all half-planes,
 * open and closed, which is the discrepancy for arbitrary edges of [Dobkin,
 * Eppstein, Mitchell 1996].  A point on the border of the square is inside of the
 * closed half-plane beyond that border, which has no area: the points (0,0), (0,1)
 * have D = 1. */

/* The closed half-plane to the left of the line that goes from one point to
 * another: H = { p : (to - from) x (p - from) >= 0 }.  Anyone can recount it:
 * koksma_half_plane_local does. */
typedef struct koksma_half_plane {
    double from[2]; /* in the unit square */
    double to[2];   /* in [-1,2]^2, and not from */
    size_t inside;  /* points in the half-plane */
} koksma_half_plane;

/* Both find the same value and witness, to the last bit. */
typedef enum koksma_edge_method {
    KOKSMA_EDGE_AUTO,  /* the sweep for n <= 64, the tree above */
    KOKSMA_EDGE_SWEEP, /* turn a line about each of the points */
    KOKSMA_EDGE_TREE   /* branch and bound */
} koksma_edge_method;

typedef struct koksma_edge_result {
    koksma_interval value;     /* D lies in [value.lower, value.upper] */
    koksma_half_plane witness; /* its local discrepancy is at least value.lower */
    koksma_edge_method method; /* which one ran */
    double work;               /* its steps: points looked at */
} koksma_edge_result;

typedef struct koksma_edge_opts {
    koksma_edge_method method;
    /* The tree stops at upper <= (1 + tolerance) lower; 0: exact. */
    double tolerance;
    /* It works towards that in stages, which takes about twice as long in all, but
     * has an upper bound when it is stopped. */
    bool anytime;
    size_t threads; /* 0: one a processor */
    /* Called a few times a second, and when value improves; by any thread, but by
     * one at a time.  NULL: never. */
    koksma_progress *progress;
    void *state; /* handed to progress */
} koksma_edge_opts;

#define KOKSMA_EDGE_DEFAULTS                                                       \
    {                                                                              \
        KOKSMA_EDGE_AUTO, 0.0, false, 0, NULL, NULL                                \
    }

/* Bound the half-plane discrepancy of p.
 *
 * Out:     out    value: exact but for rounding, one or two units in the last
 *                 place wide, unless a tolerance is given; witness: the best
 *                 half-plane, of equally good ones that with the
 *                 lexicographically least (from, to), compared with twice the
 *                 precision of a double (with a tolerance: some half-plane).
 *                 from and to are the first and the last of the points on the
 *                 line; where it meets one alone, the ends of the chord that
 *                 this point halves
 *          err    filled on failure; may be NULL
 * In:      p      n < 2^31 points in [0,1]^2, ties and repeats allowed
 *          opts   NULL means KOKSMA_EDGE_DEFAULTS
 * Returns: KOKSMA_OK; KOKSMA_STOPPED when progress said so: value is then true,
 *          but wider; KOKSMA_EINVAL or KOKSMA_EDOMAIN as koksma_points_check,
 *          and for options out of range or dim other than 2; KOKSMA_ENOMEM
 * Cost:    sweep: n^2 log n.  tree: measured on Halton points about n^1.6; it
 *          hands over to the sweep when it has taken about as long, which happens
 *          where points crowd on a line or in a spot.  Memory grows like n, for
 *          each thread
 * Source:  the definition: [Dobkin, Eppstein, Mitchell 1996]; which lines matter is
 *          proven in lib/edge_kernels.h, the tree in lib/edge_tree.c and
 *          lib/edge_cell.c */
koksma_status koksma_edge(koksma_edge_result *out, koksma_points p,
                          const koksma_edge_opts *opts, koksma_error *err);

/* Recount a half-plane: the interval, at most two units in the last place wide or
 * 2^-93, of count/n - area.  h->inside is not read.  p must have passed
 * koksma_points_check and have two coordinates.
 *
 * Cost: n */
koksma_interval koksma_half_plane_local(const koksma_half_plane *h,
                                        koksma_points p);

#endif
