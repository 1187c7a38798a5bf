#include <string.h>

#include "tree_best_kernels.h"

/* Two ways to sort.  Most points are spread out: the leading bits of the coordinate
 * as a fixed-point number nearly sort them, and insertion does the rest.  Where
 * many crowd together, a radix sort of all bits of the doubles takes over. */

enum { MOST = 13, DIGITS = 6, DIGIT = 11 };

/* Doubles from 0 to 1 are ordered like their bits, of which the top two are 0. */
static inline unsigned bits_digit(double x, unsigned place)
{
    uint64_t key;

    memcpy(&key, &x, sizeof key);
    return (unsigned)(key >> place * DIGIT) & ((1 << DIGIT) - 1);
}

/* Turn counts of digits into the places where their records begin. */
static void count_places(uint32_t *count, size_t values)
{
    uint32_t sum = 0;

    for (size_t v = 0; v < values; v++) {
        uint32_t here = count[v];

        count[v] = sum;
        sum += here;
    }
}

static void load(ki_keyed *a, koksma_points p, size_t k)
{
    for (size_t i = 0; i < p.n; i++)
        a[i] = (ki_keyed){p.x[i * p.dim + k] + 0.0, (uint32_t)i}; /* no -0 */
}

/* From the last digit on: each pass keeps the order of the one before among equal
 * digits.  One that all records share costs no pass. */
static ki_keyed *sort_bits(ki_keyed *a, ki_keyed *b, size_t n)
{
    uint32_t count[1 << DIGIT];

    for (unsigned d = 0; d < DIGITS; d++) {
        ki_keyed *from = a;

        memset(count, 0, sizeof count);
        for (size_t i = 0; i < n; i++)
            count[bits_digit(a[i].x, d)]++;
        if (count[bits_digit(a[0].x, d)] == n) continue;
        count_places(count, 1 << DIGIT);
        for (size_t i = 0; i < n; i++)
            b[count[bits_digit(from[i].x, d)]++] = from[i];
        a = b;
        b = from;
    }
    return a;
}

/* Returns false when that takes more than 8 moves a point. */
static bool insert_all(ki_keyed *a, size_t n)
{
    size_t moves = 0;

    for (size_t i = 1; i < n; i++) {
        ki_keyed r = a[i];
        size_t j = i;

        if (a[j - 1].x <= r.x) continue;
        for (; j > 0 && a[j - 1].x > r.x; j--)
            a[j] = a[j - 1];
        a[j] = r;
        moves += i - j;
        if (moves > 8 * n) return false;
    }
    return true;
}

/* Sort by the first 2*bits bits after the point, in two passes: a to b to a. */
static void sort_leading(ki_keyed *a, ki_keyed *b, koksma_points p, size_t k,
                         unsigned bits)
{
    uint32_t low[1 << MOST] = {0}, high[1 << MOST] = {0};
    size_t values = (size_t)1 << bits;
    uint32_t mask = (uint32_t)values - 1;
    double scale = (double)values * (double)values;
    double top = scale - 1.0; /* 1 goes with what is just below */

    for (size_t i = 0; i < p.n; i++) {
        double v = p.x[i * p.dim + k] * scale;
        uint32_t key = (uint32_t)(v < top ? v : top);

        low[key & mask]++;
        high[key >> bits]++;
    }
    count_places(low, values);
    count_places(high, values);
    for (size_t i = 0; i < p.n; i++) {
        double x = p.x[i * p.dim + k] + 0.0, v = x * scale; /* -0 becomes 0 */
        uint32_t key = (uint32_t)(v < top ? v : top);

        b[low[key & mask]++] = (ki_keyed){x, (uint32_t)i};
    }
    for (size_t i = 0; i < p.n; i++) {
        double v = b[i].x * scale;
        uint32_t key = (uint32_t)(v < top ? v : top);

        a[high[key >> bits]++] = b[i];
    }
}

ki_keyed *ki_sort_axis(koksma_points p, size_t k, ki_keyed *a, ki_keyed *b)
{
    if (p.n < 64)
        load(a, p, k);
    else
        sort_leading(a, b, p, k,
                     p.n < (size_t)1 << 16   ? 8
                     : p.n < (size_t)1 << 23 ? 11
                                             : MOST);
    if (insert_all(a, p.n)) return a;
    load(a, p, k);
    return sort_bits(a, b, p.n);
}
