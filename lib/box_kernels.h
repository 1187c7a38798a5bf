#ifndef KI_BOX_KERNELS_H
#define KI_BOX_KERNELS_H

#include "box.h"
#include "tree_kernels.h"

/* Private: the kernels of the box discrepancy.  Boxes have 2*dim sides. */

/* What the tree asks of it. */
extern const ki_measure ki_box_measure;

/* A kernel: it offers boxes to b, and leaves in *upper what no box deviates above,
 * in *work the steps that it took, and in *stopped whether it was told to stop.
 * Returns KOKSMA_OK, also when stopped, or KOKSMA_ENOMEM. */
typedef koksma_status ki_box_kernel(ki_best *b, const ki_run_opts *opts,
                                    double *upper, double *work, bool *stopped);

ki_box_kernel ki_box_sweep; /* dim 1 and 2; n < 2^31 */

#endif
