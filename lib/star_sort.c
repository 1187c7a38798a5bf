#include <string.h>

#include "star_kernels.h"

enum { DIGIT = 11, DIGITS = 6, VALUES = 1 << DIGIT };

/* Doubles from 0 to 1 are ordered like their bits, of which the top two are 0. */
static uint64_t key_of(double x)
{
    uint64_t key;

    x += 0.0; /* -0 becomes 0 */
    memcpy(&key, &x, sizeof key);
    return key;
}

static unsigned digit(double x, unsigned d)
{
    uint64_t key;

    memcpy(&key, &x, sizeof key);
    return (unsigned)(key >> d * DIGIT) & (VALUES - 1);
}

/* Turn counts of digits into the places where their records begin.  Returns
 * whether there are two different digits. */
static bool count_places(uint32_t *count, size_t n)
{
    uint32_t sum = 0;
    bool differ = true;

    for (size_t v = 0; v < VALUES; v++) {
        uint32_t here = count[v];

        if (here == n) differ = false;
        count[v] = sum;
        sum += here;
    }
    return differ;
}

/* Radix sort from the last digit on: each pass keeps the order of the one before
 * among equal digits.  Digits that all records share cost no pass, which spares
 * half of them for coordinates of few bits. */
ki_keyed *ki_sort_axis(koksma_points p, size_t k, ki_keyed *a, ki_keyed *b)
{
    uint32_t count[DIGITS][VALUES];

    memset(count, 0, sizeof count);
    for (size_t i = 0; i < p.n; i++) {
        uint64_t key = key_of(p.x[i * p.dim + k]);

        memcpy(&a[i].x, &key, sizeof key);
        a[i].i = (uint32_t)i;
        for (unsigned d = 0; d < DIGITS; d++)
            count[d][(key >> d * DIGIT) & (VALUES - 1)]++;
    }
    for (unsigned d = 0; d < DIGITS; d++) {
        ki_keyed *from = a;

        if (!count_places(count[d], p.n)) continue;
        for (size_t i = 0; i < p.n; i++)
            b[count[d][digit(from[i].x, d)]++] = from[i];
        a = b;
        b = from;
    }
    return a;
}
