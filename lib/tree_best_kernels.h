#ifndef KI_TREE_BEST_KERNELS_H
#define KI_TREE_BEST_KERNELS_H

#include <stdbool.h>
#include <stdint.h>

#include "num_kernels.h"
#include "points.h"

/* Private: the incumbent to which the kernels of the star and of the box
 * discrepancy offer their boxes.
 *
 * A box has so many sides: dim, the upper ends of a box with a corner in the
 * origin; or 2*dim, the lower ends of a box and then the upper ones.  The numbers
 * of an anchored box are below those of any point's count when it is open: then
 * 0 is inside.  With 2*dim sides an open box has no point on any of its faces. */

/* A box and the points in it. */
typedef struct ki_witness {
    double *corner; /* its sides */
    size_t inside;
    bool closed;
} ki_witness;

/* The best box so far.  A kernel works with deviations in plain doubles, off by
 * less than half of `slack`.  Only those above `bar` can matter, even as ties,
 * and ki_best_offer evaluates them with twice the precision; so value.lower is
 * proven by the witness and no box seen so far deviates by more than value.upper.
 */
typedef struct ki_best {
    koksma_points p;
    size_t sides; /* p.dim or 2 * p.dim */
    koksma_interval value;
    ki_witness witness;
    ki_twofold excess; /* n times its local discrepancy */
    /* The greatest value.lower so far: the discrepancy is not below it, though a box
     * that may tie can widen value by an ulp later on. */
    double proven;
    double slack;
    double bar; /* value.lower - slack */
} ki_best;

/* corner has room for the sides, all 0, and outlives what is returned. */
ki_best ki_best_begin(koksma_points p, double *corner);       /* anchored boxes */
ki_best ki_best_begin_between(koksma_points p, double *both); /* any boxes */

/* The interval of a box's local discrepancy. */
koksma_interval ki_box_deviation(koksma_points p, const double *corner,
                                 size_t sides, size_t inside, bool closed);

/* The points in a box. */
size_t ki_box_count(koksma_points p, const double *corner, size_t sides,
                    bool closed);

/* Offer the box at corner; one whose sides cross is nothing.  A kernel that cannot
 * tell tied coordinates apart may give a count that understates the deviation (too
 * high for an open box, too low for a closed one), if it also offers the same
 * corner with the true count: the true one then wins, by 1/n at least. */
void ki_best_offer(ki_best *b, const double *corner, size_t inside, bool closed);

/* A coordinate of point i. */
typedef struct ki_keyed {
    double x;
    uint32_t i;
} ki_keyed;

/* Sort coordinate k of all points; n < 2^31.  a and b have room for n each, and the
 * one returned holds them in order, tied ones in the order of the points.  -0 has
 * become 0. */
ki_keyed *ki_sort_axis(koksma_points p, size_t k, ki_keyed *a, ki_keyed *b);

#endif
