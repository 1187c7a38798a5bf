#include <stdlib.h>

#include "error.h"
#include "gen_kernels.h"

/* Sobol' sequences: coordinate k of point i is the exclusive or of direction
 * numbers v_j of k over the bits j of the Gray code of i [Sobol' 1967; Antonov,
 * Saleev 1979], 64 binary places wide. */

enum { BITS = 64, DEGREE_MOST = 8 };

typedef struct polynomial {
    unsigned degree, inner;  /* s, and a: coefficients a_1 ... a_(s-1) in binary */
    unsigned m[DEGREE_MOST]; /* the odd numbers that start the recurrence */
} polynomial;

/* Dimension 2 first; made from data/joe_kuo_50.txt. */
static const polynomial table[] = {
#include "joe_kuo.inc"
};

typedef struct sobol {
    uint64_t v[1][BITS]; /* dim rows */
} sobol;

static void van_der_corput(uint64_t v[BITS])
{
    for (int j = 0; j < BITS; j++)
        v[j] = (uint64_t)1 << (BITS - 1 - j);
}

/* v_j = a_1 v_(j-1) ^ ... ^ a_(s-1) v_(j-s+1) ^ v_(j-s) ^ (v_(j-s) >> s). */
static void directions(uint64_t v[BITS], const polynomial *p)
{
    unsigned s = p->degree;

    for (unsigned j = 0; j < BITS; j++) {
        if (j < s) {
            v[j] = (uint64_t)p->m[j] << (BITS - 1 - j);
            continue;
        }
        v[j] = v[j - s] ^ (v[j - s] >> s);
        for (unsigned i = 1; i < s; i++)
            if (p->inner >> (s - 1 - i) & 1) v[j] ^= v[j - i];
    }
}

static koksma_status prepare(koksma_gen *g, koksma_error *err)
{
    sobol *s = ki_alloc(g->opts.dim, sizeof s->v[0]);

    _Static_assert(sizeof table / sizeof table[0] == 49, "dimensions 2 to 50");
    if (s == NULL) return ki_fail_memory(err, "the direction numbers");
    van_der_corput(s->v[0]);
    for (size_t k = 1; k < g->opts.dim; k++)
        directions(s->v[k], &table[k - 1]);
    g->state = s;
    return KOKSMA_OK;
}

/* bits/2^64, without the bits behind the 53 that a double has. */
static double fraction(uint64_t bits)
{
    int leading = bits != 0 ? __builtin_clzll(bits) : 0;

    if (leading < 11) bits &= UINT64_MAX << (11 - leading);
    return (double)bits * 0x1p-64;
}

static void fill(const koksma_gen *g, double *x, uint64_t first, size_t count)
{
    const sobol *s = g->state;
    size_t dim = g->opts.dim;

    for (size_t k = 0; k < dim; k++) {
        const uint64_t *v = s->v[k];
        uint64_t bits = 0, gray = first ^ (first >> 1);

        for (int j = 0; gray >> j > 0; j++) {
            if (gray >> j & 1) bits ^= v[j];
            if (j == BITS - 1) break;
        }
        for (size_t i = 0; i < count; i++) {
            x[i * dim + k] = fraction(bits);
            /* The Gray codes of i and i + 1 differ in the lowest zero bit of i. */
            if (i + 1 < count) bits ^= v[__builtin_ctzll(~(first + i))];
        }
    }
}

const ki_gen_kernel ki_gen_sobol = {prepare, fill, NULL};
