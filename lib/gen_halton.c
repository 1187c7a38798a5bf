#include <stdlib.h>

#include "error.h"
#include "gen_kernels.h"
#include "rng.h"

/* Halton and Hammersley: a radical inverse a coordinate. */

typedef struct halton {
    size_t bases;
    ki_radical radical[];
} halton;

/* Coprimality is checked pair by pair, which for primes by default is not
 * needed: only what a caller gives is checked. */
static koksma_status take_bases(halton *h, const uint32_t *bases, koksma_error *err)
{
    for (size_t k = 0; k < h->bases; k++) {
        if (bases[k] < 2)
            return ki_fail(err, KOKSMA_EINVAL, 0, "base %ju: a base is at least 2",
                           (uintmax_t)bases[k]);
        for (size_t l = 0; l < k; l++)
            if (ki_gcd(bases[k], bases[l]) > 1)
                return ki_fail(err, KOKSMA_EINVAL, 0,
                               "bases %ju and %ju have a common factor",
                               (uintmax_t)bases[l], (uintmax_t)bases[k]);
        h->radical[k].base = bases[k];
    }
    return KOKSMA_OK;
}

/* The first primes, each found by division by those before it. */
static void take_primes(halton *h)
{
    uint32_t candidate = 2;

    for (size_t k = 0; k < h->bases; candidate++) {
        size_t l = 0;

        while (l < k &&
               (uint64_t)h->radical[l].base * h->radical[l].base <= candidate &&
               candidate % h->radical[l].base != 0)
            l++;
        if (l == k || (uint64_t)h->radical[l].base * h->radical[l].base > candidate)
            h->radical[k++].base = candidate;
    }
}

static koksma_status prepare(koksma_gen *g, size_t bases, koksma_error *err)
{
    const koksma_gen_opts *o = &g->opts;
    koksma_status status = KOKSMA_OK;
    size_t bytes;
    halton *h;

    if (__builtin_mul_overflow(bases, sizeof h->radical[0], &bytes) ||
        (h = calloc(1, sizeof *h + bytes)) == NULL)
        return ki_fail_memory(err, "the bases");
    g->state = h;
    h->bases = bases;
    if (o->bases != NULL)
        status = take_bases(h, o->bases, err);
    else
        take_primes(h);
    for (size_t k = 0; k < bases && status == KOKSMA_OK; k++) {
        status = ki_check_leap(o->leap, h->radical[k].base, err);
        if (status == KOKSMA_OK && ki_radical_scramble(&h->radical[k], o->scramble,
                                                       ki_gen_stream(g, k)) != 0)
            status = ki_fail_memory(err, "the digit permutations");
    }
    return status;
}

static koksma_status prepare_halton(koksma_gen *g, koksma_error *err)
{
    return prepare(g, g->opts.dim, err);
}

static koksma_status prepare_hammersley(koksma_gen *g, koksma_error *err)
{
    return prepare(g, g->opts.dim - 1, err);
}

static void release(void *state)
{
    halton *h = state;

    for (size_t k = 0; h != NULL && k < h->bases; k++)
        free(h->radical[k].permutation);
    free(h);
}

static void fill_halton(const koksma_gen *g, double *x, uint64_t first,
                        size_t count)
{
    const halton *h = g->state;

    for (size_t k = 0; k < h->bases; k++)
        ki_radical_fill(&h->radical[k], x + k, g->opts.dim, first, count);
}

static void fill_hammersley(const koksma_gen *g, double *x, uint64_t first,
                            size_t count)
{
    const halton *h = g->state;
    size_t dim = g->opts.dim;

    for (size_t i = 0; i < count; i++)
        x[i * dim] = ki_ratio(first + i, g->opts.n);
    for (size_t k = 0; k < h->bases; k++)
        ki_radical_fill(&h->radical[k], x + k + 1, dim, first, count);
}

const ki_gen_kernel ki_gen_halton = {prepare_halton, fill_halton, release};
const ki_gen_kernel ki_gen_hammersley = {prepare_hammersley, fill_hammersley,
                                         release};
