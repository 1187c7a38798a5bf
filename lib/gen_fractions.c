#include <string.h>

#include "gen_kernels.h"
#include "rng_kernels.h"

/* Integers to fractions, many at a time. */

enum { LANES = 16 };

/* A 53-bit integer as a double, in steps that every vector unit has: each half is
 * put behind the leading bit of a large double, and the one sum that brings them
 * together is exact. */
static inline double whole(uint64_t v)
{
    uint64_t high = (v >> 32) | 0x4530000000000000u; /* 2^84 + 2^32 (v >> 32) */
    uint64_t low = (v & UINT32_MAX) | 0x4330000000000000u; /* 2^52 + ... */
    double h, l;

    memcpy(&h, &high, sizeof h);
    memcpy(&l, &low, sizeof l);
    return (h - 0x1.00000001p84) + l;
}

KI_GEN_CLONES static void scatter(double *x, size_t stride, const uint64_t *bits,
                                  size_t count)
{
    double lane[LANES];
    size_t at = 0;

    for (; at + LANES <= count; at += LANES, bits += LANES) {
        for (size_t i = 0; i < LANES; i++)
            lane[i] = whole(bits[i] >> 11) * 0x1p-53;
        for (size_t i = 0; i < LANES; i += 4, x += 4 * stride) {
            x[0] = lane[i];
            x[stride] = lane[i + 1];
            x[2 * stride] = lane[i + 2];
            x[3 * stride] = lane[i + 3];
        }
    }
    for (; at < count; at++, x += stride)
        *x = ki_rng_fraction(*bits++);
}

KI_GEN_CLONES static void draw(double *x, koksma_rng r, size_t count)
{
    size_t at = 0;

    for (; at + LANES <= count; at += LANES)
        for (size_t i = 0; i < LANES; i++)
            x[at + i] = whole(ki_rng_at(r, at + i) >> 11) * 0x1p-53;
    for (; at < count; at++)
        x[at] = ki_rng_fraction(ki_rng_at(r, at));
}

/* Compilers do not agree on the names of versions, which stay in this file. */
void ki_fractions(double *x, size_t stride, const uint64_t *bits, size_t count)
{
    scatter(x, stride, bits, count);
}

void ki_random_fractions(double *x, koksma_rng r, size_t count)
{
    draw(x, r, count);
}
