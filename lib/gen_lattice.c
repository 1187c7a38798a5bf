#include <stdlib.h>

#include "error.h"
#include "gen_kernels.h"

/* Rank-1 lattices: coordinate k of point i is i z_k / n modulo 1, the largest
 * double not above it.  What distinguishes them is where the z_k come from. */

typedef struct lattice {
    size_t dim;
    uint64_t z[];
} lattice;

static koksma_status start(koksma_gen *g, size_t wanted, koksma_error *err)
{
    const koksma_gen_opts *o = &g->opts;
    lattice *l;
    size_t bytes;

    if (o->vector_size != wanted)
        return ki_fail(err, KOKSMA_EINVAL, 0,
                       "%s in dimension %zu takes a vector of %zu, not of %zu",
                       g->family->name, o->dim, wanted, o->vector_size);
    if (__builtin_mul_overflow(o->dim, sizeof l->z[0], &bytes) ||
        (l = calloc(1, sizeof *l + bytes)) == NULL)
        return ki_fail_memory(err, "the generating vector");
    l->dim = o->dim;
    g->state = l;
    return KOKSMA_OK;
}

static koksma_status prepare_lattice(koksma_gen *g, koksma_error *err)
{
    koksma_status status = start(g, g->opts.dim, err);
    lattice *l = g->state;

    for (size_t k = 0; status == KOKSMA_OK && k < l->dim; k++)
        l->z[k] = g->opts.vector[k] % g->opts.n;
    return status;
}

/* 1, a, a^2, ... [Korobov 1959] */
static koksma_status prepare_korobov(koksma_gen *g, koksma_error *err)
{
    koksma_status status = start(g, 1, err);
    uint64_t n = g->opts.n;
    lattice *l = g->state;

    for (size_t k = 0; status == KOKSMA_OK && k < l->dim; k++)
        l->z[k] = k == 0 ? 1 % n
                         : (uint64_t)((ki_u128)l->z[k - 1] * g->opts.vector[0] % n);
    return status;
}

/* 1, F_(m-1) for n = F_m. */
static koksma_status prepare_fibonacci(koksma_gen *g, koksma_error *err)
{
    uint64_t n = g->opts.n, before = 1, f = 1;
    koksma_status status;
    lattice *l;

    if (g->opts.dim != 2)
        return ki_fail(err, KOKSMA_EINVAL, 0,
                       "dimension %zu: Fibonacci lattices are plane", g->opts.dim);
    while (f < n) {
        uint64_t sum = before + f;

        if (sum < f || sum > n)
            return sum < f
                       ? ki_fail(err, KOKSMA_EINVAL, 0,
                                 "%ju points: no Fibonacci number", (uintmax_t)n)
                       : ki_fail(err, KOKSMA_EINVAL, 0,
                                 "%ju points: %ju and %ju are Fibonacci numbers",
                                 (uintmax_t)n, (uintmax_t)f, (uintmax_t)sum);
        before = f;
        f = sum;
    }
    status = start(g, 0, err);
    l = g->state;
    if (status == KOKSMA_OK) {
        l->z[0] = 1 % n;
        l->z[1] = before % n;
    }
    return status;
}

static void fill(const koksma_gen *g, double *x, uint64_t first, size_t count)
{
    const lattice *l = g->state;
    uint64_t n = g->opts.n;

    for (size_t k = 0; k < l->dim; k++) {
        uint64_t z = l->z[k], r = (uint64_t)((ki_u128)first * z % n);

        for (size_t i = 0; i < count; i++) {
            x[i * l->dim + k] = ki_ratio(r, n);
            r = r >= n - z ? r - (n - z) : r + z;
        }
    }
}

const ki_gen_kernel ki_gen_lattice = {prepare_lattice, fill, NULL};
const ki_gen_kernel ki_gen_korobov = {prepare_korobov, fill, NULL};
const ki_gen_kernel ki_gen_fibonacci = {prepare_fibonacci, fill, NULL};
