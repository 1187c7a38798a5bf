/* How many points the cells of a grid have. */
#include <stdlib.h>

#include "cells_kernels.h"
#include "error.h"
#include "num_wide.h"

uint64_t ki_cell_of(const double *x, size_t dim, const uint64_t *cells)
{
    uint64_t cell = 0;

    for (size_t k = 0; k < dim; k++) {
        uint64_t at = (uint64_t)ki_times(x[k], cells[k]).floor;

        cell = cell * cells[k] + (at < cells[k] ? at : cells[k] - 1);
    }
    return cell;
}

static koksma_status open_counts(uint32_t **count, uint64_t *total, uint64_t n,
                                 const uint64_t *cells, size_t dim,
                                 koksma_error *err)
{
    if (n > UINT32_MAX)
        return ki_fail(err, KOKSMA_EINVAL, 0, "more than 2^32 - 1 points");
    *total = ki_grid_total(cells, dim);
    if (*total == 0 || *total > UINT32_MAX)
        return ki_fail(err, KOKSMA_EINVAL, 0,
                       "the number of cells is not from 1 to 2^32 - 1");
    *count = ki_alloc((size_t)*total, sizeof **count);
    if (*count == NULL) return ki_fail_memory(err, "the cells");
    for (uint64_t i = 0; i < *total; i++)
        (*count)[i] = 0;
    return KOKSMA_OK;
}

static koksma_occupancy sum_up(const uint32_t *count, uint64_t total)
{
    koksma_occupancy o = {total, 0, UINT32_MAX, 0};

    for (uint64_t i = 0; i < total; i++) {
        o.empty += count[i] == 0;
        if (count[i] < o.least) o.least = count[i];
        if (count[i] > o.most) o.most = count[i];
    }
    return o;
}

koksma_status koksma_cells_occupancy(koksma_occupancy *out, koksma_points p,
                                     const uint64_t *cells, koksma_error *err)
{
    koksma_status status = koksma_points_check(p, err);
    uint32_t *count = NULL;
    uint64_t total;

    if (status == KOKSMA_OK)
        status = open_counts(&count, &total, p.n, cells, p.dim, err);
    if (status != KOKSMA_OK) return status;
    for (size_t i = 0; i < p.n; i++)
        count[ki_cell_of(p.x + i * p.dim, p.dim, cells)]++;
    *out = sum_up(count, total);
    free(count);
    return KOKSMA_OK;
}

/* ---- Radical inverses -------------------------------------------------------- */

/* floor(cells times the radical inverse of index): reversed digits times the cells
 * over base^digits, which is at most base index < 2^96; and cells are below 2^32.
 */
static uint64_t place_of(uint64_t index, uint32_t base, uint64_t cells)
{
    ki_u128 reversed = 0, power = 1;

    for (; index > 0; index /= base) {
        reversed = reversed * base + index % base;
        power *= base;
    }
    return (uint64_t)(reversed * cells / power);
}

static koksma_status check_halton(uint64_t start, uint64_t n, size_t dim,
                                  const uint32_t *bases, koksma_error *err)
{
    if (n == 0 || dim == 0) return ki_fail(err, KOKSMA_EINVAL, 0, "no points");
    if (n - 1 > UINT64_MAX - start)
        return ki_fail(err, KOKSMA_EINVAL, 0, "indices go beyond 2^64 - 1");
    for (size_t k = 0; k < dim; k++)
        if (bases[k] < 2)
            return ki_fail(err, KOKSMA_EINVAL, 0, "base %u is below 2", bases[k]);
    return KOKSMA_OK;
}

koksma_status koksma_cells_occupancy_halton(koksma_occupancy *out, uint64_t start,
                                            uint64_t n, size_t dim,
                                            const uint32_t *bases,
                                            const uint64_t *cells,
                                            koksma_error *err)
{
    koksma_status status = check_halton(start, n, dim, bases, err);
    uint32_t *count = NULL;
    uint64_t total;

    if (status == KOKSMA_OK)
        status = open_counts(&count, &total, n, cells, dim, err);
    if (status != KOKSMA_OK) return status;
    for (uint64_t i = 0; i < n; i++) {
        uint64_t cell = 0;

        for (size_t k = 0; k < dim; k++)
            cell = cell * cells[k] + place_of(start + i, bases[k], cells[k]);
        count[cell]++;
    }
    *out = sum_up(count, total);
    free(count);
    return KOKSMA_OK;
}
