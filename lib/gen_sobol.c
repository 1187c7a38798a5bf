#include "gen_kernels.h"

/* Sobol' sequences [Sobol' 1967]: the direction numbers. */

enum { BITS = KI_BINARY_BITS, DEGREE_MOST = 13 };

typedef struct polynomial {
    unsigned degree, inner;  /* s, and a: coefficients a_1 ... a_(s-1) in binary */
    unsigned m[DEGREE_MOST]; /* the odd numbers that start the recurrence */
} polynomial;

/* Dimension 2 first; made from data/joe_kuo_1111.txt. */
static const polynomial table[] = {
#include "joe_kuo.inc"
};
_Static_assert(sizeof table / sizeof table[0] == KI_SOBOL_DIMS - 1,
               "dimension 1 needs no row");

/* v_j = a_1 v_(j-1) ^ ... ^ a_(s-1) v_(j-s+1) ^ v_(j-s) ^ (v_(j-s) >> s).
 * Dimension 1 is van der Corput's sequence. */
static void directions(uint64_t v[BITS], size_t k, void *state)
{
    const polynomial *p = &table[k > 0 ? k - 1 : 0];
    unsigned s = k > 0 ? p->degree : BITS;

    (void)state;
    for (unsigned j = 0; j < BITS; j++) {
        if (j < s) {
            v[j] = (uint64_t)(k > 0 ? p->m[j] : 1) << (BITS - 1 - j);
            continue;
        }
        v[j] = v[j - s] ^ (v[j - s] >> s);
        for (unsigned i = 1; i < s; i++)
            if (p->inner >> (s - 1 - i) & 1) v[j] ^= v[j - i];
    }
}

static koksma_status prepare(koksma_gen *g, koksma_error *err)
{
    return ki_binary_prepare(g, directions, NULL, err);
}

const ki_gen_kernel ki_gen_sobol = {prepare, ki_binary_fill, ki_binary_release};
