#include <math.h>
#include <stdlib.h>

#include "error.h"
#include "gen_kernels.h"
#include "rng_kernels.h"

/* Kronecker sequences: coordinate k of point i is i alpha_k modulo 1.  Each alpha
 * is kept to 128 binary places, cut off; a product with an index, modulo 1, is then
 * one of integers modulo 2^128, below the true one by less than 2^-64 at any index.
 */

enum { TILE = 256 };

typedef struct kronecker {
    size_t dim;
    ki_u128 alpha[];
} kronecker;

static kronecker *start(koksma_gen *g, koksma_error *err)
{
    kronecker *s = NULL;
    size_t bytes;

    if (__builtin_mul_overflow(g->opts.dim, sizeof s->alpha[0], &bytes) ||
        bytes > SIZE_MAX - sizeof *s || (s = malloc(sizeof *s + bytes)) == NULL) {
        (void)ki_fail_memory(err, "the multipliers");
        return NULL;
    }
    s->dim = g->opts.dim;
    g->state = s;
    return s;
}

/* Square roots of the first primes [Richtmyer 1951]. */
static koksma_status prepare_richtmyer(koksma_gen *g, koksma_error *err)
{
    kronecker *s = start(g, err);
    uint32_t prime = 1;

    for (size_t k = 0; s != NULL && k < s->dim; k++)
        s->alpha[k] = ki_root_fraction(prime = ki_next_prime(prime + 1));
    return s != NULL ? KOKSMA_OK : KOKSMA_ENOMEM;
}

/* Powers of the g < 1 with g^dim + g^(dim+1) = 1 [Roberts 2018]. */
static koksma_status prepare_rsequence(koksma_gen *g, koksma_error *err)
{
    kronecker *s = start(g, err);

    if (s == NULL) return KOKSMA_ENOMEM;
    ki_golden_powers(s->alpha, s->dim);
    return KOKSMA_OK;
}

/* A double is its fraction to 2^-128 exactly, unless it is tiny. */
static koksma_status prepare_kronecker(koksma_gen *g, koksma_error *err)
{
    const koksma_gen_opts *o = &g->opts;
    kronecker *s;

    if (o->alpha_size != o->dim)
        return ki_fail(err, KOKSMA_EINVAL, 0,
                       "%s in dimension %zu takes a vector of %zu, not of %zu",
                       g->family->name, o->dim, o->dim, o->alpha_size);
    for (size_t k = 0; k < o->dim; k++)
        if (!(o->alpha[k] >= 0.0 && o->alpha[k] <= 0x1p53))
            return ki_fail(err, KOKSMA_EINVAL, 0,
                           "multiplier %zu is %g, not in [0, 2^53]", k + 1,
                           o->alpha[k]);
    s = start(g, err);
    for (size_t k = 0; s != NULL && k < o->dim; k++) {
        double high = (o->alpha[k] - floor(o->alpha[k])) * 0x1p64;

        s->alpha[k] = (ki_u128)(uint64_t)high << 64 |
                      (uint64_t)((high - floor(high)) * 0x1p64);
    }
    return s != NULL ? KOKSMA_OK : KOKSMA_ENOMEM;
}

static void fill(const koksma_gen *g, double *x, uint64_t first, size_t count)
{
    const kronecker *s = g->state;
    uint64_t bits[TILE];

    for (size_t k = 0; k < s->dim; k++) {
        ki_u128 alpha = s->alpha[k], product = alpha * first;

        for (size_t i = 0; i < count; i += TILE) {
            size_t now = count - i < TILE ? count - i : TILE;

            for (size_t j = 0; j < now; j++, product += alpha)
                bits[j] = (uint64_t)(product >> 64);
            ki_fractions(x + i * s->dim + k, s->dim, bits, now);
        }
    }
}

const ki_gen_kernel ki_gen_richtmyer = {prepare_richtmyer, fill, NULL};
const ki_gen_kernel ki_gen_rsequence = {prepare_rsequence, fill, NULL};
const ki_gen_kernel ki_gen_kronecker = {prepare_kronecker, fill, NULL};
