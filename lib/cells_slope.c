/* Box dimensions: how counts of cells grow when the cells get smaller. */
#include <math.h>
#include <stdlib.h>

#include "cells_kernels.h"
#include "error.h"

enum { SCALES_LEAST = 3 };

/* The slope of a line through log count against log k, by least squares. */
static double slope_of(const double *k, const double *count, size_t scales)
{
    double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, n = (double)scales;

    for (size_t i = 0; i < scales; i++) {
        x += log(k[i]) / n;
        y += log(count[i]) / n;
    }
    for (size_t i = 0; i < scales; i++) {
        xx += (log(k[i]) - x) * (log(k[i]) - x);
        xy += (log(k[i]) - x) * (log(count[i]) - y);
    }
    return xy / xx;
}

koksma_cell_slope ki_slope(const double *k, const double *count, size_t scales)
{
    size_t half = (scales + 1) / 2;

    if (scales < SCALES_LEAST)
        return (koksma_cell_slope){(double)NAN, (double)NAN, scales};
    return (koksma_cell_slope){
        slope_of(k, count, scales),
        slope_of(k, count, half) -
            slope_of(k + scales - half, count + scales - half, half),
        scales};
}

/* n/ratio^dim: cells that are ratio times as wide, for floors of floors are floors.
 */
static uint64_t coarser(uint64_t n, uint64_t ratio, size_t dim)
{
    for (size_t k = 0; k < dim && n > 0; k++)
        n /= ratio;
    return n;
}

koksma_status koksma_cells_slope(koksma_cell_slope *out, const koksma_integrand *f,
                                 uint64_t n, const uint32_t *bases,
                                 const koksma_cell_count *first,
                                 const koksma_cells_opts *opts, koksma_error *err)
{
    double k[KOKSMA_SLOPE_SCALES], count[KOKSMA_SLOPE_SCALES];
    uint64_t *cells = ki_alloc(f->dim, sizeof *cells);
    koksma_status status = KOKSMA_OK;
    uint64_t ratio = opts == NULL || opts->ratio == 0 ? 2 : opts->ratio;
    size_t scales = 0;

    if (ratio == 1) status = ki_fail(err, KOKSMA_EINVAL, 0, "a ratio of 1");
    if (cells == NULL) return ki_fail_memory(err, "a grid");
    for (; status == KOKSMA_OK && n > 0 && scales < KOKSMA_SLOPE_SCALES;
         n = coarser(n, ratio, f->dim)) {
        koksma_cell_count c;
        bool divided = true;

        status = koksma_grid_choose(cells, n, f->dim, bases, err);
        for (size_t j = 0; j < f->dim && status == KOKSMA_OK; j++)
            divided = divided && cells[j] > 1;
        if (status != KOKSMA_OK || !divided) break;
        if (scales == 0 && first != NULL)
            c = *first;
        else
            status = koksma_cells_count(&c, f, cells, opts, err);
        if (status != KOKSMA_OK || c.lower == 0 || c.lower == c.total) break;
        k[scales] = pow((double)c.total, 1.0 / (double)f->dim);
        count[scales++] = (double)c.lower;
    }
    free(cells);
    if (status == KOKSMA_OK) *out = ki_slope(k, count, scales);
    return status;
}
