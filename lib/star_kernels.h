#ifndef KI_STAR_KERNELS_H
#define KI_STAR_KERNELS_H

#include "star.h"
#include "tree_kernels.h"

/* Private: the kernels of the star discrepancy.  Boxes have dim sides. */

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

/* What the tree asks of the star discrepancy. */
extern const ki_measure ki_star_measure;

/* What a search in threads needs to know of the options. */
ki_run_opts ki_star_run_opts(const koksma_star_opts *opts);

#endif
