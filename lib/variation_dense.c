/* The variation on a grid of which every node is looked at. */
#include <math.h>
#include <stdlib.h>

#include "error.h"
#include "variation_kernels.h"

/* Rows along the last axis, one after the other. */
static koksma_status add_nodes(koksma_variation_grid *g, const koksma_integrand *f,
                               double *row, size_t k, ki_variation_watch *w,
                               koksma_error *err)
{
    size_t last = f->dim - 1, at[KOKSMA_VARIATION_DIM_MOST] = {0};
    double x[KOKSMA_VARIATION_DIM_MOST] = {0.0};

    for (;;) {
        size_t j = last;
        koksma_status status;

        for (size_t i = 0; i <= k; i++) {
            if (ki_variation_told_to_stop(w)) return ki_variation_stopped(w, err);
            x[last] = (double)i / (double)k;
            row[i] = f->value(f, x);
            w->work++;
            if (!isfinite(row[i])) return ki_variation_bad_value(f, x, err);
        }
        status = koksma_variation_add(g, row, k + 1, err);
        if (status != KOKSMA_OK) return status;
        while (j > 0 && at[j - 1] == k) {
            at[--j] = 0;
            x[j] = 0.0;
        }
        if (j == 0) return KOKSMA_OK;
        x[j - 1] = (double)++at[j - 1] / (double)k;
    }
}

koksma_status ki_variation_dense(koksma_variation_result *out,
                                 koksma_estimate *faces, const koksma_integrand *f,
                                 size_t k, ki_variation_watch *w, koksma_error *err)
{
    size_t nodes[KOKSMA_VARIATION_DIM_MOST];
    double *row = ki_alloc(k + 1, sizeof *row);
    koksma_variation_grid *g = NULL;
    koksma_status status;

    if (row == NULL) return ki_fail_memory(err, "a row of a grid");
    for (size_t j = 0; j < f->dim; j++)
        nodes[j] = k + 1;
    status = koksma_variation_open(&g, nodes, f->dim, err);
    if (status == KOKSMA_OK) status = add_nodes(g, f, row, k, w, err);
    if (status == KOKSMA_OK) status = koksma_variation_finish(out, faces, g, err);
    koksma_variation_close(g);
    free(row);
    return status;
}
