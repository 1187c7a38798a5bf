#include "error.h"
#include "gen_kernels.h"
#include "rng_kernels.h"

/* Hammersley's plane set of 2^m points with every other digit of the second
 * coordinate turned round [Halton, Zaremba 1969]: with the binary digits a_0, a_1,
 * ... of i it is the sum of ((a_j + j) mod 2)/2^(j+1) over j < m. */

static koksma_status prepare(koksma_gen *g, koksma_error *err)
{
    if (g->opts.dim != 2)
        return ki_fail(err, KOKSMA_EINVAL, 0, "dimension %zu: %s is plane",
                       g->opts.dim, g->family->name);
    if ((g->opts.n & (g->opts.n - 1)) != 0)
        return ki_fail(err, KOKSMA_EINVAL, 0, "%ju points are no power of 2",
                       (uintmax_t)g->opts.n);
    return KOKSMA_OK;
}

static void fill(const koksma_gen *g, double *x, uint64_t first, size_t count)
{
    static const uint64_t ODD = 0xAAAAAAAAAAAAAAAAu;
    uint64_t n = g->opts.n;

    for (size_t i = 0; i < count; i++) {
        uint64_t digits = (first + i) ^ (ODD & (n - 1)), reversed = 0;

        for (uint64_t place = n; place > 1; place /= 2, digits /= 2)
            reversed = 2 * reversed | (digits & 1);
        x[2 * i] = ki_ratio(first + i, n);
        x[2 * i + 1] = ki_ratio(reversed, n);
    }
}

const ki_gen_kernel ki_gen_zaremba = {prepare, fill, NULL};
