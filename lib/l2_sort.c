#include <string.h>

#include "l2_divide_kernels.h"

/* Numbers >= 0 are in the order of their bits, and sorting those digit by digit is
 * stable: equal coordinates stay in the order of their points. */

enum { BITS = 11, DIGITS = 1 << BITS, PASSES = 6 };

/* Where each digit of each pass begins; uint32_t, as there are less than 2^31. */
typedef struct beginnings {
    uint32_t of[PASSES][DIGITS];
} beginnings;

static void count_digits(const ki_l2_key *key, size_t n, beginnings *begin)
{
    memset(begin, 0, sizeof *begin);
    for (size_t i = 0; i < n; i++)
        for (int pass = 0; pass < PASSES; pass++)
            begin->of[pass][key[i].bits >> pass * BITS & (DIGITS - 1)]++;
    for (int pass = 0; pass < PASSES; pass++) {
        uint32_t sum = 0;

        for (size_t j = 0; j < DIGITS; j++) {
            uint32_t count = begin->of[pass][j];

            begin->of[pass][j] = sum;
            sum += count;
        }
    }
}

/* Whether all keys have the digit of the first: all before it are none, and the
 * next begins behind the last. */
static bool is_constant(const uint32_t *begin, size_t digit, size_t n)
{
    return begin[digit] == 0 && (digit + 1 == DIGITS || begin[digit + 1] == n);
}

ki_l2_key *ki_l2_sort(ki_l2_key *key, ki_l2_key *spare, size_t n)
{
    beginnings begin;

    count_digits(key, n, &begin);
    for (int pass = 0; pass < PASSES; pass++) {
        uint32_t *at = begin.of[pass];
        ki_l2_key *other = spare;

        if (is_constant(at, key->bits >> pass * BITS & (DIGITS - 1), n)) continue;
        for (size_t i = 0; i < n; i++)
            spare[at[key[i].bits >> pass * BITS & (DIGITS - 1)]++] = key[i];
        spare = key;
        key = other;
    }
    return key;
}
