#include <math.h>

#include "gen_kernels.h"

/* Irrational numbers to 128 binary places, by integers. */

/* 256 binary places behind the point, the first in limb[3]'s top bit. */
enum { LIMBS = 4 };
typedef struct fixed {
    uint64_t limb[LIMBS];
} fixed;

/* floor(a b 2^256)/2^256 for a and b below 1, less at most LIMBS units. */
static fixed multiply(fixed a, fixed b)
{
    fixed product = {{0}};

    for (int i = 0; i < LIMBS; i++) {
        uint64_t carry = 0;

        for (int j = LIMBS - 1 - i; j < LIMBS; j++) {
            ki_u128 part = (ki_u128)a.limb[i] * b.limb[j] + carry;
            int at = i + j - LIMBS;

            if (at >= 0) part += product.limb[at];
            if (at >= 0) product.limb[at] = (uint64_t)part;
            carry = (uint64_t)(part >> 64);
        }
        product.limb[i] = carry;
    }
    return product;
}

/* Whether a + b >= 1. */
static bool reaches_one(fixed a, fixed b)
{
    uint64_t carry = 0;

    for (int i = 0; i < LIMBS; i++)
        carry = (uint64_t)(((ki_u128)a.limb[i] + b.limb[i] + carry) >> 64);
    return carry;
}

static fixed power(fixed g, size_t exponent)
{
    fixed result = g;
    bool started = false;

    for (; exponent > 0; exponent /= 2, g = multiply(g, g))
        if (exponent % 2 > 0) {
            result = started ? multiply(result, g) : g;
            started = true;
        }
    return result;
}

/* The root of g^dim + g^(dim+1) = 1 between 1/2 and 1 bit by bit: the sum rises
 * with g.  What multiplications cut off, some dim units of 2^-256, moves the root
 * by no more than a few units, since the slope is above dim/2; its powers up to the
 * thousands then have more than 128 right places. */
void ki_golden_powers(ki_u128 *alpha, size_t dim)
{
    fixed g = {{0}}, x;

    for (int bit = 64 * LIMBS - 1; bit >= 0; bit--) {
        fixed next = g;

        next.limb[bit / 64] |= (uint64_t)1 << bit % 64;
        x = power(next, dim);
        if (!reaches_one(x, multiply(x, next))) g = next;
    }
    x = g;
    for (size_t k = 0; k < dim; k++, x = multiply(x, g))
        alpha[k] = (ki_u128)x.limb[3] << 64 | x.limb[2];
}

/* The fraction f of the square root s + f of a prime p, bit by bit: as long as
 * f^2 + 2 s f < p - s^2.  Below the 128th place there is nothing but of f^2, so
 * that whole units are counted right. */
ki_u128 ki_root_fraction(uint32_t p)
{
    uint64_t s = (uint64_t)sqrt((double)p);
    ki_u128 f = 0;

    for (int bit = 127; bit >= 0; bit--) {
        ki_u128 next = f | (ki_u128)1 << bit;
        uint64_t low = (uint64_t)next, high = (uint64_t)(next >> 64);
        fixed whole = {{0, 0, low, high}}, square = multiply(whole, whole);
        ki_u128 square_places = (ki_u128)square.limb[3] << 64 | square.limb[2];
        ki_u128 of_low = (ki_u128)(2 * s) * low;
        ki_u128 of_high = (ki_u128)(2 * s) * high + (uint64_t)(of_low >> 64);
        ki_u128 places = (of_high << 64 | (uint64_t)of_low) + square_places;

        if ((uint64_t)(of_high >> 64) + (places < square_places) < p - s * s)
            f = next;
    }
    return f;
}
