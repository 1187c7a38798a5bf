#include "gen_kernels.h"
#include "rng_kernels.h"

/* What is done to the coordinates of any family, whatever made them. */

void ki_gen_shift(const koksma_gen *g, double *x, size_t count)
{
    size_t dim = g->opts.dim;

    for (size_t k = 0; k < dim; k++) {
        koksma_rng r = ki_gen_stream(g, UINT64_MAX - k);
        uint64_t shift = koksma_rng_next(&r);

        /* In 64 binary places, where the sum modulo 1 is that of integers. */
        for (size_t i = 0; i < count; i++)
            x[i * dim + k] =
                ki_rng_fraction((uint64_t)(x[i * dim + k] * 0x1p64) + shift);
    }
}

/* Exact, for 1 - x of an x >= 1/2 is. */
void ki_gen_fold(double *x, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        double v = x[i] < 0.5 ? 2.0 * x[i] : 2.0 * (1.0 - x[i]);

        x[i] = v < 1.0 ? v : 1.0 - 0x1p-53;
    }
}
