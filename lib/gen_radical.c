#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "error.h"
#include "gen_kernels.h"
#include "rng.h"

/* Radical inverses: the digits of an index, read backwards behind the point.
 * All of it counts in integers, and one division ends it: sums of powers of 1/b
 * in doubles are wrong by up to 7 ulps and can return 1. */

enum { LANES = 8, TILE = 64 };

/* r/p by long division, 53 bits from the first that is not 0. */
static double divide_slowly(ki_u128 r, ki_u128 p)
{
    uint64_t bits = 0;
    int places = 0;

    if (r == 0) return 0.0;
    while (bits < KI_EXACT / 2) {
        r <<= 1;
        bits <<= 1;
        if (r >= p) {
            r -= p;
            bits |= 1;
        }
        places++;
    }
    return ldexp((double)bits, -places);
}

/* r/p for p <= 2^53.  The division rounds to nearest; when that went up, as the
 * exact residue (one fma: q*p - r fits a double) says, the double below is the
 * one wanted.  q is positive then, and the double below has the bits one less. */
KI_GEN_INLINE double divide(double r, double p)
{
    double q = r / p;
    uint64_t bits;

    memcpy(&bits, &q, sizeof bits);
    bits -= fma(q, p, -r) > 0.0;
    memcpy(&q, &bits, sizeof q);
    return q;
}

/* The same of many r, side by side. */
KI_GEN_FMA_CLONES static void divide_all(double *x, size_t stride, const double *r,
                                         size_t count, double p)
{
    double q[LANES];
    size_t at = 0;

    for (; at + LANES <= count; at += LANES) {
        for (size_t i = 0; i < LANES; i++)
            q[i] = divide(r[at + i], p);
        for (size_t i = 0; i < LANES; i++, x += stride)
            *x = q[i];
    }
    for (; at < count; at++, x += stride)
        *x = divide(r[at], p);
}

double ki_ratio(ki_u128 r, ki_u128 p)
{
    return p <= KI_EXACT ? divide((double)(uint64_t)r, (double)(uint64_t)p)
                         : divide_slowly(r, p);
}

unsigned ki_radical_digits(uint32_t base)
{
    unsigned digits = 0;

    for (uint64_t left = UINT64_MAX; left > 0; left /= base)
        digits++;
    return digits;
}

int ki_radical_scramble(ki_radical *r, koksma_scramble how, koksma_rng rng)
{
    unsigned digits = ki_radical_digits(r->base);

    r->how = how;
    r->nested = rng;
    if (how != KOKSMA_SCRAMBLE_DIGITS) return 0;

    r->permutation = ki_alloc(digits, r->base * sizeof *r->permutation);
    if (r->permutation == NULL) return -1;
    for (unsigned j = 0; j < digits; j++) {
        uint32_t *p = r->permutation + (size_t)j * r->base;

        /* Fisher and Yates, from the inside out. */
        for (uint32_t d = 0; d < r->base; d++) {
            uint32_t at = (uint32_t)koksma_rng_below(&rng, d + 1);

            p[d] = p[at];
            p[at] = d;
        }
    }
    return 0;
}

/* Beyond 2^53, one index at a time. */
static double inverse(uint32_t base, uint64_t index)
{
    ki_u128 reversed = 0, p = 1;

    for (; index > 0; index /= base) {
        reversed = reversed * base + index % base;
        p *= base;
    }
    return p > 1 ? ki_ratio(reversed, p) : 0.0;
}

static void fill_plain(uint32_t base, double *x, size_t stride, uint64_t first,
                       size_t count)
{
    uint64_t weight[64], p = 1, reversed = 0, index = first,
                         last = first + (count - 1);
    double numerator[TILE];
    uint32_t digit[64];
    int digits = 0;

    for (; p <= last && p <= KI_EXACT / base; p *= base)
        digits++;
    if (p <= last) {
        for (size_t i = 0; i < count; i++)
            x[i * stride] = inverse(base, first + i);
        return;
    }
    for (int j = 0; j < digits; j++, index /= base) {
        weight[j] = j > 0 ? weight[j - 1] / base : p / base;
        digit[j] = (uint32_t)(index % base);
        reversed += digit[j] * weight[j];
    }
    for (size_t i = 0; i < count; i++) {
        int j = 0;

        numerator[i % TILE] = (double)(int64_t)reversed;
        if (i % TILE == TILE - 1 || i == count - 1)
            divide_all(x + (i - i % TILE) * stride, stride, numerator, i % TILE + 1,
                       (double)p);
        for (; j < digits && ++digit[j] == base; j++) {
            digit[j] = 0;
            reversed -= (base - 1) * weight[j];
        }
        if (j < digits) reversed += weight[j];
    }
}

/* A result that was rounded up to 1 is brought back below. */
double ki_radical_join(uint64_t head, uint64_t p, uint64_t tail, uint64_t tail_p)
{
    double v = ((double)head + (double)tail / (double)tail_p) / (double)p;

    return v < 1.0 ? v : 1.0 - 0x1p-53;
}

/* Permuted digits: the first places, as many as p <= 2^53 allows, make an integer
 * over p; the rest make a fraction of its unit, which changes only when the
 * index passes p. */
static void fill_permuted(const ki_radical *r, double *x, size_t stride,
                          uint64_t first, size_t count)
{
    uint64_t weight[64], p = 1, tail_p = 1, head = 0, tail = 0, index = first;
    uint32_t digit[65], base = r->base;
    unsigned digits = ki_radical_digits(base), places = 0;
    const uint32_t *permutation = r->permutation;

    while (places < digits && p <= KI_EXACT / base)
        p *= base, places++;
    for (unsigned j = places; j < digits; j++)
        tail_p *= base;
    for (unsigned j = 0; j < digits; j++, index /= base) {
        uint64_t image;

        digit[j] = (uint32_t)(index % base);
        image = permutation[(size_t)j * base + digit[j]];
        weight[j] = (j == 0 ? p : j == places ? tail_p : weight[j - 1]) / base;
        *(j < places ? &head : &tail) += image * weight[j];
    }
    for (size_t i = 0; i < count; i++) {
        const uint32_t *image = permutation;

        x[i * stride] = ki_radical_join(head, p, tail, tail_p);
        for (unsigned j = 0; j < digits; j++, image += base) {
            uint32_t old = digit[j]++;
            uint64_t *part = j < places ? &head : &tail;
            bool carry = digit[j] == base;

            if (carry) digit[j] = 0;
            /* Modulo 2^64 the difference may be negative on the way. */
            *part += ((uint64_t)image[digit[j]] - image[old]) * weight[j];
            if (!carry) break;
        }
    }
}

static void fill_nested(const ki_radical *r, double *x, size_t stride,
                        uint64_t first, size_t count)
{
    uint32_t digit[KI_DIGITS_MOST];
    unsigned digits = ki_radical_digits(r->base);
    uint64_t index = first;

    for (unsigned j = 0; j < digits; j++, index /= r->base)
        digit[j] = (uint32_t)(index % r->base);
    for (size_t i = 0; i < count; i++) {
        x[i * stride] = ki_radical_value(r, digit, digits);
        for (unsigned j = 0; j < digits && ++digit[j] == r->base; j++)
            digit[j] = 0;
    }
}

void ki_radical_fill(const ki_radical *r, double *x, size_t stride, uint64_t first,
                     size_t count)
{
    if (r->how == KOKSMA_SCRAMBLE_OWEN)
        fill_nested(r, x, stride, first, count);
    else if (r->how == KOKSMA_SCRAMBLE_DIGITS)
        fill_permuted(r, x, stride, first, count);
    else
        fill_plain(r->base, x, stride, first, count);
}
