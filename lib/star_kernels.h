#ifndef KI_STAR_KERNELS_H
#define KI_STAR_KERNELS_H

#include <stdint.h>

#include "num_kernels.h"
#include "star.h"

/* Private: the incumbent to which the kernels of the star discrepancy offer
 * their boxes, and the kernels. */

/* The best box so far.  A kernel works with deviations in plain doubles, off by
 * less than half of `slack`.  Only those above `bar` can matter, even as ties,
 * and ki_best_offer evaluates them with twice the precision; so value.lower is
 * proven by the witness and no box seen so far deviates by more than value.upper.
 */
typedef struct ki_best {
    koksma_points p;
    koksma_interval value;
    koksma_box witness; /* its corner has room for p.dim doubles */
    ki_twofold excess;  /* n times its local discrepancy */
    double proven; /* the greatest value.lower so far: D* is not below it, though a
                    * box that may tie can widen value by an ulp later on */
    double slack;
    double bar; /* value.lower - slack */
} ki_best;

/* corner has room for p.dim numbers, all 0, and outlives what is returned. */
ki_best ki_best_begin(koksma_points p, double *corner);

/* The interval of a box's local discrepancy, as koksma_box_local has it. */
koksma_interval ki_box_deviation(koksma_points p, const double *corner,
                                 size_t inside, bool closed);

/* Offer the box at corner.  A kernel that cannot tell tied coordinates apart may
 * give a count that understates the deviation (too high for an open box, too low
 * for a closed one), if it also offers the same corner with the true count: the
 * true one then wins, by 1/n at least. */
void ki_best_offer(ki_best *b, const double *corner, size_t inside, bool closed);

/* A kernel: it offers boxes to b, and leaves in *upper what no box deviates above,
 * in *work the steps that it took, and in *stopped whether it was told to stop.
 * Returns KOKSMA_OK, also when stopped, or KOKSMA_ENOMEM. */
typedef koksma_status ki_star_kernel(ki_best *b, const koksma_star_opts *opts,
                                     double *upper, double *work, bool *stopped);

ki_star_kernel ki_star_sweep; /* visit every critical corner */
ki_star_kernel ki_star_tree;  /* branch and bound; n < 2^31 */
ki_star_kernel ki_star_dem; /* a partition, and dynamic programming in its cells */
ki_star_kernel ki_star_search; /* the heuristic alone; n < 2^31 */

/* Divide and conquer with filtered lines, for dim 2 and 3; else the same. */
koksma_status ki_star_lines(ki_best *b, const koksma_star_opts *opts, double *upper,
                            double *work, bool *stopped);

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
