#ifndef KI_NUM_WIDE_H
#define KI_NUM_WIDE_H

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

/* Private: products of 64-bit numbers, for what is decided in integers.  Compilers
 * have them under either name, for 32 bits under that of C23 alone. */
#ifdef __SIZEOF_INT128__
__extension__ typedef unsigned __int128 ki_u128;
#else
__extension__ typedef unsigned _BitInt(128) ki_u128;
#endif

/* x k as an integer and whether something is left over. */
typedef struct ki_multiple {
    ki_u128 floor;
    bool whole;
} ki_multiple;

/* floor(x k) for 0 <= x < 2^53, exactly: x is an integer of 53 bits over a power
 * of 2. */
static inline ki_multiple ki_times(double x, uint64_t k)
{
    const uint64_t hidden = (uint64_t)1 << 52;
    uint64_t bits, digits;
    ki_u128 product;
    int exponent, shift;

    memcpy(&bits, &x, sizeof bits);
    exponent = (int)(bits >> 52);
    digits = bits & (hidden - 1);
    if (exponent > 0) digits |= hidden;
    shift = 1075 - (exponent > 0 ? exponent : 1);
    product = (ki_u128)digits * k;
    if (shift >= 128) return (ki_multiple){0, product == 0};
    return (ki_multiple){product >> shift,
                         (product & (((ki_u128)1 << shift) - 1)) == 0};
}

#endif
