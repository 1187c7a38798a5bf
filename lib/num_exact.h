#ifndef KI_NUM_EXACT_H
#define KI_NUM_EXACT_H

#include <stdint.h>

/* Private: sums of products of doubles, exactly, whatever their exponents: a
 * fixed-point number that reaches below the least product, so that nothing rounds
 * and nothing underflows.  For the few signs that ordinary arithmetic leaves open.
 *
 * 36 words stand below the point: the least bit that a product of two doubles can
 * be written with is 2^-2252.  One is above it, two's complement: terms of at most
 * 16 in absolute value may add up to 2^63. */
enum { KI_WIDE_FRACTION = 36, KI_WIDE_WORDS };

typedef struct ki_wide {
    uint64_t word[KI_WIDE_WORDS]; /* the least significant first; {{0}} is 0 */
} ki_wide;

/* Add a * b, |a| and |b| at most 4. */
void ki_wide_add(ki_wide *sum, double a, double b);

/* -1, 0 or 1. */
int ki_wide_sign(const ki_wide *sum);

#endif
