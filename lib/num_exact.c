#include "num_exact.h"

#include <math.h>
#include <stdbool.h>

#include "num_wide.h"

/* |v| = mantissa 2^(exponent - 53), the mantissa below 2^53. */
static uint64_t take_apart(double v, int *exponent)
{
    return (uint64_t)ldexp(frexp(fabs(v), exponent), 53);
}

/* Add three words from word i on, and the carry as far as it goes; or take them
 * away. */
static void add_words(ki_wide *sum, const uint64_t *words, int i, bool minus)
{
    bool carry = false;

    for (int j = 0; i + j < KI_WIDE_WORDS && (j < 3 || carry); j++) {
        ki_u128 old = sum->word[i + j], word = j < 3 ? words[j] : 0;
        ki_u128 now = minus ? old - word - carry : old + word + carry;

        sum->word[i + j] = (uint64_t)now;
        carry = now >> 64 & 1;
    }
}

/* frexp's exponents are at least -1073, so that bit is not negative; a product has
 * 106 bits, and 63 more for the shift. */
void ki_wide_add(ki_wide *sum, double a, double b)
{
    int ea, eb;
    ki_u128 product = take_apart(a, &ea);
    uint64_t words[3];

    if (a == 0.0 || b == 0.0) return;
    product *= take_apart(b, &eb);

    int bit = ea + eb - 106 + 64 * KI_WIDE_FRACTION, shift = bit % 64;

    words[0] = (uint64_t)product << shift;
    words[1] = (uint64_t)((product << shift) >> 64);
    words[2] = shift > 0 ? (uint64_t)(product >> 64) >> (64 - shift) : 0;
    add_words(sum, words, bit / 64, (a < 0.0) != (b < 0.0));
}

int ki_wide_sign(const ki_wide *sum)
{
    if (sum->word[KI_WIDE_WORDS - 1] >> 63) return -1;
    for (int i = 0; i < KI_WIDE_WORDS; i++)
        if (sum->word[i] != 0) return 1;
    return 0;
}
