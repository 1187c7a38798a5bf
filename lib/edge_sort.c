#include <stdlib.h>
#include <string.h>

#include "edge_kernels.h"

/* Slopes are mostly spread out: the leading bits of the slope as a fixed-point
 * number nearly sort them, digit by digit, and insertion does the rest.  Where many
 * share those bits, the C library's sort takes over. */

enum { DIGIT = 11, DIGITS = 1 << DIGIT, FEW = 24 };

static inline uint32_t leading_bits(double slope)
{
    return (uint32_t)((slope + 2.0) * 0x1p20);
}

static inline uint32_t digit_of(double slope, int shift)
{
    return leading_bits(slope) >> shift & (DIGITS - 1);
}

static void sort_digit(ki_edge_event *to, const ki_edge_event *from, size_t count,
                       int shift)
{
    uint32_t begin[DIGITS] = {0}, sum = 0;

    for (size_t j = 0; j < count; j++)
        begin[digit_of(from[j].slope, shift)]++;
    for (size_t v = 0; v < DIGITS; v++) {
        uint32_t here = begin[v];

        begin[v] = sum;
        sum += here;
    }
    for (size_t j = 0; j < count; j++)
        to[begin[digit_of(from[j].slope, shift)]++] = from[j];
}

static int by_slope(const void *a, const void *b)
{
    const ki_edge_event *e = a, *f = b;

    return (e->slope > f->slope) - (e->slope < f->slope);
}

static void sort_run(ki_edge_event *e, size_t count)
{
    if (count > FEW) {
        qsort(e, count, sizeof *e, by_slope);
        return;
    }
    for (size_t j = 1; j < count; j++) {
        ki_edge_event moved = e[j];
        size_t k = j;

        for (; k > 0 && e[k - 1].slope > moved.slope; k--)
            e[k] = e[k - 1];
        e[k] = moved;
    }
}

ki_edge_event *ki_edge_sort(ki_edge_event *a, ki_edge_event *b, size_t count)
{
    if (count <= FEW) {
        sort_run(a, count);
        return a;
    }
    sort_digit(b, a, count, 0);
    sort_digit(a, b, count, DIGIT);
    for (size_t j = 0, k; j < count; j = k) {
        for (k = j + 1; k < count; k++)
            if (leading_bits(a[k].slope) != leading_bits(a[j].slope)) break;
        if (k > j + 1) sort_run(a + j, k - j);
    }
    return a;
}
