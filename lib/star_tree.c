#include <math.h>

#include "star_kernels.h"

/* The tree and its climbs, for boxes with a corner in the origin. */

/* Closed boxes with a side of length 0 have no volume, and no logarithm: the one
 * that matters along each axis holds the points at 0 there, and no more. */
static void offer_flat_boxes(ki_run *r, double *corner)
{
    koksma_points p = r->best->p;

    for (size_t k = 0; k < p.dim; k++) {
        size_t inside = 0;

        for (size_t l = 0; l < p.dim; l++)
            corner[l] = 0.0;
        for (size_t i = 0; i < p.n; i++) {
            const double *x = p.x + i * p.dim;

            if (x[k] > 0.0) continue;
            inside++;
            for (size_t l = 0; l < p.dim; l++)
                corner[l] = fmax(corner[l], x[l]);
        }
        if (inside > 0) ki_run_offer(r, corner, inside, true);
    }
}

koksma_status ki_star_tree(ki_best *b, const koksma_star_opts *opts, double *upper,
                           double *work, bool *stopped)
{
    ki_run_opts shared = ki_star_run_opts(opts);

    return ki_tree(b, &shared, &ki_star_measure, offer_flat_boxes, upper, work,
                   stopped);
}

koksma_status ki_star_search(ki_best *b, const koksma_star_opts *opts,
                             double *upper, double *work, bool *stopped)
{
    ki_run_opts shared = ki_star_run_opts(opts);

    return ki_tree_search(b, &shared, &ki_star_measure, KI_PATIENCE, upper, work,
                          stopped);
}
