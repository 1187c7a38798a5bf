#ifndef KOKSMA_TESTS_EXACT_H
#define KOKSMA_TESTS_EXACT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "num.h"

/* Integers and ratios that do not round, for truths that 128 bits do not hold.
 * They owe nothing to lib/ but the type of an interval. */

/* A sign, and words of 64 bits of which the first is the least and the last is not
 * 0; 0 has no words.  More than EXACT_WORDS words abort. */
enum { EXACT_WORDS = 24 };

typedef struct exact_int {
    bool negative;
    unsigned used;
    uint64_t word[EXACT_WORDS];
} exact_int;

exact_int exact_of(int64_t v);
/* v 2^bits, which must be an integer. */
exact_int exact_scaled(double v, unsigned bits);
/* The least bits, no less than `bits`, for which all x 2^bits are integers. */
unsigned exact_bits(const double *x, size_t count, unsigned bits);

exact_int exact_plus(exact_int a, exact_int b);
exact_int exact_minus(exact_int a, exact_int b);
exact_int exact_times(exact_int a, exact_int b);
exact_int exact_times_of(exact_int a, int64_t b);
exact_int exact_shifted(exact_int a, unsigned bits); /* a 2^bits */
exact_int exact_abs(exact_int a);
int exact_sign(exact_int a);               /* -1, 0, 1 */
int exact_order(exact_int a, exact_int b); /* the sign of a - b */

/* num / den, den > 0. */
typedef struct exact_ratio {
    exact_int num, den;
} exact_ratio;

/* The sign of r - s, and of r - v for any v but a NaN. */
int exact_ratio_order(exact_ratio r, exact_ratio s);
int exact_against(exact_ratio r, double v);
bool exact_contains(koksma_interval v, exact_ratio r);
/* Whether the interval holds the root of r, r >= 0. */
bool exact_contains_root(koksma_interval v, exact_ratio r);
/* r to within some units in the last place. */
long double exact_value(exact_ratio r);

#endif
