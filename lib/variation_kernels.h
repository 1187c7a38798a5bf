#ifndef KI_VARIATION_KERNELS_H
#define KI_VARIATION_KERNELS_H

#include <math.h>

#include "num_kernels.h"
#include "rng.h"
#include "variation.h"

/* Private: what the ways to a grid's variation share. */

/* Below that a difference of 2^order values, of which top is the largest, counts
 * as 0.  A difference of two is right to an ulp of itself. */
static inline double ki_variation_floor(double top, size_t order)
{
    return order < 2 ? 0.0 : ldexp(top, (int)order - 52);
}

/* What is done so far, and whom to tell. */
typedef struct ki_variation_watch {
    koksma_progress *progress; /* NULL: nobody */
    void *state;
    double value; /* V_k of the finest grid that is done */
    double work;  /* values of the function */
    double told;  /* how many there were when it was last told */
} ki_variation_watch;

/* Whether to stop. */
static inline bool ki_variation_told_to_stop(ki_variation_watch *w)
{
    if (w->progress == NULL || w->work < w->told + 0x1p12) return false;
    w->told = w->work;
    return w->progress(w->state, w->value, w->value, w->work) != 0;
}

/* |Delta| of f at the cell of the k-grid whose lower corner is at `low`, for the
 * axes in u; x holds the others already, and has room for dim numbers.  Where a
 * value is not finite, that value, with x its place.  *work counts the values. */
double ki_variation_cell(const koksma_integrand *f, unsigned u, const size_t *low,
                         size_t k, double *x, double *work);

koksma_status ki_variation_check_dim(size_t dim, koksma_error *err);
/* Why Delta is not finite: the value at x, or the differences. */
koksma_status ki_variation_bad_value(const koksma_integrand *f, const double *x,
                                     koksma_error *err);
koksma_status ki_variation_too_large(koksma_error *err);
koksma_status ki_variation_stopped(const ki_variation_watch *w, koksma_error *err);

/* An estimate of which every cell was looked at. */
static inline koksma_estimate ki_variation_exact(double v)
{
    return (koksma_estimate){v, v, v, 1.0};
}

/* Each fills out->level and faces for its grids, of which k is the finest, unless
 * it returns KOKSMA_STOPPED.  The tree and the random cells do one grid; faces may
 * be NULL. */
koksma_status ki_variation_dense(koksma_variation_result *out,
                                 koksma_estimate *faces, const koksma_integrand *f,
                                 size_t k, ki_variation_watch *w,
                                 koksma_error *err);
koksma_status ki_variation_tree(koksma_variation_level *out, koksma_estimate *faces,
                                const koksma_integrand *f, size_t k,
                                ki_variation_watch *w, koksma_error *err);
koksma_status ki_variation_random(koksma_variation_level *out,
                                  koksma_estimate *faces, const koksma_integrand *f,
                                  size_t k, double samples, uint64_t seed,
                                  ki_variation_watch *w, koksma_error *err);

/* Cells of the k-grid of the cube that the tree would look at; SIZE_MAX without
 * memory. */
size_t ki_variation_tree_leaves(const koksma_integrand *f, size_t k);

#endif
