#include <string.h>

#include "l2_divide_kernels.h"

/* Numbers >= 0 are in the order of their bits, and sorting those digit by digit is
 * stable: equal coordinates stay in the order of their points. */

enum { BITS = 11, DIGITS = 1 << BITS };

static void count_digits(const ki_l2_key *key, size_t n, int shift, size_t *begin)
{
    size_t sum = 0;

    memset(begin, 0, DIGITS * sizeof *begin);
    for (size_t i = 0; i < n; i++)
        begin[key[i].bits >> shift & (DIGITS - 1)]++;
    for (size_t j = 0; j < DIGITS; j++) {
        size_t count = begin[j];

        begin[j] = sum;
        sum += count;
    }
}

ki_l2_key *ki_l2_sort(ki_l2_key *key, ki_l2_key *spare, size_t n)
{
    size_t begin[DIGITS];

    for (int shift = 0; shift < 64; shift += BITS) {
        ki_l2_key *other = spare;

        count_digits(key, n, shift, begin);
        for (size_t i = 0; i < n; i++)
            spare[begin[key[i].bits >> shift & (DIGITS - 1)]++] = key[i];
        spare = key;
        key = other;
    }
    return key;
}
