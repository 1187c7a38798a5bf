#include "gen_kernels.h"

/* Niederreiter's sequence in base 2 [Niederreiter 1988] with the choices of
 * [Bratley, Fox, Niederreiter 1994]: coordinate k has the k-th irreducible
 * polynomial p over the field of two elements, by value of its bits, of degree e.
 * Row j = q e + u of its matrix, 0 <= u < e, is the sequence v_u, v_(u+1), ... of
 * the linear recurrence with characteristic polynomial p^(q+1) that starts with q e
 * zeros and then ones, as many as p^(q+1) still wants. */

enum { BITS = KI_BINARY_BITS };

/* Polynomials as bits, that of x^0 lowest. */
static int degree(uint32_t p) { return 31 - __builtin_clz(p); }

static uint32_t remainder_of(uint32_t a, uint32_t b)
{
    while (a != 0 && degree(a) >= degree(b))
        a ^= b << (degree(a) - degree(b));
    return a;
}

static uint32_t next_irreducible(uint32_t p)
{
    for (uint32_t d = 2; 2 * degree(d) <= degree(p); d++)
        if (remainder_of(p, d) == 0) d = 1, p++;
    return p;
}

static ki_u128 product(ki_u128 power, uint32_t p)
{
    ki_u128 sum = 0;

    for (; p > 0; p &= p - 1)
        sum ^= power << __builtin_ctz(p);
    return sum;
}

static bool parity(ki_u128 bits)
{
    return __builtin_parityll((uint64_t)(bits >> 64) ^ (uint64_t)bits);
}

/* The length <= BITS + e terms of the recurrence of `power`, of degree q e + e <=
 * BITS + 2e < 128. */
static void recur(bool *term, int length, ki_u128 power, int zeros, int e)
{
    ki_u128 window = 0;
    int m = zeros + e;

    for (int r = 0; r < length; r++) {
        term[r] = r < m ? r >= zeros : parity(power & window);
        /* window has terms r+1-m, ..., r in its bits 0, ..., m-1 once r >= m-1. */
        window = window >> 1 | (ki_u128)term[r] << (m - 1);
    }
}

static void directions(uint64_t v[BITS], size_t k, void *state)
{
    uint32_t *p = state;
    bool term[BITS + 32];
    ki_u128 power = 1;
    int e;

    *p = next_irreducible(k > 0 ? *p + 1 : 2);
    e = degree(*p);
    for (int r = 0; r < BITS; r++)
        v[r] = 0;
    for (int j = 0; j < BITS; j++) {
        if (j % e == 0) {
            power = product(power, *p);
            recur(term, BITS + e, power, j, e);
        }
        for (int r = 0; r < BITS; r++)
            v[r] |= (uint64_t)term[r + j % e] << (BITS - 1 - j);
    }
}

static koksma_status prepare(koksma_gen *g, koksma_error *err)
{
    uint32_t polynomial = 0;

    return ki_binary_prepare(g, directions, &polynomial, err);
}

const ki_gen_kernel ki_gen_niederreiter = {prepare, ki_binary_fill,
                                           ki_binary_release};
