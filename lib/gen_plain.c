#include <math.h>

#include "error.h"
#include "gen_kernels.h"

/* Random points, and grids. */

static void fill_random(const koksma_gen *g, double *x, uint64_t first,
                        size_t count)
{
    koksma_rng r = koksma_rng_seed(g->opts.seed, g->opts.replicate);

    koksma_rng_skip(&r, first * g->opts.dim);
    ki_random_fractions(x, r, count * g->opts.dim);
}

/* m^dim, or 0 when it is 2^64 or more. */
static uint64_t power(uint64_t m, size_t dim)
{
    uint64_t p = 1;

    while (dim-- > 0 && m != 1)
        if (__builtin_mul_overflow(p, m, &p)) return 0;
    return p;
}

uint64_t ki_grid_side(const koksma_gen *g)
{
    uint64_t n = g->opts.n, m;

    if (g->opts.dim == 1) return n;
    m = (uint64_t)pow((double)n, 1.0 / (double)g->opts.dim);
    /* m is at most 2^32, and pow may have rounded either way. */
    for (uint64_t near = m > 1 ? m - 1 : 1; near <= m + 1; near++)
        if (power(near, g->opts.dim) == n) return near;
    return 0;
}

koksma_status ki_grid_check(koksma_gen *g, koksma_error *err)
{
    if (ki_grid_side(g) > 0) return KOKSMA_OK;
    return ki_fail(err, KOKSMA_EINVAL, 0,
                   "%ju points make no grid in %zu dimensions: no m^%zu",
                   (uintmax_t)g->opts.n, g->opts.dim, g->opts.dim);
}

/* (digit + half/2)/m in each axis. */
static void fill_cells(const koksma_gen *g, double *x, uint64_t first, size_t count,
                       unsigned half)
{
    size_t dim = g->opts.dim;
    uint64_t m = ki_grid_side(g);

    for (size_t i = 0; i < count; i++) {
        uint64_t index = first + i;

        for (size_t k = dim; k-- > 0; index /= m)
            x[i * dim + k] =
                ki_ratio((ki_u128)2 * (index % m) + half, (ki_u128)2 * m);
    }
}

static void fill_grid(const koksma_gen *g, double *x, uint64_t first, size_t count)
{
    fill_cells(g, x, first, count, 0);
}

static void fill_centred(const koksma_gen *g, double *x, uint64_t first,
                         size_t count)
{
    fill_cells(g, x, first, count, 1);
}

const ki_gen_kernel ki_gen_random = {NULL, fill_random, NULL};
const ki_gen_kernel ki_gen_grid = {ki_grid_check, fill_grid, NULL};
const ki_gen_kernel ki_gen_centred = {ki_grid_check, fill_centred, NULL};
